//! Extensions of materials: what each says is what the material has. Numbers are those of the specifications' examples
//! and tables.

use super::file::{File, warnings};
use luch::color::Rgb;
use luch::load::Options;
use luch::material::{Finish, Material, Model as Shape, Volume};
use serde_json::{Value, json};

/// The first material of a file whose first material has these extensions, and the file's warnings.
fn read(extensions: Value) -> (Material, Vec<String>) {
    let mut file = File::triangle();
    file.json["materials"] = json!([{"name": "a", "extensions": extensions}]);
    let model = file.model();
    (model.materials[0].clone(), warnings(&model))
}

fn finish(extensions: Value) -> Finish {
    let (material, warnings) = read(extensions);
    assert_eq!(warnings, [""; 0]);
    match material.model {
        Shape::MetallicRoughness(m) => m.finish.map_or(Finish::PLAIN, |finish| *finish),
        other => panic!("{other:?}"),
    }
}

#[test]
fn what_extensions_say_by_default_is_a_material_without_them() {
    let all = json!({
        "KHR_materials_anisotropy": {}, "KHR_materials_clearcoat": {}, "KHR_materials_diffuse_transmission": {},
        "KHR_materials_dispersion": {}, "KHR_materials_ior": {}, "KHR_materials_iridescence": {},
        "KHR_materials_sheen": {}, "KHR_materials_specular": {}, "KHR_materials_transmission": {},
        "KHR_materials_volume": {},
    });
    let (material, warnings) = read(all);
    assert_eq!(warnings, [""; 0]);
    assert_eq!(
        material,
        Material {
            name: "a".into(),
            ..File::triangle().model().materials[0].clone()
        }
    );
}

#[test]
fn the_index_of_refraction_is_read_and_zero_is_infinite() {
    let ior = |ior: f32| finish(json!({"KHR_materials_ior": {"ior": ior}})).ior;
    assert_eq!([ior(1.4), ior(2.42), ior(0.0)], [1.4, 2.42, f32::INFINITY]);
}

#[test]
fn a_specular_colour_may_be_above_one() {
    // A reflectance of 8 % is a colour of 2 (KHR_materials_specular, "Materials with reflectance parameter").
    let finish = finish(json!({"KHR_materials_specular": {
        "specularFactor": 0.5, "specularColorFactor": [2, 1, 0]}}));
    assert_eq!(finish.specular.factor, 0.5);
    assert_eq!(finish.specular_color.factor, Rgb::new(2.0, 1.0, 0.0));
}

#[test]
fn a_coat_is_smooth_unless_the_file_says_otherwise() {
    let coat = finish(json!({"KHR_materials_clearcoat": {"clearcoatFactor": 1.0}})).clearcoat;
    let coat = coat.expect("there is a coat");
    assert_eq!((coat.weight.factor, coat.roughness.factor), (1.0, 0.0));
}

#[test]
fn velvet_has_sheen() {
    let velvet =
        finish(json!({"KHR_materials_sheen": {"sheenColorFactor": [0.9, 0.9, 0.9]}})).sheen;
    let velvet = velvet.expect("there is sheen");
    assert_eq!(
        (velvet.color.factor, velvet.roughness.factor),
        (Rgb::grey(0.9), 0.0)
    );
}

#[test]
fn a_film_is_as_thick_as_its_maximum_where_no_texture_says_otherwise() {
    let film = finish(json!({"KHR_materials_iridescence": {
        "iridescenceFactor": 1.0, "iridescenceIor": 1.3, "iridescenceThicknessMaximum": 400.0}}));
    let film = film.iridescence.expect("there is a film");
    assert_eq!(
        (film.strength.factor, film.ior, film.thickness),
        (1.0, 1.3, [100.0, 400.0])
    );
}

#[test]
fn the_strength_of_a_grain_is_read() {
    let grain = finish(json!({"KHR_materials_anisotropy": {
        "anisotropyStrength": 0.6, "anisotropyRotation": 1.57}}));
    assert_eq!(grain.anisotropy.map(|strength| strength.factor), Some(0.6));
}

#[test]
fn a_leaf_lets_diffuse_light_through() {
    let leaf = finish(json!({"KHR_materials_diffuse_transmission": {
        "diffuseTransmissionFactor": 0.25, "diffuseTransmissionColorFactor": [1.0, 0.9, 0.85]}}));
    let through = leaf.diffuse_transmission.expect("light comes through");
    assert_eq!(through.share.factor, 0.25);
    assert_eq!(through.color.factor, Rgb::new(1.0, 0.9, 0.85));
}

#[test]
fn a_body_of_glass_bends_spreads_and_swallows_light() {
    let (glass, _) = read(json!({
        "KHR_materials_transmission": {"transmissionFactor": 0.8},
        "KHR_materials_ior": {"ior": 1.52},
        "KHR_materials_volume": {
            "thicknessFactor": 1.0, "attenuationDistance": 0.006, "attenuationColor": [0.5, 0.5, 0.5]},
        "KHR_materials_dispersion": {"dispersion": 0.33},
    }));
    let glass = glass.transmission.expect("it transmits");
    assert_eq!(
        (glass.share.factor, glass.ior, glass.dispersion),
        (0.8, 1.52, 0.33)
    );
    let volume = Volume {
        attenuation_color: Rgb::grey(0.5),
        attenuation_distance: 0.006,
    };
    assert_eq!(glass.volume, Some(volume));
}

#[test]
fn without_thickness_a_transmissive_surface_is_a_thin_sheet() {
    let (sheet, _) = read(json!({
        "KHR_materials_transmission": {"transmissionFactor": 1.0},
        "KHR_materials_volume": {"attenuationDistance": 0.006},
    }));
    let sheet = sheet.transmission.expect("it transmits");
    assert_eq!((sheet.ior, sheet.volume), (1.5, None));
    let (clear, warnings) = read(json!({
        "KHR_materials_transmission": {"transmissionFactor": 1.0},
        "KHR_materials_volume": {"thicknessFactor": 2, "attenuationDistance": 0},
    }));
    let clear = clear.transmission.and_then(|t| t.volume);
    assert_eq!(clear.map(|v| v.attenuation_distance), Some(f32::INFINITY));
    assert_eq!(
        warnings,
        ["material \"a\": its attenuationDistance is 0, taken as none"]
    );
}

#[test]
fn specular_glossiness_stands_for_metallic_roughness() {
    let (gold, warnings) = read(json!({"KHR_materials_pbrSpecularGlossiness": {
        "diffuseFactor": [0.0, 0.0, 0.0, 0.5], "specularFactor": [1.0, 0.766, 0.336], "glossinessFactor": 0.9}}));
    assert_eq!(warnings, [""; 0]);
    let Shape::SpecularGlossiness(m) = &gold.model else {
        panic!("{:?}", gold.model)
    };
    assert_eq!(m.specular.factor, Rgb::new(1.0, 0.766, 0.336));
    assert_eq!((m.diffuse.factor, m.glossiness), (Rgb::BLACK, 0.9));
    assert_eq!(gold.alpha.coverage.factor, 0.5);
}

#[test]
fn an_extension_of_the_wrong_type_costs_itself_alone() {
    let (material, warnings) = read(json!({
        "KHR_materials_ior": {"ior": 1.33},
        "KHR_materials_sheen": {"sheenColorFactor": [1, 0]},
        "KHR_materials_clearcoat": 7,
    }));
    let Shape::MetallicRoughness(m) = material.model else {
        panic!("{:?}", material.model)
    };
    let finish = Finish {
        ior: 1.33,
        ..Finish::PLAIN
    };
    assert_eq!(m.finish.as_deref(), Some(&finish));
    assert_eq!(
        warnings,
        [
            "material \"a\", KHR_materials_clearcoat: invalid type: integer `7`, expected an object: \
             it is ignored",
            "material \"a\", KHR_materials_sheen: invalid length 2, expected an array of length 3: it is ignored",
        ]
    );
}

#[test]
fn factors_out_of_range_are_taken_as_the_nearest_in_it() {
    let (material, warnings) = read(json!({
        "KHR_materials_ior": {"ior": 0.5},
        "KHR_materials_specular": {"specularFactor": 3, "specularColorFactor": [-1, 2, 3]},
    }));
    let Shape::MetallicRoughness(m) = material.model else {
        panic!("{:?}", material.model)
    };
    let finish = m.finish.expect("there is one");
    assert_eq!((finish.ior, finish.specular.factor), (1.0, 1.0));
    assert_eq!(finish.specular_color.factor, Rgb::new(0.0, 2.0, 3.0));
    assert_eq!(
        warnings,
        [
            "material \"a\": its ior is 0.5, taken as 1",
            "material \"a\": its specularFactor is 3, taken as 1",
            "material \"a\": its specularColorFactor is -1, taken as 0",
        ]
    );
}

#[test]
fn textures_of_every_slot_are_decoded() {
    // One red pixel.
    const PNG: &str = "data:image/png;base64,iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAIAAACQd1PeAAAADElEQVR4nGP4z8AAAAMBAQDJ/pLvAAAAAElFTkSuQmCC";
    let mut file = File::triangle();
    file.json["images"] = json!([{"uri": PNG}]);
    file.json["textures"] = json!(vec![json!({"source": 0}); 14]);
    let slot = |index: u32| json!({"index": index});
    file.json["materials"] = json!([
        {"extensions": {
            "KHR_materials_anisotropy": {"anisotropyStrength": 1, "anisotropyTexture": slot(0)},
            "KHR_materials_clearcoat": {
                "clearcoatFactor": 1, "clearcoatTexture": slot(1), "clearcoatRoughnessTexture": slot(2),
                "clearcoatNormalTexture": {"index": 13, "scale": 0.5}},
            "KHR_materials_diffuse_transmission": {"diffuseTransmissionFactor": 1,
                "diffuseTransmissionTexture": slot(3), "diffuseTransmissionColorTexture": slot(4)},
            "KHR_materials_iridescence": {
                "iridescenceFactor": 1, "iridescenceTexture": slot(5), "iridescenceThicknessTexture": slot(6)},
            "KHR_materials_sheen": {"sheenColorFactor": [1, 1, 1],
                "sheenColorTexture": slot(7), "sheenRoughnessTexture": slot(8)},
            "KHR_materials_specular": {"specularTexture": slot(9), "specularColorTexture": slot(10)},
            "KHR_materials_transmission": {"transmissionFactor": 1, "transmissionTexture": slot(11)},
        }},
        {"extensions": {"KHR_materials_pbrSpecularGlossiness": {
            "diffuseTexture": slot(11), "specularGlossinessTexture": slot(12)}}},
    ]);
    let model = file.model();
    let used = |index: usize| model.materials[index].textures().count();
    // The second one's diffuse texture is its coverage, too.
    assert_eq!((used(0), used(1)), (13, 3));
    let coat = model.materials[0].clearcoat();
    let normals = coat.and_then(|coat| coat.normal_map.as_ref());
    assert_eq!(normals.map(|map| map.scale), Some(0.5));
    assert_eq!(model.facts.textures[0].size, Some((1, 1)));
}

/// One thing with two materials beside its own, and what it has in a variant.
fn material_in(variant: Option<&str>) -> Result<u32, String> {
    let mut file = File::triangle();
    file.json["materials"] = json!([{}, {}, {}]);
    file.json["extensions"] = json!({"KHR_materials_variants": {
        "variants": [{"name": "midnight"}, {"name": "beach"}, {"name": "street"}]}});
    file.primitive()["material"] = 0.into();
    file.primitive()["extensions"] = json!({"KHR_materials_variants": {"mappings": [
        {"material": 2, "variants": [0, 1]}, {"material": 1, "variants": [1]}]}});
    let options = Options {
        variant: variant.map(Into::into),
        ..Options::default()
    };
    let model = file.open_with(&options)?;
    assert_eq!(model.facts.variants, ["midnight", "beach", "street"]);
    Ok(model.shapes[0].parts[0].material)
}

#[test]
fn a_variant_chooses_by_name_or_index_the_first_material_that_is_mapped() {
    assert_eq!(material_in(None), Ok(0));
    assert_eq!(material_in(Some("midnight")), Ok(2));
    assert_eq!(material_in(Some("beach")), Ok(2));
    assert_eq!(material_in(Some("1")), Ok(2));
    // Nothing is mapped to it.
    assert_eq!(material_in(Some("street")), Ok(0));
}

#[test]
fn an_unknown_variant_is_an_error_that_names_those_there_are() {
    assert_eq!(
        material_in(Some("3")),
        Err(
            "model.gltf: there is no variant \"3\"; there are 0 \"midnight\", 1 \"beach\" and 2 \"street\""
                .into()
        )
    );
    let options = Options {
        variant: Some("beach".into()),
        ..Options::default()
    };
    assert_eq!(
        File::triangle().open_with(&options).err(),
        Some("model.gltf: there is no variant \"beach\"; the file has none".into())
    );
}

#[test]
fn a_variant_of_a_material_that_does_not_exist_is_an_error() {
    let mut file = File::triangle();
    file.json["extensions"] = json!({"KHR_materials_variants": {"variants": [{"name": "a"}]}});
    file.primitive()["extensions"] = json!({"KHR_materials_variants": {"mappings": [
        {"material": 9, "variants": [0]}]}});
    let options = Options {
        variant: Some("a".into()),
        ..Options::default()
    };
    assert_eq!(
        file.open_with(&options).err(),
        Some(
            "model.gltf: mesh \"chair\", primitive 0: material 9 does not exist, there are 0"
                .into()
        )
    );
}
