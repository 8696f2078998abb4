//! What glTF's extensions add to a surface, where its picture is known on paper.

use glam::{Vec2, Vec3};
use luch::accel::{Accel, Options};
use luch::camera::Camera;
use luch::color::Rgb;
use luch::generate;
use luch::geometry::{Plane, Sphere};
use luch::light::{Falloff, Light, LightKind};
use luch::material::{
    Clearcoat, DiffuseTransmission, Finish, Material, MetallicRoughness, Model, NormalMap, Textured,
};
use luch::mesh::Mesh;
use luch::render::{Progress, Settings, render};
use luch::scene::{Background, Object, Scene, SceneDescription, Shown};
use luch::shade::Shading;
use luch::texture::{Encoding, Filter, Image, Pixels, Texture, TextureUse, Wrap};
use std::sync::Arc;

/// A black surface without gloss, but for what lies over it or comes through.
fn black(finish: Finish) -> Material {
    let finish = Finish {
        specular: Textured::uniform(0.0),
        ..finish
    };
    Material {
        model: Model::MetallicRoughness(MetallicRoughness {
            base_color: Textured::uniform(Rgb::BLACK),
            metallic: 0.0,
            roughness: 1.0,
            metallic_roughness: None,
            occlusion: Textured::uniform(1.0),
            finish: Some(Box::new(finish)),
        }),
        ..Material::matt("", Rgb::BLACK)
    }
}

/// The one pixel of a picture: the ray along the camera's axis.
fn pixel(description: SceneDescription) -> [f32; 4] {
    let scene = Scene::new(description).expect("a scene");
    let settings = Settings::new(1, 1, 1, 5, Shading::BlinnPhong).expect("settings");
    let accel = Accel::build(&scene, &Options::default());
    let film = render(&scene, &accel, &settings, &Progress::default());
    film.beauty().next().expect("a pixel")
}

/// Nothing, seen along -z.
fn looking() -> SceneDescription {
    let camera = Camera::looking_at(Vec3::Z * 4.0, Vec3::ZERO, Vec3::Y, 0.5);
    SceneDescription::empty(camera)
}

fn assert_close(found: [f32; 4], expected: [f64; 3]) {
    for (found, expected) in found.iter().zip(expected) {
        let close = (f64::from(*found) - expected).abs() < 1e-5;
        assert!(close, "{found}, expected {expected}");
    }
}

#[test]
fn a_lamp_behind_a_leaf_shines_through_it_as_lambert_says() {
    let finish = Finish {
        diffuse_transmission: Some(DiffuseTransmission {
            share: Textured::uniform(0.5),
            color: Textured::uniform(Rgb::new(1.0, 0.5, 0.0)),
        }),
        ..Finish::PLAIN
    };
    // From behind at 60 degrees: the cosine is 1/2.
    let along = Vec3::new(0.75f32.sqrt(), 0.0, 0.5);
    let lit = |kind, hidden: bool| {
        let mut scene = looking();
        scene.materials = vec![black(finish.clone()), Material::matt("", Rgb::WHITE)];
        let (point, normal) = (Vec3::ZERO, Vec3::Z);
        scene.planes = vec![Object {
            name: String::new(),
            shape: Plane { point, normal },
            material: 0,
        }];
        if hidden {
            let (center, radius) = (along * -3.0, 1.0);
            scene.spheres = vec![Object {
                name: String::new(),
                shape: Sphere { center, radius },
                material: 1,
            }];
        }
        scene.lights = vec![Light {
            name: String::new(),
            kind,
            color: Rgb::WHITE,
            intensity: 1.0,
            falloff: Falloff::None,
            range: None,
        }];
        pixel(scene)
    };
    let sun = LightKind::Directional { direction: along };
    let position = along * -9.0;
    let point = LightKind::Point { position };
    assert_close(lit(sun, false), [0.25, 0.125, 0.0]);
    assert_close(lit(point, false), [0.25, 0.125, 0.0]);
    // Not through something else, and not from before the leaf, whose own diffuse light is black.
    assert_close(lit(sun, true), [0.0; 3]);
    let direction = Vec3::NEG_Z;
    let before = LightKind::Directional { direction };
    assert_close(lit(before, false), [0.0; 3]);
}

/// One normal everywhere: bent by 36.87 degrees along x.
fn bent() -> (Texture, NormalMap) {
    // (0.6, 0, 0.8), of which 255 is 1 and 0 is -1; no byte is 0.
    let words = [0.6f32, 0.0, 0.8, 1.0].map(|x| ((x * 0.5 + 0.5) * 65_535.0).round() as u16);
    let texture = Texture {
        image: Arc::new(Image {
            name: String::new(),
            width: 1,
            height: 1,
            pixels: Pixels::Sixteen(vec![words]),
        }),
        wrap: [Wrap::Repeat; 2],
        filter: Filter::Nearest,
        mipmaps: true,
        encoding: Encoding::Linear,
    };
    let (uv_set, transform) = (0, None);
    let used = TextureUse {
        texture: 0,
        uv_set,
        transform,
    };
    let scale = 1.0;
    (
        texture,
        NormalMap {
            texture: used,
            scale,
        },
    )
}

/// What a square before the camera, black below a coat, mirrors of a glow in a direction.
fn mirrored(glow: Vec3, base: Option<NormalMap>, coat: Option<NormalMap>) -> [f32; 4] {
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let mesh = Mesh {
        positions: corners.map(|[x, y]| Vec3::new(x, y, 0.0)).to_vec(),
        triangles: vec![[0, 1, 2], [0, 2, 3]],
        normals: vec![Vec3::Z; 4],
        tangents: vec![Vec3::X.extend(1.0); 4],
        uvs: [vec![Vec2::ZERO; 4], Vec::new()],
        ..Mesh::default()
    };
    let finish = Finish {
        clearcoat: Some(Clearcoat {
            weight: Textured::uniform(1.0),
            roughness: Textured::uniform(0.0),
            normal_map: coat,
        }),
        ..Finish::PLAIN
    };
    let mut glowing = Material::matt("", Rgb::BLACK);
    glowing.emission.factor = Rgb::WHITE;
    let camera = looking().camera;
    let mut scene = generate::mesh_scene(mesh, camera);
    scene.materials = vec![
        Material {
            normal_map: base,
            ..black(finish)
        },
        glowing,
    ];
    scene.textures = vec![bent().0];
    scene.lights = Vec::new();
    scene.ambient = Rgb::BLACK;
    scene.background = Background::plain(Rgb::BLACK, Shown::Always);
    // Behind the camera too.
    let (center, radius) = (glow * 9.0, 0.1);
    scene.spheres = vec![Object {
        name: String::new(),
        shape: Sphere { center, radius },
        material: 1,
    }];
    pixel(scene)
}

#[test]
fn a_coat_has_a_normal_of_its_own_whatever_lies_below() {
    let map = || Some(bent().1);
    // About (0.6, 0, 0.8), +z is mirrored to (0.96, 0, 0.28): 2 * 0.8 * n - z.
    let (straight, aside) = (Vec3::Z, Vec3::new(0.96, 0.0, 0.28));
    // 0.04 + 0.96 (1 - 0.8)^5.
    let slanted = 0.040_307_2;
    for (base, coat, bent) in [
        (None, None, false),
        (map(), None, false),
        (None, map(), true),
        (map(), map(), true),
    ] {
        let at = |glow| mirrored(glow, base.clone(), coat.clone());
        let (ahead, beside) = if bent { (0.0, slanted) } else { (0.04, 0.0) };
        assert_close(at(straight), [ahead; 3]);
        assert_close(at(aside), [beside; 3]);
    }
}
