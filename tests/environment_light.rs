//! Environment light and the ground, where the answer is known on paper.

use crate::common::picture::bits;
use glam::Vec3;
use luch::accel::{Accel, Options, Preset};
use luch::camera::{Camera, Fov, Projection};
use luch::color::Rgb;
use luch::environment::{Environment, Equirect, Surroundings, studio, uniform};
use luch::film::Film;
use luch::geometry::{Plane, Sphere};
use luch::light::{Falloff, Light, LightKind};
use luch::material::{Material, MetallicRoughness, Model, Textured};
use luch::render::{Progress, Settings, render};
use luch::scene::{Background, Ground, Object, Scene, SceneDescription, Shown};
use luch::shade::Shading;
use std::sync::{Arc, LazyLock};

fn surroundings(radiance: Equirect) -> Arc<Surroundings> {
    Arc::new(Surroundings::new(&Environment {
        radiance: Arc::new(radiance),
        rotation: 0.0,
        intensity: 1.0,
        lights: 64,
    }))
}

/// Made ready once: it takes a while without optimisation.
static WHITE: LazyLock<Arc<Surroundings>> = LazyLock::new(|| surroundings(uniform(Rgb::WHITE)));
static STUDIO: LazyLock<Arc<Surroundings>> = LazyLock::new(|| surroundings(studio()));

/// Nothing in a white world, seen from above at an angle.
fn white_world() -> SceneDescription {
    let camera = Camera::looking_at(Vec3::new(0.0, 3.0, 4.0), Vec3::ZERO, Vec3::Y, 0.6);
    SceneDescription {
        environment: Some(WHITE.clone()),
        ..SceneDescription::empty(camera)
    }
}

fn ball(center: Vec3, radius: f32) -> Object<Sphere> {
    Object {
        name: String::new(),
        shape: Sphere { center, radius },
        material: 0,
    }
}

fn film(description: SceneDescription, side: u32, samples: u32) -> Film {
    let scene = Scene::new(description).expect("a scene");
    let settings = Settings::new(side, side, samples, 5, Shading::BlinnPhong).expect("settings");
    let accel = Accel::build(&scene, &Options::default());
    render(&scene, &accel, &settings, &Progress::default())
}

/// The one pixel about the camera's axis, and narrow.
fn pixel(description: SceneDescription) -> [f32; 4] {
    let fov = Fov::Y(1e-4);
    let narrow = Camera {
        projection: Projection::Perspective { fov },
        ..description.camera
    };
    let description = SceneDescription {
        camera: narrow,
        ..description
    };
    film(description, 1, 4).beauty().next().expect("a pixel")
}

/// A surface of glTF's.
fn metal(color: Rgb, roughness: f32) -> Material {
    let model = MetallicRoughness {
        base_color: Textured::uniform(color),
        metallic: 1.0,
        roughness,
        metallic_roughness: None,
        occlusion: Textured::uniform(1.0),
        finish: None,
    };
    Material {
        model: Model::MetallicRoughness(model),
        ..Material::matt("", Rgb::BLACK)
    }
}

fn ground() -> Option<Ground> {
    Some(Ground {
        center: Vec3::ZERO,
        radius: 100.0,
        reflectivity: 0.0,
    })
}

#[test]
fn a_matt_ball_in_a_white_world_shows_its_colour_everywhere() {
    let grey = Rgb::new(0.5, 0.25, 1.0);
    let mut scene = white_world();
    scene.materials = vec![Material::matt("", grey)];
    scene.spheres = vec![ball(Vec3::ZERO, 1.0)];
    let film = film(scene, 24, 1);
    let mut seen = 0;
    for [r, g, b, alpha] in film.beauty().filter(|[.., alpha]| *alpha > 0.0) {
        let near = |found: f32, of: f32| (found - of).abs() < 1e-4;
        assert!(near(r, 0.5) && near(g, 0.25) && near(b, 1.0) && alpha == 1.0);
        seen += 1;
    }
    assert!(seen > 150, "{seen}");
}

#[test]
fn a_smooth_metal_mirrors_the_environment_in_its_colour() {
    let gold = Rgb::new(1.0, 0.5, 0.25);
    let around = STUDIO.clone();
    let mut scene = white_world();
    scene.environment = Some(around.clone());
    scene.materials = vec![metal(gold, 0.0)];
    scene.spheres = vec![ball(Vec3::ZERO, 1.0)];
    // Seen along its normal it mirrors what is behind the viewer.
    let seen = around.radiance(Vec3::new(0.0, 0.6, 0.8), 0.0);
    let [r, g, b, _] = pixel(scene);
    for (found, of) in [(r, seen.r), (g, seen.g * 0.5), (b, seen.b * 0.25)] {
        assert!((found - of).abs() < 0.01 * of, "{found}, expected {of}");
    }
}

#[test]
fn no_metal_is_brighter_than_a_white_world_however_rough() {
    for roughness in 0..=10 {
        let mut scene = white_world();
        scene.materials = vec![metal(Rgb::WHITE, roughness as f32 / 10.0)];
        scene.spheres = vec![ball(Vec3::ZERO, 1.0)];
        let film = film(scene, 12, 4);
        for [r, _, _, alpha] in film.beauty() {
            assert!(r <= 1.02 * alpha + 1e-5, "{roughness}: {r} of {alpha}");
        }
    }
}

#[test]
fn a_floor_beside_a_wall_without_end_gets_half_of_the_light() {
    let mut scene = white_world();
    scene.camera = Camera::looking_at(Vec3::new(0.01, 3.0, 4.0), Vec3::X * 0.01, Vec3::Y, 0.01);
    scene.materials = vec![Material::matt("", Rgb::WHITE)];
    let plane = |normal| Object {
        name: String::new(),
        shape: Plane {
            point: Vec3::ZERO,
            normal,
        },
        material: 0,
    };
    scene.planes = vec![plane(Vec3::Y), plane(Vec3::X)];
    let [r, ..] = pixel(scene);
    assert!((r - 0.5).abs() < 0.03, "{r}");
}

#[test]
fn ground_that_all_light_reaches_is_not_seen() {
    let mut scene = white_world();
    scene.ground = ground();
    let [r, g, b, alpha] = pixel(scene);
    assert!([r, g, b, alpha].iter().all(|v| v.abs() < 1e-5), "{alpha}");
}

#[test]
fn ground_beside_a_wall_is_half_covered_by_black() {
    let mut scene = white_world();
    scene.camera = Camera::looking_at(Vec3::new(0.01, 3.0, 4.0), Vec3::X * 0.01, Vec3::Y, 0.01);
    scene.ground = ground();
    scene.materials = vec![Material::matt("", Rgb::WHITE)];
    let (point, normal) = (Vec3::ZERO, Vec3::X);
    scene.planes = vec![Object {
        name: String::new(),
        shape: Plane { point, normal },
        material: 0,
    }];
    let [r, _, _, alpha] = pixel(scene.clone());
    assert!(r == 0.0 && (alpha - 0.5).abs() < 0.03, "{r} {alpha}");
    // Before a background that is part of the picture it darkens that.
    scene.background = Background::plain(Rgb::WHITE, Shown::Always);
    let [r, _, _, alpha] = pixel(scene);
    assert!((r - 0.5).abs() < 0.03 && alpha == 1.0, "{r} {alpha}");
}

#[test]
fn ground_in_the_shadow_of_the_only_lamp_is_black_and_all_there() {
    let lamp = |x: f32| {
        let mut scene = white_world();
        scene.environment = None;
        scene.ground = ground();
        scene.materials = vec![Material::matt("", Rgb::WHITE)];
        scene.spheres = vec![ball(Vec3::Y * 2.0, 0.5)];
        let position = Vec3::new(x, 4.0, 0.0);
        scene.lights = vec![Light {
            name: String::new(),
            kind: LightKind::Point { position },
            color: Rgb::WHITE,
            intensity: 1.0,
            falloff: Falloff::None,
            range: None,
        }];
        pixel(scene)
    };
    assert_eq!(lamp(0.0), [0.0, 0.0, 0.0, 1.0]);
    let [.., alpha] = lamp(4.0);
    assert!(alpha.abs() < 1e-5, "{alpha}");
}

#[test]
fn ground_that_mirrors_shows_the_model_and_else_what_lies_behind() {
    let mirrored = |center: Vec3| {
        let mut scene = white_world();
        let mut glowing = Material::matt("", Rgb::BLACK);
        glowing.emission.factor = Rgb::WHITE;
        scene.materials = vec![glowing];
        // In the mirrored ray, and too small and far to matter as a shadow.
        scene.spheres = vec![ball(center, 0.5)];
        scene.ground = ground().map(|ground| Ground {
            reflectivity: 0.25,
            ..ground
        });
        pixel(scene)
    };
    let [r, _, _, alpha] = mirrored(Vec3::new(0.0, 30.0, -40.0));
    assert!(
        (r - 0.25).abs() < 1e-3 && (alpha - 0.25).abs() < 1e-2,
        "{r} {alpha}"
    );
    let [r, _, _, alpha] = mirrored(Vec3::new(0.0, 30.0, 400.0));
    assert!(r.abs() < 1e-5 && alpha.abs() < 1e-2, "{r} {alpha}");
}

#[test]
fn the_environment_is_part_of_the_picture_where_it_is_asked_for() {
    let mut scene = white_world();
    let around = STUDIO.clone();
    scene.environment = Some(around.clone());
    scene.background.shown = Shown::Environment;
    let [r, .., alpha] = pixel(scene);
    let seen = around.radiance(Vec3::new(0.0, -0.6, -0.8), 0.0).r;
    assert!(
        (r - seen).abs() < 0.02 * seen && alpha == 1.0,
        "{r}, expected {seen}"
    );
}

#[test]
fn threads_tiles_and_trees_change_no_bit_of_environment_light_and_ground() {
    let mut description = white_world();
    description.environment = Some(STUDIO.clone());
    description.ground = ground();
    description.materials = vec![
        metal(Rgb::new(1.0, 0.5, 0.25), 0.3),
        Material::matt("", Rgb::WHITE),
    ];
    description.spheres = vec![
        ball(Vec3::new(-0.6, 0.5, 0.0), 0.5),
        Object {
            material: 1,
            ..ball(Vec3::new(0.6, 0.7, 0.0), 0.7)
        },
    ];
    let scene = Scene::new(description).expect("a scene");
    let settings = Settings::new(48, 40, 4, 4, Shading::BlinnPhong).expect("settings");
    let picture = |options: &Options, settings: &Settings| {
        let accel = Accel::build(&scene, options);
        bits(&render(&scene, &accel, settings, &Progress::default()))
    };
    let expected = picture(&Options::default(), &settings);
    for threads in [1, 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let found = pool
            .expect("a pool")
            .install(|| picture(&Options::default(), &settings));
        assert_eq!(found, expected, "{threads} threads");
    }
    for side in [1, 5, 64] {
        let found = picture(&Options::default(), &settings.with_tile_side(side));
        assert_eq!(found, expected, "tiles of {side}");
    }
    let fast = Options {
        preset: Preset::Fastest,
        ..Options::default()
    };
    assert_eq!(picture(&fast, &settings), expected);
}
