//! Search: every fast path gives the bits of the oracle.

use crate::common::scenes::{self, Named};
use glam::{DAffine3, DQuat, DVec3, Vec3};
use luch::accel::{Accel, Isa, Options, Preset, linear};
use luch::generate::Random;
use luch::geometry::Hit;
use luch::ray::Ray;
use luch::scene::{Instance, Scene};

/// Bits, so that a NaN or a -0.0 would show.
fn bits(hit: Option<Hit>) -> Option<(u32, u32, [u32; 2])> {
    hit.map(|h| (h.t.to_bits(), h.primitive, h.barycentric.map(f32::to_bits)))
}

/// Every instruction set that this machine has, each with packets and without.
fn kernels() -> Vec<(Isa, bool)> {
    let both = |isa| [(isa, false), (isa, true)];
    Isa::available().into_iter().flat_map(both).collect()
}

fn assert_equals_oracle(name: &str, scene: &Scene, rays: &[Ray]) {
    let presets = [
        Preset::Fastest,
        Preset::VeryFast,
        Preset::Fast,
        Preset::Medium,
        Preset::Slow,
        Preset::VerySlow,
    ];
    let leaf_sizes = [
        None,
        std::num::NonZeroU8::new(1),
        std::num::NonZeroU8::new(16),
    ];
    let expected: Vec<_> = rays
        .iter()
        .map(|ray| bits(linear::intersect(scene, ray)))
        .collect();
    let expected_occluded: Vec<_> = rays
        .iter()
        .map(|ray| linear::occluded(scene, ray))
        .collect();
    for preset in presets {
        for leaf_size in leaf_sizes {
            for (isa, packets) in kernels() {
                let options = Options {
                    preset,
                    leaf_size,
                    isa,
                    packets,
                    ..Options::default()
                };
                let accel = Accel::build(scene, &options);
                let (mut hits, mut occluded) = (Vec::new(), Vec::new());
                accel.intersect_all(rays, &mut hits);
                accel.occluded_all(rays, &mut occluded);
                for (index, ray) in rays.iter().enumerate() {
                    let at = || format!("{name}, {options:?}: {ray:?}");
                    assert_eq!(bits(hits[index]), expected[index], "{}", at());
                    assert_eq!(occluded[index], expected_occluded[index], "{}", at());
                }
            }
        }
    }
    let accel = Accel::build(scene, &Options::default());
    for ray in rays {
        assert_eq!(
            bits(accel.intersect(ray)),
            bits(linear::intersect(scene, ray)),
            "one ray is a batch of one"
        );
        assert_eq!(accel.occluded(ray), linear::occluded(scene, ray));
    }
}

#[test]
fn every_tree_equals_the_oracle() {
    for Named { name, scene } in scenes::all() {
        let scene = scene.expect(name);
        assert_equals_oracle(name, &scene, &scenes::nasty_rays(&scene, 300));
    }
}

#[test]
fn any_hit_agrees_with_closest_hit_where_everything_is_opaque() {
    for Named { name, scene } in scenes::all() {
        let scene = scene.expect(name);
        if scene
            .materials()
            .iter()
            .any(|material| !material.is_opaque())
        {
            continue;
        }
        let accel = Accel::build(&scene, &Options::default());
        for ray in scenes::nasty_rays(&scene, 300) {
            assert_eq!(
                accel.occluded(&ray),
                accel.intersect(&ray).is_some(),
                "{name}: {ray:?}"
            );
        }
    }
}

#[test]
fn going_on_behind_each_hit_meets_every_primitive_once_in_order() {
    for Named { name, scene } in scenes::all() {
        let scene = scene.expect(name);
        let accel = Accel::build(&scene, &Options::default());
        for ray in scenes::nasty_rays(&scene, 40) {
            let (mut fast, mut slow) = (ray, ray);
            for _ in 0..50 {
                let (a, b) = (accel.intersect(&fast), linear::intersect(&scene, &slow));
                assert_eq!(bits(a), bits(b), "{name}: {fast:?}");
                let Some(hit) = a else { break };
                (fast, slow) = (
                    fast.beyond(hit.t, hit.primitive),
                    slow.beyond(hit.t, hit.primitive),
                );
            }
        }
    }
}

#[test]
fn coincident_triangles_are_met_one_after_another() {
    let scene = scenes::coincident_triangles(20).expect("a scene");
    let accel = Accel::build(&scene, &Options::default());
    let mut ray = Ray::new(Vec3::new(0.2, 0.2, 1.0), Vec3::NEG_Z, 0.0, f32::INFINITY);
    let mut met = Vec::new();
    while let Some(hit) = accel.intersect(&ray) {
        met.push(hit.primitive);
        ray = ray.beyond(hit.t, hit.primitive);
    }
    assert_eq!(met, (0..20).collect::<Vec<_>>());
}

#[test]
fn many_identical_triangles_are_built_in_proportion() {
    let scene = scenes::coincident_triangles(100_000).expect("a scene");
    let accel = Accel::build(&scene, &Options::default());
    assert_eq!(accel.statistics().nodes, 1);
    let ray = Ray::new(Vec3::new(0.2, 0.2, 1.0), Vec3::NEG_Z, 0.0, f32::INFINITY);
    assert_eq!(accel.intersect(&ray).map(|hit| hit.primitive), Some(0));
}

#[test]
fn no_ray_from_inside_leaves_a_closed_mesh() {
    // Aimed at vertices and at points of edges, where neighbours must agree.
    let scene = scenes::icosphere_scene(3, DAffine3::IDENTITY).expect("a scene");
    let accel = Accel::build(&scene, &Options::default());
    let mesh = scene.mesh(0);
    let mut random = Random::new(7);
    for corners in &mesh.triangles {
        let [a, b, _] = corners.map(|i| mesh.positions[i as usize]);
        for target in [a, (a + b) * 0.5, a + (b - a) * random.next_f32()] {
            for from in [Vec3::ZERO, random.in_cube() * 0.5] {
                let ray = Ray::new(from, (target - from).normalize(), 0.0, f32::INFINITY);
                assert!(accel.intersect(&ray).is_some(), "{ray:?} slipped through");
            }
        }
    }
}

#[test]
fn shared_instances_look_like_copies_in_the_world() {
    let place = |i: usize| {
        let turn = DQuat::from_rotation_y(i as f64);
        let scale = if i.is_multiple_of(2) {
            DVec3::new(1.0, 0.5, 2.0)
        } else {
            DVec3::new(-1.0, 1.0, 1.0)
        };
        DAffine3::from_scale_rotation_translation(scale, turn, DVec3::new(i as f64 * 4.0, 0.0, 0.0))
    };
    let places: Vec<DAffine3> = (0..6).map(place).collect();
    let shared = scenes::instanced_icospheres(5, &places).expect("a scene");
    assert!(
        shared
            .instances()
            .iter()
            .all(|instance| instance.space.is_some())
    );
    let mut copies = scenes::instanced_description(5, &places);
    copies.meshes = vec![copies.meshes[0].clone(); places.len()];
    let renumbered = |(mesh, instance): (u32, Instance)| Instance { mesh, ..instance };
    copies.instances = (0..).zip(copies.instances).map(renumbered).collect();
    let copies = Scene::new(copies).expect("a scene");
    let (a, b) = (
        Accel::build(&shared, &Options::default()),
        Accel::build(&copies, &Options::default()),
    );
    let mut random = Random::new(3);
    let mut met = 0;
    for _ in 0..2000 {
        let target = Vec3::new(random.next_f32() * 20.0, 0.0, 0.0) + random.in_cube();
        let from = Vec3::new(10.0, 8.0, 20.0) + random.in_cube();
        let ray = Ray::new(from, (target - from).normalize(), 0.0, f32::INFINITY);
        let (p, q) = (a.intersect(&ray), b.intersect(&ray));
        // Rays along an edge may take either neighbour: rounding differs between both spaces.
        if let (Some(p), Some(q)) = (p, q) {
            met += 1;
            assert!((p.t - q.t).abs() < 1e-4 * q.t, "{p:?} {q:?}");
            let (p, q) = (shared.surface(&ray, &p), copies.surface(&ray, &q));
            assert!(
                p.normal.dot(q.normal) > 0.9,
                "{:?} {:?}",
                p.normal,
                q.normal
            );
        } else {
            assert_eq!(p.is_some(), q.is_some(), "{ray:?}");
        }
    }
    assert!(met > 500, "only {met} rays met anything");
}

#[test]
fn statistics_count_what_was_built() {
    let scene = scenes::icosphere_scene(1, DAffine3::IDENTITY).expect("a scene");
    let one_each = Options {
        preset: Preset::Medium,
        leaf_size: std::num::NonZeroU8::new(1),
        ..Options::default()
    };
    let accel = Accel::build(&scene, &one_each);
    let statistics = accel.statistics();
    // A binary tree over 80 leaves.
    assert_eq!((statistics.leaves, statistics.nodes), (80, 159));
    assert!(statistics.depth >= 8 && statistics.bytes > 80 * 36 && statistics.sah_cost > 1.0);
}

#[test]
fn an_empty_scene_has_nothing_to_meet() {
    let scene = scenes::empty().expect("a scene");
    let accel = Accel::build(&scene, &Options::default());
    let ray = Ray::new(Vec3::ZERO, Vec3::X, 0.0, f32::INFINITY);
    assert!(accel.intersect(&ray).is_none() && !accel.occluded(&ray));
    assert_eq!(accel.statistics().nodes, 0);
}
