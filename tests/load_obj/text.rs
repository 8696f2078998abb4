//! The file as text: line ends, encodings, what is ignored, what is wrong.

use super::files::{TRIANGLE, folder, open, problem, warnings};
use luch::load::{self, obj};

#[test]
fn every_way_to_end_a_line_gives_the_same_model() {
    let plain = open(TRIANGLE);
    let mut with_mark = b"\xef\xbb\xbf".to_vec();
    with_mark.extend(TRIANGLE.bytes());
    let utf_16: Vec<u8> = [0xff, 0xfe]
        .into_iter()
        .chain(TRIANGLE.bytes().flat_map(|byte| [byte, 0]))
        .collect();
    for text in [
        TRIANGLE.replace('\n', "\r\n").into_bytes(),
        TRIANGLE.replace('\n', "\r").into_bytes(),
        TRIANGLE.replace("f 1 2 3", "f 1 \\\n2 \\\n 3").into_bytes(),
        TRIANGLE.replace(' ', "\t ").into_bytes(),
        TRIANGLE.trim_end().as_bytes().to_vec(),
        with_mark,
        utf_16,
    ] {
        assert_eq!(open(text).meshes, plain.meshes);
    }
}

#[test]
fn latin_1_names_are_read() {
    let model = open(b"o gr\xfcn\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n");
    assert_eq!(model.shapes[0].name, "gr\u{fc}n");
}

#[test]
fn what_is_ignored_is_told() {
    let text = format!(
        "{TRIANGLE}curv 0 1 1 2\ncurv 0 1\nv 0 0 0 2\ns 1\nf 1/7 2//-3 3\nv nan 0 0\nf 1 2 5\ncall a.obj\ncsh rm a\n"
    );
    assert_eq!(
        warnings(&open(text)),
        [
            "statement \"curv\" is not supported and ignored (2 times)",
            "statement \"call\" is not supported and ignored",
            "statement \"csh\" is not supported and ignored",
            "the fourth number of a vertex, its weight, is ignored",
            "a corner names a texture coordinate or a normal that is not there, and has none (2 times)",
            "a triangle with a vertex that is no finite point is dropped",
        ]
    );
}

#[test]
fn a_wrong_line_is_named() {
    for (line, expected) in [
        ("v 1 2", "a vertex has too few numbers (2), expected x y z"),
        ("v 1 2 x", "a vertex has \"x\", expected a number"),
        ("v 1 2 0x3", "a vertex has \"0x3\", expected a number"),
        (
            "vt",
            "a texture coordinate has too few numbers (0), expected u v",
        ),
        ("vn 1 2", "a normal has too few numbers (2), expected x y z"),
        ("v 1,5 2 3", "a vertex has \"1,5\", expected a number"),
    ] {
        let text = format!("{TRIANGLE}\n{line}\n");
        assert_eq!(problem(&text), format!("line 6: {expected}"));
        let joined = format!("# one \\\nv 0 \\\n0 0\nv 1 0 0\nv 0 1 0\n{line}\n");
        assert_eq!(problem(&joined), format!("line 6: {expected}"));
    }
}

#[test]
fn a_wrong_face_costs_that_face() {
    for (line, expected) in [
        ("f 1 2 91", "face names vertex 91, there are 3"),
        ("f 1 2 -9", "face names vertex -9, there are 3"),
        ("f 0 1 2", "face names vertex 0, indices start at 1"),
        (
            "f 1 2 99999999999999999999",
            "face names vertex 99999999999999999999, there are 3",
        ),
        (
            "f 1 2 4294967296",
            "face names vertex 4294967296, there are 3",
        ),
        ("f 1.5 2 3", "face has \"1.5\", expected an index"),
        ("f 1 2 /3", "face corner \"/3\" names no vertex"),
        (
            "f 1/2/3/4 2 3",
            "face corner \"1/2/3/4\" has 4 numbers, expected at most 3",
        ),
        ("f", "face has no corner, expected 3 or more"),
    ] {
        let expected = format!("line 6: {expected}");
        let model = open(format!("{TRIANGLE}\n{line}\n"));
        assert_eq!(model.facts.triangles, 1);
        assert_eq!(
            warnings(&model),
            [format!("{expected}; the face is left out")]
        );
        let nothing_else = TRIANGLE.replace("f 1 2 3\n", "\n\n");
        assert_eq!(problem(format!("{nothing_else}{line}\n")), expected);
    }
    let model = open(format!("f 7 8 9\nf\n{TRIANGLE}f\n"));
    assert_eq!(
        warnings(&model),
        [
            "line 1: face names vertex 7, there are 3; the face is left out",
            "a further face with a wrong line is left out (2 times)"
        ]
    );
}

#[test]
fn nothing_to_draw_is_an_error() {
    let nothing = "has nothing to draw, expected a face with finite vertices";
    let no_faces = TRIANGLE.replace('f', "#");
    for text in ["", "\0\0\0", "# nothing\n", &no_faces] {
        assert_eq!(problem(text), nothing);
    }
    assert_eq!(problem(TRIANGLE.replace("1 0 0", "1e400 0 0")), nothing);
    let folder = folder(&[]);
    let error = obj::open(folder.path(), &load::Options::default())
        .unwrap_err()
        .to_string();
    assert!(error.ends_with("is a folder, expected a file"), "{error}");
}
