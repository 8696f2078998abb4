//! How a model is read: which scene, with which cameras, without which extensions.

use super::Folder;
use serde_json::json;

const BUFFER: &str =
    "data:application/octet-stream;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";

/// Two scenes, of one triangle and of two; the second has two cameras; the file requires what no one has.
fn two_scenes() -> Vec<u8> {
    json!({
        "asset": {"version": "2.0"},
        "scene": 0,
        "scenes": [{"name": "plan", "nodes": [0]}, {"name": "room", "nodes": [0, 1, 2, 3]}],
        "nodes": [
            {"mesh": 0},
            {"mesh": 0, "translation": [2, 0, 0]},
            {"name": "tripod", "camera": 0, "translation": [0, 0, 4]},
            {"name": "wall", "camera": 1, "translation": [0, 0, 2]},
        ],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
        "cameras": [
            {"name": "door", "type": "perspective", "perspective": {"yfov": 1, "znear": 0.1}},
            {"type": "orthographic", "orthographic": {"xmag": 1, "ymag": 1, "znear": 0, "zfar": 9}},
        ],
        "accessors": [{"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": 3}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}],
        "buffers": [{"uri": BUFFER, "byteLength": 36}],
        "extensionsUsed": ["ACME_x"],
        "extensionsRequired": ["ACME_x"],
    })
    .to_string()
    .into_bytes()
}

fn folder() -> Folder {
    Folder::new(&[("a.gltf", &two_scenes())])
}

#[test]
fn what_is_required_and_lacks_is_an_error_unless_it_is_allowed() {
    let folder = folder();
    folder.luch_fails(
        &["info", "a.gltf"],
        1,
        "a.gltf: needs ACME_x, which is not supported; re-export without it, or go on without with --allow ACME_x",
    );
    let ran = folder.luch_succeeds(&["info", "a.gltf", "--allow", "ACME_x"]);
    assert!(
        ran.out()
            .contains("asks        ACME_x, required: ignored\n")
    );
    let ran = folder.luch_succeeds(&["render", "a.gltf", "--allow", "ACME_x", "--size", "4x4"]);
    assert!(
        ran.out().contains("asked: ignored: ACME_x\n"),
        "{}",
        ran.out()
    );
}

#[test]
fn a_scene_is_chosen_by_name_or_by_index() {
    let folder = folder();
    let drawn = |scene: &[&str]| {
        let arguments = [&["info", "a.gltf", "--allow", "ACME_x", "--json"], scene].concat();
        let json = folder.luch_succeeds(&arguments).json();
        json["drawn"]["triangles"].as_u64()
    };
    assert_eq!(drawn(&[]), Some(1));
    assert_eq!(drawn(&["--scene", "room"]), Some(2));
    assert_eq!(drawn(&["--scene", "1"]), Some(2));
    assert_eq!(drawn(&["--scene", "plan"]), Some(1));
    folder.luch_fails(
        &["info", "a.gltf", "--allow", "ACME_x", "--scene", "2"],
        1,
        "a.gltf: there is no scene \"2\"; there are 0 \"plan\" and 1 \"room\"",
    );
}

#[test]
fn cameras_are_listed_and_nothing_is_rendered() {
    let folder = folder();
    let list = ["render", "a.gltf", "--allow", "ACME_x", "--list-cameras"];
    let none = folder.luch_succeeds(&list);
    assert_eq!(
        none.out(),
        "none in the file; without one, luch frames the model\n"
    );
    let of_room = [&list[..], &["--scene", "room"]].concat();
    assert_eq!(
        folder.luch_succeeds(&of_room).out(),
        "0 \"door\", node \"tripod\": perspective, 57.3 degrees, at 0.000, 0.000, 4.000\n\
         1 \"wall\": orthographic, at 0.000, 0.000, 2.000\n"
    );
    let json = folder
        .luch_succeeds(&[&of_room[..], &["--json"]].concat())
        .json();
    assert_eq!(json[1]["node"], "wall");
    assert_eq!(json[0]["look_at"], json!([0.0, 0.0, 0.0]));
    assert_eq!(folder.names(), ["a.gltf"]);
}
