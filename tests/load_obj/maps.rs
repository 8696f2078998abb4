//! Textures: options, coverage, heights and normals.

use super::files::{TEXTURED, open_with, phong, png, warnings};
use glam::{Vec2, Vec3};
use luch::color::Rgb;
use luch::material::{AlphaChannel, AlphaMode, Model};
use luch::texture::{Encoding, Pixels, Wrap};

#[test]
fn a_texture_that_is_no_image_is_told_and_not_used() {
    let files: [(&str, &[u8]); 2] = [("a.mtl", b"newmtl a\nmap_Kd a.dds\n"), ("a.dds", b"DDS |")];
    let model = open_with(TEXTURED, &files);
    let said = &warnings(&model)[0];
    let expected =
        "a.dds: is a DDS image, which is not supported; use PNG or JPEG; the texture is not used";
    assert!(said.ends_with(expected), "{said}");
    assert!(model.textures.is_empty());
}

#[test]
fn texture_options_do_what_they_say() {
    let mtl = b"newmtl a\nKd .5 .5 .5\nmap_Kd -s 2 3 1 -o .25 .5 -clamp on dark oak.png\n";
    let picture = png(1, &[[1, 2, 3, 255]]);
    let files: [(&str, &[u8]); 2] = [("a.mtl", mtl), ("dark oak.png", &picture)];
    let model = open_with(TEXTURED, &files);
    let diffuse = &phong(&model.materials[0]).diffuse;
    assert_eq!(diffuse.factor, Rgb::grey(0.5));
    let used = diffuse.texture.as_ref().unwrap();
    // The file's (0.5, 0.5): 2 x 0.5 + 0.25 and 3 x 0.5 + 0.5 from below.
    let uv = used.transform.unwrap().transform_point2(Vec2::splat(0.5));
    assert!((uv - Vec2::new(1.25, 1.0 - 2.0)).length() < 1e-6);
    let texture = &model.textures[used.texture as usize];
    assert_eq!(texture.wrap, [Wrap::ClampToEdge; 2]);
    assert_eq!(texture.encoding, Encoding::Srgb);
    assert_eq!(model.facts.textures[0].size, Some((1, 1)));
}

#[test]
fn roughness_and_metalness_are_one_picture() {
    let mtl = b"newmtl a\nPr .5\nmap_Pr r.png\nmap_Pm -imfchan b m.png\n";
    let rough = png(1, &[[64, 64, 64, 255]]);
    let metal = png(1, &[[0, 0, 200, 255]]);
    let files: [(&str, &[u8]); 3] = [("a.mtl", mtl), ("r.png", &rough), ("m.png", &metal)];
    let model = open_with(TEXTURED, &files);
    let Model::MetallicRoughness(made) = &model.materials[0].model else {
        panic!("metallic-roughness expected")
    };
    // A texture stands instead of its number.
    assert_eq!((made.roughness, made.metallic), (1.0, 1.0));
    let used = made.metallic_roughness.as_ref().unwrap();
    let texture = &model.textures[used.texture as usize];
    assert_eq!(texture.encoding, Encoding::Linear);
    let expected = Pixels::Eight(vec![[255, 64, 200, 255]]);
    assert_eq!(texture.image.pixels, expected);
}

#[test]
fn coverage_is_an_alpha_that_says_something_or_else_red() {
    let mtl = b"newmtl a\nmap_d cover.png\n";
    for (pixel, options, expected) in [
        ([9, 9, 9, 255], "", AlphaChannel::Red),
        ([9, 9, 9, 100], "", AlphaChannel::Alpha),
        ([9, 9, 9, 255], "-imfchan m ", AlphaChannel::Alpha),
        ([9, 9, 9, 100], "-imfchan r ", AlphaChannel::Red),
    ] {
        let picture = png(1, &[pixel]);
        let mtl = String::from_utf8_lossy(mtl).replace("cover", &format!("{options}cover"));
        let files = [("a.mtl", mtl.as_bytes()), ("cover.png", &picture)];
        let alpha = &open_with(TEXTURED, &files).materials[0].alpha;
        assert_eq!((alpha.mode, alpha.channel), (AlphaMode::Blend, expected));
        assert!(alpha.coverage.texture.is_some());
    }
}

#[test]
fn normals_and_heights_become_normal_maps_with_tangents() {
    let normals = png(1, &[[128, 128, 255, 255]]);
    let heights = png(2, &[[0, 0, 0, 255], [255, 255, 255, 255]]);
    let files = |mtl: &'static str| {
        let (normals, heights): (&[u8], &[u8]) = (&normals, &heights);
        open_with(
            TEXTURED,
            &[
                ("a.mtl", mtl.as_bytes()),
                ("n.png", normals),
                ("h.png", heights),
            ],
        )
    };
    for (mtl, width, scale) in [
        ("newmtl a\nnorm n.png\n", 1, 1.0),
        ("newmtl a\nnorm h.png\n", 2, 1.0),
        ("newmtl a\nmap_Bump -bm 0.5 n.png\n", 1, 0.5),
        ("newmtl a\nbump h.png -bm 3\n", 2, 3.0),
    ] {
        let model = files(mtl);
        let map = model.materials[0].normal_map.as_ref().unwrap();
        assert_eq!(map.scale, scale);
        let texture = &model.textures[map.texture.texture as usize];
        assert_eq!(
            (texture.image.width, texture.encoding),
            (width, Encoding::Linear)
        );
        let mesh = &model.meshes[0];
        // u grows along x, and green, up in the picture, along y: n x t = y.
        assert_eq!(mesh.tangents, [Vec3::X.extend(1.0); 3]);
    }
    // A clamped ramp rising to the right by one pixel's width at both edges leans back to the left.
    let model = files("newmtl a\nbump -clamp on h.png\n");
    let [x, y, z, _] = model.textures[0]
        .sample(Vec2::new(0.25, 0.5))
        .map(|part| part * 2.0 - 1.0);
    assert!((Vec3::new(x, y, z) - Vec3::new(-1.0, 0.0, 2.0).normalize()).length() < 1e-3);
}
