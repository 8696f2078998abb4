//! Sequences: which frames, where they go, and what each shows.

use super::{EXR, Folder, PNG, SCENE};
use serde_json::json;
use std::fs;

/// A triangle that goes 2 to the right in a second, and has come back after the next.
fn moving() -> Folder {
    let floats =
        |numbers: &[f32]| -> Vec<u8> { numbers.iter().flat_map(|x| x.to_le_bytes()).collect() };
    let positions = floats(&[-1.0, -1.0, 0.0, 1.0, -1.0, 0.0, 0.0, 1.0, 0.0]);
    let times = floats(&[0.0, 1.0, 2.0]);
    let places = floats(&[0.0, 0.0, 0.0, 2.0, 0.0, 0.0, 0.0, 0.0, 0.0]);
    let bytes = [positions, times, places].concat();
    let gltf = json!({
        "asset": { "version": "2.0" },
        "scene": 0,
        "scenes": [{ "nodes": [0] }],
        "nodes": [{ "mesh": 0 }],
        "meshes": [{ "primitives": [{ "attributes": { "POSITION": 0 } }] }],
        "animations": [{
            "channels": [{ "sampler": 0, "target": { "node": 0, "path": "translation" } }],
            "samplers": [{ "input": 1, "output": 2 }]
        }],
        "accessors": [
            { "bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3", "min": [-1, -1, 0], "max": [1, 1, 0] },
            { "bufferView": 1, "componentType": 5126, "count": 3, "type": "SCALAR", "min": [0], "max": [2] },
            { "bufferView": 2, "componentType": 5126, "count": 3, "type": "VEC3" }
        ],
        "bufferViews": [
            { "buffer": 0, "byteOffset": 0, "byteLength": 36 },
            { "buffer": 0, "byteOffset": 36, "byteLength": 12 },
            { "buffer": 0, "byteOffset": 48, "byteLength": 36 }
        ],
        "buffers": [{ "byteLength": 84, "uri": "a.bin" }]
    });
    Folder::new(&[("a.gltf", gltf.to_string().as_bytes()), ("a.bin", &bytes)])
}

/// A picture in no time, from where nothing is chosen that could depend on the moment.
const STILL: [&str; 8] = [
    "--size",
    "24x16",
    "--samples",
    "1",
    "--eye",
    "0,0,9",
    "--ground",
    "off",
];

#[test]
fn a_frame_is_the_still_picture_of_its_moment() {
    let folder = moving();
    let still = [&["render", "a.gltf", "--target", "0,0,0"][..], &STILL].concat();
    let frames = [
        "--frames",
        "1,13,25,37,3",
        "-o",
        "f.##.png",
        "-o",
        "f_%03d.exr",
    ];
    let ran = folder.luch_succeeds(&[&still[..], &frames].concat());
    // Frames 13 and 37 show the same place, on the way out and back.
    for (frame, time) in [("01", "0"), ("13", "0.5"), ("25", "1"), ("37", "1.5")] {
        folder.luch_succeeds(&[&still[..], &["--time", time, "-o", "still.png"]].concat());
        assert_eq!(
            folder.read(&format!("f.{frame}.png")),
            folder.read("still.png"),
            "{frame}"
        );
    }
    assert_ne!(folder.read("f.01.png"), folder.read("f.13.png"));
    assert_eq!(folder.read("f.37.png"), folder.read("f.13.png"));
    let exr = folder.read("f_003.exr");
    assert!(exr.starts_with(EXR) && exr.windows(12).any(|name| name == b"imageCounter"));
    assert!(exr.windows(15).any(|name| name == b"framesPerSecond"));
    assert!(
        ran.out()
            .contains("frame 13: wrote f.13.png, f_013.exr (search tree built)")
    );
    assert!(
        ran.out().contains(
            "5 frames rendered, 0 there and whole; search tree built 5 times, kept 0 times"
        )
    );
    assert!(folder.names().iter().all(|name| !name.ends_with(".tmp")));
}

#[test]
fn a_frame_is_the_same_alone_as_among_others_with_the_camera_of_frame_1() {
    let folder = moving();
    let render = [
        "render",
        "a.gltf",
        "--size",
        "24x16",
        "--samples",
        "1",
        "--fps",
        "4",
    ];
    folder.luch_succeeds(&[&render[..], &["--frames", "1-8", "-o", "all.#.png"]].concat());
    folder.luch_succeeds(
        &[
            &render[..],
            &["--frames", "4", "-o", "one.#.png", "--threads", "1"],
        ]
        .concat(),
    );
    assert_eq!(folder.read("one.4.png"), folder.read("all.4.png"));
    assert_ne!(folder.read("all.1.png"), folder.read("all.4.png"));
    folder.luch_succeeds(&[&render[..6], &["-o", "still.png"]].concat());
    assert_eq!(folder.read("all.1.png"), folder.read("still.png"));
}

#[test]
fn a_turntable_starts_with_the_usual_picture_and_keeps_the_tree() {
    let folder = Folder::with_scene_and_model();
    let render = ["render", "model.obj", "--size", "24x16", "--samples", "1"];
    let ran = folder.luch_succeeds(&[&render[..], &["--turntable", "4"]].concat());
    folder.luch_succeeds(&[&render[..], &["-o", "still.png"]].concat());
    assert_eq!(folder.read("model.0001.png"), folder.read("still.png"));
    assert_ne!(folder.read("model.0002.png"), folder.read("still.png"));
    assert!(folder.read("model.0004.png").starts_with(PNG));
    assert!(
        ran.out()
            .contains("search tree built 1 times, kept 3 times")
    );
    let some = [
        "--turntable",
        "4",
        "--frames",
        "2",
        "-o",
        "some.#.png",
        "--json",
    ];
    let ran = folder.luch_succeeds(&[&render[..], &some].concat());
    assert_eq!(ran.json()["rendered"], 1);
    assert_eq!(folder.read("some.2.png"), folder.read("model.0002.png"));
    folder.luch_fails(
        &[&render[..], &["--turntable", "4", "--frames", "2,5"]].concat(),
        1,
        "frame 5 is past the last one of --turntable 4",
    );
}

#[test]
fn whole_files_stay_and_cut_ones_are_made_again() {
    let folder = Folder::with_scene_and_model();
    let render = [
        "render",
        "scene.toml",
        "--frames",
        "1-4",
        "-o",
        "a.#.exr",
        "-o",
        "a.#.png",
        "--skip-existing",
    ];
    folder.luch_succeeds(&render);
    let cut = |name: &str| {
        let bytes = folder.read(name);
        fs::write(folder.path(name), &bytes[..bytes.len() - 5]).expect("writable");
        bytes
    };
    let (exr, png) = (cut("a.2.exr"), cut("a.3.png"));
    let old = fs::metadata(folder.path("a.1.exr")).and_then(|file| file.modified());
    let ran = folder.luch_succeeds(&render);
    assert!(
        ran.out()
            .contains("frame 1: a.1.exr, a.1.png are there and whole\n"),
        "{}",
        ran.out()
    );
    assert!(
        ran.out().contains("2 frames rendered, 2 there and whole"),
        "{}",
        ran.out()
    );
    assert_eq!((folder.read("a.2.exr"), folder.read("a.3.png")), (exr, png));
    let new = fs::metadata(folder.path("a.1.exr")).and_then(|file| file.modified());
    assert_eq!(new.ok(), old.ok());
    // With nothing to do, nothing is read.
    fs::remove_file(folder.path("scene.toml")).expect("a file");
    folder.luch_succeeds(&render);
    let ran = folder.luch_succeeds(&["render", "scene.toml", "-o", "a.1.png", "--skip-existing"]);
    assert_eq!(ran.out(), "a.1.png is there and whole\n");
}

#[test]
fn what_makes_no_sequence_is_one_error() {
    let folder = Folder::with_scene_and_model();
    let see = "(see luch render --help)";
    for (arguments, error) in [
        (
            &["--frames", "1-2", "-o", "b/shot.exr"][..],
            "b/shot.exr: expected one place for the number of a frame, as in shot.####.exr or %04d"
                .to_owned(),
        ),
        (
            &["-o", "shot.####.exr"],
            "shot.####.exr: is a name for frames; say which, as in --frames 1-48, or --frames 1"
                .into(),
        ),
        (
            &["--frames", "1", "-o", "-"],
            "-o - takes one picture; give the frames names, as in -o shot.####.png".into(),
        ),
        (
            &["--frames", "1", "--time", "1"],
            "--time is the moment of one picture; frames have moments of their own (--fps)".into(),
        ),
        (
            &["--frames", "1-99999999999"],
            format!(
                "invalid value '1-99999999999' for '--frames <LIST>': expected frames from 1 to 1000000, as in 1-48, \
                 1-100x2, 1-5:2 or 1,5,9-12 {see}"
            ),
        ),
    ] {
        folder.luch_fails(&[&["render", "scene.toml"], arguments].concat(), 1, &error);
    }
    let twice = [
        "render",
        "scene.toml",
        "--frames",
        "1",
        "-o",
        "a.#.png",
        "-o",
        "a.%d.png",
    ];
    folder.luch_fails(&twice, 1, "a.1.png: is given twice as an output");
    assert_eq!(folder.names(), ["model.obj", "scene.toml"]);
}

#[test]
fn open_job_description_is_told_progress_status_and_failure() {
    let folder = Folder::with_scene_and_model();
    let render = ["render", "scene.toml", "--progress", "openjd"];
    let ran = folder.luch_succeeds(&[&render[..], &["--frames", "1-3", "-o", "a.#.png"]].concat());
    let told: Vec<&str> = ran
        .out()
        .lines()
        .filter(|line| line.starts_with("openjd_"))
        .collect();
    assert_eq!(told.last(), Some(&"openjd_progress: 100.0"), "{told:?}");
    assert!(
        told.iter().any(|line| line.starts_with("openjd_status: ")),
        "{told:?}"
    );
    assert_eq!(ran.err, "");
    let ran = folder.luch(&[&render[..], &["-o", "-"]].concat());
    assert!(ran.err.contains("both want standard output"), "{}", ran.err);
    let ran = folder.luch(&["render", "lost.toml", "--progress", "openjd", "-o", "a.png"]);
    assert_eq!(ran.code, Some(1));
    let fail = ran
        .out()
        .lines()
        .find_map(|line| line.strip_prefix("openjd_fail: "));
    assert!(
        fail.is_some_and(|fail| fail.starts_with("lost.toml: cannot open")),
        "{}",
        ran.out()
    );
}

#[test]
fn progress_is_of_all_frames() {
    let folder = Folder::new(&[("scene.toml", SCENE.as_bytes())]);
    let ran = folder.luch_succeeds(&["render", "scene.toml", "--frames", "1-3", "-o", "a.#.png"]);
    assert!(ran.err.ends_with("Progress: 100%\n"), "{}", ran.err);
}

#[cfg(unix)]
#[test]
fn a_frame_that_cannot_be_written_ends_the_sequence() {
    let folder = Folder::with_scene_and_model();
    fs::create_dir(folder.path("a.2.png")).expect("a folder");
    let ran = folder.luch(&[
        "render",
        "scene.toml",
        "-q",
        "--frames",
        "1-9",
        "-o",
        "a.#.png",
    ]);
    assert_eq!(ran.code, Some(2));
    assert_eq!(ran.err, "error: a.2.png: is a folder, expected a file\n");
    assert_eq!(
        folder.names(),
        ["a.1.png", "a.2.png", "model.obj", "scene.toml"]
    );
}
