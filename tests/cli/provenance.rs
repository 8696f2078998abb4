//! What an EXR tells of where it comes from.

use super::{Folder, SCENE};
use exr::meta::MetaData;
use exr::meta::attribute::AttributeValue;

/// An attribute in words, if the file has it.
fn said(exr: &[u8], name: &str) -> Option<String> {
    let meta = MetaData::read_from_buffered(exr, true).expect("an EXR");
    let mut all = meta
        .headers
        .iter()
        .flat_map(|header| header.all_named_attributes());
    let (_, value) = all.find(|(key, _)| *key == name.as_bytes())?;
    match value {
        AttributeValue::Text(text) => {
            Some(String::from_utf8(text.bytes().to_vec()).expect("UTF-8"))
        }
        AttributeValue::F64(number) => Some(number.to_string()),
        other => Some(format!("{other:?}")),
    }
}

/// A scene below a folder, lit by a picture, with a model beside it.
fn folder() -> Folder {
    let folder = Folder::with_scene_and_model();
    let scene = format!("{SCENE}[[model]]\npath = \"../model.obj\"\n");
    std::fs::create_dir(folder.path("below")).expect("a folder");
    std::fs::write(folder.path("below/scene.toml"), scene).expect("a file");
    std::fs::write(
        folder.path("sky.hdr"),
        b"#?RADIANCE\n\n-Y 1 +X 2\n\x40\x40\x40\x81\x40\x40\x40\x81",
    )
    .expect("a file");
    folder
}

#[test]
fn every_file_that_was_read_is_named_with_its_hash() {
    let folder = folder();
    let arguments = [
        "render",
        "below/scene.toml",
        "--environment",
        "sky.hdr",
        "-o",
        "a.exr",
    ];
    folder.luch_succeeds(&arguments);
    let exr = folder.read("a.exr");
    let names = [0, 1, 2].map(|number| said(&exr, &format!("luch/input/{number}/file")));
    // As it was given, or without a folder.
    let expected = ["below/scene.toml", "model.obj", "sky.hdr"];
    assert_eq!(names, expected.map(|name| Some(name.to_owned())));
    // What `printf 'v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n' | sha256sum` says.
    assert_eq!(
        said(&exr, "luch/input/1/sha256").as_deref(),
        Some("697b00ab13410c52a542d2e9c63711fcc04e9cbf6c0d3439a9b43cc812e6e713")
    );
    assert_eq!(said(&exr, "luch/input/3/file"), None);
}

#[test]
fn an_environment_is_never_overwritten() {
    let folder = folder();
    let sky = folder.read("sky.hdr");
    std::fs::write(folder.path("sky.exr"), &sky).expect("a file");
    let arguments = [
        "render",
        "scene.toml",
        "--environment",
        "sky.exr",
        "-o",
        "sky.exr",
    ];
    let error = "sky.exr: was read for this picture; choose another output";
    folder.luch_fails(&arguments, 1, error);
    assert_eq!(folder.read("sky.exr"), sky);
}

#[test]
fn an_exr_tells_what_made_it_and_how() {
    let folder = folder();
    let arguments = [
        "render",
        "scene.toml",
        "--samples",
        "4",
        "-o",
        "a.exr",
        "--owner",
        "me",
    ];
    folder.luch_succeeds(&arguments);
    let exr = folder.read("a.exr");
    for (name, expected) in [
        ("owner", "me"),
        (
            "comments",
            "luch render scene.toml --samples 4 -o a.exr --owner me",
        ),
        ("luch/version", env!("CARGO_PKG_VERSION")),
        ("luch/settings/samples", "4"),
        ("luch/settings/filter", "box"),
        ("luch/settings/shading", "blinn-phong"),
        // 8 x 8 pixels.
        ("luch/samples", "256"),
        ("luch/bvh/leaves", "1"),
    ] {
        assert_eq!(said(&exr, name).as_deref(), Some(expected), "{name}");
    }
    for name in ["luch/commit", "luch/rays/all", "worldToNDC", "near", "far"] {
        assert!(said(&exr, name).is_some(), "{name}");
    }
}

#[test]
fn two_runs_leave_the_same_bytes_on_any_number_of_threads() {
    let folder = folder();
    let arguments = [
        "render",
        "below/scene.toml",
        "--layers",
        "all",
        "--adaptive",
        "-o",
        "a.exr",
    ];
    let runs = ["1", "3", "1"].map(|threads| {
        let mut command = folder.command(&arguments);
        // The command line, which the file holds, stays the same.
        let ran = command.env("RAYON_NUM_THREADS", threads).output();
        assert!(ran.expect("the program runs").status.success());
        folder.read("a.exr")
    });
    assert!(runs[0] == runs[1] && runs[0] == runs[2]);
}

#[test]
fn a_file_says_when_it_was_made_only_where_that_is_asked_for() {
    let folder = folder();
    let date = |arguments: &[&str], epoch: Option<&str>| {
        let mut command = folder.command(&["render", "scene.toml", "-o", "a.exr"]);
        command.args(arguments).env_remove("SOURCE_DATE_EPOCH");
        if let Some(epoch) = epoch {
            command.env("SOURCE_DATE_EPOCH", epoch);
        }
        let ran = command.output().expect("the program runs");
        let error = String::from_utf8_lossy(&ran.stderr).into_owned();
        (said(&folder.read("a.exr"), "capDate"), error)
    };
    assert_eq!(date(&[], None).0, None);
    let said = Some("2000:02:29 00:00:00".to_owned());
    for arguments in [&[][..], &["--timestamp"]] {
        assert_eq!(date(arguments, Some("951782400")).0, said);
    }
    assert!(date(&["--timestamp"], None).0.is_some());
    let (_, error) = date(&[], Some("yesterday"));
    assert_eq!(
        error,
        "error: SOURCE_DATE_EPOCH is \"yesterday\", expected seconds since 1970 as a whole number; unset it\n"
    );
}
