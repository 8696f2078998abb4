//! Same scene, same bits: whatever threads, tiles, trees and places do.

use crate::common::picture::bits;
use glam::Vec3;
use luch::accel::{Accel, Options, Preset};
use luch::camera::Camera;
use luch::color::Rgb;
use luch::film::Film;
use luch::generate;
use luch::geometry::{Plane, Sphere};
use luch::light::{Falloff, Light, LightKind};
use luch::material::{Material, Model};
use luch::render::{Progress, Settings, render};
use luch::scene::{Object, Scene, SceneDescription};
use luch::shade::Shading;

/// Spheres, a mirror, a knot and a floor, scaled and then moved.
pub(crate) fn description(scale: f32, offset: f32) -> SceneDescription {
    let place = |p: Vec3| p * scale + offset;
    let camera = Camera::looking_at(
        place(Vec3::new(3.0, 2.5, -6.0)),
        place(Vec3::ZERO),
        Vec3::Y,
        0.7,
    );
    let knot = generate::knot(60, 10);
    let mut scene = generate::mesh_scene(knot, camera);
    for p in &mut scene.meshes[0].positions {
        *p = place(*p + Vec3::new(1.5, 0.4, 0.0));
    }
    let mut mirror = Material::matt("mirror", Rgb::grey(0.1));
    if let Model::Phong(phong) = &mut mirror.model {
        phong.reflectivity = Rgb::grey(0.7);
        phong.specular.factor = Rgb::WHITE;
    }
    scene.materials.push(mirror);
    let sphere = |center, radius: f32, material| Object {
        name: String::new(),
        shape: Sphere {
            center: place(center),
            radius: radius * scale,
        },
        material,
    };
    scene.spheres = vec![
        sphere(Vec3::new(-0.8, 0.0, 0.0), 1.0, 1),
        sphere(Vec3::new(-0.2, -0.7, -1.4), 0.3, 0),
    ];
    let floor = Plane {
        point: place(Vec3::NEG_Y),
        normal: Vec3::Y,
    };
    scene.planes = vec![Object {
        name: String::new(),
        shape: floor,
        material: 0,
    }];
    let kind = LightKind::Point {
        position: place(Vec3::new(-7.0, 10.0, -10.0)),
    };
    let lamp = Light {
        name: String::new(),
        kind,
        color: Rgb::WHITE,
        intensity: 1.0,
        falloff: Falloff::None,
        range: None,
    };
    scene.lights = vec![lamp];
    scene
}

fn settings() -> Settings {
    Settings::new(96, 72, 4, 4, Shading::BlinnPhong).expect("settings")
}

fn picture(scene: &Scene, options: &Options, settings: &Settings) -> Film {
    render(
        scene,
        &Accel::build(scene, options),
        settings,
        &Progress::default(),
    )
}

#[test]
fn threads_tiles_and_trees_change_no_bit() {
    let scene = Scene::new(description(1.0, 0.0)).expect("a scene");
    let expected = bits(&picture(&scene, &Options::default(), &settings()));
    for threads in [1, 2, 5] {
        let pool = rayon::ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .expect("a pool");
        let film = pool.install(|| picture(&scene, &Options::default(), &settings()));
        assert_eq!(bits(&film), expected, "{threads} threads");
    }
    for side in [1, 3, 16, 1000] {
        let film = picture(
            &scene,
            &Options::default(),
            &settings().with_tile_side(side),
        );
        assert_eq!(bits(&film), expected, "tiles of {side}");
    }
    for preset in [Preset::Fastest, Preset::VerySlow] {
        let options = Options {
            preset,
            leaf_size: std::num::NonZeroU8::new(7),
            ..Options::default()
        };
        assert_eq!(
            bits(&picture(&scene, &options, &settings())),
            expected,
            "{preset:?}"
        );
    }
}

/// The share of pixels that differ by more than 0.01 in any channel.
fn differing(a: &Film, b: &Film) -> f64 {
    let differs =
        |(p, q): &([f32; 4], [f32; 4])| p.iter().zip(q).any(|(p, q)| (p - q).abs() > 0.01);
    let pairs = a.beauty().zip(b.beauty());
    pairs.filter(differs).count() as f64 / f64::from(a.width * a.height)
}

#[test]
fn a_power_of_two_in_scale_changes_no_bit_of_the_light() {
    let beauty = |scale| {
        let scene = Scene::new(description(scale, 0.0)).expect("a scene");
        let film = picture(&scene, &Options::default(), &settings());
        film.beauty()
            .map(|pixel| pixel.map(f32::to_bits))
            .collect::<Vec<_>>()
    };
    let expected = beauty(1.0);
    assert_eq!(beauty(1.0 / 1024.0), expected);
    assert_eq!(beauty(1024.0), expected);
}

#[test]
fn scale_and_place_do_not_change_the_picture() {
    let film = |scale, offset| {
        picture(
            &Scene::new(description(scale, offset)).expect("a scene"),
            &Options::default(),
            &settings(),
        )
    };
    let expected = film(1.0, 0.0);
    for (scale, offset, share) in [(1e-3, 0.0, 0.005), (1e3, 0.0, 0.005), (1.0, 1e4, 0.05)] {
        let differing = differing(&film(scale, offset), &expected);
        assert!(
            differing <= share,
            "scale {scale}, offset {offset}: {differing} of the pixels differ"
        );
    }
}

#[test]
fn a_cancelled_render_gives_back_an_unfinished_film() {
    let scene = Scene::new(description(1.0, 0.0)).expect("a scene");
    let progress = Progress::default();
    progress.cancel();
    let film = render(
        &scene,
        &Accel::build(&scene, &Options::default()),
        &settings(),
        &progress,
    );
    assert!(!film.complete && film.beauty().all(|pixel| pixel == [0.0; 4]));
}

#[test]
fn progress_ends_at_one() {
    let scene = Scene::new(description(1.0, 0.0)).expect("a scene");
    let progress = Progress::default();
    let film = render(
        &scene,
        &Accel::build(&scene, &Options::default()),
        &settings(),
        &progress,
    );
    assert!(film.complete);
    assert_eq!(progress.share(), 1.0);
}
