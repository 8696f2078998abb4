//! The layouts that are there to compare with: the same bits, and numbers that are right.

use super::batches::{self, Batch};
use super::kernels::compare;
use crate::common::scenes::{self, Named};
use glam::{DAffine3, Vec3};
use luch::accel::{Accel, Builder, Layout, Options, Preset, linear};
use luch::generate::{self, Random};
use luch::ray::Ray;
use luch::scene::Scene;
use std::num::NonZeroU8;

pub(super) const OTHERS: [Layout; 3] = [Layout::Bvh2, Layout::CwBvh, Layout::List];

fn built(scene: &Scene, layout: Layout, leaf_size: Option<u8>) -> Accel {
    let options = Options {
        layout,
        leaf_size: leaf_size.and_then(NonZeroU8::new),
        ..Options::default()
    };
    Accel::build(scene, &options)
}

#[test]
fn every_other_layout_equals_the_oracle() {
    let mut ways = Vec::new();
    for layout in OTHERS {
        for (preset, builder, leaf_size) in [
            (Preset::Medium, Builder::Own, None),
            (Preset::Fastest, Builder::Own, Some(1)),
            (Preset::VeryFast, Builder::Obvhs, Some(16)),
            (Preset::Slow, Builder::Obvhs, Some(3)),
        ] {
            ways.push(Options {
                preset,
                builder,
                leaf_size: leaf_size.and_then(NonZeroU8::new),
                layout,
                ..Options::default()
            });
        }
    }
    let mut rays = 0;
    for Named { name, scene } in scenes::all() {
        let scene = scene.expect(name);
        let mut batches = batches::coherent(&scene);
        batches.push(Batch {
            name: "nasty",
            rays: scenes::nasty_rays(&scene, 300),
        });
        let triangles: usize = scene.meshes().iter().map(|m| m.triangles.len()).sum();
        let ways = ways.iter().filter(|way| {
            way.layout != Layout::List || (triangles < 10_000 && way.preset == Preset::Medium)
        });
        let ways: Vec<Options> = ways.copied().collect();
        rays += compare(name, &scene, &batches, &ways)
            .values()
            .sum::<usize>();
    }
    assert!(rays > 200_000, "{rays} rays");
}

#[test]
fn what_obvhs_misses_by_itself_is_found() {
    let scene = scenes::icosphere_scene(3, DAffine3::IDENTITY).expect("a scene");
    let accel = built(&scene, Layout::CwBvh, None);
    let mut random = Random::new(31);
    let mut near = 0;
    for index in 0..4000 {
        let axis = [Vec3::X, Vec3::NEG_Y, Vec3::Z][index % 3];
        let direction = if index % 2 == 0 {
            axis
        } else {
            random.direction()
        };
        // Right before a surface, or far away; a zero of either sign.
        let mut ray = Ray::new(random.in_cube(), direction, 0.0, f32::INFINITY);
        if let Some(hit) = linear::intersect(&scene, &ray) {
            let before = [1e-6, 1e-5, 1e-4, 1.0, 50.0][index % 5];
            ray.origin = ray.point_at(hit.t - before);
        }
        if index % 7 < 3 {
            ray.direction = -(-ray.direction + Vec3::ZERO);
        }
        let (hit, expected) = (accel.intersect(&ray), linear::intersect(&scene, &ray));
        assert_eq!(super::bits(hit), super::bits(expected), "{ray:?}");
        assert_eq!(
            accel.occluded(&ray),
            linear::occluded(&scene, &ray),
            "{ray:?}"
        );
        near += usize::from(hit.is_some_and(|hit| hit.t < 1e-4));
    }
    assert!(near > 500, "only {near} hits are near");
}

#[test]
fn a_binary_tree_has_a_leaf_more_than_inner_nodes() {
    let scene = scenes::mesh_scene(generate::terrain(24, 1)).expect("a scene");
    let triangles = scene.meshes()[0].triangles.len();
    for leaf_size in [1, 2, 8, 16] {
        let accel = built(&scene, Layout::Bvh2, Some(leaf_size));
        let (built, sizes) = (*accel.statistics(), accel.leaf_sizes());
        assert_eq!(built.leaves, built.nodes + 1, "{built:?}");
        // 48 bytes a node, 44 an item: three vertices, a number and its kind.
        let bytes = 48 * (built.nodes + built.leaves) + 44 * triangles;
        assert_eq!(built.bytes, bytes, "{built:?}");
        assert!(sizes.len() <= usize::from(leaf_size), "{sizes:?}");
        // Some more than a balanced tree.
        let least = built.leaves.ilog2() as usize;
        assert!((least..3 * least).contains(&built.depth), "{built:?}");
    }
}

#[test]
fn a_compressed_tree_has_nodes_of_80_bytes_and_at_most_3_items_a_leaf() {
    let scene = scenes::mesh_scene(generate::terrain(24, 1)).expect("a scene");
    let triangles = scene.meshes()[0].triangles.len();
    let accel = built(&scene, Layout::CwBvh, None);
    let built = accel.statistics();
    assert_eq!(built.bytes, 80 * built.nodes + 44 * triangles, "{built:?}");
    assert_eq!(accel.leaf_sizes().len(), 3);
    // Every node but the root is a child, as every leaf is.
    let children = built.nodes - 1 + built.leaves;
    assert!((2 * built.nodes..=8 * built.nodes).contains(&children));
    assert!((3..=8).contains(&built.depth), "{built:?}");
}

#[test]
fn a_list_has_its_items_and_nothing_else() {
    let scene = scenes::icosphere_scene(2, DAffine3::IDENTITY).expect("a scene");
    let accel = built(&scene, Layout::List, None);
    let built = accel.statistics();
    assert_eq!((built.nodes, built.leaves, built.depth), (0, 0, 0));
    assert_eq!((built.bytes, built.sah_cost), (320 * 44, 320.0));
    assert!(accel.leaf_sizes().is_empty());
}

#[test]
fn leaf_sizes_add_up_to_leaves_and_to_primitives() {
    for Named { name, scene } in scenes::all() {
        let scene = scene.expect(name);
        for layout in [Layout::Wide, Layout::Small, Layout::Bvh2, Layout::CwBvh] {
            let accel = built(&scene, layout, None);
            let sizes = accel.leaf_sizes();
            let leaves: u64 = sizes.iter().sum();
            let held: u64 = (1..).zip(&sizes).map(|(size, count)| size * count).sum();
            let built = accel.statistics();
            assert_eq!(leaves, built.leaves as u64, "{name}, {layout:?}");
            let triangles = |mesh: u32| scene.mesh(mesh).triangles.len();
            let instances = scene.instances();
            let in_world = instances.iter().map(|i| match i.space {
                Some(_) => 1,
                None => triangles(i.mesh),
            });
            let shared = |mesh: &u32| {
                let mut sharing = instances.iter().filter(|i| i.space.is_some());
                sharing.any(|i| i.mesh == *mesh)
            };
            let in_meshes = (0..scene.meshes().len() as u32)
                .filter(shared)
                .map(triangles);
            let expected =
                scene.spheres().len() + in_world.sum::<usize>() + in_meshes.sum::<usize>();
            assert_eq!(held, expected as u64, "{name}, {layout:?}: {sizes:?}");
        }
    }
}

#[test]
fn surface_area_cost_is_that_of_its_definition() {
    // Two unit squares far apart, two triangles each: a root of 11 x 1 x 0, and two leaves of 1 x 1 x 0.
    let square = |x: f32| {
        let [a, b, c, d] =
            [(0.0, 0.0), (1.0, 0.0), (1.0, 1.0), (0.0, 1.0)].map(|(u, v)| Vec3::new(x + u, v, 0.0));
        [[a, b, c], [a, c, d]]
    };
    let scene = scenes::soup_scene([square(0.0), square(10.0)].concat()).expect("a scene");
    for layout in [Layout::Wide, Layout::Bvh2] {
        let accel = built(&scene, layout, Some(2));
        let cost = f64::from(accel.statistics().sah_cost);
        assert_eq!(accel.leaf_sizes(), [0, 2], "{layout:?}");
        assert!(
            (cost - (1.0 + 2.0 * 2.0 / 11.0)).abs() < 1e-6,
            "{layout:?}: {cost}"
        );
    }
}
