//! Parts of pictures: which pixels, where they lie, and what cannot be asked.

use super::{Folder, asset};
use exr::math::Vec2;
use exr::meta::MetaData;

/// Left, top, width and height of the data window, and the width and height of the display window.
fn windows(folder: &Folder, name: &str) -> ([i64; 4], [usize; 2]) {
    let file = folder.read(name);
    let read = MetaData::read_from_buffered(file.as_slice(), true).expect("an EXR");
    let header = &read.headers[0];
    let (data, display) = (
        header.data_window(),
        header.shared_attributes.display_window,
    );
    assert_eq!(display.position, Vec2(0, 0));
    let place = [data.position.0, data.position.1].map(i64::from);
    let size = [data.size.0, data.size.1].map(|side| side as i64);
    (
        [place[0], place[1], size[0], size[1]],
        [display.size.0, display.size.1],
    )
}

#[test]
fn an_exr_says_where_its_pixels_lie_and_a_png_is_the_pixels() {
    let folder = Folder::new(&[]);
    let scene = asset("scenes/figure-4.toml");
    let render = |more: &[&str], name: &str| {
        let [exr, png] = ["exr", "png"].map(|extension| format!("{name}.{extension}"));
        let usual = ["render", &scene, "--size", "48x32", "-o", &exr, "-o", &png];
        folder.luch_succeeds(&[&usual, more].concat());
        let png = image::load_from_memory(&folder.read(&png)).expect("a PNG");
        (windows(&folder, &exr), png.to_rgb8())
    };
    let (whole, picture) = render(&[], "whole");
    assert_eq!(whole, ([0, 0, 48, 32], [48, 32]));
    for (name, more, [left, top, width, height]) in [
        ("crop", &["--crop", "5,6,40,20"][..], [5, 6, 35, 14]),
        ("strip", &["--tile", "2/3"], [0, 10, 48, 11]),
        ("tile", &["--tile", "4,1/4,3"], [36, 0, 12, 10]),
        ("margin", &["--overscan", "3"], [-3, -3, 54, 38]),
        (
            "corner",
            &["--overscan", "3", "--crop", "-3,-1,9,2"],
            [-3, -1, 12, 3],
        ),
        (
            "upper",
            &["--overscan", "3", "--tile", "1/2"],
            [-3, -3, 54, 19],
        ),
    ] {
        let (found, part) = render(more, name);
        assert_eq!(found, ([left, top, width, height], [48, 32]), "{name}");
        assert_eq!(
            [part.width(), part.height()].map(i64::from),
            [width, height]
        );
        for (i, j, pixel) in part.enumerate_pixels() {
            let [i, j] = [i64::from(i) + left, i64::from(j) + top];
            let is_inside = (0..48).contains(&i) && (0..32).contains(&j);
            assert!(
                !is_inside || picture.get_pixel(i as u32, j as u32) == pixel,
                "{name}: {i}, {j}"
            );
        }
    }
}

#[test]
fn a_window_that_cannot_be_is_told_what_can() {
    let folder = Folder::with_scene_and_model();
    for (more, error) in [
        (
            &["--crop", "0,0,9,8"][..],
            "--crop 0,0,9,8 reaches beyond the picture of 8 x 8 pixels; keep it inside, or add a margin with --overscan",
        ),
        (
            &["--crop", "-4,0,8,8", "--overscan", "3"],
            "--crop -4,0,8,8 reaches beyond the picture and its margin, -3,-3,11,11; keep it inside, or make --overscan larger",
        ),
        (
            &["--tile", "1/9"],
            "--tile asks for 1 tiles across and 9 down of 8 x 8 pixels, some without a pixel; ask for fewer",
        ),
        (
            &["--overscan", "100000"],
            "a picture of 200008 x 200008 pixels needs 5600448 MB of memory, more than the 4294 MB allowed; make it smaller",
        ),
        (
            &["--tile", "5/4"],
            "invalid value '5/4' for '--tile <I/N|I,J/NX,NY>': there is no tile 5 of 4; the first is 1, the last 4 (see luch \
             render --help)",
        ),
        (
            &["--crop", "0,0,0.5,0.5"],
            "invalid value '0,0,0.5,0.5' for '--crop <X0,Y0,X1,Y1>': expected four whole numbers of pixels with commas between, \
             as in 0,0,320,240 (see luch render --help)",
        ),
        (
            &["--crop", "0,0,4,4", "--tile", "1/2"],
            "the argument '--crop <X0,Y0,X1,Y1>' cannot be used with '--tile <I/N|I,J/NX,NY>' (see luch render --help)",
        ),
    ] {
        let arguments = [&["render", "scene.toml", "-o", "a.exr"], more].concat();
        folder.luch_fails(&arguments, 1, error);
    }
    assert_eq!(folder.names(), ["model.obj", "scene.toml"]);
}

#[test]
fn tiles_are_merged_to_what_one_run_gives() {
    let folder = Folder::new(&[]);
    let scene = asset("scenes/figure-4.toml");
    let render = |more: &[&str], name: &str| {
        let usual = ["render", &scene, "--size", "24x16", "--layers", "all"];
        folder.luch_succeeds(&[&usual[..], &["-q", "-o", name], more].concat());
    };
    render(&["--overscan", "1"], "whole.exr");
    for tile in ["1/2", "2/2"] {
        let name = format!("{}.exr", &tile[..1]);
        render(&["--overscan", "1", "--tile", tile], &name);
    }
    let ran = folder.luch_succeeds(&["merge", "2.exr", "1.exr", "-o", "merged.exr"]);
    assert_eq!(ran.out(), "wrote merged.exr\n");
    // All that stands behind the attributes, which differ in comments alone.
    let [whole, merged] = ["whole.exr", "merged.exr"].map(|name| folder.read(name));
    let blocks = |bytes: &[u8]| {
        let read = exr::block::read(std::io::Cursor::new(bytes), true).expect("an EXR");
        let mut header = read.headers()[0].clone();
        let comments = header
            .own_attributes
            .comments
            .take()
            .map(|text| text.to_string());
        let blocks: Vec<String> = read
            .all_chunks(true)
            .expect("blocks")
            .map(|chunk| format!("{:?}", chunk.expect("a block")))
            .collect();
        (
            format!("{:?}", header.data_window()),
            header.all_named_attributes().count(),
            blocks,
            comments,
        )
    };
    let ((window, attributes, pixels, _), (found, count, merged, comments)) =
        (blocks(&whole), blocks(&merged));
    assert!(window == found && attributes == count && pixels == merged);
    let comments = comments.unwrap_or_default();
    assert!(
        comments.starts_with("luch merge 2.exr 1.exr -o merged.exr\nluch render "),
        "{comments}"
    );
    for (arguments, code, error) in [
        (
            &["merge", "1.exr", "2.exr", "-o", "1.exr"][..],
            1,
            "1.exr: is one of the tiles; choose another output",
        ),
        (
            &["merge", "1.exr", "2.exr", "-o", "a.png"],
            1,
            "a.png: its name does not end in .exr; tiles are merged to an EXR",
        ),
        (
            &["merge", "lost.exr", "-o", "a.exr"],
            1,
            "lost.exr: cannot open: No such file or directory (os error 2)",
        ),
    ] {
        folder.luch_fails(arguments, code, error);
    }
}
