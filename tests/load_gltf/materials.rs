//! Materials and their textures.

use super::file::{File, warnings};
use luch::material::{AlphaMode, Model as Shape};
use serde_json::json;

#[test]
fn materials_are_read_with_their_extensions_and_limits() {
    let mut file = File::triangle();
    file.json["materials"] = json!([
        {
            "name": "lamp",
            "pbrMetallicRoughness": {"baseColorFactor": [0.5, -1, 2, 0.25], "metallicFactor": 1.5},
            "emissiveFactor": [0.5, 0, 1],
            "extensions": {"KHR_materials_emissive_strength": {"emissiveStrength": 4}},
            "alphaMode": "MASK",
            "doubleSided": true,
        },
        {"extensions": {"KHR_materials_unlit": {}}, "alphaMode": "BLEND"},
    ]);
    let model = file.model();
    let [lamp, unlit, default] = &model.materials[..] else {
        panic!("{} materials", model.materials.len())
    };
    let Shape::MetallicRoughness(m) = &lamp.model else {
        panic!("{:?}", lamp.model)
    };
    assert_eq!(<[f32; 3]>::from(m.base_color.factor), [0.5, 0.0, 1.0]);
    assert_eq!((m.metallic, m.roughness), (1.0, 1.0));
    assert_eq!(<[f32; 3]>::from(lamp.emission.factor), [2.0, 0.0, 4.0]);
    assert_eq!(lamp.alpha.mode, AlphaMode::Mask { cutoff: 0.5 });
    assert_eq!(
        (lamp.alpha.coverage.factor, lamp.double_sided),
        (0.25, true)
    );
    assert!(matches!(unlit.model, Shape::Unlit { .. }) && unlit.alpha.mode == AlphaMode::Blend);
    let Shape::MetallicRoughness(m) = &default.model else {
        panic!("{:?}", default.model)
    };
    assert_eq!(<[f32; 3]>::from(m.base_color.factor), [1.0; 3]);
    assert_eq!(
        (m.metallic, m.roughness, m.occlusion.factor),
        (1.0, 1.0, 1.0)
    );
    assert_eq!((default.is_opaque(), default.double_sided), (true, false));
    assert_eq!(
        warnings(&model),
        [
            "material \"lamp\": its baseColorFactor is -1, taken as 0",
            "material \"lamp\": its baseColorFactor is 2, taken as 1",
            "material \"lamp\": its metallicFactor is 1.5, taken as 1",
        ]
    );
}

#[test]
fn an_image_that_cannot_be_shown_leaves_the_factor() {
    let mut file = File::triangle();
    file.json["images"] = json!([{"uri": "wood%20grain.png"}, {"uri": "https://example.org/a.png"}, {"bufferView": 9}]);
    file.json["textures"] = json!([{"source": 0}, {"source": 1}, {"source": 2}, {}]);
    file.json["materials"] = json!([{
        "pbrMetallicRoughness": {"baseColorTexture": {"index": 0}, "metallicRoughnessTexture": {"index": 1}},
        "emissiveTexture": {"index": 2},
        "normalTexture": {"index": 3},
        "occlusionTexture": {"index": 0, "texCoord": 2},
    }]);
    let model = file.model();
    assert_eq!(model.materials[0].textures().count(), 0);
    assert!(model.textures.is_empty());
    assert_eq!(
        warnings(&model),
        [
            "texture 3: has no image that luch reads: it is left out",
            "wood%20grain.png: cannot open: No such file or directory (os error 2): it is left out",
            "https://example.org/a.png: its URI begins with \"https:\", expected a file in the model's \
             folder or data: it is left out",
            "image 2: buffer view 9 does not exist, there are 1: it is left out",
            "material 0, occlusion texture: uses TEXCOORD_2, luch reads 0 and 1: it is left out",
        ]
    );
    let names: Vec<&str> = model
        .facts
        .textures
        .iter()
        .map(|t| t.name.as_str())
        .collect();
    assert_eq!(
        names,
        ["wood%20grain.png", "https://example.org/a.png", "image 2"]
    );
}
