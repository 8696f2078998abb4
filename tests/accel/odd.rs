//! Scenes that trees do not like: built in proportion, and searched rightly.

use super::bits;
use crate::common::scenes;
use glam::Vec3;
use luch::accel::{Accel, Isa, Layout, Options, Preset, linear};
use luch::generate::Random;
use luch::geometry::Sphere;
use luch::ray::Ray;
use luch::scene::Scene;
use rayon::prelude::*;

/// A scene, how many primitives it has, and what to call it.
type Odd = (&'static str, usize, Scene);

fn triangles(name: &'static str, corners: Vec<[Vec3; 3]>) -> Odd {
    (
        name,
        corners.len(),
        scenes::soup_scene(corners).expect(name),
    )
}

fn spheres(name: &'static str, spheres: Vec<Sphere>) -> Odd {
    let count = spheres.len();
    (name, count, scenes::sphere_scene(spheres).expect(name))
}

/// The six faces of a box around the origin, two triangles each.
fn cube(half: f32) -> Vec<[Vec3; 3]> {
    let face = |axis: usize, side: f32| {
        let corner = |u: f32, v: f32| {
            let mut p = Vec3::ZERO;
            (p[axis], p[(axis + 1) % 3], p[(axis + 2) % 3]) = (side, u, v);
            p * half
        };
        let [a, b, c, d] = [
            corner(-1.0, -1.0),
            corner(1.0, -1.0),
            corner(1.0, 1.0),
            corner(-1.0, 1.0),
        ];
        [[a, b, c], [a, c, d]]
    };
    (0..3)
        .flat_map(|axis| [face(axis, -1.0), face(axis, 1.0)])
        .flatten()
        .collect()
}

fn all() -> Vec<Odd> {
    let triangle = [Vec3::ZERO, Vec3::X, Vec3::Y];
    let nested = (1..=2000).flat_map(|i| cube(i as f32 * 0.01)).collect();
    // Each of half the size and in the corner of the one before, down to numbers that have no more bits to lose.
    let smaller = (0..140).map(|i| triangle.map(|p| p * f32::exp2(-(i as f32))));
    let slowly_smaller = (0..20_000).map(|i| triangle.map(|p| (p + Vec3::Z) * 0.999f32.powi(i)));
    let fan = (0..20_000).map(|i| {
        let rim = |i: i32| {
            let angle = f64::from(i) * (std::f64::consts::TAU / 20_000.0);
            Vec3::new(libm::cos(angle) as f32, libm::sin(angle) as f32, 0.1)
        };
        [Vec3::ZERO, rim(i), rim(i + 1)]
    });
    let mut random = Random::new(5);
    let mut point = || random.in_cube();
    let no_area = (0..20_000).map(|i| {
        let (a, b) = (point(), point());
        match i % 3 {
            0 => [a; 3],
            1 => [a, b, a],
            _ => [a, b, a + (b - a) * 0.5],
        }
    });
    let no_area = no_area.collect();
    let both_sizes = (0..10_000).map(|i| Sphere {
        center: point() * if i % 2 == 0 { 1.0 } else { 1e6 },
        radius: if i % 2 == 0 { 1e-6 } else { 1e6 },
    });
    let both_sizes = both_sizes.collect();
    let on_a_line = (0..20_000).map(|i| triangle.map(|p| p * 1e-3 + Vec3::X * i as f32));
    let one_center = (1..=20_000).map(|i| Sphere {
        center: Vec3::ONE,
        radius: i as f32,
    });
    vec![
        triangles("identical", vec![triangle; 100_000]),
        triangles("nested boxes", nested),
        triangles("ever smaller", smaller.collect()),
        triangles("slowly smaller", slowly_smaller.collect()),
        triangles("fan", fan.collect()),
        triangles("no area", no_area),
        triangles("on a line", on_a_line.collect()),
        triangles("one triangle", vec![triangle]),
        spheres("both sizes", both_sizes),
        spheres("one center", one_center.collect()),
        spheres(
            "one sphere",
            vec![Sphere {
                center: Vec3::ZERO,
                radius: 1.0,
            }],
        ),
        ("nothing", 0, scenes::empty().expect("a scene")),
    ]
}

/// A tile that looks at the origin, and rays that are hard.
fn rays(scene: &Scene) -> Vec<Ray> {
    let eye = Vec3::new(0.4, 0.3, 3.0);
    let tile = (0..16).map(|i| {
        let target = Vec3::new((i % 4) as f32 * 0.2, (i / 4) as f32 * 0.2, 0.0);
        Ray::new(eye, (target - eye).normalize(), 0.0, f32::INFINITY)
    });
    tile.chain(scenes::nasty_rays(scene, 24)).collect()
}

#[test]
fn odd_scenes_are_built_in_proportion_and_searched_rightly() {
    let presets = [
        Preset::Fastest,
        Preset::VeryFast,
        Preset::Fast,
        Preset::Medium,
        Preset::Slow,
        Preset::VerySlow,
    ];
    for (name, count, scene) in all() {
        let rays = rays(&scene);
        let expected: Vec<_> = rays
            .par_iter()
            .map(|ray| {
                (
                    bits(linear::intersect(&scene, ray)),
                    linear::occluded(&scene, ray),
                )
            })
            .collect();
        for (index, preset) in presets.into_iter().enumerate() {
            let kernels = Isa::available();
            let options = Options {
                preset,
                layout: [Layout::Wide, Layout::Small][index % 2],
                isa: kernels[index % kernels.len()],
                ..Options::default()
            };
            let accel = Accel::build(&scene, &options);
            let built = accel.statistics();
            let at = || format!("{name}, {options:?}: {built:?}");
            // A leaf has a primitive, a node a leaf or two nodes; a block that is all but empty takes 320 bytes.
            assert!(built.leaves <= count && built.nodes <= count, "{}", at());
            assert!(built.bytes <= 640 * count, "{}", at());
            assert!(built.depth <= count.min(500), "{}", at());
            assert!((built.nodes == 0) == (count == 0), "{}", at());
            let (mut hits, mut occluded) = (Vec::new(), Vec::new());
            accel.intersect_all(&rays, &mut hits);
            accel.occluded_all(&rays, &mut occluded);
            let found: Vec<_> = hits.into_iter().map(bits).zip(occluded).collect();
            assert_eq!(found, expected, "{}", at());
        }
    }
}

#[test]
fn many_identical_triangles_take_no_more_than_others() {
    let scene = scenes::coincident_triangles(100_000).expect("a scene");
    let accel = Accel::build(&scene, &Options::default());
    let built = accel.statistics();
    assert!(
        built.nodes <= 100_000 / 8 && built.bytes <= 90 * 100_000,
        "{built:?}"
    );
    assert!(built.depth <= 20, "{built:?}");
    let ray = Ray::new(Vec3::new(0.2, 0.2, 1.0), Vec3::NEG_Z, 0.0, f32::INFINITY);
    assert_eq!(accel.intersect(&ray).map(|hit| hit.primitive), Some(0));
}
