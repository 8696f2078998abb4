//! What a ray is tested against, counted.

use super::bits;
use super::layouts::OTHERS;
use crate::common::scenes::{self, Named};
use glam::Vec3;
use luch::accel::{Accel, Isa, Layout, Options, Tests, linear};
use luch::ray::Ray;
use luch::scene::Scene;

fn built(scene: &Scene, layout: Layout) -> Accel {
    let options = Options {
        layout,
        ..Options::default()
    };
    Accel::build(scene, &options)
}

fn along_x(from: f32, y: f32, z: f32) -> Ray {
    Ray::new(Vec3::new(from, y, z), Vec3::X, 0.0, f32::INFINITY)
}

/// Triangles that stand across the x axis at these places: each fills half of its box, where `y + z <= 1`.
fn row(places: impl IntoIterator<Item = f32>) -> Scene {
    let at = |x: f32| [Vec3::ZERO, Vec3::Y, Vec3::Z].map(|p| p + Vec3::X * x);
    scenes::soup_scene(places.into_iter().map(at).collect()).expect("a scene")
}

fn counted(accel: &Accel, ray: &Ray) -> (u32, u32) {
    let Tests { nodes, primitives } = accel.intersect_counted(ray).1;
    (nodes, primitives)
}

#[test]
fn counted_answers_are_those_of_the_oracle() {
    for Named { name, scene } in scenes::all() {
        let scene = scene.expect(name);
        let layouts = [Layout::Wide, Layout::Small].into_iter().chain(OTHERS);
        for layout in layouts {
            let accel = built(&scene, layout);
            let count = if layout == Layout::List { 16 } else { 200 };
            for ray in scenes::nasty_rays(&scene, count) {
                let (hit, tests) = accel.intersect_counted(&ray);
                let at = || format!("{name}, {layout:?}: {ray:?}");
                assert_eq!(bits(hit), bits(linear::intersect(&scene, &ray)), "{}", at());
                let (occluded, _) = accel.occluded_counted(&ray);
                assert_eq!(occluded, linear::occluded(&scene, &ray), "{}", at());
                assert!(tests.primitives <= scene.primitive_count(), "{}", at());
            }
        }
    }
}

#[test]
fn counts_do_not_depend_on_the_kernel() {
    let scene = row((0..100).map(|i| i as f32));
    let rays = scenes::nasty_rays(&scene, 200);
    let mut seen = Vec::new();
    for isa in Isa::available() {
        for packets in [false, true] {
            let options = Options {
                isa,
                packets,
                ..Options::default()
            };
            let accel = Accel::build(&scene, &options);
            let all = rays.iter().map(|ray| {
                (
                    accel.intersect_counted(ray).1,
                    accel.occluded_counted(ray).1,
                )
            });
            seen.push(all.collect::<Vec<_>>());
        }
    }
    assert!(seen.windows(2).all(|pair| pair[0] == pair[1]));
}

#[test]
fn two_triangles_take_one_node_and_two_tests() {
    let scene = row([0.0, 1.0]);
    let (hits, misses) = (along_x(-1.0, 0.2, 0.2), along_x(-1.0, 2.0, 2.0));
    for (layout, of_hit, of_miss) in [
        // A root with one leaf: a block of two triangles.
        (Layout::Wide, (1, 2), (1, 0)),
        (Layout::Small, (1, 2), (1, 0)),
        // Half areas: 3 for both, 1 for each. A node with two leaves costs 3 + 1 + 1, a leaf of two 3 + 3. The second box is
        // behind the hit.
        (Layout::Bvh2, (1, 1), (1, 0)),
        // A root with both in its slots. The second is tested: what a node meets is known before its first test.
        (Layout::CwBvh, (1, 2), (1, 0)),
        (Layout::List, (0, 2), (0, 2)),
    ] {
        let accel = built(&scene, layout);
        assert_eq!(counted(&accel, &hits), of_hit, "{layout:?}");
        assert_eq!(counted(&accel, &misses), of_miss, "{layout:?}");
    }
}

#[test]
fn a_hundred_triangles_take_the_tests_worked_out_by_hand() {
    // Twelve heaps of eight, the greatest leaf, and one of four, far apart: thirteen leaves. A root of seven leaves and a
    // node for the six others is all it takes.
    let place = |i: u32| (i / 8 * 1000) as f32 + (i % 8) as f32 * 0.01;
    let scene = row((0..100).map(place));
    let across = |heap: u32| {
        let origin = Vec3::new(heap as f32 * 1000.0 + 0.015, 0.5, -1.0);
        Ray::new(origin, Vec3::Z, 0.0, f32::INFINITY)
    };
    let accel = built(&scene, Layout::Wide);
    assert_eq!(accel.statistics().nodes, 2);
    assert_eq!(accel.leaf_sizes(), [0, 0, 0, 1, 0, 0, 0, 12]);
    let mut nodes = 0;
    for heap in 0..13 {
        let (of_heap, primitives) = counted(&accel, &across(heap));
        assert_eq!(primitives, if heap == 12 { 4 } else { 8 }, "heap {heap}");
        nodes += of_heap;
    }
    assert_eq!(nodes, 7 + 6 * 2);
    // Through every box and past every triangle; then into the first triangle, behind which nothing is tested.
    let (past, into) = (along_x(-1.0, 0.9, 0.9), along_x(-1.0, 0.2, 0.2));
    assert_eq!(counted(&accel, &past), (2, 100));
    assert_eq!(counted(&accel, &into).1, 8);
    assert_eq!(accel.occluded_counted(&past).1.primitives, 100);
    assert!(accel.occluded_counted(&into).1.primitives <= 8);

    // The same leaves; a binary tree has a node less than leaves.
    let accel = built(&scene, Layout::Bvh2);
    assert_eq!(accel.leaf_sizes(), [0, 0, 0, 1, 0, 0, 0, 12]);
    assert_eq!(counted(&accel, &past), (12, 100));
    assert_eq!(counted(&accel, &into).1, 8);
    let accel = built(&scene, Layout::CwBvh);
    let all = accel.statistics().nodes as u32;
    assert_eq!(counted(&accel, &past), (all, 100));
    let accel = built(&scene, Layout::List);
    assert_eq!(counted(&accel, &past), (0, 100));
    assert_eq!(counted(&accel, &into), (0, 100));
    assert_eq!(accel.occluded_counted(&into).1.primitives, 1);
}
