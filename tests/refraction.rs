//! Glass whose picture is known on paper.

use crate::common::picture::bits;
use crate::common::scenes::half_transparent;
use crate::invariance;
use glam::Vec3;
use luch::accel::{Accel, Isa, Options, Preset};
use luch::camera::Camera;
use luch::color::Rgb;
use luch::film::Film;
use luch::generate;
use luch::geometry::{Plane, Sphere};
use luch::light::{Falloff, Light, LightKind};
use luch::material::{Finish, Material, MetallicRoughness, Model, Textured, Transmission, Volume};
use luch::mesh::Mesh;
use luch::render::{Progress, Settings, render};
use luch::scene::{Background, Object, Scene, SceneDescription, Shown};
use luch::shade::Shading;
use luch::shade::facets::albedo;

/// Behind what is looked through, so that a picture tells it from everything else.
const GLOW: u32 = 1;

/// A body of this index that takes no light away, or a sheet of it.
fn glass(ior: f32, thin: bool) -> Material {
    let clear = Volume {
        attenuation_color: Rgb::WHITE,
        attenuation_distance: f32::INFINITY,
    };
    let transmission = Transmission {
        share: Textured::uniform(1.0),
        ior,
        dispersion: 0.0,
        volume: (!thin).then_some(clear),
    };
    Material {
        transmission: Some(transmission),
        ..Material::matt("glass", Rgb::WHITE)
    }
}

fn tinted(color: Rgb, distance: f32) -> Material {
    let mut material = glass(1.0, false);
    if let Some(transmission) = &mut material.transmission {
        transmission.volume = Some(Volume {
            attenuation_color: color,
            attenuation_distance: distance,
        });
    }
    material
}

fn glow() -> Material {
    let mut material = Material::matt("glow", Rgb::BLACK);
    material.emission.factor = Rgb::WHITE;
    material
}

fn plane(point: Vec3, normal: Vec3, material: u32) -> Object<Plane> {
    let name = String::new();
    Object {
        name,
        shape: Plane { point, normal },
        material,
    }
}

fn sphere(center: Vec3, radius: f32, material: u32) -> Object<Sphere> {
    let name = String::new();
    Object {
        name,
        shape: Sphere { center, radius },
        material,
    }
}

/// A scene before black of one material, and what glows, seen from a point along a direction.
fn looking(from: Vec3, along: Vec3, material: Material) -> SceneDescription {
    let up = if along.x == 0.0 && along.z == 0.0 {
        Vec3::X
    } else {
        Vec3::Y
    };
    SceneDescription {
        materials: vec![material, glow()],
        ..SceneDescription::empty(Camera::looking_at(from, from + along, up, 0.5))
    }
}

/// Everything between two planes, z = 0 and z = -`thickness`.
fn slab(thickness: f32) -> Vec<Object<Plane>> {
    let behind = Vec3::NEG_Z * thickness;
    vec![plane(Vec3::ZERO, Vec3::Z, 0), plane(behind, Vec3::NEG_Z, 0)]
}

fn film(description: SceneDescription, side: u32, max_depth: u32) -> Film {
    let scene = Scene::new(description).expect("a scene");
    let settings = Settings::new(side, side, 1, max_depth, Shading::BlinnPhong).expect("settings");
    let accel = Accel::build(&scene, &Options::default());
    render(&scene, &accel, &settings, &Progress::default())
}

/// The one pixel of a picture: the ray along the camera's axis.
fn pixel(description: SceneDescription, max_depth: u32) -> [f32; 4] {
    let film = film(description, 1, max_depth);
    film.beauty().next().expect("a pixel")
}

/// Along -z, at an angle with it.
fn slanted(degrees: f64) -> Vec3 {
    let (sin, cos) = degrees.to_radians().sin_cos();
    Vec3::new(sin as f32, 0.0, -cos as f32)
}

fn assert_close(found: f32, expected: f64) {
    assert!(
        (f64::from(found) - expected).abs() < 1e-5,
        "{found}, expected {expected}"
    );
}

#[test]
fn a_slab_moves_a_ray_sideways_by_what_snells_law_says() {
    let (degrees, thickness): (f64, f64) = (50.0, 1.0);
    let sin = degrees.to_radians().sin();
    let bent = (sin / 1.5).asin();
    // Enters at the origin; one more unit behind the slab.
    let x = thickness * bent.tan() + degrees.to_radians().tan();
    let at = |x: f64| {
        let along = slanted(degrees);
        let mut scene = looking(along * -2.0, along, glass(1.5, false));
        scene.planes = slab(1.0);
        scene.spheres = vec![sphere(Vec3::new(x as f32, 0.0, -2.0), 1e-4, GLOW)];
        pixel(scene, 0)[0]
    };
    assert!(at(x) > 0.8, "it arrives within a ten-thousandth");
    assert_eq!((at(x + 4e-4), at(x - 4e-4)), (0.0, 0.0));
    let unbent = 2.0 * degrees.to_radians().tan();
    assert_eq!(at(unbent), 0.0);
}

#[test]
fn normals_that_are_tilted_near_a_rim_catch_no_light_in_a_wall() {
    // Beyond the critical angle of 41.8 degrees for who asks the normal alone.
    let tilted = Vec3::new(1.0, 0.0, -1.0).normalize();
    let square = |z: f32| {
        [(-1.0, -1.0), (1.0, -1.0), (1.0, 1.0), (-1.0, 1.0)].map(|(x, y)| Vec3::new(x, y, z))
    };
    let wall = Mesh {
        positions: [square(0.0), square(-0.1)].concat(),
        triangles: vec![[0, 1, 2], [0, 2, 3], [4, 6, 5], [4, 7, 6]],
        normals: [[Vec3::Z; 4], [tilted; 4]].concat(),
        ..Mesh::default()
    };
    let camera = Camera::looking_at(Vec3::Z, Vec3::ZERO, Vec3::Y, 0.5);
    let mut scene = generate::mesh_scene(wall, camera);
    scene.materials = vec![glass(1.5, false), glow()];
    scene.lights.clear();
    scene.planes = vec![plane(Vec3::NEG_Z * 2.0, Vec3::Z, GLOW)];
    // Of either boundary 4 % are mirrored.
    assert_close(pixel(scene, 0)[0], 0.96 * 0.96);
}

#[test]
fn a_ball_of_glass_focuses_at_its_focal_length() {
    // n R / (2 (n - 1)) from its centre.
    for (ior, focus) in [(1.5f32, 1.5f32), (1.8, 1.125), (2.0, 1.0)] {
        for height in [0.01f32, -0.02] {
            let from = Vec3::new(0.0, height, 5.0);
            let mut scene = looking(from, Vec3::NEG_Z, glass(ior, false));
            let spot = Vec3::NEG_Z * (focus + 1e-4);
            scene.spheres = vec![sphere(Vec3::ZERO, 1.0, 0), sphere(spot, 5e-5, GLOW)];
            assert!(pixel(scene, 0)[0] > 0.7, "{ior} {height}");
        }
    }
}

#[test]
fn from_within_the_world_is_seen_up_to_the_critical_angle() {
    // asin(1 / 1.5) is 41.81 degrees. Above shines the background, below a floor.
    let seen = |degrees: f64| {
        let (sin, cos) = degrees.to_radians().sin_cos();
        let up = Vec3::new(sin as f32, cos as f32, 0.0);
        let mut scene = looking(Vec3::NEG_Y, up, glass(1.5, false));
        scene.planes = vec![
            plane(Vec3::ZERO, Vec3::Y, 0),
            plane(Vec3::NEG_Y * 3.0, Vec3::Y, GLOW),
        ];
        scene.materials[1].emission.factor = Rgb::new(1.0, 0.0, 0.0);
        scene.background = Background::plain(Rgb::new(0.0, 0.0, 1.0), Shown::Always);
        pixel(scene, 1)
    };
    let [red, _, blue, _] = seen(40.0);
    assert!(
        blue > 0.5 && (red + blue - 1.0).abs() < 1e-5,
        "{red} {blue}"
    );
    for degrees in [41.9, 60.0, 89.0] {
        assert_eq!(seen(degrees), [1.0, 0.0, 0.0, 1.0], "{degrees}");
    }
}

/// Fresnel's reflectance at an index of 1.5, from its form in sines and tangents, reckoned with 30 digits; at 56.31 degrees,
/// Brewster's angle, ((1 - n^2) / (1 + n^2))^2 / 2.
const REFLECTED: [(f64, f64); 6] = [
    (0.0, 0.04),
    (30.0, 0.041_522_625_975_8),
    (56.309_932_474_02, 0.073_964_497_041_4),
    (60.0, 0.089_186_712_802_2),
    (75.0, 0.253_060_562_990_3),
    (85.0, 0.612_799_645_264_8),
];

#[test]
fn a_boundary_lets_through_what_fresnels_equations_leave() {
    for (degrees, reflected) in REFLECTED {
        for thin in [false, true] {
            let along = slanted(degrees);
            let mut scene = looking(along * -2.0, along, glass(1.5, thin));
            scene.planes = vec![
                plane(Vec3::ZERO, Vec3::Z, 0),
                plane(Vec3::NEG_Z, Vec3::Z, GLOW),
            ];
            assert_close(pixel(scene.clone(), 1)[0], 1.0 - reflected);
            // What is before it is mirrored by the rest.
            scene.planes[1].shape.point = Vec3::Z * 9.0;
            assert_close(pixel(scene, 1)[0], reflected);
        }
    }
}

#[test]
fn metallic_roughness_has_the_same_fresnel_where_it_is_smooth() {
    for (degrees, reflected) in REFLECTED {
        let along = slanted(degrees);
        let mut scene = looking(along * -2.0, along, physical(Rgb::WHITE, 0.0));
        let floor = plane(Vec3::NEG_Z, Vec3::Z, GLOW);
        scene.planes = vec![plane(Vec3::ZERO, Vec3::Z, 0), floor];
        assert_close(pixel(scene.clone(), 1)[0], 1.0 - reflected);
        scene.planes[1].shape.point = Vec3::Z * 9.0;
        assert_close(pixel(scene, 1)[0], reflected);
    }
}

#[test]
fn frosted_glass_is_glossy_from_without_alone() {
    let mut frosted = physical(Rgb::WHITE, 0.0);
    if let Model::MetallicRoughness(m) = &mut frosted.model {
        m.roughness = 1.0;
    }
    let seen_along = |along: Vec3| {
        let mut scene = looking(along * -2.0, along, frosted.clone());
        scene.ambient = Rgb::WHITE;
        scene.planes = vec![plane(Vec3::ZERO, Vec3::Z, 0)];
        pixel(scene, 1)[0]
    };
    let [head_on, edge] = albedo(1.0, 1.0);
    let again = 1.0 + 0.04 * (1.0 / (head_on + edge) - 1.0);
    let once = 0.04 * head_on + edge;
    assert_close(seen_along(Vec3::NEG_Z), f64::from(once * again));
    // Within, all that is reflected is in the mirror, before which is nothing here.
    assert_close(seen_along(Vec3::Z), 0.0);
}

/// Glass as glTF has it, seen from the front alone.
fn physical(base_color: Rgb, metallic: f32) -> Material {
    Material {
        model: Model::MetallicRoughness(MetallicRoughness {
            base_color: Textured::uniform(base_color),
            metallic,
            roughness: 0.0,
            metallic_roughness: None,
            occlusion: Textured::uniform(1.0),
            finish: None,
        }),
        double_sided: false,
        ..glass(1.5, false)
    }
}

#[test]
fn metals_let_nothing_through() {
    let mut scene = looking(Vec3::Z, Vec3::NEG_Z, physical(Rgb::WHITE, 1.0));
    let floor = plane(Vec3::NEG_Z, Vec3::Z, GLOW);
    scene.planes = vec![plane(Vec3::ZERO, Vec3::Z, 0), floor];
    assert_eq!(pixel(scene, 5), [0.0, 0.0, 0.0, 1.0]);
}

#[test]
fn beers_law_takes_light_away_by_the_length_of_the_way() {
    // An index of 1, so that nothing else does. At 60 degrees the way is twice as long.
    for (degrees, exponent) in [(0.0, 2.0f64), (60.0, 4.0)] {
        let along = slanted(degrees);
        let material = tinted(Rgb::new(0.5, 0.8, 1.0), 1.5);
        let mut scene = looking(along * -2.0, along, material);
        scene.planes = slab(3.0);
        scene.planes.push(plane(Vec3::NEG_Z * 5.0, Vec3::Z, GLOW));
        let [r, g, b, _] = pixel(scene, 0);
        assert_close(r, 0.5f64.powf(exponent));
        assert_close(g, 0.8f64.powf(exponent));
        assert_close(b, 1.0);
    }
}

#[test]
fn a_transparent_layer_within_a_body_does_not_make_its_way_count_twice() {
    let mut scene = looking(Vec3::Z, Vec3::NEG_Z, tinted(Rgb::grey(0.5), 1.0));
    scene.planes = slab(2.0);
    scene.planes.push(plane(Vec3::NEG_Z * 1.5, Vec3::Z, 2));
    scene.planes.push(plane(Vec3::NEG_Z * 5.0, Vec3::Z, GLOW));
    scene.materials.push(half_transparent());
    assert_close(pixel(scene, 0)[0], 0.5 * 0.25);
}

#[test]
fn colour_tints_at_each_boundary_once_at_a_sheet_and_twice_through_a_body() {
    for (thin, expected) in [(true, 0.5), (false, 0.25)] {
        let mut material = glass(1.0, thin);
        if let Model::Phong(phong) = &mut material.model {
            phong.diffuse.factor = Rgb::new(0.5, 1.0, 1.0);
        }
        let mut scene = looking(Vec3::Z, Vec3::NEG_Z, material);
        scene.planes = if thin {
            vec![plane(Vec3::ZERO, Vec3::Z, 0)]
        } else {
            slab(1.0)
        };
        scene.planes.push(plane(Vec3::NEG_Z * 5.0, Vec3::Z, GLOW));
        let [r, g, b, _] = pixel(scene, 0);
        assert_close(r, expected);
        assert_eq!((g, b), (1.0, 1.0));
    }
}

#[test]
fn a_thin_sheet_leaves_the_direction() {
    let along = slanted(70.0);
    let mut scene = looking(along * -2.0, along, glass(1.5, true));
    scene.planes = vec![plane(Vec3::ZERO, Vec3::Z, 0); 20];
    scene.spheres = vec![sphere(along * 3.0, 1e-4, GLOW)];
    // Twenty sheets at one place, and no mirror bounce is needed to see through them: (1 - F(70 degrees))^20.
    let one: f64 = 1.0 - 0.171_042_535_4;
    let found = f64::from(pixel(scene, 0)[0]);
    assert!((found - one.powi(20)).abs() < 1e-4, "{found}");
}

#[test]
fn what_is_not_let_through_is_diffuse() {
    let mut material = glass(1.0, true);
    if let Some(transmission) = &mut material.transmission {
        transmission.share.factor = 0.25;
    }
    let mut scene = looking(Vec3::Z, Vec3::NEG_Z, material);
    scene.ambient = Rgb::new(1.0, 0.0, 0.0);
    scene.planes = vec![plane(Vec3::ZERO, Vec3::Z, 0)];
    scene.background = Background::plain(Rgb::new(0.0, 0.0, 1.0), Shown::Always);
    assert_eq!(pixel(scene, 0), [0.75, 0.0, 0.25, 1.0]);
}

#[test]
fn nothing_behind_a_sheet_is_transparent_and_behind_a_body_is_the_background() {
    let behind = |thin| {
        let mut scene = looking(Vec3::Z, Vec3::NEG_Z, glass(1.5, thin));
        scene.planes = slab(1.0);
        scene.background.color = Rgb::grey(0.5);
        pixel(scene, 0)
    };
    let [.., alpha] = behind(true);
    assert_close(alpha, 1.0 - 0.96 * 0.96);
    let [r, _, _, alpha] = behind(false);
    assert_close(r, 0.5 * 0.96 * 0.96);
    assert_eq!(alpha, 1.0);
}

/// Everything that is seen of something in an evenly white world.
fn furnace(description: SceneDescription) -> Vec<f32> {
    let background = Background::plain(Rgb::WHITE, Shown::Always);
    let film = film(
        SceneDescription {
            background,
            ambient: Rgb::BLACK,
            lights: Vec::new(),
            ..description
        },
        40,
        1000,
    );
    film.beauty().flat_map(|[r, g, b, _]| [r, g, b]).collect()
}

#[test]
fn clear_glass_is_as_bright_as_an_evenly_bright_world() {
    let camera = Camera::looking_at(Vec3::Z * 5.0, Vec3::ZERO, Vec3::Y, 0.45);
    let ball = || {
        vec![Sphere {
            center: Vec3::ZERO,
            radius: 1.0,
        }]
    };
    let mut of_shape = generate::sphere_scene(ball(), camera);
    of_shape.materials = vec![glass(1.5, false)];
    let mut dispersing = of_shape.clone();
    if let Some(transmission) = &mut dispersing.materials[0].transmission {
        transmission.dispersion = 1.0;
    }
    // Its inner side is there, though the material is not double-sided.
    let mut of_facets = generate::mesh_scene(generate::icosphere(3), camera);
    of_facets.materials = vec![physical(Rgb::WHITE, 0.0)];
    let mut smooth = of_facets.clone();
    for mesh in &mut smooth.meshes {
        mesh.normals = mesh.positions.iter().map(|p| p.normalize()).collect();
    }
    for (name, scene) in [
        ("shape", of_shape),
        ("dispersing", dispersing),
        ("facets", of_facets),
        ("smooth", smooth),
    ] {
        let light = furnace(scene);
        let mean = light.iter().sum::<f32>() / light.len() as f32;
        let (least, most) = light
            .iter()
            .fold((1.0f32, 1.0f32), |(a, b), l| (a.min(*l), b.max(*l)));
        assert!(most <= 1.0 + 1e-5, "{name}: {most}");
        // What is too faint to be followed is missing, most where nearly all is mirrored, at the edge of a true sphere.
        // Facets send some light round and round; that, too, comes out.
        let (darkest, means) = match name {
            "facets" | "smooth" => (0.998, 0.9999),
            _ => (0.97, 0.999),
        };
        assert!(least > darkest && mean > means, "{name}: {least} {mean}");
    }
}

#[test]
fn a_clear_slab_of_any_index_is_as_bright_as_an_evenly_bright_world() {
    // What is mirrored above the 4 % of glTF's own index must not be taken from what goes through a second time.
    for ior in [1.0, 1.33, 1.5, 1.8, 2.4] {
        let mut material = physical(Rgb::WHITE, 0.0);
        material.transmission = glass(ior, false).transmission;
        if let Model::MetallicRoughness(m) = &mut material.model {
            let finish = Finish {
                ior,
                ..Finish::PLAIN
            };
            m.finish = Some(Box::new(finish));
        }
        for degrees in [0.0, 40.0, 70.0] {
            let along = slanted(degrees);
            let mut scene = looking(along * -2.0, along, material.clone());
            scene.planes = slab(1.0);
            let light = furnace(scene);
            // Each of the two rays that a boundary makes may be too faint to be followed.
            let faint = 8.0 / 4096.0;
            let wrong = light.iter().find(|l| (**l - 1.0).abs() > faint);
            assert_eq!(wrong, None, "{ior} {degrees}");
        }
    }
}

#[test]
fn dispersion_sends_colours_apart() {
    // 10 is 20 over an Abbe number of 2: the indices are 1.375, 1.5 and 1.625.
    let colors = [(1.375f64, 0), (1.5, 1), (1.625, 2)];
    for (ior, channel) in colors {
        let bent = (60f64.to_radians().sin() / ior).asin();
        let along = slanted(60.0);
        let mut scene = looking(along * -2.0, along, glass(1.5, false));
        if let Some(transmission) = &mut scene.materials[0].transmission {
            transmission.dispersion = 10.0;
        }
        scene.planes = vec![plane(Vec3::ZERO, Vec3::Z, 0)];
        let at = Vec3::new(bent.tan() as f32, 0.0, -1.0);
        scene.spheres = vec![sphere(at, 1e-3, GLOW)];
        let found = pixel(scene, 0);
        for other in 0..3 {
            assert_eq!(found[other] > 0.8, other == channel, "{ior}: {found:?}");
            assert!(found[other] > 0.8 || found[other] == 0.0);
        }
    }
}

fn lamp(kind: LightKind) -> Light {
    Light {
        name: String::new(),
        kind,
        color: Rgb::WHITE,
        intensity: 1.0,
        falloff: Falloff::None,
        range: None,
    }
}

/// The light on a grey wall at z = -5, lit along its normal from +z through what stands before it, the camera between.
fn lit_through(mut scene: SceneDescription) -> [f32; 4] {
    scene.planes.push(plane(Vec3::NEG_Z * 5.0, Vec3::Z, 1));
    scene.materials[1] = Material::matt("wall", Rgb::grey(0.5));
    let kinds = [
        LightKind::Directional {
            direction: Vec3::NEG_Z,
        },
        LightKind::Point {
            position: Vec3::Z * 3.0,
        },
    ];
    let [sun, point] = kinds.map(|kind| {
        let lights = vec![lamp(kind)];
        pixel(
            SceneDescription {
                lights,
                ..scene.clone()
            },
            0,
        )
    });
    for (a, b) in sun.iter().zip(&point) {
        assert!((a - b).abs() < 1e-5, "{sun:?} {point:?}");
    }
    sun
}

#[test]
fn shadows_of_sheets_and_bodies_are_tinted() {
    let from = Vec3::NEG_Z * 4.0;
    let mut sheet = glass(1.5, true);
    if let Model::Phong(phong) = &mut sheet.model {
        phong.diffuse.factor = Rgb::new(1.0, 0.5, 0.0);
    }
    let mut scene = looking(from, Vec3::NEG_Z, sheet);
    scene.planes = vec![plane(Vec3::ZERO, Vec3::Z, 0)];
    let [r, g, b, _] = lit_through(scene);
    assert_close(r, 0.5 * 0.96);
    assert_close(g, 0.25 * 0.96);
    assert_eq!(b, 0.0);
    let mut scene = looking(from, Vec3::NEG_Z, tinted(Rgb::new(0.5, 0.8, 1.0), 1.5));
    scene.planes = slab(3.0);
    let [r, g, b, _] = lit_through(scene);
    assert_close(r, 0.5 * 0.25);
    assert_close(g, 0.5 * 0.64);
    assert_close(b, 0.5);
}

#[test]
fn light_that_ends_in_a_body_loses_what_it_passed_of_it() {
    // The wall lies 5 below the surface of a sea, and so does the camera, 4 below.
    let from = Vec3::NEG_Z * 4.0;
    let mut scene = looking(from, Vec3::NEG_Z, tinted(Rgb::grey(0.5), 1.0));
    scene.planes = vec![plane(Vec3::ZERO, Vec3::Z, 0)];
    assert_close(lit_through(scene)[0], 0.5 / 32.0);
}

/// The invariance tests' scene with a mirror of glass, and the knot too.
fn glassy(scale: f32, offset: f32) -> Scene {
    let mut scene = invariance::description(scale, offset);
    let mut clear = glass(1.5, false);
    if let Some(transmission) = &mut clear.transmission {
        transmission.dispersion = 0.5;
        transmission.share.factor = 0.9;
        transmission.volume = Some(Volume {
            attenuation_color: Rgb::new(0.4, 0.7, 0.6),
            attenuation_distance: scale,
        });
    }
    scene.materials[1] = clear;
    scene.instances[0].material = 1;
    Scene::new(scene).expect("a scene")
}

#[test]
fn threads_tiles_trees_and_kernels_change_no_bit_of_glass() {
    let scene = glassy(1.0, 0.0);
    let settings = Settings::new(24, 18, 1, 4, Shading::BlinnPhong).expect("settings");
    let picture = |options: &Options, settings: &Settings| {
        let accel = Accel::build(&scene, options);
        render(&scene, &accel, settings, &Progress::default())
    };
    let film = picture(&Options::default(), &settings);
    assert!(film.statistics.refracted_rays > 100);
    let expected = bits(&film);
    for threads in [1, 3] {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads);
        let pool = pool.build().expect("a pool");
        let film = pool.install(|| picture(&Options::default(), &settings));
        assert_eq!(bits(&film), expected, "{threads} threads");
    }
    for side in [1, 5, 1000] {
        let film = picture(&Options::default(), &settings.with_tile_side(side));
        assert_eq!(bits(&film), expected, "tiles of {side}");
    }
    let preset = Preset::Fastest;
    let options = Options {
        preset,
        ..Options::default()
    };
    assert_eq!(bits(&picture(&options, &settings)), expected);
    let isa = Isa::scalar();
    let options = Options {
        isa,
        ..Options::default()
    };
    assert_eq!(bits(&picture(&options, &settings)), expected);
}
