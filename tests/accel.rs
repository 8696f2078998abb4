//! Search: every fast path gives the bits of the oracle.

mod batches;
mod cost;
mod kernels;
mod layouts;
mod memory;
mod odd;
mod watertight;

use crate::common::scenes::{self, Named};
use glam::{DAffine3, DQuat, DVec3, Vec3};
use luch::accel::{Accel, Options, Preset, linear};
use luch::generate::{self, Random};
use luch::geometry::Hit;
use luch::ray::Ray;
use luch::scene::{Instance, Scene};

/// Bits, so that a NaN or a -0.0 would show.
fn bits(hit: Option<Hit>) -> Option<(u32, u32, [u32; 2])> {
    hit.map(|h| (h.t.to_bits(), h.primitive, h.barycentric.map(f32::to_bits)))
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
    let mut copies = scenes::instanced(generate::icosphere(5), &places);
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
    // Nodes of two to eight children.
    let nodes = statistics.nodes;
    assert!(
        statistics.leaves == 80 && (80 / 8..80 / 2).contains(&nodes),
        "{statistics:?}"
    );
    // At least as deep as a full tree, and not a chain.
    assert!((3..=10).contains(&statistics.depth), "{statistics:?}");
    // A block for each leaf.
    assert_eq!(statistics.bytes, nodes * 256 + 80 * 320);
    assert!(statistics.sah_cost > 1.0);
}

#[test]
fn an_empty_scene_has_nothing_to_meet() {
    let scene = scenes::empty().expect("a scene");
    let accel = Accel::build(&scene, &Options::default());
    let ray = Ray::new(Vec3::ZERO, Vec3::X, 0.0, f32::INFINITY);
    assert!(accel.intersect(&ray).is_none() && !accel.occluded(&ray));
    assert_eq!(accel.statistics().nodes, 0);
}
