//! `luch info`, in words and as JSON.

use super::{Folder, SCENE, TRIANGLE, asset};
use serde_json::json;

/// A model with one of everything.
fn one_of_everything() -> String {
    let buffer =
        "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
    // 1 x 1, grey.
    let image = "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGNoAAAAggCBd81ytgAAAABJRU5ErkJggg==";
    json!({
        "asset": {"version": "2.0", "generator": "a test", "extras": {"by": "hand"}},
        "scene": 0,
        "scenes": [{"name": "room", "nodes": [0, 1, 2, 3]}],
        "nodes": [
            {"mesh": 0},
            {"mesh": 0, "translation": [2, 0, 0]},
            {"camera": 0},
            {"extensions": {"KHR_lights_punctual": {"light": 0}}},
        ],
        "meshes": [{"name": "chair\n", "primitives": [
            {"attributes": {"POSITION": 0}, "material": 0},
            {"attributes": {"POSITION": 0}, "mode": 0},
        ]}],
        "materials": [{"name": "oak", "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}],
        "textures": [{"source": 0}],
        "images": [{"name": "grain", "uri": image}],
        "cameras": [{"name": "door", "type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}}],
        "animations": [{"name": "run", "channels": [], "samplers": []}],
        "extensionsUsed": ["KHR_lights_punctual", "ACME_x"],
        "extensionsRequired": ["KHR_lights_punctual"],
        "extensions": {"KHR_lights_punctual": {"lights": [{"name": "sun", "type": "directional"}]}},
        "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"uri": buffer, "byteLength": 36}],
    })
    .to_string()
}

#[test]
fn everything_in_a_model_is_told_in_words() {
    let folder = Folder::new(&[("a.gltf", one_of_everything().as_bytes())]);
    let ran = folder.luch_succeeds(&["info", "a.gltf"]);
    let expected = "\
a.gltf
  format      glTF 2.0 (a test)
  scenes      1: room
  nodes       4
  meshes      1: chair\u{fffd}
  triangles   1
  not drawn   3 points, 0 lines
  materials   1: oak
  textures    1: grain (1 x 1)
  lights      1: sun
  cameras     1: door
  animation   0 \"run\": 0 s
  asks        KHR_lights_punctual, required: honoured
  asks        ACME_x: ignored
  asks        metallic-roughness materials: approximated: Blinn-Phong highlights as wide, mirror rays off what is smooth
  asks        animations: honoured
  note        asset: {\"by\":\"hand\"}
  instances   2
  drawn       2 triangles, 1 light
  bounds      (0, 0, 0) to (3, 1, 0)
  warning     uses ACME_x, which is ignored
";
    let (found, more) = ran.out().split_at(expected.len().min(ran.out().len()));
    assert_eq!(found, expected, "{more}");
    assert_eq!(ran.err, "");
}

#[test]
fn everything_in_a_model_is_told_as_json() {
    let folder = Folder::new(&[("a.gltf", one_of_everything().as_bytes())]);
    let mut json = folder.luch_succeeds(&["info", "a.gltf", "--json"]).json();
    let warnings = json["warnings"].take();
    assert!(
        warnings
            .as_array()
            .is_some_and(|w| w.contains(&json!("uses ACME_x, which is ignored")))
    );
    let expected = json!({
        "file": "a.gltf",
        "scene_file": null,
        "models": [{
            "file": "a.gltf",
            "format": "glTF 2.0 (a test)",
            "scenes": ["room"],
            "nodes": 4,
            "meshes": ["chair\n"],
            "triangles": 1,
            "points": 3,
            "lines": 0,
            "materials": ["oak"],
            "variants": [],
            "textures": [{"name": "grain", "size": [1, 1]}],
            "lights": ["sun"],
            "cameras": ["door"],
            "animations": [{"name": "run", "seconds": 0.0, "moves": []}],
            "asks": [
                {"what": "KHR_lights_punctual", "required": true, "treatment": "honoured", "by": null},
                {"what": "ACME_x", "required": false, "treatment": "ignored", "by": null},
                {"what": "metallic-roughness materials", "required": false, "treatment": "approximated",
                    "by": "Blinn-Phong highlights as wide, mirror rays off what is smooth"},
                {"what": "animations", "required": false, "treatment": "honoured", "by": null},
            ],
            "notes": [{"of": "asset", "says": {"by": "hand"}}],
        }],
        "instances": 2,
        "drawn": {"triangles": 2, "spheres": 0, "planes": 0, "lights": 1},
        "bounds": [[0.0, 0.0, 0.0], [3.0, 1.0, 0.0]],
        "warnings": null,
    });
    assert_eq!(json, expected);
}

#[test]
fn a_scene_file_tells_of_itself_and_of_its_models() {
    let scene = format!("{SCENE}[[model]]\npath = \"model.obj\"\n");
    let folder = Folder::new(&[
        ("scene.toml", scene.as_bytes()),
        ("model.obj", TRIANGLE.as_bytes()),
    ]);
    let words = folder.luch_succeeds(&["info", "scene.toml"]);
    let expected = "\
scene.toml
  format      scene file
  materials   1: red
  spheres     1
  planes      0
  lights      1
  camera      its own
  model       model.obj
  format      OBJ
";
    assert!(words.out().starts_with(expected), "{}", words.out());
    assert!(
        words
            .out()
            .contains("\n  drawn       1 triangle, 1 sphere, 1 light\n"),
        "{}",
        words.out()
    );
    let json = folder
        .luch_succeeds(&["info", "scene.toml", "--json"])
        .json();
    let itself = json!({"materials": ["red"], "spheres": 1, "planes": 0, "lights": [""], "camera": "its own"});
    assert_eq!(json["scene_file"], itself);
    assert_eq!(json["models"][0]["file"], "model.obj");
}

#[test]
fn every_scene_and_model_of_the_project_can_be_told() {
    for name in [
        "scenes/figure-3.toml",
        "scenes/figure-4.toml",
        "scenes/mixed.toml",
        "models/cube.glb",
        "models/cube.gltf",
        "models/cube.obj",
        "models/knot.obj",
    ] {
        let folder = Folder::new(&[]);
        let ran = folder.luch_succeeds(&["info", &asset(name)]);
        assert!(!ran.out().contains("warning"), "{}", ran.out());
        assert!(folder.names().is_empty());
    }
}
