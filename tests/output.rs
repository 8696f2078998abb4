//! What luch writes, other readers read: crate `image` for PNG, crate `exr` for EXR.

#![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

mod as_exr;
mod as_png;
mod destination;
mod display;
mod header;

use luch::Error;
use luch::color::Rgb;
use luch::film::{BEAUTY, DEPTH, FAR_AWAY, Film, Layer, Statistics};
use luch::output::{Format, Options, encode};
use luch::scene::{Background, Shown};
use std::io::{self, Write};
use std::path::Path;

/// A film of these pixels, `width` a row, seen at distances 1, 2, 3...; the last is far away.
fn film(width: u32, shown: Shown, pixels: &[[f32; 4]]) -> Film {
    let mut depth: Vec<f32> = (1..=pixels.len()).map(|t| t as f32).collect();
    *depth.last_mut().unwrap() = FAR_AWAY;
    let layer = |layer: Layer, values| Layer { values, ..layer };
    Film {
        width,
        height: pixels.len() as u32 / width,
        left: 0,
        top: 0,
        display_width: width,
        display_height: pixels.len() as u32 / width,
        layers: vec![
            layer(BEAUTY, pixels.as_flattened().to_vec()),
            layer(DEPTH, depth),
        ],
        background: Background::plain(Rgb::new(0.5, 0.25, 1.0), shown),
        complete: true,
        statistics: Statistics::default(),
    }
}

fn encoded(film: &Film, format: Format, options: &Options) -> Vec<u8> {
    let mut bytes = Vec::new();
    encode(film, format, options, Path::new("test"), &mut bytes).unwrap();
    bytes
}

#[test]
fn the_same_film_becomes_the_same_bytes() {
    let pixels: Vec<[f32; 4]> = (0..4096u32)
        .map(|at| [at as f32 / 4096.0, (at % 64) as f32, (at % 7) as f32, 1.0])
        .collect();
    let film = film(64, Shown::Always, &pixels);
    let options = Options {
        comments: Some("luch render".into()),
        ..Options::default()
    };
    let one_thread = rayon::ThreadPoolBuilder::new().num_threads(1).build();
    for format in [Format::Png, Format::Exr] {
        let once = encoded(&film, format, &options);
        assert_eq!(once, encoded(&film, format, &options));
        let alone = one_thread.as_ref().unwrap();
        assert_eq!(once, alone.install(|| encoded(&film, format, &options)));
    }
}

#[test]
fn the_extension_names_the_format_in_either_case() {
    let of = |name: &str| Format::of(Path::new(name)).ok();
    assert_eq!(of("a.png"), Some(Format::Png));
    assert_eq!(of("b/a.b.EXR"), Some(Format::Exr));
    assert_eq!([of("a.jpg"), of("png"), of(".png"), of("-")], [None; 4]);
    let error = Format::of(Path::new("a.jpg")).unwrap_err();
    assert!(matches!(error, Error::Unsupported { .. }));
    assert!(error.to_string().starts_with("a.jpg: "), "{error}");
    assert!(error.to_string().contains(".png or .exr"), "{error}");
}

/// Has room for so many bytes, then is full.
struct Full(usize);

impl Write for Full {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        match self.0.checked_sub(bytes.len()) {
            Some(room) => self.0 = room,
            None => return Err(io::ErrorKind::StorageFull.into()),
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

#[test]
fn a_full_disk_is_an_error_wherever_it_ends() {
    let film = film(1, Shown::Always, &[[1.0; 4], [0.5; 4]]);
    for format in [Format::Png, Format::Exr] {
        let options = Options::default();
        let size = encoded(&film, format, &options).len();
        for room in 0..size {
            let written = encode(&film, format, &options, Path::new("a"), &mut Full(room));
            match written {
                Err(Error::Io { reason, .. }) => {
                    assert_eq!(reason.kind(), io::ErrorKind::StorageFull);
                }
                other => panic!("{format:?} in {room} bytes: {other:?}"),
            }
        }
    }
}

#[test]
fn an_unfinished_film_is_never_written() {
    let unfinished = Film {
        complete: false,
        ..film(1, Shown::Always, &[[1.0; 4]])
    };
    let mut out = Vec::new();
    let options = Options::default();
    let error = encode(&unfinished, Format::Png, &options, Path::new("a"), &mut out).unwrap_err();
    assert_eq!(
        error.to_string(),
        "a: is not finished, its render was cancelled"
    );
    assert!(out.is_empty());
}

#[test]
fn a_film_without_pixels_or_beauty_is_an_error() {
    let whole = film(1, Shown::Always, &[[1.0; 4]]);
    let without_pixels = Film {
        width: 0,
        ..whole.clone()
    };
    let without_beauty = Film {
        layers: Vec::new(),
        ..whole.clone()
    };
    let too_wide = Film {
        width: u32::MAX,
        ..whole
    };
    for film in [without_pixels, without_beauty, too_wide] {
        for format in [Format::Png, Format::Exr] {
            let options = Options::default();
            let result = encode(&film, format, &options, Path::new("a"), &mut io::sink());
            assert!(matches!(result, Err(Error::Malformed { .. })));
        }
    }
}
