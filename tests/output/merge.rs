//! Tiles put together: the bytes of the whole picture, or one line that says why not.

use super::encoded;
use luch::color::Rgb;
use luch::film::{BEAUTY, DEPTH, Film, Layer, Statistics, Window};
use luch::output::{Format, Options, merge};
use luch::scene::{Background, Shown};
use std::fs;
use std::path::PathBuf;
use tempfile::TempDir;

const WIDTH: u32 = 23;
const HEIGHT: u32 = 17;

/// A film of a window, whose numbers follow from their places alone.
fn film(window: Window) -> Film {
    let Window {
        left,
        top,
        width,
        height,
    } = window;
    let places = (0..height).flat_map(|j| (0..width).map(move |i| [i, j]));
    let places: Vec<[f32; 2]> = places
        .map(|[i, j]| [(left + i as i32) as f32, (top + j as i32) as f32])
        .collect();
    let light = |&[x, y]: &[f32; 2]| [x * 0.1 + 3.0, y * 0.37 + 9.0, (x * y).abs().sqrt(), 1.0];
    let beauty: Vec<[f32; 4]> = places.iter().map(light).collect();
    let depth = places.iter().map(|[x, y]| 0.1 + x / 7.0 + y / 3.0);
    Film {
        width,
        height,
        left,
        top,
        display_width: WIDTH,
        display_height: HEIGHT,
        layers: vec![
            Layer {
                values: beauty.into_flattened(),
                ..BEAUTY
            },
            Layer {
                values: depth.collect(),
                ..DEPTH
            },
        ],
        background: Background::plain(Rgb::BLACK, Shown::Never),
        manifests: Vec::new(),
        complete: true,
        statistics: Statistics::default(),
    }
}

fn exr(film: &Film) -> Vec<u8> {
    let options = Options {
        comments: Some("luch render ü.glb".into()),
        ..Options::default()
    };
    encoded(film, Format::Exr, &options)
}

/// A folder with these files, and their paths in order.
fn files(contents: &[Vec<u8>]) -> (TempDir, Vec<PathBuf>) {
    let folder = tempfile::tempdir().unwrap();
    let numbered = contents.iter().enumerate();
    let paths = numbered.map(|(number, bytes)| {
        let path = folder.path().join(format!("{number}.exr"));
        fs::write(&path, bytes).unwrap();
        path
    });
    let paths = paths.collect();
    (folder, paths)
}

fn merged(contents: &[Vec<u8>]) -> Result<Vec<u8>, String> {
    let (folder, paths) = files(contents);
    let said = |error: luch::Error| {
        let folder = format!("{}/", folder.path().display());
        error.to_string().replace(&folder, "")
    };
    merge(&paths, None).map_err(said)
}

#[test]
fn tiles_put_together_are_the_bytes_of_the_whole_picture() {
    let display = Window::whole(WIDTH, HEIGHT);
    for whole in [display, display.grown(5)] {
        let expected = exr(&film(whole));
        for [across, down] in [[1, 1], [1, 3], [4, 1], [3, 4], [1, whole.height]] {
            let tiles = (1..=down).flat_map(|j| (1..=across).map(move |i| [i, j]));
            let tiles = tiles.map(|[i, j]| whole.column(i, across).strip(j, down));
            let mut tiles: Vec<Vec<u8>> = tiles.map(|tile| exr(&film(tile))).collect();
            tiles.reverse();
            assert!(
                merged(&tiles).as_ref() == Ok(&expected),
                "{across} x {down} of {whole:?}"
            );
        }
    }
}

#[test]
fn a_comment_stands_before_those_of_the_tiles() {
    let tiles = [1, 2].map(|number| exr(&film(Window::whole(WIDTH, HEIGHT).strip(number, 2))));
    let (_folder, paths) = files(&tiles);
    let bytes = merge(&paths, Some("luch merge 0 1")).unwrap();
    let comments = "luch merge 0 1\nluch render ü.glb".as_bytes();
    assert!(bytes.windows(comments.len()).any(|it| it == comments));
}

#[test]
fn tiles_that_make_no_picture_are_told_why() {
    let tile = |number| film(Window::whole(WIDTH, HEIGHT).strip(number, 3));
    let [one, two, three] = [1, 2, 3].map(tile);
    let [first, second, third] = [&one, &two, &three].map(exr);
    let refused = |tiles: &[&Vec<u8>]| {
        let tiles: Vec<Vec<u8>> = tiles.iter().map(|tile| (*tile).clone()).collect();
        merged(&tiles).unwrap_err()
    };
    assert_eq!(
        refused(&[&first, &third]),
        "0.exr: the picture, 0,0,23,17, lacks the pixels 0,5,23,11 in all of the files, expected each in one; render the tile that has them"
    );
    assert_eq!(
        refused(&[&first, &second, &second, &third]),
        "2.exr: dataWindow: has the pixels 0,5,23,11, which are in 1.exr, too, expected each in one tile; leave one of the files out"
    );
    let larger = Film {
        display_height: 18,
        ..two.clone()
    };
    assert!(refused(&[&first, &exr(&larger), &third]).starts_with(
        "1.exr: displayWindow: 23 x 18 pixels from 0,0, expected 23 x 17 pixels from 0,0 as in"
    ));
    let mut flat = two.clone();
    flat.layers.truncate(1);
    assert!(
        refused(&[&first, &exr(&flat), &third])
            .starts_with("1.exr: channels: A (half), B (half), G (half), R (half), expected A (half), B (half), G (half), R (half), Z (float) as in")
    );
    // What may differ may.
    let other = Options {
        comments: Some("luch render elsewhere.glb".into()),
        ..Options::default()
    };
    let other = encoded(&two, Format::Exr, &other);
    let whole = exr(&film(Window::whole(WIDTH, HEIGHT)));
    assert!(merged(&[first, other, third]) == Ok(whole));
}

/// Cut off anywhere, or with any byte another: an error or a picture, and no panic.
#[test]
fn a_damaged_tile_is_an_error_and_no_panic() {
    let whole = exr(&film(Window::whole(WIDTH, HEIGHT)));
    for length in (0..whole.len()).step_by(7) {
        assert!(
            merged(&[whole[..length].to_vec()]).is_err(),
            "{length} bytes"
        );
    }
    for at in 0..whole.len().min(1200) {
        for value in [0, 0x7f, 0xff] {
            let mut damaged = whole.clone();
            damaged[at] = value;
            let _ = merged(&[damaged]);
        }
    }
    let folder = tempfile::tempdir().unwrap();
    let error = merge(&[folder.path().to_owned()], None).unwrap_err();
    assert!(error.to_string().ends_with("expected a file"), "{error}");
    assert!(merge(&[], None).is_err());
}
