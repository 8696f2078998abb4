//! The door to obvhs, which builds the trees (PLOC with reinsertion; Meister and Bittner 2018 and 2017).
//!
//! obvhs 0.4 has traps, which are met here: it builds chains in quadratic time where many boxes coincide, so equal ones
//! go in as one; areas overflow and underflow at the ends of the number range, so it sees boxes moved into -1..1; it
//! panics on nothing, so that never reaches it. Only its topology is used: our boxes are exact.

use super::primitive::Bounded;
use super::tree::{Node, Tree};
use super::{Options, Preset};
use crate::geometry::Bounds;
use glam::{DVec3, Vec3A};
use obvhs::BvhBuildParams;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2;
use rayon::prelude::*;
use std::time::Duration;

/// The tree over `items`; empty where there are none.
pub(super) fn build<Item: Bounded + Copy + Sync + Send>(
    items: Vec<Item>,
    options: &Options,
) -> Tree<Item> {
    if items.is_empty() {
        return Tree::default();
    }
    let bounds: Vec<Bounds> = items.iter().map(Bounded::bounds).collect();
    let groups = Groups::of_equal_boxes(&bounds);
    let boxes = scaled(groups.firsts().map(|item| bounds[item as usize]).collect());
    let mut core_build_time = Duration::ZERO;
    let bvh = build_bvh2(&boxes, parameters(options), &mut core_build_time);
    let (mut nodes, order, depth) = copied(&bvh, &groups);
    let ordered: Vec<Item> = order.iter().map(|&item| items[item as usize]).collect();
    // Children follow their parents, so backwards every box is ready before the box around it.
    for index in (0..nodes.len()).rev() {
        let Node { first, count, .. } = nodes[index];
        let (first, count) = (first as usize, count as usize);
        nodes[index].bounds = if count > 0 {
            order[first..first + count]
                .iter()
                .fold(Bounds::EMPTY, |b, &item| b.union(bounds[item as usize]))
        } else {
            nodes[first].bounds.union(nodes[first + 1].bounds)
        };
    }
    Tree::new(nodes, ordered, depth)
}

/// Items with the same box, side by side.
struct Groups {
    /// Item indices, sorted by box.
    sorted: Vec<u32>,
    /// Where in `sorted` each group starts, and the end of the last.
    starts: Vec<u32>,
}

impl Groups {
    fn of_equal_boxes(bounds: &[Bounds]) -> Groups {
        let key = |item: &u32| {
            let b = &bounds[*item as usize];
            [b.min.x, b.min.y, b.min.z, b.max.x, b.max.y, b.max.z].map(f32::to_bits)
        };
        let mut sorted: Vec<u32> = (0..bounds.len() as u32).collect();
        sorted.par_sort_unstable_by_key(|item| (key(item), *item));
        let is_start =
            |&at: &u32| at == 0 || key(&sorted[at as usize]) != key(&sorted[at as usize - 1]);
        let mut starts: Vec<u32> = (0..sorted.len() as u32).filter(is_start).collect();
        starts.push(sorted.len() as u32);
        Groups { sorted, starts }
    }

    /// One item of each group.
    fn firsts(&self) -> impl Iterator<Item = u32> {
        self.starts[..self.starts.len() - 1]
            .iter()
            .map(|&start| self.sorted[start as usize])
    }

    fn items(&self, group: u32) -> &[u32] {
        let group = group as usize;
        &self.sorted[self.starts[group] as usize..self.starts[group + 1] as usize]
    }
}

/// The boxes, moved and scaled into -1..1.
fn scaled(boxes: Vec<Bounds>) -> Vec<Aabb> {
    let all = boxes.iter().copied().fold(Bounds::EMPTY, Bounds::union);
    let (min, max) = (all.min.as_dvec3(), all.max.as_dvec3());
    let center = (min + max) * 0.5;
    let scale = 2.0 / (max - min).max_element().max(f64::MIN_POSITIVE);
    let moved = |p: glam::Vec3| -> Vec3A {
        ((p.as_dvec3() - center) * scale)
            .clamp(DVec3::NEG_ONE, DVec3::ONE)
            .as_vec3a()
    };
    boxes
        .iter()
        .map(|b| Aabb::new(moved(b.min), moved(b.max)))
        .collect()
}

fn parameters(options: &Options) -> BvhBuildParams {
    let preset = match options.preset {
        Preset::Fastest => BvhBuildParams::fastest_build(),
        Preset::VeryFast => BvhBuildParams::very_fast_build(),
        Preset::Fast => BvhBuildParams::fast_build(),
        Preset::Medium => BvhBuildParams::medium_build(),
        Preset::Slow => BvhBuildParams::slow_build(),
        Preset::VerySlow => BvhBuildParams::very_slow_build(),
    };
    let max_prims_per_leaf = options
        .leaf_size
        .map_or(preset.max_prims_per_leaf, |n| u32::from(n.get()));
    // Splitting needs triangles, and lists some of them twice.
    BvhBuildParams {
        pre_split: false,
        max_prims_per_leaf,
        ..preset
    }
}

/// obvhs's nodes in our form, boxes still empty: the nodes, the items in the order of the leaves, and the depth.
fn copied(bvh: &Bvh2, groups: &Groups) -> (Vec<Node>, Vec<u32>, usize) {
    let empty = Node {
        bounds: Bounds::EMPTY,
        first: 0,
        count: 0,
    };
    let mut nodes = vec![empty];
    let mut order = Vec::with_capacity(groups.sorted.len());
    let mut depth = 1;
    // Ours, obvhs's, and how deep.
    let mut open = vec![(0usize, 0usize, 1usize)];
    while let Some((to, from, level)) = open.pop() {
        depth = depth.max(level);
        let source = &bvh.nodes[from];
        if source.is_leaf() {
            let first = order.len();
            for i in source.first_index..source.first_index + source.prim_count {
                order.extend_from_slice(groups.items(bvh.primitive_indices[i as usize]));
            }
            nodes[to] = Node {
                first: first as u32,
                count: (order.len() - first) as u32,
                ..empty
            };
        } else {
            let first = nodes.len();
            nodes.extend([empty, empty]);
            nodes[to].first = first as u32;
            let child = source.first_index as usize;
            open.extend([(first + 1, child + 1, level + 1), (first, child, level + 1)]);
        }
    }
    (nodes, order, depth)
}
