//! Scene files: every key, every default, and every error with the words a person reads.

mod environment;
mod wrong_files;
mod wrong_keys;
mod wrong_values;

use glam::{DVec3, Vec3};
use luch::camera::{Camera, Clip, Fov, Projection};
use luch::color::Rgb;
use luch::light::{Falloff, Light, LightKind};
use luch::load::scene_file::{open, parse};
use luch::load::{Asset, CameraSource, Options, PictureDefaults};
use luch::material::{Alpha, Material, Model, Textured, Transmission, Volume};
use luch::sampling::{Filter, Pattern};
use luch::shade::Shading;
use luch::texture::{Checker, TextureFilter};
use std::f32::consts::{FRAC_PI_2, FRAC_PI_4};
use std::f64::consts::PI;
use std::fs;
use std::path::Path;

/// The least that can be seen; 10 lines.
const LEAST: &str = "\
[camera]
position = [0, 0, -5]
look_at = [0, 0, 0]
[[material]]
name = \"red\"
[[sphere]]
center = [1, 2, 3]
radius = 0.5
material = \"red\"
";

/// The line after those of [`LEAST`].
const NEXT: usize = 10;

fn scene(text: &str) -> Result<Asset, String> {
    parse(text, Path::new("scene.toml"), &Options::default()).map_err(|error| error.to_string())
}

fn error(text: &str) -> String {
    match scene(text) {
        Ok(_) => "no error".into(),
        Err(error) => error,
    }
}

/// What [`LEAST`] gives with `more` after it.
#[track_caller]
fn with(more: &str) -> Asset {
    match scene(&format!("{LEAST}{more}")) {
        Ok(asset) => asset,
        Err(error) => panic!("{error}"),
    }
}

/// `more` after [`LEAST`] fails on its line `line`, from 1, with `message`.
#[track_caller]
fn assert_error(more: &str, line: usize, message: &str) {
    let line = NEXT + line - 1;
    assert_eq!(
        error(&format!("{LEAST}{more}")),
        format!("scene.toml: line {line}: {message}"),
        "{more}"
    );
}

/// `key = value` in the camera of an otherwise good scene.
fn camera_error(entry: &str) -> String {
    let text = LEAST.replace(
        "look_at = [0, 0, 0]",
        &format!("look_at = [0, 0, 0]\n{entry}"),
    );
    error(&text)
}

fn degrees(angle: f64) -> f32 {
    angle.to_radians() as f32
}

fn material(name: &str) -> Material {
    Material::matt(name, Rgb::grey(0.8))
}

#[test]
fn what_is_not_written_has_the_documented_default() {
    let asset = with("[[light]]\ntype = \"point\"\nposition = [1, 2, 3]");
    let camera = Camera::looking_at(Vec3::Z * -5.0, Vec3::ZERO, Vec3::Y, 40f64.to_radians());
    assert_eq!(asset.camera, Some(CameraSource::Given(camera)));
    assert_eq!(camera.clip, Clip::Ray);
    assert_eq!((camera.near, camera.far), (0.0, f32::INFINITY));
    let picture = PictureDefaults {
        width: Some(640),
        height: Some(480),
        samples: Some(1),
        pattern: Some(Pattern::Grid),
        filter: Some(Filter::Box),
        adaptive: Some(false),
        max_depth: Some(5),
        shading: Some(Shading::BlinnPhong),
        texture_filter: Some(TextureFilter::Point),
    };
    assert_eq!(asset.picture, picture);
    assert_eq!((asset.background, asset.ambient), (None, None));
    assert_eq!(asset.materials, [material("red")]);
    let light = Light {
        name: String::new(),
        kind: LightKind::Point {
            position: Vec3::new(1.0, 2.0, 3.0),
        },
        color: Rgb::WHITE,
        intensity: 1.0,
        falloff: Falloff::None,
        range: None,
    };
    assert_eq!(asset.lights, [light]);
    assert!(asset.is_scene_file);
    assert_eq!(asset.file, Path::new("scene.toml"));
    assert!(asset.models.is_empty() && asset.planes.is_empty());
    assert!(asset.files.is_empty(), "{:?}", asset.files);
}

#[test]
fn a_matt_material_is_the_default_one() {
    let Model::Phong(phong) = material("red").model else {
        panic!("matt is Phong's");
    };
    assert_eq!(phong.diffuse.factor, Rgb::grey(0.8));
    assert_eq!(phong.specular.factor, Rgb::BLACK);
    assert_eq!((phong.shininess, phong.reflectivity), (32.0, Rgb::BLACK));
}

#[test]
fn background_and_ambient_are_black_where_their_tables_are_empty() {
    let asset = with("[background]\n[ambient]\n[render]\n");
    assert_eq!(asset.background, Some(Rgb::BLACK));
    assert_eq!(asset.ambient, Some(Rgb::BLACK));
}

#[test]
fn every_key_of_the_picture_is_read() {
    let asset = with(
        "[render]\nwidth = 320\nheight = 200\nsamples = 26\npattern = \"spread\"\n\
         filter = \"blackman-harris\"\nadaptive = true\nmax_depth = 0\nshading = \"phong\"\n\
         texture_filter = \"footprint\"\n\
         [background]\ncolor = [0.1, 0.2, 0.3]\n[ambient]\ncolor = [1, 2, 3]",
    );
    let picture = PictureDefaults {
        width: Some(320),
        height: Some(200),
        samples: Some(26),
        pattern: Some(Pattern::Spread),
        filter: Some(Filter::BlackmanHarris),
        adaptive: Some(true),
        max_depth: Some(0),
        shading: Some(Shading::Phong),
        texture_filter: Some(TextureFilter::Footprint),
    };
    assert_eq!(asset.picture, picture);
    assert_eq!(asset.background, Some(Rgb::new(0.1, 0.2, 0.3)));
    assert_eq!(asset.ambient, Some(Rgb::new(1.0, 2.0, 3.0)));
}

#[test]
fn every_shading_has_its_word() {
    for (word, shading) in [
        ("blinn-phong", Shading::BlinnPhong),
        ("phong", Shading::Phong),
        ("lambert", Shading::Lambert),
        ("flat", Shading::Flat),
    ] {
        let asset = with(&format!("[render]\nshading = \"{word}\""));
        assert_eq!(asset.picture.shading, Some(shading));
    }
}

#[test]
fn every_key_of_the_camera_is_read() {
    let text = LEAST.replace(
        "look_at = [0, 0, 0]",
        "look_at = [0, 1, 0]\nup = [0, 0, 2]\nfov_x = 60\nfov_y = 45.5\nnear = 1\nfar = 9.5",
    );
    let camera = Camera {
        position: DVec3::Z * -5.0,
        look_at: DVec3::Y,
        up: DVec3::Z * 2.0,
        projection: Projection::Perspective {
            fov: Fov::Both(60f64.to_radians(), 45.5f64.to_radians()),
        },
        near: 1.0,
        far: 9.5,
        clip: Clip::Ray,
    };
    assert_eq!(
        scene(&text).map(|asset| asset.camera),
        Ok(Some(CameraSource::Given(camera)))
    );
}

#[test]
fn one_field_of_view_leaves_the_other_to_the_pictures_shape() {
    for (entry, fov) in [
        ("fov_x = 90", Fov::X(PI / 2.0)),
        ("fov_y = 90", Fov::Y(PI / 2.0)),
    ] {
        let text = LEAST.replace("[[material]]", &format!("{entry}\n[[material]]"));
        let camera = scene(&text).map(|asset| asset.camera);
        let Ok(Some(CameraSource::Given(camera))) = camera else {
            panic!("{camera:?}");
        };
        assert_eq!(camera.projection, Projection::Perspective { fov });
    }
}

#[test]
fn every_key_of_a_material_is_read() {
    let asset = with(
        "[[material]]\nname = \"all\"\ndiffuse = [0.1, 0.2, 0.3]\nspecular = [1, 1, 2]\nshininess = 0\n\
         reflectivity = 0.5\nemission = [3, 2, 1]\nchecker = { color = [0, 0.5, 1], size = 2 }",
    );
    let all = &asset.materials[1];
    let Model::Phong(phong) = &all.model else {
        panic!("{all:?}");
    };
    assert_eq!(all.name, "all");
    assert_eq!(all.emission.factor, Rgb::new(3.0, 2.0, 1.0));
    assert!(all.double_sided && all.alpha == Alpha::OPAQUE && all.normal_map.is_none());
    assert_eq!(phong.diffuse.factor, Rgb::new(0.1, 0.2, 0.3));
    assert_eq!(phong.specular.factor, Rgb::new(1.0, 1.0, 2.0));
    assert_eq!(phong.shininess, 0.0);
    assert_eq!(phong.reflectivity, Rgb::grey(0.5));
    let checker = Checker {
        color: Rgb::new(0.0, 0.5, 1.0),
        size: 2.0,
    };
    assert_eq!(phong.checker, Some(checker));
}

#[test]
fn every_key_of_what_goes_through_a_material_is_read() {
    let asset = with(
        "[[material]]\nname = \"a\"\ntransmission = 0.5\nior = 1.3\nattenuation_color = [0.1, 0.2, 0.3]\n\
         attenuation_distance = 2\ndispersion = 0.25\n\
         [[material]]\nname = \"b\"\ntransmission = 1\n\
         [[material]]\nname = \"c\"\ntransmission = 1\nthin = true",
    );
    let volume = |attenuation_color, attenuation_distance| Volume {
        attenuation_color,
        attenuation_distance,
    };
    let all = Transmission {
        share: Textured::uniform(0.5),
        ior: 1.3,
        dispersion: 0.25,
        volume: Some(volume(Rgb::new(0.1, 0.2, 0.3), 2.0)),
    };
    let clear = Transmission {
        share: Textured::uniform(1.0),
        ior: 1.5,
        dispersion: 0.0,
        volume: Some(volume(Rgb::WHITE, f32::INFINITY)),
    };
    let thin = Transmission {
        volume: None,
        ..clear.clone()
    };
    for (material, expected) in asset.materials[1..].iter().zip([all, clear, thin]) {
        assert_eq!(material.transmission, Some(expected));
        let Model::Phong(phong) = &material.model else {
            panic!("{material:?}");
        };
        assert_eq!(phong.diffuse.factor, Rgb::WHITE);
    }
}

#[test]
fn spheres_and_planes_wear_the_material_they_name() {
    let asset = with(
        "[[plane]]\npoint = [0, -1, 0]\nnormal = [0, 2, 0]\nmaterial = \"board\"\n\
         [[material]]\nname = \"board\"\nchecker = { color = [0, 0, 0], size = 1 }",
    );
    let (sphere, plane) = (&asset.spheres[0], &asset.planes[0]);
    assert_eq!(sphere.shape.center, Vec3::new(1.0, 2.0, 3.0));
    assert_eq!((sphere.shape.radius, sphere.material), (0.5, 0));
    assert_eq!(plane.shape.point, Vec3::NEG_Y);
    assert_eq!(plane.shape.normal.normalize(), Vec3::Y);
    assert_eq!(plane.material, 1);
}

#[test]
fn every_key_of_a_light_is_read() {
    let asset = with(
        "[[light]]\ntype = \"spot\"\nname = \"lamp\"\nposition = [1, 2, 3]\ndirection = [0, -2, 0]\n\
         color = [1, 0.5, 0]\nintensity = 4\nfalloff = \"inverse-square\"\ninner_angle = 10\nouter_angle = 90\n\
         [[light]]\ntype = \"spot\"\nposition = [0, 0, 0]\ndirection = [1, 0, 0]\nfalloff = \"none\"\n\
         [[light]]\ntype = \"directional\"\ndirection = [0, 0, 1]",
    );
    let lamp = Light {
        name: "lamp".into(),
        kind: LightKind::Spot {
            position: Vec3::new(1.0, 2.0, 3.0),
            direction: Vec3::Y * -2.0,
            inner_angle: degrees(10.0),
            outer_angle: FRAC_PI_2,
        },
        color: Rgb::new(1.0, 0.5, 0.0),
        intensity: 4.0,
        falloff: Falloff::InverseSquare,
        range: None,
    };
    assert_eq!(asset.lights[0], lamp);
    let default_spot = LightKind::Spot {
        position: Vec3::ZERO,
        direction: Vec3::X,
        inner_angle: 0.0,
        outer_angle: FRAC_PI_4,
    };
    assert_eq!(asset.lights[1].kind, default_spot);
    let sun = LightKind::Directional { direction: Vec3::Z };
    assert_eq!(asset.lights[2].kind, sun);
}

#[test]
fn whole_numbers_are_numbers_in_every_notation_of_toml() {
    let asset =
        with("[render]\nwidth = 1_000\nheight = 0x10\n[ambient]\ncolor = [0b1, 1_0.5, +1e-1]");
    assert_eq!(asset.picture.width, Some(1000));
    assert_eq!(asset.picture.height, Some(16));
    assert_eq!(asset.ambient, Some(Rgb::new(1.0, 10.5, 0.1)));
}

#[test]
fn tables_may_be_written_in_any_of_tomls_ways() {
    let text = "camera.position = [0, 0, 1]\ncamera.look_at = [0, 0, 0]\n\
                sphere = [{ center = [0, 0, 0], radius = 1, material = \"m\" }]\n\
                [[material]]\nname = \"m\"\n";
    assert_eq!(scene(text).map(|asset| asset.spheres.len()), Ok(1));
}

#[test]
fn an_opened_scene_file_is_the_first_file_that_was_read() {
    let folder = tempfile::tempdir().expect("a temporary folder");
    let file = folder.path().join("scene.toml");
    fs::write(&file, LEAST).expect("writable");
    assert_eq!(
        open(&file, &Options::default())
            .map(|asset| asset.files)
            .ok(),
        Some(vec![file])
    );
}

#[test]
fn the_papers_scenes_are_read() {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/scenes");
    for (name, spheres, samples) in [
        ("figure-3.toml", 1, 16),
        ("figure-4.toml", 2, 16),
        ("figure-5-1-sample.toml", 2, 1),
        ("figure-5-16-samples.toml", 2, 16),
    ] {
        let asset = open(&scenes.join(name), &Options::default()).expect(name);
        assert_eq!(asset.spheres.len(), spheres, "{name}");
        assert_eq!(asset.picture.samples, Some(samples), "{name}");
        // What the paper gives.
        assert_eq!(asset.planes[0].shape.point, Vec3::NEG_Y);
        assert_eq!(
            (asset.spheres[0].shape.center, asset.spheres[0].shape.radius),
            (Vec3::ZERO, 1.0)
        );
        let position = Vec3::new(-7.0, 10.0, -10.0);
        assert_eq!(asset.lights[0].kind, LightKind::Point { position });
    }
}

#[test]
fn both_settings_of_figure_5_are_figure_4() {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/scenes");
    let body = |name: &str| {
        let text = fs::read_to_string(scenes.join(name)).expect(name);
        let lines = text
            .lines()
            .filter(|line| !line.starts_with('#') && !line.starts_with("samples = "));
        lines.map(str::to_owned).collect::<Vec<_>>()
    };
    assert_eq!(body("figure-4.toml"), body("figure-5-1-sample.toml"));
    assert_eq!(body("figure-4.toml"), body("figure-5-16-samples.toml"));
}
