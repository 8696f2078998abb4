//! Models and scene files that are no such thing: one line that names the file and the place, and exit code 1.

use super::{Folder, SCENE, TRIANGLE};
use serde_json::{Value, json};

/// A glTF of the triangle (0, 0, 0), (1, 0, 0), (0, 1, 0), all in one file.
fn triangle() -> Value {
    let buffer = "data:application/octet-stream;base64,\
                  AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
    json!({
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"name": "chair", "primitives": [{"attributes": {"POSITION": 0}}]}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"uri": buffer, "byteLength": 36}],
    })
}

#[test]
fn a_file_that_is_none_is_one_line() {
    let header = b"glTF\x02\0\0\0\xff\0\0\0";
    let folder = Folder::new(&[
        ("empty.glb", b""),
        ("empty.gltf", b""),
        ("empty.obj", b""),
        ("empty.toml", b""),
        ("short.glb", header),
        ("magic.glb", b"PK\x03\x04 and more"),
        ("bytes.gltf", b"{\"\xff"),
        ("bytes.toml", b"# \xff"),
        ("bad.gltf", b"{\"asset\": "),
        ("bad.toml", b"a = = 1"),
        ("picture.jpg", b"\xff\xd8\xff"),
    ]);
    std::fs::create_dir(folder.path("folder.glb")).expect("a folder");
    for (name, problem) in [
        (
            "missing.glb",
            "cannot open: No such file or directory (os error 2)",
        ),
        (
            "missing",
            "cannot open: No such file or directory (os error 2)",
        ),
        ("folder.glb", "is a folder, expected a file"),
        (".", "is a folder, expected a file"),
        ("empty.glb", "is empty, expected glTF"),
        ("empty.gltf", "is empty, expected glTF"),
        (
            "empty.obj",
            "has nothing to draw, expected a face with finite vertices",
        ),
        (
            "empty.toml",
            "has nothing to draw; write a [[sphere]], a [[plane]] or a [[model]]",
        ),
        ("short.glb", "is cut off: 12 bytes of 255"),
        (
            "magic.glb",
            "does not begin with \"glTF\", so that it is no GLB; if it is JSON, call it .gltf",
        ),
        ("bytes.gltf", "is not UTF-8 at byte 2 of its JSON"),
        (
            "bytes.toml",
            "line 1: byte 0xff is not UTF-8; save the file as UTF-8",
        ),
        (
            "bad.gltf",
            "line 1, column 10: is no JSON: EOF while parsing a value",
        ),
        ("bad.toml", "line 1, column 5: extra `=`, expected nothing"),
        (
            "picture.jpg",
            "its name does not end in .gltf, .glb, .obj or .toml; convert it to glTF, or rename it if it is one of these",
        ),
    ] {
        let error = format!("{name}: {problem}");
        folder.luch_fails(&["render", name, "-o", "out.png"], 1, &error);
        folder.luch_fails(&["info", name], 1, &error);
    }
    assert!(!folder.names().iter().any(|name| name.contains("out.png")));
}

#[test]
fn a_truncated_glb_is_cut_off_wherever_it_ends() {
    let whole = std::fs::read(super::asset("models/cube.glb")).expect("an asset");
    for end in [4, 11, 12, 19, 20, whole.len() / 2, whole.len() - 1] {
        let folder = Folder::new(&[("a.glb", &whole[..end])]);
        let ran = folder.luch(&["info", "a.glb"]);
        assert_eq!(ran.code, Some(1), "{end}");
        assert!(ran.err.starts_with("error: a.glb: "), "{}", ran.err);
        assert_eq!(ran.err.lines().count(), 1, "{}", ran.err);
    }
}

#[test]
fn a_wrong_gltf_is_one_line_that_names_the_place() {
    type Break = fn(&mut Value);
    let cases: [(Break, &str); 6] = [
        (
            |f| f["accessors"][0]["count"] = 4.into(),
            "mesh \"chair\", primitive 0, POSITION: accessor 0: 4 elements of 12 bytes from 0 do not fit into buffer \
             view 0 (36 bytes)",
        ),
        (
            |f| f["nodes"][0]["mesh"] = 7.into(),
            "node 0: mesh 7 does not exist, there are 1",
        ),
        (
            |f| f["nodes"] = json!([{"children": [1]}, {"mesh": 0, "children": [0]}]),
            "node 0: is below itself",
        ),
        (
            |f| f["extensionsRequired"] = json!(["KHR_texture_procedurals"]),
            "needs KHR_texture_procedurals, which is not supported; re-export without it, or go on without with --allow KHR_texture_procedurals",
        ),
        (
            |f| f["nodes"][0] = json!({}),
            "has nothing to draw: no node of its scene shows a triangle",
        ),
        (
            |f| f["meshes"][0]["name"] = "\u{1b}[2J\n".into(),
            "mesh \"\u{fffd}[2J\u{fffd}\", primitive 0: index 9 is past the last vertex (2)",
        ),
    ];
    for (number, (break_it, problem)) in cases.into_iter().enumerate() {
        let mut file = triangle();
        break_it(&mut file);
        if number == 5 {
            // Three bytes, the last of which is 9.
            file["buffers"]
                .as_array_mut()
                .expect("buffers")
                .push(json!({
                "uri": "data:application/octet-stream;base64,AAEJ", "byteLength": 3}));
            file["bufferViews"]
                .as_array_mut()
                .expect("views")
                .push(json!({"buffer": 1, "byteLength": 3}));
            file["accessors"]
                .as_array_mut()
                .expect("accessors")
                .push(json!({
                "bufferView": 1, "componentType": 5121, "type": "SCALAR", "count": 3}));
            file["meshes"][0]["primitives"][0]["indices"] = 1.into();
        }
        let folder = Folder::new(&[("a.gltf", file.to_string().as_bytes())]);
        folder.luch_fails(&["render", "a.gltf"], 1, &format!("a.gltf: {problem}"));
        assert_eq!(folder.names(), ["a.gltf"]);
    }
}

#[test]
fn a_missing_texture_is_a_warning_and_the_factor_is_used() {
    let mut file = triangle();
    let plain =
        json!([{"pbrMetallicRoughness": {"baseColorFactor": [1, 0, 0, 1]}, "doubleSided": true}]);
    file["materials"] = plain;
    file["meshes"][0]["primitives"][0]["material"] = 0.into();
    let without = file.to_string();
    file["materials"][0]["pbrMetallicRoughness"]["baseColorTexture"] = json!({"index": 0});
    file["textures"] = json!([{"source": 0}]);
    file["images"] = json!([{"uri": "lost.png"}]);
    let folder = Folder::new(&[
        ("with.gltf", file.to_string().as_bytes()),
        ("without.gltf", without.as_bytes()),
    ]);
    let small = ["--size", "8x8", "--json"];
    let with = folder.luch_succeeds(&[&["render", "with.gltf"], &small[..]].concat());
    folder.luch_succeeds(&[&["render", "without.gltf"], &small[..]].concat());
    assert_eq!(folder.read("with.png"), folder.read("without.png"));
    let warning = "lost.png: cannot open: No such file or directory (os error 2): it is left out";
    assert_eq!(with.json()["warnings"], json!([warning]));
    assert!(
        with.err.contains(&format!("warning: {warning}\n")),
        "{}",
        with.err
    );
}

#[test]
fn a_missing_material_library_is_a_warning() {
    let text = format!("mtllib lost.mtl\nusemtl red\n{TRIANGLE}");
    let folder = Folder::new(&[("a.obj", text.as_bytes())]);
    let ran = folder.luch_succeeds(&["render", "a.obj", "--size", "8x8", "--json"]);
    let warnings = ran.json()["warnings"].to_string();
    assert!(warnings.contains("lost.mtl"), "{warnings}");
    assert!(ran.err.starts_with("warning: "), "{}", ran.err);
    assert!(folder.read("a.png").starts_with(super::PNG));
}

#[test]
fn an_obj_with_an_index_out_of_range_or_nothing_but_points_draws_nothing_in_silence() {
    let folder = Folder::new(&[
        ("range.obj", b"v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 9\n"),
        ("points.obj", b"v 0 0 0\nv 1 0 0\np 1 2\n"),
        ("nan.obj", b"v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
    ]);
    for name in ["range.obj", "points.obj", "nan.obj"] {
        let ran = folder.luch(&["render", name]);
        assert_eq!(ran.code, Some(1), "{name}: {}", ran.err);
        assert!(
            ran.err.starts_with(&format!("error: {name}: ")),
            "{}",
            ran.err
        );
        assert_eq!(ran.err.lines().count(), 1, "{}", ran.err);
    }
}

#[test]
fn causes_are_told_where_they_are_asked_for() {
    let folder = Folder::new(&[("bad.toml", b"a = = 1"), ("bad.gltf", b"{\"asset\": ")]);
    let first = "error: bad.toml: line 1, column 5: extra `=`, expected nothing\n";
    for command in ["render", "info"] {
        let ran = folder.luch(&[command, "bad.toml", "-v"]);
        let causes = ran.err.strip_prefix(first).unwrap_or_default();
        assert!(causes.starts_with("  because: "), "{}", ran.err);
        assert!(causes.contains("1 | a = = 1\n"), "{}", ran.err);
        assert_eq!(folder.luch(&[command, "bad.toml"]).err, first);
    }
    let ran = folder.luch(&["info", "bad.gltf", "-v"]);
    assert!(
        ran.err
            .ends_with("\n  because: EOF while parsing a value at line 1 column 10\n"),
        "{}",
        ran.err
    );
}

#[test]
fn a_scene_file_that_names_a_lost_model_tells_of_the_model() {
    let scene = format!("{SCENE}[[model]]\npath = \"lost.glb\"\n");
    let folder = Folder::new(&[("scene.toml", scene.as_bytes())]);
    folder.luch_fails(
        &["render", "scene.toml"],
        1,
        "lost.glb: cannot open: No such file or directory (os error 2)",
    );
}

#[cfg(unix)]
#[test]
fn what_lies_outside_a_models_folder_is_read_for_who_means_it() {
    let buffer: Vec<u8> = [0., 0., 0., 1., 0., 0., 0., 1., 0.]
        .into_iter()
        .flat_map(f32::to_le_bytes)
        .collect();
    let gltf = |uri: &str| {
        let json = r#"{"asset":{"version":"2.0"},"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
            "meshes":[{"primitives":[{"attributes":{"POSITION":0}}]}],
            "accessors":[{"bufferView":0,"componentType":5126,"type":"VEC3","count":3}],
            "bufferViews":[{"buffer":0,"byteLength":36}],"buffers":[{"byteLength":36,"uri":"URI"}]}"#;
        json.replace("URI", uri)
    };
    let folder = Folder::new(&[("model.bin", &buffer)]);
    std::fs::create_dir(folder.path("below")).expect("a writable folder");
    let absolute = format!("file://{}", folder.path("model.bin").display());
    for (name, uri) in [
        ("up", "../model.bin"),
        ("link", "link.bin"),
        ("file", &absolute),
    ] {
        let model = format!("below/{name}.gltf");
        std::fs::write(folder.path(&model), gltf(uri)).expect("a writable folder");
    }
    std::os::unix::fs::symlink("../model.bin", folder.path("below/link.bin")).expect("a link");
    for (name, uri) in [("up", "../model.bin"), ("link", "link.bin")] {
        let model = format!("below/{name}.gltf");
        let problem = format!(
            "{model}: buffer 0: its URI \"{uri}\" leads out of the model's folder; \
             move the file beside the model, or use --allow-external"
        );
        folder.luch_fails(&["info", &model], 1, &problem);
        folder.luch_succeeds(&["info", &model, "--allow-external"]);
    }
    let ran = folder.luch(&["info", "below/file.gltf"]);
    assert!(ran.err.contains("begins with \"file:\""), "{}", ran.err);
    folder.luch_succeeds(&["info", "below/file.gltf", "--allow-external"]);
    // Devices stay out: they never end.
    std::fs::write(folder.path("device.gltf"), gltf("/dev/zero")).expect("a writable folder");
    let problem = "/dev/zero: is a device or a pipe, expected a file";
    folder.luch_fails(&["info", "device.gltf", "--allow-external"], 1, problem);
}

#[test]
fn a_picture_that_does_not_fit_into_the_memory_allowed_is_one_line() {
    let folder = Folder::with_scene_and_model();
    let render = |memory: &str| {
        let arguments = [
            "render",
            "model.obj",
            "--size",
            "2000x2000",
            "--max-memory",
            memory,
        ];
        let ran = folder.luch(&arguments);
        (ran.code, ran.err)
    };
    let (code, said) = render("100M");
    assert_eq!(code, Some(1));
    assert_eq!(
        said,
        "error: model.obj: the scene with its picture takes 609 MB of memory, 104 MB are left; \
         make it smaller, or allow more with --max-memory\n"
    );
    let (code, said) = render("4 bananas");
    assert_eq!(code, Some(1));
    assert!(said.contains("expected a whole number of bytes above 0, as in 4G or 500M"));
    assert_eq!(folder.names(), ["model.obj", "scene.toml"]);
}
