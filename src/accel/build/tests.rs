use super::binary::Node;
use super::{build, reinsertion};
use crate::accel::wide::{self, Kind, Reference, Topology};
use crate::accel::{Layout, Options, Preset};
use crate::generate::Random;
use crate::geometry::Bounds;
use glam::{Vec3, Vec3A};
use std::num::NonZeroU8;

const PRESETS: [Preset; 6] = [
    Preset::Fastest,
    Preset::VeryFast,
    Preset::Fast,
    Preset::Medium,
    Preset::Slow,
    Preset::VerySlow,
];

fn with(preset: Preset) -> Options {
    Options {
        preset,
        ..Options::default()
    }
}

fn boxed(node: &wide::Node, slot: usize) -> Bounds {
    let corner = |planes: &[[f32; 8]; 3]| Vec3::from(planes.map(|plane| plane[slot]));
    Bounds {
        min: corner(&node.corners[0]),
        max: corner(&node.corners[1]),
    }
}

fn children(node: &wide::Node) -> impl Iterator<Item = (usize, Reference)> + '_ {
    let count = node
        .children
        .iter()
        .take_while(|&&child| child != Reference::NONE)
        .count();
    assert!(node.children[count..].iter().all(|&c| c == Reference::NONE));
    (0..count).map(|slot| (slot, node.children[slot]))
}

/// Asserts what every tree keeps: each item once, in a leaf of its kind; the tightest boxes; parents first.
fn check(topology: &Topology, bounds: &[Bounds], kind: impl Fn(u32) -> Kind, leaf_size: u32) {
    let mut seen = vec![false; bounds.len()];
    for &item in &topology.order {
        assert!(!std::mem::replace(&mut seen[item as usize], true), "twice");
    }
    assert!(seen.iter().all(|&seen| seen), "an item is missing");
    let (mut next_leaf, mut next_item) = (0, 0);
    let mut depth = vec![1; topology.nodes.len()];
    for (index, node) in topology.nodes.iter().enumerate() {
        for (slot, child) in children(node) {
            let inside = boxed(node, slot);
            if child.kind() == Kind::Node {
                assert!(child.index() > index, "a child before its parent");
                depth[child.index()] = depth[index] + 1;
                let of_child = &topology.nodes[child.index()];
                let exact = children(of_child)
                    .fold(Bounds::EMPTY, |b, (slot, _)| b.union(boxed(of_child, slot)));
                assert_eq!(inside, exact);
            } else {
                assert_eq!(child.index(), next_leaf, "leaves out of order");
                let leaf = topology.leaves[next_leaf];
                assert_eq!(leaf.first, next_item, "a gap between leaves");
                (next_leaf, next_item) = (next_leaf + 1, leaf.first + leaf.count);
                let most = match child.kind() {
                    Kind::Instances => 1,
                    _ => leaf_size,
                };
                assert!((1..=most).contains(&leaf.count), "{} items", leaf.count);
                let items = &topology.order[leaf.first as usize..next_item as usize];
                assert!(items.iter().all(|&item| kind(item) == child.kind()));
                let exact = items
                    .iter()
                    .fold(Bounds::EMPTY, |b, &item| b.union(bounds[item as usize]));
                assert_eq!(inside, exact);
            }
        }
    }
    assert_eq!(next_leaf, topology.leaves.len());
    assert_eq!(topology.depth, depth.iter().copied().max().unwrap_or(0));
    assert!(topology.sah_cost.is_finite());
}

fn triangles(_: u32) -> Kind {
    Kind::Triangles
}

/// Boxes of many sizes all over a cube.
fn random_boxes(count: usize) -> Vec<Bounds> {
    let mut random = Random::new(11);
    (0..count)
        .map(|_| {
            let center = random.in_cube();
            let size = (random.in_cube() * random.next_f32() * 0.2).abs();
            Bounds {
                min: center - size,
                max: center + size,
            }
        })
        .collect()
}

#[test]
fn nothing_makes_an_empty_tree() {
    let topology = build(&[], triangles, &Options::default());
    assert!(topology.nodes.is_empty() && topology.leaves.is_empty());
}

#[test]
fn one_item_hangs_below_a_root() {
    for kind in [Kind::Triangles, Kind::Spheres, Kind::Instances] {
        let bounds = random_boxes(1);
        let topology = build(&bounds, |_| kind, &Options::default());
        assert_eq!(topology.nodes.len(), 1);
        assert_eq!(topology.nodes[0].children[0], Reference::new(kind, 0));
        check(&topology, &bounds, |_| kind, 8);
    }
}

#[test]
fn eight_pairs_far_apart_are_eight_leaves_of_one_node() {
    let bounds: Vec<Bounds> = (0..16)
        .map(|i| {
            let side = |bit: usize| (((i / 2) >> bit) & 1) as f32 * 100.0;
            let at = Vec3::new(side(0), side(1), side(2)) + (i % 2) as f32;
            Bounds::around([at, at + 1.0])
        })
        .collect();
    for preset in PRESETS {
        let topology = build(&bounds, triangles, &with(preset));
        assert_eq!(topology.nodes.len(), 1, "{preset:?}");
        // Along the curve a leaf is full as soon as it may be.
        let count = if preset == Preset::Fastest { 8 } else { 2 };
        assert!(topology.leaves.iter().all(|leaf| leaf.count == count));
        check(&topology, &bounds, triangles, 8);
    }
}

#[test]
fn every_tree_holds_every_item_once() {
    let bounds = random_boxes(3000);
    let mixed = |item: u32| match item % 7 {
        0 => Kind::Instances,
        1 | 2 => Kind::Spheres,
        _ => Kind::Triangles,
    };
    for preset in PRESETS {
        for (layout, leaf_size) in [(Layout::Wide, 8), (Layout::Small, 8), (Layout::Wide, 16)] {
            let options = Options {
                preset,
                layout,
                leaf_size: NonZeroU8::new(leaf_size),
                ..Options::default()
            };
            let topology = build(&bounds, triangles, &options);
            check(&topology, &bounds, triangles, u32::from(leaf_size));
            check(
                &build(&bounds, mixed, &options),
                &bounds,
                mixed,
                u32::from(leaf_size),
            );
        }
        let one = Options {
            leaf_size: NonZeroU8::new(1),
            ..with(preset)
        };
        check(&build(&bounds, triangles, &one), &bounds, triangles, 1);
    }
}

#[test]
fn reinsertion_parts_a_wrong_pair() {
    // Two pairs far apart, paired crosswise: half areas of 2 for each and of 11 for the wrong ones.
    let leaf = |x: f32, item| {
        let min = Vec3A::new(x, 0.0, 0.0);
        Node::leaf(min, min + Vec3A::new(0.5, 1.0, 0.0), item)
    };
    let (a, b, c, d) = (leaf(0.0, 0), leaf(10.0, 1), leaf(0.5, 2), leaf(10.5, 3));
    let (left, right) = (a.joined(&b, 3), c.joined(&d, 5));
    let mut nodes = [left.joined(&right, 1), left, right, a, b, c, d];
    let sum = |nodes: &[Node]| nodes.iter().map(Node::half_area).sum::<f32>();
    assert_eq!(sum(&nodes), 11.0 + 10.5 + 10.5 + 4.0 * 0.5);
    reinsertion::improve(&mut nodes, 1.0, 8);
    assert_eq!(sum(&nodes), 11.0 + 1.0 + 1.0 + 4.0 * 0.5);
}

#[test]
fn any_number_of_threads_makes_the_same_tree() {
    let bounds = random_boxes(20_000);
    let built = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        let topology = pool
            .expect("threads")
            .install(|| build(&bounds, triangles, &Options::default()));
        (topology.order, topology.leaves, topology.nodes.len())
    };
    let alone = built(1);
    assert_eq!(built(2), alone);
    assert_eq!(built(5), alone);
}

/// Boxes that once took long, or that make deep trees: each in time and depth like any others.
fn odd(name: &str, count: usize) -> Vec<Bounds> {
    let cube = |center: Vec3, half: f32| Bounds {
        min: center - half,
        max: center + half,
    };
    (0..count)
        .map(|i| {
            let x = i as f32 / count as f32;
            match name {
                "identical" => cube(Vec3::ONE, 0.5),
                "nested" => cube(Vec3::ZERO, 1.0 + i as f32),
                "nested in a corner" => Bounds::around([Vec3::ZERO, Vec3::splat(1.0 + i as f32)]),
                "ever smaller" => cube(Vec3::X * (1.0 - x), 1e-3 * (1.0 - x)),
                "geometric" => {
                    let size = libm::exp2f(-(i as f32) * 140.0 / count as f32);
                    cube(Vec3::X * size, size * 0.25)
                }
                "halved each time" => {
                    let size = libm::exp2f(-(i as f32));
                    cube(Vec3::X * size, size * 0.25)
                }
                "fan" => {
                    let rim = |x: f32| {
                        let turn = x * std::f32::consts::TAU;
                        Vec3::new(libm::cosf(turn), libm::sinf(turn), 0.0)
                    };
                    Bounds::around([Vec3::ZERO, rim(x), rim((i + 1) as f32 / count as f32)])
                }
                "two fans" => {
                    let rim = |x: f32| {
                        let turn = x * std::f32::consts::TAU;
                        Vec3::new(libm::cosf(turn), libm::sinf(turn), 0.0)
                    };
                    let tip = Vec3::Z * (i % 2) as f32 * 1e-3;
                    let (from, to) = (i / 2 * 2, i / 2 * 2 + 2);
                    let at = |i: usize| rim(i as f32 / count as f32);
                    Bounds::around([tip, at(from), at(to)])
                }
                "flat" => cube(Vec3::new(x, libm::sinf(x * 100.0), 0.0), 0.0),
                "one point" => cube(Vec3::ONE, 0.0),
                "small and great" => cube(Vec3::X * x, if i % 2 == 0 { 1e-6 } else { 1e6 }),
                _ => cube(Vec3::new(x, x * x, 1.0) * 1e15, 1e10),
            }
        })
        .collect()
}

#[test]
fn odd_boxes_are_built_like_any_others() {
    let names = [
        "identical",
        "nested",
        "nested in a corner",
        "ever smaller",
        "geometric",
        "halved each time",
        "fan",
        "two fans",
        "flat",
        "one point",
        "small and great",
        "far",
    ];
    for name in names {
        let bounds = odd(name, 20_000);
        for preset in [Preset::Fastest, Preset::Medium] {
            let topology = build(&bounds, triangles, &with(preset));
            check(&topology, &bounds, triangles, 8);
            assert!(topology.depth <= 200, "{name}: {}", topology.depth);
            assert!(
                topology.nodes.len() * 3 <= bounds.len(),
                "{name}: {}",
                topology.nodes.len()
            );
        }
    }
}
