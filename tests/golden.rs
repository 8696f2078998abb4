//! A few small pictures, one idea each. They are the same on every machine, so every pixel counts.
//!
//! On failure the picture and the difference are written beside the build; `BLESS=1` makes the pictures anew.

use crate::common::picture;
use image::{ImageFormat, RgbImage};
use luch::accel::{Accel, Options};
use luch::load::{self, Asset};
use luch::output::{self, Display, Format};
use luch::render::{Progress, Settings, render};
use luch::scene::SceneDescription;
use luch::scene::{Background, Object, Scene, Shown};
use luch::texture::TextureFilter;
use std::path::{Path, PathBuf};

const WIDTH: u32 = 96;
const HEIGHT: u32 = 72;

fn project(path: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join(path)
}

/// Renders a scene as the program would, and holds it against `tests/golden/NAME.png`.
fn assert_golden(name: &str, scene: &Scene, display: Display) {
    let settings = Settings::new(WIDTH, HEIGHT, 4, 5, Default::default()).expect("settings");
    // The paper's checkerboards are of points.
    let settings = settings.with_texture_filter(TextureFilter::Point);
    let film = render(
        scene,
        &Accel::build(scene, &Options::default()),
        &settings,
        &Progress::default(),
    );
    let options = output::Options {
        display,
        ..Default::default()
    };
    let mut png = Vec::new();
    output::encode(&film, Format::Png, &options, Path::new(name), &mut png).expect("a picture");
    let golden = project(&format!("tests/golden/{name}.png"));
    if std::env::var_os("BLESS").is_some() {
        std::fs::write(&golden, &png).expect("a writable golden picture");
    }
    let actual = decoded(&png);
    let expected = decoded(&std::fs::read(&golden).expect("a golden picture; BLESS=1 makes it"));
    let differing = actual
        .pixels()
        .zip(expected.pixels())
        .filter(|(a, b)| a != b)
        .count();
    if differing > 0 || actual.dimensions() != expected.dimensions() {
        let folder = Path::new(env!("CARGO_TARGET_TMPDIR"));
        std::fs::write(folder.join(format!("{name}.actual.png")), &png)
            .expect("a writable build folder");
        let difference = RgbImage::from_fn(WIDTH, HEIGHT, |x, y| {
            let (a, b) = (
                actual.get_pixel_checked(x, y),
                expected.get_pixel_checked(x, y),
            );
            let (Some(a), Some(b)) = (a, b) else {
                return image::Rgb([255; 3]);
            };
            image::Rgb(std::array::from_fn(|c| {
                a.0[c].abs_diff(b.0[c]).saturating_mul(8)
            }))
        });
        difference
            .save(folder.join(format!("{name}.difference.png")))
            .expect("a writable build folder");
        panic!(
            "{name}: {differing} pixels differ; see {}",
            folder.display()
        );
    }
}

fn decoded(png: &[u8]) -> RgbImage {
    image::load_from_memory_with_format(png, ImageFormat::Png)
        .expect("a PNG")
        .into_rgb8()
}

fn opened(path: &str) -> Asset {
    load::open(&project(path), &load::Options::default()).unwrap_or_else(|error| panic!("{error}"))
}

fn scene_of(path: &str) -> Scene {
    let aspect = f64::from(WIDTH) / f64::from(HEIGHT);
    let (scene, _) = opened(path)
        .scene(0.0, &picture::viewpoint(aspect))
        .unwrap_or_else(|error| panic!("{error}"));
    scene
}

#[test]
fn figure_3_has_a_highlight_and_a_hard_shadow() {
    assert_golden(
        "figure-3",
        &scene_of("assets/scenes/figure-3.toml"),
        Display::Srgb,
    );
}

#[test]
fn figure_4_mirrors_a_checkerboard() {
    assert_golden(
        "figure-4",
        &scene_of("assets/scenes/figure-4.toml"),
        Display::Srgb,
    );
}

#[test]
fn a_model_stands_among_spheres_on_a_plane() {
    assert_golden(
        "mixed",
        &scene_of("assets/scenes/mixed.toml"),
        Display::Srgb,
    );
}

#[test]
fn glass_bends_light_and_tints_shadows() {
    assert_golden(
        "glass",
        &scene_of("assets/scenes/glass.toml"),
        Display::Srgb,
    );
}

#[test]
fn a_model_without_camera_and_light_is_framed_and_lit() {
    assert_golden(
        "cube",
        &scene_of("assets/models/cube.glb"),
        Display::PbrNeutral,
    );
}

#[test]
fn a_transparent_sphere_shows_what_is_behind_it_and_casts_a_light_shadow() {
    let Asset {
        spheres,
        planes,
        lights,
        mut materials,
        camera,
        ..
    } = opened("assets/scenes/figure-3.toml");
    let Some(load::CameraSource::Given(camera)) = camera else {
        panic!("figure 3 has a camera")
    };
    let mut behind: Object<_> = spheres[0].clone();
    behind.shape.center += glam::Vec3::new(-1.0, -0.1, 1.2);
    behind.shape.radius = 0.9;
    behind.material = materials.len() as u32;
    materials.push(luch::material::Material::matt(
        "behind",
        luch::color::Rgb::new(0.8, 0.2, 0.1),
    ));
    materials[spheres[0].material as usize].alpha = crate::common::scenes::half_transparent().alpha;
    let background = Background::plain(luch::color::Rgb::grey(0.5), Shown::Always);
    let spheres = vec![spheres[0].clone(), behind];
    let description = SceneDescription {
        spheres,
        planes,
        lights,
        materials,
        background,
        ..SceneDescription::empty(camera)
    };
    assert_golden(
        "transparent",
        &Scene::new(description).expect("a scene"),
        Display::Srgb,
    );
}
