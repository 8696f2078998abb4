//! What a render says: choices, progress, the summary in words and as JSON, or nothing.

use super::Folder;
use serde_json::json;

#[test]
fn each_choice_and_each_file_is_said_once() {
    let folder = Folder::with_scene_and_model();
    let ran = folder.luch_succeeds(&["render", "model.obj", "--size", "8x8"]);
    let choices: Vec<&str> = ran.out().lines().take(3).collect();
    assert_eq!(
        choices,
        [
            "camera: none in the file; a three-quarter view, fitted to the model",
            "light: none in the file; the environment",
            "background: light grey (an EXR is transparent there)",
        ]
    );
    let rest: Vec<&str> = ran.out().lines().skip(3).collect();
    assert_eq!(rest.len(), 4, "{rest:?}");
    assert!(
        rest[0].starts_with("1 triangle, 1 node, 1 leaf, depth 1, 576 B, SAH cost "),
        "{}",
        rest[0]
    );
    assert!(
        rest[1].starts_with("rays: ")
            && rest[1].contains(" camera (")
            && rest[1].contains(" a pixel), ")
            && rest[1].ends_with(" % of what search alone reaches"),
        "{}",
        rest[1]
    );
    for phase in ["load ", ", build ", ", render ", ", write "] {
        assert!(rest[2].contains(phase), "{}", rest[2]);
    }
    assert_eq!(rest[3], "wrote model.png");
}

#[test]
fn on_a_pipe_progress_is_lines_that_end_at_100() {
    let folder = Folder::with_scene_and_model();
    let ran = folder.luch_succeeds(&["render", "scene.toml", "--size", "64x64", "--samples", "4"]);
    let percents: Vec<u32> = ran
        .err
        .lines()
        .map(|line| {
            let percent = line
                .strip_prefix("Progress: ")
                .and_then(|l| l.strip_suffix('%'));
            percent.and_then(|p| p.parse().ok()).expect(line)
        })
        .collect();
    assert_eq!(percents.last(), Some(&100));
    assert!(
        percents.windows(2).all(|pair| pair[0] < pair[1]),
        "{percents:?}"
    );
}

#[test]
fn quiet_says_nothing_but_errors() {
    let text = format!("mtllib lost.mtl\n{}", super::TRIANGLE);
    let folder = Folder::new(&[("a.obj", text.as_bytes())]);
    let ran = folder.luch_succeeds(&["render", "a.obj", "-q", "--size", "8x8"]);
    assert_eq!((ran.out(), ran.err.as_str()), ("", ""));
    folder.luch_fails(
        &["render", "lost.obj", "-q"],
        1,
        "lost.obj: cannot open: No such file or directory (os error 2)",
    );
}

#[test]
fn json_is_all_that_standard_output_has() {
    let folder = Folder::with_scene_and_model();
    let ran = folder.luch_succeeds(&[
        "render",
        "model.obj",
        "--size",
        "16x8",
        "--threads",
        "1",
        "--json",
        "-o",
        "a.png",
        "-o",
        "a.exr",
    ]);
    let json = ran.json();
    for (field, expected) in [
        ("/input", json!("model.obj")),
        ("/files_read", json!(["model.obj"])),
        ("/outputs", json!(["a.png", "a.exr"])),
        ("/width", json!(16)),
        ("/height", json!(8)),
        ("/samples", json!(16)),
        ("/display", json!("pbr-neutral")),
        ("/exposure", json!(0.0)),
        ("/warnings", json!([])),
        ("/threads", json!(1)),
        (
            "/scene",
            json!({"triangles": 1, "spheres": 0, "planes": 0, "lights": 0}),
        ),
        ("/rays/lost_in_layers", json!(0)),
        ("/bvh/nodes", json!(1)),
    ] {
        assert_eq!(json.pointer(field), Some(&expected), "{field}");
    }
    assert_eq!(json["choices"].as_array().map(Vec::len), Some(3));
    // A triangle has edges, and none are in the corners.
    let mean = json["mean_samples"].as_f64().expect("a mean");
    assert!(4.0 < mean && mean < 16.0, "{mean}");
    let rays = |kind: &str| json["rays"][kind].as_u64().expect("a count");
    assert_eq!(rays("camera") as f64, mean * 16.0 * 8.0);
    let sum: u64 = ["camera", "transparent", "shadow", "mirror", "refracted"]
        .map(rays)
        .iter()
        .sum();
    assert_eq!(sum, rays("total"));
    for number in [
        "/seconds/load",
        "/seconds/build",
        "/seconds/render",
        "/seconds/write",
        "/bvh/leaves",
        "/bvh/depth",
        "/bvh/bytes",
        "/bvh/sah_cost",
        "/rays/millions_per_second",
        "/rays/search_share",
    ] {
        assert!(
            json.pointer(number).is_some_and(|n| n.is_number()),
            "{number}"
        );
    }
    let fields = json.as_object().map_or(0, |object| object.len());
    assert_eq!(fields, 17);
    let quiet = folder.luch_succeeds(&["render", "scene.toml", "-q", "--json"]);
    assert_eq!(quiet.err, "");
    assert_eq!(quiet.json()["display"], "srgb");
}

#[test]
fn rays_that_end_among_transparent_layers_are_warned_of() {
    // 70 sheets, one behind the other.
    let mut obj = "mtllib a.mtl\nusemtl a\n".to_owned();
    for z in 0..70 {
        let z = -z;
        obj += &format!("v -9 -9 {z}\nv 9 -9 {z}\nv 0 9 {z}\nf -3 -2 -1\n");
    }
    let folder = Folder::new(&[("a.mtl", b"newmtl a\nd 0.01\n"), ("a.obj", obj.as_bytes())]);
    let arguments = [
        "render", "a.obj", "--size", "4x4", "--eye", "0,0,5", "--target", "0,0,0", "--fov", "5",
    ];
    let words = folder.luch_succeeds(&arguments);
    let warning = "rays ended behind 64 transparent layers; what lies behind is missing";
    assert_eq!(words.err.matches(warning).count(), 1, "{}", words.err);
    let json = folder.luch_succeeds(&[&arguments[..], &["--json"]].concat());
    let lost = json.json()["rays"]["lost_in_layers"]
        .as_u64()
        .unwrap_or_default();
    assert!(lost > 0);
    assert_eq!(
        json.json()["warnings"],
        json!([format!("{lost} {warning}")])
    );
}

#[cfg(target_os = "linux")]
#[test]
fn a_path_that_is_no_utf_8_is_told_as_well_as_it_can_be() {
    use std::ffi::OsStr;
    use std::os::unix::ffi::OsStrExt;
    let folder = Folder::new(&[]);
    let name = OsStr::from_bytes(b"caf\xe9.toml");
    std::fs::write(folder.0.path().join(name), super::SCENE).expect("writable");
    for command in ["render", "info"] {
        let output = folder
            .command(&[command, "--json"])
            .arg(name)
            .output()
            .expect("the program runs");
        let json: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
        let told = if command == "render" {
            &json["input"]
        } else {
            &json["file"]
        };
        assert_eq!(told, "caf\u{fffd}.toml");
    }
    assert!(
        folder
            .0
            .path()
            .join(OsStr::from_bytes(b"caf\xe9.png"))
            .exists()
    );
}
