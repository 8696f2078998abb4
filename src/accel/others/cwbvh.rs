//! obvhs's compressed tree with eight children a node, and its traversal (Ylitie, Karras and Laine 2017, "Efficient
//! Incoherent Ray Traversal on GPUs Through Compressed Wide BVHs").
//!
//! Its traps are met here. The ray that its box test sees has a unit of length of its own, in which no hit is nearer than
//! the test's 1e-4; a direction as [`crate::accel::slab`] has it, without a `-0.0`; and boxes are grown so far that its
//! rounding, and ours, lose no hit. The stack is as deep as the tree.

use super::binary::{Binary, half_area};
use super::{Search, Shape, bvh2};
use crate::accel::Statistics;
use crate::accel::cost::Tally;
use crate::accel::kernel::Question;
use crate::accel::primitive::Probe;
use crate::accel::slab::RELATIVE_PAD;
use crate::geometry::Bounds;
use glam::{UVec2, Vec3, Vec3A};
use obvhs::bvh2::Bvh2;
use obvhs::cwbvh::bvh2_to_cwbvh::bvh2_to_cwbvh;
use obvhs::cwbvh::node::{CwBvhNode, extract_byte64};
use obvhs::faststack::FastStack;
use obvhs::ray::Ray;
use obvhs::{fast_stack, traverse};

/// How far from the world's origin, in extents, a ray may start whose boxes obvhs tests.
const FARTHEST: f32 = 8.0;
/// Extents for which nothing on the way overflows or vanishes.
const EXTENTS: std::ops::Range<f32> = 1e-12..1e16;
/// The same for the directions of rays.
const DIRECTIONS: std::ops::Range<f32> = 1e-9..1e9;
/// A leaf has a code for so many items.
const MOST_IN_LEAF: u32 = 3;
/// obvhs converts trees recursively.
const DEEPEST: usize = 500;
/// Below this `t` obvhs finds no box.
const LEAST_T: f32 = 1e-4;
/// The greatest `1/d` that obvhs computes with, for a direction whose greatest component is 1.
const MOST_INVERSE: f32 = 1.0 / f32::EPSILON;

/// A tree whose leaves are ranges of items.
#[derive(Clone, Debug)]
pub(super) struct CwBvh {
    tree: obvhs::cwbvh::CwBvh,
    extent: f32,
    /// Without the bytes of the items.
    pub(super) statistics: Statistics,
}

/// What boxes are grown by: what the slab test takes hits for that lie outside, and half of that again for the rounding
/// of compression and of obvhs's test. The half is [`spare`].
fn margin(extent: f32) -> f32 {
    3.0 * spare(extent)
}

fn spare(extent: f32) -> f32 {
    0.5 * RELATIVE_PAD * (FARTHEST + 1.0) * extent
}

/// The tree, compressed, and the items in the order of its leaves.
pub(super) fn of(binary: &Binary, extent: f32) -> (Shape, Vec<u32>) {
    if binary.nodes.is_empty() || binary.depth > DEEPEST {
        return bvh2::of(binary);
    }
    let margin = Vec3A::splat(margin(extent));
    let mut grown = Bvh2 {
        nodes: binary.nodes.clone(),
        ..Bvh2::default()
    };
    // obvhs finds an item by its place in a list.
    for node in &mut grown.nodes {
        let mut aabb = *node.aabb();
        (aabb.min, aabb.max) = (aabb.min - margin, aabb.max + margin);
        node.set_aabb(aabb);
    }
    grown.primitive_indices = (0..binary.nodes.len().div_ceil(2) as u32).collect();
    let most_in_leaf = binary.leaf_size.min(MOST_IN_LEAF);
    let mut tree = bvh2_to_cwbvh(&grown, most_in_leaf, true, false);
    let order = std::mem::take(&mut tree.primitive_indices);
    tree.nodes.shrink_to_fit();
    let mut tree = CwBvh {
        tree,
        extent,
        statistics: Statistics::default(),
    };
    tree.statistics = tree.measure();
    (Shape::CwBvh(tree), order)
}

/// What tests the boxes of a node: those that a ray meets, as obvhs wants them.
enum Boxes<'a> {
    /// obvhs's own test. `t` counts in units of its own, so many to one.
    Obvhs { ray: Ray, units: f32 },
    /// One box after another.
    Careful(&'a Probe),
}

impl<'a> Boxes<'a> {
    fn new(probe: &'a Probe, extent: f32) -> Boxes<'a> {
        let (ray, length) = (&probe.ray, probe.ray.direction.abs().max_element());
        let fits = EXTENTS.contains(&extent)
            && DIRECTIONS.contains(&length)
            && ray.origin.abs().max_element() <= FARTHEST * extent
            && ray.t_min >= 0.0;
        if !fits {
            return Boxes::Careful(probe);
        }
        // A ray leaves a box with a hit in it by half the spare room after the hit or later.
        let units = 2.0 * LEAST_T * length / spare(extent);
        let most = Vec3::splat(MOST_INVERSE / length);
        let inverse = probe.slab.inverse.clamp(-most, most) * units;
        Boxes::Obvhs {
            ray: Ray {
                origin: ray.origin.into(),
                // Only its signs are looked at.
                direction: inverse.into(),
                inv_direction: inverse.into(),
                tmin: 0.0,
                tmax: 0.0,
            },
            units,
        }
    }

    /// Which children the ray meets up to `end`, in the bits of obvhs.
    #[inline(always)]
    fn met(&mut self, node: &CwBvhNode, octant: u32, end: f32) -> u32 {
        match self {
            Boxes::Obvhs { ray, units } => {
                ray.tmax = (end * *units).max(LEAST_T);
                node.intersect_ray(ray, octant)
            }
            Boxes::Careful(probe) => {
                let (bits, places) = node.get_child_and_index_bits(octant);
                let mut met = 0;
                for child in 0..8 {
                    let aabb = node.child_aabb(child);
                    let (near, far) = probe.slab.interval(&Bounds {
                        min: aabb.min.into(),
                        max: aabb.max.into(),
                    });
                    if near.max(probe.ray.t_min) <= far.min(end) {
                        met |= extract_byte64(bits, child) << extract_byte64(places, child);
                    }
                }
                met
            }
        }
    }
}

/// obvhs's state of a traversal, with a stack of any size.
struct State<'a, S> {
    stack: &'a mut S,
    current_group: UVec2,
    primitive_group: UVec2,
    oct_inv4: u32,
    primitive_id: u32,
    hitmask: u32,
}

impl CwBvh {
    /// Items in each leaf.
    pub(super) fn leaf_sizes(&self) -> impl Iterator<Item = u32> {
        self.tree.nodes.iter().flat_map(|node| {
            let leaves = (0..8).filter(|&child| node.is_leaf(child) && !node.is_child_empty(child));
            leaves.map(|child| node.child_primitives(child).1)
        })
    }

    fn measure(&self) -> Statistics {
        let nodes = &self.tree.nodes;
        let mut statistics = Statistics {
            nodes: nodes.len(),
            leaves: self.leaf_sizes().count(),
            bytes: size_of_val(nodes.as_slice()),
            ..Statistics::default()
        };
        let of_root = half_area(&self.tree.total_aabb);
        let mut sum = of_root;
        let mut open = vec![(0, 1)];
        while let Some((index, depth)) = open.pop() {
            statistics.depth = statistics.depth.max(depth);
            let Some(node) = nodes.get(index) else {
                continue;
            };
            for child in (0..8).filter(|&child| !node.is_child_empty(child)) {
                let mut cost = 1;
                if node.is_leaf(child) {
                    cost = node.child_primitives(child).1;
                } else {
                    open.push((node.child_node_index(child) as usize, depth + 1));
                }
                sum += half_area(&node.child_aabb(child)) * f64::from(cost);
            }
        }
        if of_root > 0.0 {
            statistics.sah_cost = (sum / of_root) as f32;
        }
        statistics
    }

    /// Follows a ray; true at once where any hit will do and one is opaque.
    pub(super) fn walk<Q: Question, T: Tally>(&self, search: &mut Search<Q, T>) -> bool {
        // A node leaves at most one group of others behind.
        fast_stack!(UVec2, (32, 192), self.statistics.depth, stack, {
            self.walk_with(&mut stack, search)
        })
    }

    fn walk_with<Q: Question, T: Tally>(
        &self,
        stack: &mut impl FastStack<UVec2>,
        search: &mut Search<Q, T>,
    ) -> bool {
        let mut boxes = Boxes::new(search.probe, self.extent);
        let [x, y, z] = search.probe.slab.near();
        let mut state = State {
            stack,
            current_group: UVec2::new(0, 0x8000_0000),
            primitive_group: UVec2::ZERO,
            oct_inv4: (7 - (x << 2 | y << 1 | z) as u32) * 0x0101_0101,
            primitive_id: 0,
            hitmask: 0,
        };
        let mut node;
        traverse!(
            self.tree,
            node,
            state,
            {
                search.tally.node();
                boxes.met(node, state.oct_inv4, search.best.t)
            },
            {
                let item = state.primitive_id as usize;
                if search.test(item..item + 1) {
                    return true;
                }
            }
        );
        false
    }
}
