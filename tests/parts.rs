//! Light told apart: every kind of parts adds up to the beauty, and each is what it says.

use crate::common::models;
use crate::common::picture::bits;
use crate::invariance::description;
use glam::Vec3;
use luch::accel::{Accel, Options};
use luch::camera::Camera;
use luch::color::Rgb;
use luch::environment::{Environment, Surroundings, uniform};
use luch::film::{COMPONENTS, FROM_NO_LAMP, Film, Layers};
use luch::generate;
use luch::light::{Falloff, Light, LightKind};
use luch::load::{self, Viewpoint};
use luch::material::Material;
use luch::render::{Progress, Settings, render};
use luch::sampling::{Filter, Pattern, Sampling};
use luch::scene::{Scene, SceneDescription};
use luch::shade::Shading;
use std::path::Path;
use std::sync::Arc;

/// Every pixel of parts and beauty, in the film that tells everything apart.
fn told_apart(scene: &Scene, [width, height]: [u32; 2], sampling: Sampling) -> Film {
    let layers = Layers {
        components: true,
        lights: Some(scene.lights().len() as u32),
        bounces: 3,
        ..Layers::NONE
    };
    let settings = Settings::new(width, height, 1, 5, Shading::BlinnPhong)
        .and_then(|settings| settings.with_sampling(sampling))
        .and_then(|settings| settings.with_layers(layers))
        .expect("settings");
    let accel = Accel::build(scene, &Options::default());
    render(scene, &accel, &settings, &Progress::default())
}

/// The pixels of a layer, of three channels.
fn layer<'a>(film: &'a Film, name: &str) -> &'a [[f32; 3]] {
    let named = film.layers.iter().find(|layer| layer.name == name);
    let layer = named.unwrap_or_else(|| panic!("there is no layer {name}"));
    layer.values.as_chunks().0
}

/// Finds whether the layers whose names are asked for add up to `whole` in every pixel.
fn assert_sum(name: &str, film: &Film, whole: &[[f32; 3]], is_summand: impl Fn(&str) -> bool) {
    let names = film.layers.iter().map(|layer| &*layer.name);
    let names: Vec<&str> = names.filter(|name| is_summand(name)).collect();
    let summands: Vec<&[[f32; 3]]> = names.iter().map(|name| layer(film, name)).collect();
    for (pixel, whole) in whole.iter().enumerate() {
        for channel in 0..3 {
            let sum: f32 = summands.iter().map(|layer| layer[pixel][channel]).sum();
            let off = (sum - whole[channel]).abs();
            assert!(
                off <= 1e-3 * whole[channel].abs().max(1.0),
                "{name}, pixel {pixel}: {names:?} add up to {sum}, expected {}",
                whole[channel]
            );
        }
    }
}

/// Finds whether all parts add up, and whether some of them have light.
fn assert_adds_up(name: &str, film: &Film) {
    let beauty: Vec<[f32; 3]> = film.beauty().map(|[r, g, b, _]| [r, g, b]).collect();
    assert_sum(name, film, &beauty, |name| COMPONENTS.contains(&name));
    assert_sum(name, film, &beauty, |name| name.starts_with("light_"));
    let reflection = layer(film, "reflection").to_vec();
    assert_sum(name, film, &reflection, |name| {
        name.starts_with("reflection_")
    });
}

fn open(path: &Path) -> Scene {
    let asset = load::open(path, &load::Options::default()).expect("a file");
    let scene = asset.scene(0.0, &Viewpoint::of_file(4.0 / 3.0));
    scene.expect("a scene").0
}

fn of_model(samples: u32) -> Sampling {
    Sampling {
        samples,
        pattern: Pattern::Spread,
        filter: Filter::BlackmanHarris,
        adaptive: true,
    }
}

#[test]
fn parts_of_paper_scenes_add_up() {
    for name in ["figure-3", "figure-5-16-samples", "mixed", "glass"] {
        let path = format!("assets/scenes/{name}.toml");
        let scene = open(&Path::new(env!("CARGO_MANIFEST_DIR")).join(path));
        let film = told_apart(&scene, [60, 45], Sampling::grid(4));
        assert_adds_up(name, &film);
    }
}

#[test]
fn parts_of_outside_models_add_up() {
    let Some(folder) = models::folder("parts", "valid") else {
        return;
    };
    for name in [
        "khr-DamagedHelmet-Binary",
        "khr-IridescenceLamp-glTF",
        "khr-ToyCar-glTF",
        "khr-ClearCoatCarPaint-glTF",
        "khr-AlphaBlendModeTest-Binary",
        "khr-TransmissionRoughnessTest-Binary",
        "khr-LightsPunctualLamp-glTF",
    ] {
        let files = models::below(&folder.join(name), &["glb", "gltf"]);
        let Some(path) = files.first() else {
            models::say(&format!("SKIPPED, not passed: parts: there is no {name}"));
            continue;
        };
        assert_adds_up(name, &told_apart(&open(path), [32, 24], of_model(16)));
    }
}

#[test]
fn whatever_the_filter_parts_add_up_and_the_beauty_has_the_bits_it_has_alone() {
    let scene = Scene::new(description(1.0, 0.0)).expect("a scene");
    for filter in [
        Filter::Box,
        Filter::Gaussian,
        Filter::Mitchell,
        Filter::BlackmanHarris,
    ] {
        let sampling = Sampling {
            filter,
            ..of_model(20)
        };
        let film = told_apart(&scene, [48, 36], sampling);
        assert_adds_up(&format!("{filter:?}"), &film);
        let settings = Settings::new(48, 36, 1, 5, Shading::BlinnPhong)
            .and_then(|settings| settings.with_sampling(sampling))
            .and_then(|settings| settings.with_layers(Layers::NONE))
            .expect("settings");
        let accel = Accel::build(&scene, &Options::default());
        let alone = render(&scene, &accel, &settings, &Progress::default());
        assert_eq!(bits(&alone)[0], bits(&film)[0], "{filter:?}");
    }
}

#[test]
fn without_a_lamp_the_picture_is_less_by_its_layer() {
    let mut whole = description(1.0, 0.0);
    whole.lights.push(Light {
        name: "from the side".into(),
        kind: LightKind::Directional {
            direction: Vec3::new(1.0, -1.0, 0.0).normalize(),
        },
        color: Rgb::new(1.0, 0.5, 0.25),
        intensity: 0.5,
        falloff: Falloff::None,
        range: None,
    });
    let film = told_apart(
        &Scene::new(whole.clone()).expect("a scene"),
        [40, 30],
        Sampling::grid(1),
    );
    let names = film.layers.iter().map(|layer| layer.name.to_string());
    let names = names.filter(|name| name.starts_with("light_"));
    let of_lamps = names.take(whole.lights.len());
    for (number, name) in of_lamps.enumerate() {
        let mut without = whole.clone();
        without.lights.remove(number);
        let without = Scene::new(without).expect("a scene");
        let dark = told_apart(&without, [40, 30], Sampling::grid(1));
        let pixels = film.beauty().zip(dark.beauty()).zip(layer(&film, &name));
        for ((with, without), light) in pixels {
            for channel in 0..3 {
                let off = with[channel] - without[channel] - light[channel];
                assert!(off.abs() < 1e-5, "{name}: {with:?} {without:?} {light:?}");
            }
        }
    }
}

/// One pixel's parts by name.
fn parts(description: SceneDescription) -> impl Fn(&str) -> f32 {
    let scene = Scene::new(description).expect("a scene");
    let film = told_apart(&scene, [1, 1], Sampling::grid(1));
    move |name| layer(&film, name)[0][0]
}

/// A wall of this material before the camera, lit head-on by a light that travels with the eye.
fn wall(material: Material) -> SceneDescription {
    let camera = Camera::looking_at(Vec3::Z * 4.0, Vec3::ZERO, Vec3::Y, 0.3);
    let mut scene = generate::mesh_scene(generate::icosphere(0), camera);
    scene.meshes.clear();
    scene.instances.clear();
    scene.planes = vec![luch::scene::Object {
        name: "wall".into(),
        shape: luch::geometry::Plane {
            point: Vec3::ZERO,
            normal: Vec3::Z,
        },
        material: 0,
    }];
    scene.materials = vec![material];
    scene.ambient = Rgb::BLACK;
    scene.lights = vec![Light {
        name: "key".into(),
        kind: LightKind::Directional {
            direction: Vec3::NEG_Z,
        },
        color: Rgb::WHITE,
        intensity: 0.5,
        falloff: Falloff::None,
        range: None,
    }];
    scene
}

#[test]
fn a_matt_wall_has_diffuse_light_of_its_lamp_and_what_it_emits() {
    let mut material = Material::matt("wall", Rgb::grey(0.8));
    material.emission.factor = Rgb::grey(0.25);
    let mut scene = wall(material);
    scene.ambient = Rgb::grey(0.1);
    let part = parts(scene);
    let close = |name: &str, expected: f32| {
        let found = part(name);
        assert!((found - expected).abs() < 1e-6, "{name}: {found}");
    };
    close("diffuse", 0.4);
    close("light_key", 0.4);
    close("emission", 0.25);
    close("light_emission", 0.25);
    close("ambient", 0.08);
    close("light_ambient", 0.08);
    for name in [
        "specular",
        "reflection",
        "transmission",
        "light_environment",
    ] {
        close(name, 0.0);
    }
}

#[test]
fn what_a_mirror_shows_is_reflection_and_keeps_its_lamp() {
    // A mirror sends the eye back to a matt wall behind it.
    let mut scene = wall(Material::matt("mirror", Rgb::BLACK));
    if let luch::material::Model::Phong(phong) = &mut scene.materials[0].model {
        phong.reflectivity = Rgb::grey(0.5);
    }
    scene.materials.push(Material::matt("wall", Rgb::WHITE));
    let mut behind = scene.planes[0].clone();
    (behind.shape.point, behind.shape.normal) = (Vec3::Z * 5.0, Vec3::NEG_Z);
    behind.material = 1;
    scene.planes.push(behind);
    scene.lights[0].kind = LightKind::Point {
        position: Vec3::new(1.0, 0.0, 2.0),
    };
    let part = parts(scene);
    let reflected = part("reflection");
    assert!(reflected > 0.1, "{reflected}");
    assert_eq!(part("reflection_1"), reflected);
    assert_eq!((part("reflection_2"), part("diffuse")), (0.0, 0.0));
    assert_eq!(part("light_key"), reflected);
}

#[test]
fn light_from_everywhere_is_diffuse_light_of_the_environment() {
    let mut scene = wall(Material::matt("wall", Rgb::grey(0.5)));
    scene.lights.clear();
    scene.environment = Some(Arc::new(Surroundings::new(&Environment {
        radiance: Arc::new(uniform(Rgb::WHITE)),
        rotation: 0.0,
        intensity: 1.0,
        lights: 16,
    })));
    let part = parts(scene);
    assert!((part("diffuse") - 0.5).abs() < 1e-4);
    assert!((part("light_environment") - 0.5).abs() < 1e-4);
    for name in FROM_NO_LAMP
        .iter()
        .filter(|name| **name != "light_environment")
    {
        assert_eq!(part(name), 0.0, "{name}");
    }
}
