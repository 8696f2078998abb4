//! Trees in no more memory than promised.

use crate::common::scenes;
use glam::{DAffine3, DVec3};
use luch::accel::{Accel, Layout, Options};
use luch::generate::{self, Decoration};
use luch::scene::Scene;

/// Bytes of nodes and blocks for each triangle.
fn bytes_per_triangle(scene: &Scene, layout: Layout) -> f64 {
    let options = Options {
        layout,
        ..Options::default()
    };
    let triangles: usize = scene.meshes().iter().map(|m| m.triangles.len()).sum();
    Accel::build(scene, &options).statistics().bytes as f64 / triangles as f64
}

#[test]
fn a_triangle_takes_at_most_90_bytes_and_78_in_the_small_layout() {
    for (name, scene) in [
        ("terrain", scenes::mesh_scene(generate::terrain(354, 1))),
        ("hair", scenes::mesh_scene(generate::hair(5_000, 10, 2))),
        (
            "interior",
            Scene::new(generate::interior(Decoration::Plain)),
        ),
    ] {
        let scene = scene.expect(name);
        let wide = bytes_per_triangle(&scene, Layout::Wide);
        let small = bytes_per_triangle(&scene, Layout::Small);
        assert!(
            wide <= 90.0 && small <= 78.0,
            "{name}: {wide:.1} and {small:.1}"
        );
    }
}

#[test]
fn ten_thousand_instances_take_the_memory_of_one_mesh() {
    let knot = || generate::knot(100, 50);
    let one = scenes::mesh_scene(knot()).expect("a scene");
    let one = Accel::build(&one, &Options::default()).statistics().bytes;
    let place = |i: u32| {
        let (x, z) = (f64::from(i % 100), f64::from(i / 100));
        DAffine3::from_translation(DVec3::new(x, 0.0, z) * 3.0)
    };
    let places: Vec<DAffine3> = (0..10_000).map(place).collect();
    let scene = Scene::new(scenes::instanced(knot(), &places)).expect("a scene");
    let all = Accel::build(&scene, &Options::default()).statistics().bytes;
    assert!(all <= one + 300 * 10_000, "{all} bytes, one takes {one}");
}
