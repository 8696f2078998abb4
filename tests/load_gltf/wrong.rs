//! Files that are refused.

use super::file::{BYTE, FLOAT, File, SHORT, floats, push, shorts};
use serde_json::json;

#[test]
fn every_wrong_file_has_its_own_words() {
    type Break = fn(&mut File);
    let cases: &[(Break, &str)] = &[
        (
            |f| f.json["extensionsRequired"] = json!(["ACME_x"]),
            "model.gltf: needs ACME_x, which is not supported; re-export without it, or go on without with --allow ACME_x",
        ),
        (
            |f| f.json["extensionsRequired"] = json!(["ACME_x", "ACME_y"]),
            "model.gltf: needs ACME_x and ACME_y, which are not supported; re-export without them, or go on without with --allow ACME_x --allow ACME_y",
        ),
        (
            |f| f.json["asset"]["version"] = "1.0".into(),
            "model.gltf: is glTF 1.0, expected 2.0; export it as glTF 2.0",
        ),
        (
            |f| f.json["buffers"] = json!([{"uri": "model.bin", "byteLength": 99}]),
            "model.gltf: buffer 0: is 36 bytes long, expected 99",
        ),
        (
            |f| f.json["buffers"] = json!([{"uri": "lost.bin", "byteLength": 36}]),
            "lost.bin: cannot open: No such file or directory (os error 2)",
        ),
        (
            |f| f.json["buffers"] = json!([{"uri": "../model.bin", "byteLength": 36}]),
            "model.gltf: buffer 0: its URI \"../model.bin\" leads out of the model's folder; move the file beside the model, or use --allow-external",
        ),
        (
            |f| f.json["buffers"] = json!([{"byteLength": 36}]),
            "model.gltf: mesh \"chair\", primitive 0, POSITION: accessor 0: buffer view 0: buffer 0 has neither a URI \
             nor a GLB's binary chunk",
        ),
        (
            |f| f.json["bufferViews"][0]["byteLength"] = 40.into(),
            "model.gltf: mesh \"chair\", primitive 0, POSITION: accessor 0: buffer view 0: 40 bytes from 0 do not fit \
             into buffer 0 (36 bytes)",
        ),
        (
            |f| f.json["bufferViews"][0]["byteStride"] = 8.into(),
            "model.gltf: mesh \"chair\", primitive 0, POSITION: accessor 0: its elements are 12 bytes long and 8 bytes \
             apart in buffer view 0",
        ),
        (
            |f| f.json["accessors"][0]["count"] = 4.into(),
            "model.gltf: mesh \"chair\", primitive 0, POSITION: accessor 0: 4 elements of 12 bytes from 0 do not fit \
             into buffer view 0 (36 bytes)",
        ),
        (
            |f| f.json["accessors"][0]["count"] = u64::MAX.into(),
            "model.gltf: mesh \"chair\", primitive 0, POSITION: accessor 0: 18446744073709551615 elements of 12 bytes \
             from 0 do not fit into buffer view 0 (36 bytes)",
        ),
        (
            |f| {
                f.json["accessors"][0] =
                    json!({"componentType": FLOAT, "type": "VEC3", "count": 300_000_000})
            },
            "model.gltf: mesh \"chair\", primitive 0, POSITION: accessor 0: has 300000000 elements without a buffer \
             view, the buffers have 36 bytes in all",
        ),
        (
            |f| f.json["accessors"][0]["bufferView"] = 7.into(),
            "model.gltf: mesh \"chair\", primitive 0, POSITION: accessor 0: buffer view 7 does not exist, there are 1",
        ),
        (
            |f| f.json["accessors"][0]["type"] = "VEC2".into(),
            "model.gltf: mesh \"chair\", primitive 0, POSITION: accessor 0: its type is VEC2, expected VEC3",
        ),
        (
            |f| f.json["accessors"][0]["componentType"] = 5130.into(),
            "model.gltf: mesh \"chair\", primitive 0, POSITION: accessor 0: its componentType is unknown",
        ),
        (
            |f| f.primitive()["attributes"]["POSITION"] = 3.into(),
            "model.gltf: mesh \"chair\", primitive 0, POSITION: accessor 3 does not exist, there are 1",
        ),
        (
            |f| {
                f.indices(BYTE, &[0, 1, 91]);
            },
            "model.gltf: mesh \"chair\", primitive 0: index 91 is past the last vertex (2)",
        ),
        (
            |f| {
                f.indices(FLOAT, &floats(&[0.0, 1.0, 2.0]));
            },
            "model.gltf: mesh \"chair\", primitive 0, indices: are signed or fractions, expected unsigned integers",
        ),
        (
            |f| {
                f.attribute("NORMAL", "VEC3", &floats(&[0.0; 6]));
            },
            "model.gltf: mesh \"chair\", primitive 0, NORMAL: has 2 elements for 3 positions",
        ),
        (
            |f| {
                let view = f.view(&shorts(&[3]));
                let values = f.view(&floats(&[0.0; 3]));
                f.json["accessors"][0]["sparse"] = json!({"count": 1, "indices": {"bufferView": view,
                "componentType": SHORT}, "values": {"bufferView": values}});
            },
            "model.gltf: mesh \"chair\", primitive 0, POSITION: accessor 0: sparse: index 3 is past the last element (2)",
        ),
        (
            |f| {
                f.json["accessors"][0]["sparse"] = json!({"count": 4, "indices": {"bufferView": 0,
            "componentType": SHORT}, "values": {"bufferView": 0}})
            },
            "model.gltf: mesh \"chair\", primitive 0, POSITION: accessor 0: sparse: changes 4 elements of 3",
        ),
        (
            |f| f.primitive()["mode"] = 7.into(),
            "model.gltf: mesh \"chair\", primitive 0: its mode is unknown, expected 0 to 6",
        ),
        (
            |f| f.primitive()["material"] = 0.into(),
            "model.gltf: mesh \"chair\", primitive 0: material 0 does not exist, there are 0",
        ),
        (
            |f| f.json["materials"] = json!([{"normalTexture": {"index": 0}}]),
            "model.gltf: material 0, normal texture: texture 0 does not exist, there are 0",
        ),
        (
            |f| f.json["nodes"] = json!([{"mesh": 2}]),
            "model.gltf: node 0: mesh 2 does not exist, there are 1",
        ),
        (
            |f| f.json["nodes"] = json!([{"mesh": 0, "children": [5]}]),
            "model.gltf: node 0: child node 5 does not exist, there are 1",
        ),
        (
            |f| f.json["nodes"] = json!([{"mesh": 0, "children": [1]}, {"name": "leg", "children": [2]}, {"children": [1]}]),
            "model.gltf: node \"leg\": is below itself",
        ),
        (
            |f| f.json["nodes"] = json!([{"mesh": 0, "camera": 0}]),
            "model.gltf: node 0: camera 0 does not exist, there are 0",
        ),
        (
            |f| f.json["nodes"][0]["extensions"] = json!({"KHR_lights_punctual": {"light": 3}}),
            "model.gltf: node 0: light 3 does not exist, there are 0",
        ),
        (
            |f| f.json["scene"] = 4.into(),
            "model.gltf: scene 4 does not exist, there are 1",
        ),
        (
            |f| f.json["scenes"] = json!([{"name": "room", "nodes": [9]}]),
            "model.gltf: scene \"room\": node 9 does not exist, there are 1",
        ),
        (
            |f| f.json["scenes"] = json!([{}]),
            "model.gltf: has nothing to draw: no node of its scene shows a triangle",
        ),
        (
            |f| f.primitive()["mode"] = 0.into(),
            "model.gltf: has nothing to draw: it shows points and lines only, which are not supported",
        ),
        (
            |f| f.bytes = floats(&[f32::NAN; 9]),
            "model.gltf: has nothing to draw: its triangles have positions that are no numbers",
        ),
    ];
    for (break_it, expected) in cases {
        let mut file = File::triangle();
        break_it(&mut file);
        assert_eq!(file.open().err().as_deref(), Some(*expected));
    }
}

#[test]
fn bytes_that_are_read_again_and_again_are_refused() {
    let mut file = File::triangle();
    // Each primitive has an accessor of its own, on the same bytes.
    let many = vec![0u8; 3 * 60_000];
    let accessor = file.accessor(BYTE, "SCALAR", &many);
    let template = file.json["accessors"][accessor].clone();
    for _ in 0..40 {
        let copy = push(&mut file.json["accessors"], template.clone());
        let primitive = json!({"attributes": {"POSITION": 0}, "indices": copy});
        push(&mut file.json["meshes"][0]["primitives"], primitive);
    }
    let error = file.open().err().unwrap_or_default();
    assert!(
        error.ends_with(": the geometry up to here is many times what the buffers hold"),
        "{error}"
    );
}
