//! From MTL statements to materials.

use super::files::{TEXTURED, open, open_with, phong, warnings};
use luch::color::Rgb;
use luch::material::{AlphaMode, Model};

#[test]
fn a_material_has_what_its_mtl_says() {
    let mtl = "newmtl a\nKd .1 .2 .3\nKs .4 .5 .6\nKe 7 8 9\nNs 50\nd .5\nillum 3\n";
    let model = open_with(TEXTURED, &[("a.mtl", mtl.as_bytes())]);
    let [a, default] = &model.materials[..] else {
        panic!("two expected")
    };
    let phong = phong(a);
    assert_eq!(phong.diffuse.factor, Rgb::new(0.1, 0.2, 0.3));
    assert_eq!(phong.specular.factor, Rgb::new(0.4, 0.5, 0.6));
    assert_eq!(phong.reflectivity, Rgb::new(0.4, 0.5, 0.6));
    assert_eq!(phong.shininess, 50.0);
    assert_eq!(a.emission.factor, Rgb::new(7.0, 8.0, 9.0));
    assert_eq!(
        (a.alpha.mode, a.alpha.coverage.factor),
        (AlphaMode::Blend, 0.5)
    );
    assert!(a.double_sided && default.double_sided);
    assert_eq!(model.shapes[0].parts[0].material, 0);
    assert_eq!(warnings(&model), [""; 0]);
}

#[test]
fn a_missing_mtl_leaves_grey() {
    let model = open(TEXTURED);
    assert_eq!(
        warnings(&model),
        [
            "MTL \"a.mtl\" is missing; its materials are grey",
            "material \"a\" is in no MTL; it is grey"
        ]
    );
    assert_eq!(model.materials.len(), 1);
    assert_eq!(phong(&model.materials[0]).diffuse.factor, Rgb::grey(0.8));
}

#[test]
fn several_mtls_and_names_with_blanks_are_found() {
    let red: &[u8] = b"newmtl a\nKd 1 0 0\n";
    let other: &[u8] = b"newmtl other\n";
    for (names, expected) in [
        ("one.mtl two.MTL", 3),
        ("my colors.mtl", 2),
        ("one.mtl my colors.mtl", 3),
        ("one.mtl\nmtllib two.MTL", 3),
        ("./one.mtl one.mtl two.MTL", 3),
    ] {
        let text = TEXTURED.replace("a.mtl", names);
        let beside = [("one.mtl", other), ("two.MTL", red), ("my colors.mtl", red)];
        let model = open_with(&text, &beside);
        assert_eq!(model.files.len(), expected, "{names}");
        let diffuse = phong(&model.materials[0]).diffuse.factor;
        assert_eq!(diffuse, Rgb::new(1.0, 0.0, 0.0), "{names}");
        assert_eq!(warnings(&model), [""; 0]);
    }
}

#[test]
fn the_mtl_of_the_same_name_helps_out() {
    let red: &[u8] = b"newmtl a\nKd 1 0 0\n";
    let text = TEXTURED.replace("a.mtl", "b.mtl");
    for (beside, warning) in [
        (
            vec![("model.mtl", red)],
            "materials that no mtllib leads to are looked for in \"model.mtl\", which has the model's name",
        ),
        (vec![("b.mtl", red), ("model.mtl", b"newmtl a\n")], ""),
    ] {
        let model = open_with(&text, &beside);
        let diffuse = phong(&model.materials[0]).diffuse.factor;
        assert_eq!(diffuse, Rgb::new(1.0, 0.0, 0.0));
        assert_eq!(warnings(&model).pop().unwrap_or_default(), warning);
    }
}

#[test]
fn of_two_materials_of_one_name_the_first_counts() {
    let mtl = b"newmtl a\nKd 1 0 0\nnewmtl a\nKd 0 1 0\n";
    let model = open_with(TEXTURED, &[("a.mtl", mtl)]);
    let diffuse = phong(&model.materials[0]).diffuse.factor;
    assert_eq!(diffuse, Rgb::new(1.0, 0.0, 0.0));
    let expected = "a.mtl: material \"a\" was there before; the earlier one counts";
    assert_eq!(warnings(&model), [expected]);
}

#[test]
fn glass_and_metal_come_through_the_door() {
    let glass = b"newmtl a\nillum 7\nTf 1 .5 1\nNi 1.5\n";
    let model = open_with(TEXTURED, &[("a.mtl", glass)]);
    let transmission = model.materials[0].transmission.as_ref().unwrap();
    assert_eq!(
        (transmission.ior, transmission.volume.is_some()),
        (1.5, true)
    );
    let metal = b"newmtl a\nPr .25\nPm 1\nKd 1 0 0\n";
    let model = open_with(TEXTURED, &[("a.mtl", metal)]);
    let Model::MetallicRoughness(made) = &model.materials[0].model else {
        panic!("metallic-roughness expected")
    };
    assert_eq!((made.metallic, made.roughness), (1.0, 0.25));
    assert_eq!(warnings(&model), [""; 0]);
}

#[test]
fn a_missing_texture_leaves_the_factor() {
    let mtl = b"newmtl a\nKd 1 0 0\nmap_Kd gone.png\nmap_Ks /dev/zero\n";
    let model = open_with(TEXTURED, &[("a.mtl", mtl)]);
    assert_eq!(
        warnings(&model),
        [
            "texture \"gone.png\" is missing and not used",
            "texture \"/dev/zero\" leads out of the model's folder; move it beside the model or use --allow-external; it is not used"
        ]
    );
    let diffuse = &phong(&model.materials[0]).diffuse;
    assert_eq!(
        (diffuse.factor, &diffuse.texture),
        (Rgb::new(1.0, 0.0, 0.0), &None)
    );
    assert_eq!(model.facts.textures.len(), 2);
}
