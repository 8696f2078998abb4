//! What a film has beside its beauty.

use crate::common::{picture::bits, scenes};
use crate::invariance::description;
use glam::Vec3;
use luch::accel::{Accel, Isa, Layout, Options};
use luch::color::Rgb;
use luch::film::{BEAUTY, COST, DEPTH, Film, Layers};
use luch::geometry::Sphere;
use luch::light::{Falloff, Light, LightKind};
use luch::render::{Progress, Settings, render};
use luch::scene::{Scene, SceneDescription};
use luch::shade::Shading;

const WITH_COST: Layers = Layers {
    depth: true,
    cost: true,
    ..Layers::NONE
};

fn settings(samples: u32, shading: Shading) -> Settings {
    Settings::new(48, 36, samples, 4, shading)
        .and_then(|settings| settings.with_layers(WITH_COST))
        .expect("settings")
}

fn picture(scene: &Scene, options: &Options, settings: &Settings) -> Film {
    let accel = Accel::build(scene, options);
    render(scene, &accel, settings, &Progress::default())
}

/// The cost of each pixel, nodes and primitives.
fn costs(film: &Film) -> Vec<[f32; 2]> {
    let layer = film.layer(COST.channels).expect("the layer");
    layer.values.as_chunks().0.to_vec()
}

/// Mirrors, a floor, and a knot that lets half of the light through.
fn some_of_everything() -> Scene {
    let mut scene = description(1.0, 0.0);
    scene.materials.push(scenes::half_transparent());
    scene.instances[0].material = scene.materials.len() as u32 - 1;
    Scene::new(scene).expect("a scene")
}

#[test]
fn cost_depends_on_no_thread_tile_kernel_or_packet() {
    let scene = some_of_everything();
    let settings = settings(4, Shading::BlinnPhong);
    let expected = bits(&picture(&scene, &Options::default(), &settings));
    for threads in [1, 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let pool = pool.expect("a pool");
        let film = pool.install(|| picture(&scene, &Options::default(), &settings));
        assert_eq!(bits(&film), expected, "{threads} threads");
    }
    for side in [1, 5, 1000] {
        let film = picture(&scene, &Options::default(), &settings.with_tile_side(side));
        assert_eq!(bits(&film), expected, "tiles of {side}");
    }
    for isa in Isa::available() {
        for packets in [false, true] {
            let options = Options {
                isa,
                packets,
                ..Options::default()
            };
            assert_eq!(
                bits(&picture(&scene, &options, &settings)),
                expected,
                "{options:?}"
            );
        }
    }
}

#[test]
fn other_layers_are_the_same_with_and_without_cost() {
    let scene = some_of_everything();
    let with = settings(4, Shading::BlinnPhong);
    let without = |depth| {
        let layers = Layers {
            depth,
            ..Layers::NONE
        };
        with.with_layers(layers).expect("settings")
    };
    let with = picture(&scene, &Options::default(), &with);
    let names = |film: &Film| {
        film.layers
            .iter()
            .map(|layer| layer.channels)
            .collect::<Vec<_>>()
    };
    assert_eq!(
        names(&with),
        [BEAUTY.channels, DEPTH.channels, COST.channels]
    );
    for depth in [false, true] {
        let film = picture(&scene, &Options::default(), &without(depth));
        let count = 1 + usize::from(depth);
        assert_eq!(names(&film), names(&with)[..count]);
        assert_eq!(bits(&film), bits(&with)[..count]);
    }
}

#[test]
fn cost_without_shadows_and_mirrors_is_that_of_the_camera_ray() {
    let scene = Scene::new(description(1.0, 0.0)).expect("a scene");
    for layout in [Layout::Wide, Layout::Bvh2, Layout::CwBvh, Layout::List] {
        let options = Options {
            layout,
            ..Options::default()
        };
        let accel = Accel::build(&scene, &options);
        let view = scene.camera().view(48, 36);
        let mut rays = Vec::new();
        for y in 0..36 {
            for x in 0..48 {
                let [column, row] = [x, y].map(|along| f64::from(along) + 0.5);
                view.primary_rays(&[column], &[row], &mut rays);
            }
        }
        let counted = rays.iter().map(|ray| {
            let tests = accel.intersect_counted(ray).1;
            [tests.nodes as f32, tests.primitives as f32]
        });
        let film = picture(&scene, &options, &settings(1, Shading::Flat));
        assert_eq!(costs(&film), counted.collect::<Vec<_>>(), "{layout:?}");
    }
}

/// One sphere in the middle, and a light at the eye.
fn one_sphere() -> SceneDescription {
    let eye = Vec3::new(0.0, 0.0, 5.0);
    let camera = luch::camera::Camera::looking_at(eye, Vec3::ZERO, Vec3::Y, 0.8);
    let sphere = Sphere {
        center: Vec3::ZERO,
        radius: 1.0,
    };
    let mut scene = luch::generate::sphere_scene(vec![sphere], camera);
    scene.lights = vec![Light {
        name: String::new(),
        kind: LightKind::Point { position: eye },
        color: Rgb::WHITE,
        intensity: 1.0,
        falloff: Falloff::None,
        range: None,
    }];
    scene
}

#[test]
fn cost_is_what_can_be_counted_on_paper() {
    let nothing = picture(
        &scenes::empty().expect("a scene"),
        &Options::default(),
        &settings(4, Shading::BlinnPhong),
    );
    assert!(costs(&nothing).iter().all(|cost| *cost == [0.0; 2]));

    let scene = Scene::new(one_sphere()).expect("a scene");
    let film = picture(
        &scene,
        &Options::default(),
        &settings(4, Shading::BlinnPhong),
    );
    let costs = costs(&film);
    // A corner's rays are tested against the root's only child and miss it.
    assert_eq!(costs[0], [1.0, 0.0]);
    // In the middle a camera ray is tested against the root and the sphere, and its shadow ray again.
    assert_eq!(costs[18 * 48 + 24], [2.0, 2.0]);
}
