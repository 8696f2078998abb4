//! What is told of a file, and the ways in which it may lie on the disk.

use super::file::{File, corners, warnings};
use luch::load::{self, gltf};
use serde_json::json;
use std::fs;
use tempfile::TempDir;

#[test]
fn facts_tell_of_scenes_animations_and_extensions() {
    let mut file = File::triangle();
    file.json["asset"]["generator"] = "Test 1\n".into();
    file.json["scenes"][0]["name"] = "room".into();
    file.json["animations"] = json!([{"name": "run", "channels": [], "samplers": []}]);
    file.json["extensionsUsed"] = json!(["KHR_materials_unlit", "ACME_x"]);
    file.json["extensionsRequired"] = json!(["KHR_materials_unlit"]);
    let model = file.model();
    let facts = &model.facts;
    assert_eq!(facts.format, "glTF 2.0 (Test 1\u{fffd})");
    assert_eq!(
        (facts.scenes.as_slice(), facts.animations[0].name.as_str()),
        (&["room".to_owned()][..], "run")
    );
    let asks: Vec<_> = facts
        .asks
        .iter()
        .map(|ask| (ask.what.as_str(), ask.required, ask.treatment.name()))
        .collect();
    assert_eq!(
        asks,
        [
            ("KHR_materials_unlit", true, "honoured"),
            ("ACME_x", false, "ignored"),
            ("animations", false, "honoured"),
        ]
    );
    assert_eq!(warnings(&model), ["uses ACME_x, which is ignored"]);
    let names: Vec<_> = model.files.iter().filter_map(|f| f.file_name()).collect();
    assert_eq!(names, ["model.gltf", "model.bin"]);
}

#[test]
fn a_glb_and_a_data_uri_are_the_same_model() {
    let plain = File::triangle();
    let expected = corners(&File::triangle().model());
    let mut embedded = File::triangle();
    let base64 = "AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";
    let buffer =
        json!({"uri": format!("data:application/octet-stream;base64,{base64}"), "byteLength": 36});
    embedded.json["buffers"] = json!([buffer]);
    assert_eq!(corners(&embedded.model()), expected);

    let folder = TempDir::new().expect("a folder");
    let path = folder.path().join("model.glb");
    let mut json = plain.json;
    json["buffers"] = json!([{"byteLength": 36}]);
    let mut text = json.to_string();
    while !text.len().is_multiple_of(4) {
        text.push(' ');
    }
    let chunk =
        |kind: &[u8], bytes: &[u8]| [&(bytes.len() as u32).to_le_bytes(), kind, bytes].concat();
    let body = [
        chunk(b"JSON", text.as_bytes()),
        chunk(b"BIN\0", &plain.bytes),
    ]
    .concat();
    let length = (12 + body.len()) as u32;
    let bytes = [
        b"glTF",
        &2u32.to_le_bytes()[..],
        &length.to_le_bytes(),
        &body,
    ]
    .concat();
    fs::write(&path, bytes).expect("a file");
    let model = gltf::open(&path, &load::Options::default()).expect("the file is right");
    assert_eq!(corners(&model), expected);
}
