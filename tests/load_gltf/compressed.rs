//! Geometry that an extension compresses or quantizes.

use super::file::{BYTE, FLOAT, File, SHORT, corners, floats, shorts, warnings};
use glam::Vec3;
use serde_json::json;

/// A tent of 4 triangles over 5 vertices with a colour each, as Draco's own encoder (1.5.7) writes it: EdgeBreaker,
/// positions of 6 bits. POSITION is attribute 0, COLOR_0 is attribute 1.
const TENT: &[u8] = &[
    68, 82, 65, 67, 79, 2, 2, 1, 1, 0, 0, 0, 5, 4, 1, 4, 0, 0, 2, 111, 1, 255, 1, 17, 255, 2, 68,
    64, 2, 255, 0, 0, 0, 0, 0, 1, 0, 9, 3, 0, 0, 2, 1, 2, 2, 3, 0, 1, 1, 1, 1, 1, 0, 7, 23, 1, 64,
    1, 0, 255, 15, 250, 191, 11, 0, 242, 255, 3, 192, 239, 2, 0, 0, 0, 0, 63, 0, 0, 0, 0, 0, 128,
    191, 0, 0, 0, 0, 0, 0, 0, 191, 0, 0, 0, 64, 6, 1, 1, 1, 0, 9, 3, 153, 25, 19, 205, 12, 157, 25,
    3, 115, 243, 176, 161, 48, 142, 139, 40, 134, 163, 4, 222, 4, 0, 0, 0, 0, 255, 0, 0, 0,
];

/// What Draco's own decoder makes of it, as the bits of floats.
const TENT_POSITIONS: [[u32; 3]; 5] = [
    [0x3f800000, 0x0, 0xbf000000],
    [0x3c820840, 0x3f820821, 0x3c020840],
    [0x3f800000, 0x0, 0x3f3cf3d0],
    [0xbf800000, 0x0, 0x3f3cf3d0],
    [0xbf800000, 0x0, 0xbf000000],
];

fn tent() -> File {
    let mut file = File::new();
    let view = file.view(TENT);
    file.json["accessors"] = json!([
        {"componentType": FLOAT, "type": "VEC3", "count": 5},
        {"componentType": BYTE, "type": "VEC3", "count": 5, "normalized": true},
        {"componentType": SHORT, "type": "SCALAR", "count": 12},
    ]);
    file.json["meshes"][0]["primitives"][0] = json!({
        "attributes": {"POSITION": 0, "COLOR_0": 1},
        "indices": 2,
        "extensions": {"KHR_draco_mesh_compression":
            {"bufferView": view, "attributes": {"POSITION": 0, "COLOR_0": 1}}},
    });
    file.json["extensionsRequired"] = json!(["KHR_draco_mesh_compression"]);
    file
}

#[test]
fn a_draco_stream_holds_what_the_reference_decoder_says() {
    let model = tent().model();
    let mesh = &model.meshes[0];
    assert_eq!(mesh.triangles, [[0, 1, 2], [2, 1, 3], [3, 1, 4], [1, 0, 4]]);
    let expected = TENT_POSITIONS.map(|bits| Vec3::from(bits.map(f32::from_bits)));
    assert_eq!(mesh.positions, expected);
    let colors = [
        [0, 0, 255],
        [255, 0, 0],
        [9, 99, 199],
        [255, 255, 255],
        [0, 255, 0],
    ];
    let expected = colors.map(|[r, g, b]| [r, g, b, 255].map(|c| c as f32 / 255.0));
    assert_eq!(mesh.colors, expected);
    assert!(warnings(&model).is_empty());
}

#[test]
fn a_broken_draco_stream_is_named_or_replaced_by_accessors_with_bytes() {
    let draco = |id: u32| json!({"KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": id}}});
    let mut file = File::triangle();
    file.primitive()["extensions"] = draco(0);
    let model = file.model();
    assert_eq!(model.facts.triangles, 1);
    let said = warnings(&model).join("");
    assert!(said.contains("its accessors are used instead"), "{said}");

    let mut file = tent();
    file.bytes.truncate(90);
    file.json["bufferViews"][0]["byteLength"] = 90.into();
    let error = file.open().err().unwrap_or_default();
    let expected =
        "model.gltf: mesh \"chair\", primitive 0, KHR_draco_mesh_compression: cannot be read: ";
    assert!(error.starts_with(expected), "{error}");

    let mut file = tent();
    file.primitive()["extensions"] = draco(7);
    assert_eq!(
        file.open().err().as_deref(),
        Some(
            "model.gltf: mesh \"chair\", primitive 0, KHR_draco_mesh_compression: has no attribute 7, \
             which is to be POSITION"
        )
    );
}

#[test]
fn a_meshopt_view_needs_no_bytes_in_its_fallback_buffer() {
    let source: &[u8] = &[
        160, 0, 0, 1, 48, 0, 0, 0, 255, 1, 60, 192, 0, 0, 129, 255, 255, 0, 0, 1, 48, 0, 0, 0, 255,
        1, 48, 0, 0, 0, 125, 0, 0, 1, 3, 0, 0, 0, 128, 1, 51, 0, 0, 0, 129, 255, 0, 0, 0, 0, 0, 0,
        0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 128, 63, 0, 0, 0, 0,
    ];
    for name in ["EXT_meshopt_compression", "KHR_meshopt_compression"] {
        let mut file = File::new();
        file.bytes.extend(source);
        file.json["buffers"] = json!([
            {"byteLength": 60, "extensions": {name: {"fallback": true}}},
            {"uri": "model.bin", "byteLength": source.len()},
        ]);
        file.json["bufferViews"] = json!([{"buffer": 0, "byteLength": 60, "byteStride": 12,
            "extensions": {name: {"buffer": 1, "byteLength": source.len(), "byteStride": 12,
                "count": 5, "mode": "ATTRIBUTES"}}}]);
        file.json["accessors"] =
            json!([{"bufferView": 0, "componentType": FLOAT, "type": "VEC3", "count": 5}]);
        file.primitive()["attributes"]["POSITION"] = 0.into();
        file.json["extensionsRequired"] = json!([name]);
        let first = [
            Vec3::Y,
            Vec3::new(-1.0, 0.0, -0.5),
            Vec3::new(1.0, 0.0, -0.5),
        ];
        assert_eq!(corners(&file.model()), [first]);
    }
}

#[test]
fn a_meshopt_view_that_claims_more_than_its_bytes_can_say_is_refused() {
    let mut file = File::triangle();
    file.json["bufferViews"][0]["extensions"]["EXT_meshopt_compression"] = json!({"buffer": 0,
        "byteLength": 36, "byteStride": 256, "count": 1_000_000_000, "mode": "ATTRIBUTES"});
    assert_eq!(
        file.open().err().as_deref(),
        Some(
            "model.gltf: mesh \"chair\", primitive 0, POSITION: accessor 0: buffer view 0: \
             EXT_meshopt_compression: the views up to here unpack to many times what the buffers hold"
        )
    );
}

#[test]
fn quantized_attributes_stand_for_shares_or_for_themselves() {
    let mut file = File::new();
    // Each element is padded to 4 bytes, as the extension wants it.
    let positions = file.view(&[0, 0, 0, 0, 127, 0, 0, 0, 0, 0x81, 0, 0]);
    let normals = file.view(&[0, 0, 127, 0, 0, 0, 127, 0, 0, 0, 0x80, 0]);
    for view in [positions, normals] {
        file.json["bufferViews"][view]["byteStride"] = 4.into();
    }
    let uvs = file.view(&shorts(&[0, 0, 65535, 0, 7, 65535]));
    let bytes = 5120;
    file.json["accessors"] = json!([
        {"bufferView": positions, "componentType": bytes, "type": "VEC3", "count": 3},
        {"bufferView": normals, "componentType": bytes, "type": "VEC3", "count": 3, "normalized": true},
        {"bufferView": uvs, "componentType": SHORT, "type": "VEC2", "count": 3},
    ]);
    file.primitive()["attributes"] = json!({"POSITION": 0, "NORMAL": 1, "TEXCOORD_0": 2});
    file.json["nodes"][0]["scale"] = json!([0.5, 0.5, 0.5]);
    file.json["extensionsRequired"] = json!(["KHR_mesh_quantization"]);
    let mut as_shares = File {
        json: file.json.clone(),
        bytes: file.bytes.clone(),
    };
    let model = file.model();
    let mesh = &model.meshes[0];
    let expected = [Vec3::ZERO, Vec3::X * 127.0, Vec3::Y * -127.0];
    assert_eq!(mesh.positions, expected);
    assert_eq!(mesh.normals, [Vec3::Z, Vec3::Z, Vec3::NEG_Z]);
    assert_eq!(mesh.uvs[0][2].to_array(), [7.0, 65535.0]);
    assert_eq!(model.nodes[0].to_parent.matrix3.x_axis.x, 0.5);

    as_shares.json["accessors"][0]["normalized"] = true.into();
    let model = as_shares.model();
    assert_eq!(
        model.meshes[0].positions,
        [Vec3::ZERO, Vec3::X, Vec3::NEG_Y]
    );
}

#[test]
fn sparse_changes_of_a_normalized_accessor_are_shares_as_well() {
    let mut file = File::triangle();
    let which = file.view(&[2, 1]);
    let what = file.view(&[255, 255, 255, 255, 51, 102, 0, 255]);
    let colors = file.accessor(BYTE, "VEC4", &[0; 12]);
    let accessor = &mut file.json["accessors"][colors];
    accessor["normalized"] = true.into();
    accessor["sparse"] = json!({
        "count": 2,
        "indices": {"bufferView": which, "componentType": BYTE},
        "values": {"bufferView": what},
    });
    file.primitive()["attributes"]["COLOR_0"] = colors.into();
    let model = file.model();
    // Out of order, which the format forbids and which does no harm.
    assert_eq!(
        model.meshes[0].colors,
        [[0.0; 4], [0.2, 0.4, 0.0, 1.0], [1.0; 4]]
    );
    let mut indexed = File::new();
    indexed.attribute("POSITION", "VEC3", &floats(&[0.0; 12]));
    let indices = indexed.indices(BYTE, &[0, 0, 0, 0, 0, 0]);
    let (which, what) = (indexed.view(&[1, 2, 5]), indexed.view(&[1, 2, 3]));
    indexed.json["accessors"][indices]["sparse"] = json!({
        "count": 3,
        "indices": {"bufferView": which, "componentType": BYTE},
        "values": {"bufferView": what},
    });
    assert_eq!(indexed.model().meshes[0].triangles, [[0, 1, 2], [0, 0, 3]]);
}
