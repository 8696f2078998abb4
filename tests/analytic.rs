//! Pictures whose answer is known on paper.

use crate::common::scenes::half_transparent;
use glam::{DAffine3, DVec3, Vec3};
use luch::accel::{Accel, Options};
use luch::camera::Camera;
use luch::color::Rgb;
use luch::film::{BEAUTY, DEPTH, FAR_AWAY, Film};
use luch::generate;
use luch::geometry::{Plane, Sphere};
use luch::light::{Falloff, Light, LightKind};
use luch::material::{Material, Model};
use luch::ray::Ray;
use luch::render::{Progress, Settings, render};
use luch::scene::{Background, Instance, Object, Scene, SceneDescription, Shown};
use luch::shade::Shading;

fn picture(scene: &Scene, width: u32, height: u32, samples: u32, max_depth: u32) -> Film {
    let settings =
        Settings::new(width, height, samples, max_depth, Shading::BlinnPhong).expect("settings");
    render(
        scene,
        &Accel::build(scene, &Options::default()),
        &settings,
        &Progress::default(),
    )
}

/// The colour in the middle of a one-pixel picture.
fn seen(description: SceneDescription, max_depth: u32) -> Rgb {
    let scene = Scene::new(description).expect("a scene");
    let [r, g, b, _] = picture(&scene, 1, 1, 1, max_depth)
        .beauty()
        .next()
        .expect("a pixel");
    Rgb::new(r, g, b)
}

fn camera_at(position: Vec3, look_at: Vec3) -> Camera {
    Camera::looking_at(position, look_at, Vec3::Y, 0.8)
}

fn sun(toward: Vec3, intensity: f32) -> Light {
    let kind = LightKind::Directional { direction: -toward };
    Light {
        name: String::new(),
        kind,
        color: Rgb::WHITE,
        intensity,
        falloff: Falloff::None,
        range: None,
    }
}

fn plane(point: Vec3, normal: Vec3, material: u32) -> Object<Plane> {
    Object {
        name: String::new(),
        shape: Plane { point, normal },
        material,
    }
}

fn sphere(center: Vec3, radius: f32, material: u32) -> Object<Sphere> {
    Object {
        name: String::new(),
        shape: Sphere { center, radius },
        material,
    }
}

/// A material that is nothing but a mirror.
fn mirror(reflectivity: f32) -> Material {
    let mut material = Material::matt("mirror", Rgb::BLACK);
    if let Model::Phong(phong) = &mut material.model {
        phong.reflectivity = Rgb::grey(reflectivity);
    }
    material
}

/// A wall at z = 0 seen from +z.
fn wall(light: Light) -> SceneDescription {
    SceneDescription {
        materials: vec![Material::matt("wall", Rgb::grey(0.5))],
        planes: vec![plane(Vec3::ZERO, Vec3::Z, 0)],
        lights: vec![light],
        ..SceneDescription::empty(camera_at(Vec3::Z * 3.0, Vec3::ZERO))
    }
}

fn close(a: f32, b: f32) -> bool {
    (a - b).abs() <= 1e-5 * b.abs().max(1.0)
}

#[test]
fn a_wall_lit_at_sixty_degrees_is_half_as_bright() {
    let head_on = seen(wall(sun(Vec3::Z, 1.0)), 0).g;
    let slanted = seen(wall(sun(Vec3::new(0.75f32.sqrt(), 0.0, 0.5), 1.0)), 0).g;
    assert!(
        close(head_on, 0.5) && close(slanted, 0.25),
        "{head_on} {slanted}"
    );
}

#[test]
fn a_wall_is_lit_from_the_side_it_is_seen_from() {
    assert_eq!(seen(wall(sun(Vec3::NEG_Z, 1.0)), 0), Rgb::BLACK);
    let mut turned = wall(sun(Vec3::Z, 1.0));
    turned.planes[0].shape.normal = Vec3::NEG_Z;
    assert!(
        close(seen(turned, 0).g, 0.5),
        "a normal that points away is turned toward the viewer"
    );
}

#[test]
fn ambient_light_and_emission_need_no_light() {
    let mut scene = wall(sun(Vec3::NEG_Z, 1.0));
    scene.ambient = Rgb::grey(0.25);
    scene.materials[0].emission.factor = Rgb::new(1.0, 0.0, 0.0);
    assert_eq!(seen(scene, 0), Rgb::new(1.125, 0.125, 0.125));
}

#[test]
fn a_shadow_ray_stops_at_the_light() {
    // The sphere stands behind the light, seen from the wall: no shadow. Then between: shadow.
    let lamp = |z| Light {
        kind: LightKind::Point {
            position: Vec3::new(0.0, 2.0, z),
        },
        ..sun(Vec3::Z, 1.0)
    };
    let mut scene = wall(lamp(1.0));
    scene.spheres = vec![sphere(Vec3::new(0.0, 4.0, 2.0), 0.5, 0)];
    assert!(seen(scene.clone(), 0).g > 0.1);
    scene.spheres[0].shape.center = Vec3::new(0.0, 1.0, 0.5);
    scene.spheres[0].shape.radius = 0.2;
    assert_eq!(seen(scene, 0), Rgb::BLACK);
}

#[test]
fn a_sun_straight_overhead_casts_a_shadow() {
    // -Vec3::NEG_Y has two negative zeros, which some search structures never recover from.
    let scene = SceneDescription {
        materials: vec![Material::matt("floor", Rgb::WHITE)],
        planes: vec![plane(Vec3::ZERO, Vec3::Y, 0)],
        spheres: vec![sphere(Vec3::Y * 2.0, 1.0, 0)],
        lights: vec![Light {
            kind: LightKind::Directional {
                direction: Vec3::NEG_Y,
            },
            ..sun(Vec3::Y, 1.0)
        }],
        ..SceneDescription::empty(camera_at(Vec3::new(5.0, 0.5, 0.0), Vec3::ZERO))
    };
    assert_eq!(seen(scene, 0), Rgb::BLACK);
}

#[test]
fn a_light_in_a_surface_is_not_hidden_by_it() {
    let mut scene = wall(Light {
        kind: LightKind::Point {
            position: Vec3::new(0.0, 0.0, 2.0),
        },
        ..sun(Vec3::Z, 1.0)
    });
    scene
        .planes
        .push(plane(Vec3::new(0.0, 0.0, 2.0), Vec3::NEG_Z, 0));
    scene.camera = camera_at(Vec3::new(0.0, 0.0, 1.0), Vec3::ZERO);
    assert!(close(seen(scene, 0).g, 0.5));
}

/// A camera between two mirrors that face each other, and the reflectivity of each.
fn two_mirrors(first: f32, second: f32, background: f32) -> SceneDescription {
    // The first mirror leans a little, so that the ray climbs out after the second bounce.
    SceneDescription {
        materials: vec![mirror(first), mirror(second)],
        spheres: vec![
            sphere(Vec3::new(0.0, 0.0, -11.0), 10.0, 0),
            sphere(Vec3::new(0.0, 0.0, 13.0), 10.0, 1),
        ],
        background: Background::plain(Rgb::grey(background), Shown::Always),
        ..SceneDescription::empty(camera_at(
            Vec3::new(0.0, 0.9, 0.0),
            Vec3::new(0.0, 1.1, -1.0),
        ))
    }
}

#[test]
fn a_mirror_of_a_mirror_gives_back_the_product_of_their_reflectivities() {
    let at_depth = |max_depth| seen(two_mirrors(0.5, 0.5, 1.0), max_depth).r;
    let product = at_depth(20);
    let bounces = (-product.log2()).round() as u32;
    assert!(
        bounces >= 2 && close(product, 0.5f32.powi(bounces as i32)),
        "{product}"
    );
    for max_depth in 0..bounces {
        assert_eq!(
            at_depth(max_depth),
            0.0,
            "a ray needs {bounces} bounces to leave"
        );
    }
    assert_eq!(at_depth(bounces), product);
}

#[test]
fn no_mirror_ray_is_sent_below_one_in_4096() {
    // Two parallel mirrors: 0.5^12 is 1/4096 exactly, so twelve bounces and not one more, each adding emission 1.
    let mut scene = SceneDescription {
        materials: vec![mirror(0.5)],
        planes: vec![
            plane(Vec3::NEG_Z, Vec3::Z, 0),
            plane(Vec3::Z, Vec3::NEG_Z, 0),
        ],
        ..SceneDescription::empty(camera_at(Vec3::ZERO, Vec3::NEG_Z))
    };
    scene.materials[0].emission.factor = Rgb::WHITE;
    let expected: f32 = (0..=12).map(|bounce| 0.5f32.powi(bounce)).sum();
    assert!((seen(scene, 100).r - expected).abs() < 1e-6);
}

#[test]
fn a_sphere_shows_a_disc_of_its_silhouette_radius() {
    // Seen from distance D, a sphere of radius R is a cone of half-angle asin(R/D).
    let description = SceneDescription {
        materials: vec![Material::matt("ball", Rgb::WHITE)],
        spheres: vec![sphere(Vec3::ZERO, 1.0, 0)],
        ..SceneDescription::empty(camera_at(Vec3::Z * 4.0, Vec3::ZERO))
    };
    let film = picture(&Scene::new(description).expect("a scene"), 400, 400, 1, 0);
    let covered = film.beauty().filter(|pixel| pixel[3] > 0.0).count() as f64;
    let tangent = (0.25f64).asin().tan() / 0.4f64.tan() * 200.0;
    let disc = std::f64::consts::PI * tangent * tangent;
    assert!(
        (covered / disc - 1.0).abs() < 0.005,
        "{covered} pixels, {disc} expected"
    );
}

#[test]
fn depth_is_along_the_axis_of_the_nearest_sample_and_far_away_where_nothing_is() {
    let wall_only = Scene::new(wall(sun(Vec3::Z, 1.0))).expect("a scene");
    let film = picture(&wall_only, 9, 9, 4, 0);
    let depth = film.layer(DEPTH.channels).expect("depth");
    assert!(
        depth.values.iter().all(|&z| (z - 3.0).abs() < 1e-5),
        "a wall square to the axis is as far everywhere"
    );
    let nothing =
        Scene::new(SceneDescription::empty(camera_at(Vec3::ZERO, Vec3::X))).expect("a scene");
    let film = picture(&nothing, 2, 2, 1, 0);
    assert_eq!(
        film.layer(DEPTH.channels).expect("depth").values,
        [FAR_AWAY; 4]
    );
    assert_eq!(
        film.layer(BEAUTY.channels).expect("beauty").values,
        [0.0; 16]
    );
}

#[test]
fn an_edge_is_averaged_in_the_beauty_and_never_in_depth() {
    let description = SceneDescription {
        materials: vec![Material::matt("ball", Rgb::WHITE)],
        spheres: vec![sphere(Vec3::ZERO, 1.0, 0)],
        ..SceneDescription::empty(camera_at(Vec3::Z * 4.0, Vec3::ZERO))
    };
    let film = picture(&Scene::new(description).expect("a scene"), 40, 40, 16, 0);
    assert!(film.beauty().any(|pixel| pixel[3] > 0.0 && pixel[3] < 1.0));
    let depth = film.layer(DEPTH.channels).expect("depth");
    assert!(
        depth
            .values
            .iter()
            .all(|&z| z == FAR_AWAY || (3.0..4.0).contains(&z))
    );
}

/// Half-transparent sheets before the camera, each glowing with 1, before a background of 8.
fn sheets(distances: &[f32]) -> SceneDescription {
    let mut material = half_transparent();
    material.emission.factor = Rgb::WHITE;
    SceneDescription {
        materials: vec![material],
        planes: distances
            .iter()
            .map(|z| plane(Vec3::NEG_Z * *z, Vec3::Z, 0))
            .collect(),
        background: Background::plain(Rgb::grey(8.0), Shown::Always),
        ..SceneDescription::empty(camera_at(Vec3::ZERO, Vec3::NEG_Z))
    }
}

#[test]
fn transparent_layers_are_seen_from_front_to_back_and_coincident_ones_are_not_lost() {
    // Each layer gives half of its glow, and passes half of what is behind.
    assert!(close(seen(sheets(&[1.0]), 0).r, 0.5 + 4.0));
    assert!(close(seen(sheets(&[1.0, 2.0]), 0).r, 0.5 + 0.25 + 2.0));
    assert!(close(seen(sheets(&[1.0, 1.0]), 0).r, 0.5 + 0.25 + 2.0));
    assert!(close(
        seen(sheets(&[1.0, 1.0, 1.0]), 0).r,
        0.5 + 0.25 + 0.125 + 1.0
    ));
}

#[test]
fn transparent_layers_dim_shadows_and_mirrors_alike() {
    let mut scene = wall(sun(Vec3::Z, 1.0));
    scene.materials.push(half_transparent());
    // Behind the camera, between the wall and the sun; twice, at one place.
    scene.planes.extend([
        plane(Vec3::Z * 5.0, Vec3::Z, 1),
        plane(Vec3::Z * 5.0, Vec3::Z, 1),
    ]);
    assert!(close(seen(scene, 0).g, 0.5 * 0.25));
    let mut mirrored = sheets(&[-1.0, -1.0]);
    mirrored.materials.push(mirror(1.0));
    mirrored.planes.push(plane(Vec3::NEG_Z, Vec3::Z, 1));
    assert!(close(seen(mirrored, 1).r, 0.5 + 0.25 + 2.0));
}

#[test]
fn a_ray_ends_in_its_sixty_fifth_layer_and_says_so() {
    let mut description = sheets(&[1.0; 70]);
    description.materials[0].alpha.coverage.factor = 0.0;
    let scene = Scene::new(description).expect("a scene");
    let film = picture(&scene, 1, 1, 1, 0);
    assert_eq!(film.statistics.lost_in_layers, 1);
    assert_eq!(film.statistics.transparent_rays, 64);
}

#[test]
fn what_is_behind_a_transparent_surface_gets_its_share_of_alpha() {
    let mut description = sheets(&[1.0]);
    description.background.shown = Shown::OnDisplay;
    let film = picture(&Scene::new(description).expect("a scene"), 1, 1, 1, 0);
    assert_eq!(film.beauty().next(), Some([0.5, 0.5, 0.5, 0.5]));
}

#[test]
fn a_single_sided_surface_is_not_seen_from_behind_but_casts_a_shadow() {
    let mut scene = wall(sun(Vec3::Z, 1.0));
    let single = Material {
        double_sided: false,
        ..Material::matt("single", Rgb::WHITE)
    };
    scene.materials.push(single);
    // Faces the wall: camera rays pass it from behind, the sun's do not.
    scene.planes.push(plane(Vec3::Z * 2.0, Vec3::NEG_Z, 1));
    let film = picture(&Scene::new(scene).expect("a scene"), 1, 1, 1, 0);
    assert_eq!(film.beauty().next(), Some([0.0, 0.0, 0.0, 1.0]));
    let depth = film.layer(DEPTH.channels).expect("depth");
    assert!(close(depth.values[0], 3.0));
}

#[test]
fn flat_shading_is_the_diffuse_colour_alone() {
    let mut description = wall(sun(Vec3::Z, 1.0));
    description.materials[0].emission.factor = Rgb::WHITE;
    description.ambient = Rgb::WHITE;
    let scene = Scene::new(description).expect("a scene");
    let settings = Settings::new(1, 1, 1, 5, Shading::Flat).expect("settings");
    let film = render(
        &scene,
        &Accel::build(&scene, &Options::default()),
        &settings,
        &Progress::default(),
    );
    assert_eq!(film.beauty().next(), Some([0.5, 0.5, 0.5, 1.0]));
}

/// How many pixels that a convex thing covers are dark, though light comes from where the camera is.
fn dark_pixels(mut description: SceneDescription, center: Vec3, distance: f32) -> (usize, usize) {
    let toward = Vec3::new(0.3, 0.2, 0.9).normalize();
    description.camera = camera_at(center + toward * distance, center);
    description.lights = vec![sun(toward, 1.0)];
    let film = picture(&Scene::new(description).expect("a scene"), 160, 160, 4, 0);
    let covered = film.beauty().filter(|pixel| pixel[3] == 1.0);
    let (dark, all) = covered.fold((0, 0), |(dark, all), pixel| {
        (dark + usize::from(pixel[1] < 0.02), all + 1)
    });
    (dark, all)
}

#[test]
fn nothing_convex_shadows_itself_at_any_scale_or_place() {
    for (scale, offset) in [
        (1.0, 0.0),
        (1e-3, 0.0),
        (1e3, 0.0),
        (1.0, 1e4),
        (100.0, 1e4),
    ] {
        let center = Vec3::splat(offset);
        let to_world = DAffine3::from_scale_rotation_translation(
            DVec3::splat(f64::from(scale)),
            glam::DQuat::from_rotation_x(0.4),
            center.as_dvec3(),
        );
        let placeholder = camera_at(Vec3::Z, Vec3::ZERO);
        let mesh = generate::mesh_scene(generate::icosphere(5).transformed(&to_world), placeholder);
        let ball = generate::sphere_scene(
            vec![Sphere {
                center,
                radius: scale,
            }],
            placeholder,
        );
        let mut shared = generate::mesh_scene(generate::icosphere(6), placeholder);
        // Three in one place, so that the mesh is worth sharing.
        shared.instances = vec![
            Instance {
                to_world,
                ..shared.instances[0].clone()
            };
            3
        ];
        for (name, description) in [("mesh", mesh), ("sphere", ball), ("instances", shared)] {
            let (dark, all) = dark_pixels(description, center, 3.0 * scale);
            assert!(
                all > 5000 && dark == 0,
                "{name}, scale {scale}, offset {offset}: {dark} of {all} are dark"
            );
        }
    }
}

/// The shadow ray of what `ray` meets first, from a lamp that it faces: from the lamp or, where that cannot be, to it.
fn shadow_ray(scene: &Scene, accel: &Accel, ray: &Ray, lamp: Vec3) -> Option<Ray> {
    let point = scene.surface(ray, &accel.intersect(ray)?).place.point;
    let toward = lamp - point.position;
    let faces = point.normal.dot(toward.normalize()) > 0.0;
    let Some(from_lamp) = Ray::reaching(point.position, point.normal, point.error, lamp) else {
        let (l, end) = (toward.normalize(), toward.length() * (1.0 - 1e-6));
        let leaving = Ray::leaving(point.position, point.normal, point.error, l, end);
        return faces.then_some(leaving);
    };
    faces.then_some(from_lamp)
}

#[test]
fn nothing_convex_shadows_itself_however_near_or_far_the_lamp() {
    for (scale, offset) in [(1.0, 0.0), (1e-3, 0.0), (1e3, 0.0), (1.0, 1e4)] {
        let center = Vec3::splat(offset);
        let camera = camera_at(center + Vec3::Z * 3.0 * scale, center);
        let placed = DAffine3::from_scale_rotation_translation(
            DVec3::splat(f64::from(scale)),
            glam::DQuat::from_rotation_x(0.4),
            center.as_dvec3(),
        );
        let ball = vec![Sphere {
            center,
            radius: scale,
        }];
        let floor = SceneDescription {
            planes: vec![plane(center, Vec3::new(0.6, 0.0, 0.8), 0)],
            ..generate::sphere_scene(Vec::new(), camera)
        };
        for (name, description) in [
            (
                "mesh",
                generate::mesh_scene(generate::icosphere(4).transformed(&placed), camera),
            ),
            ("sphere", generate::sphere_scene(ball, camera)),
            ("plane", floor),
        ] {
            let scene = Scene::new(description).expect("a scene");
            let accel = Accel::build(&scene, &Options::default());
            let view = scene.camera().view(100, 100);
            for distance in [1.01, 1.1, 3.0, 100.0, 1e4, 1e6] {
                let toward = Vec3::new(0.5, 0.3, 1.0).normalize();
                let lamp = center + toward * (distance * scale);
                let mut met = 0;
                for pixel in 0..10_000 {
                    let (x, y) = (f64::from(pixel % 100) + 0.5, f64::from(pixel / 100) + 0.5);
                    if let Some(ray) = shadow_ray(&scene, &accel, &view.primary_ray(x, y), lamp) {
                        met += 1;
                        let place = format!("{name}, scale {scale}, offset {offset}");
                        assert!(
                            !accel.occluded(&ray),
                            "{place}, lamp at {distance}: {ray:?}"
                        );
                    }
                }
                assert!(met > 50, "{name} {scale} {offset} {distance}: {met}");
            }
        }
    }
}
