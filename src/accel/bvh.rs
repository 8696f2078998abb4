//! The door to obvhs, which builds the trees (PLOC with reinsertion; Meister and Bittner 2018 and 2017).
//!
//! obvhs 0.4 has traps, which are met here: it builds chains in quadratic time where many boxes coincide, so equal ones
//! go in as one; areas overflow and underflow at the ends of the number range, so it sees boxes moved into -1..1; it
//! panics on nothing, so that never reaches it. Only its topology is used: our boxes are exact.

use super::wide::{Kind, Leaf, Node, Reference, Topology};
use super::{Options, Preset};
use crate::geometry::Bounds;
use glam::{DVec3, Vec3A};
use obvhs::BvhBuildParams;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::builder::build_bvh2;
use rayon::prelude::*;
use std::time::Duration;


/// temporary
pub(super) fn build(bounds: &[Bounds], kind: impl Fn(u32) -> Kind + Sync, options: &Options) -> Topology {
    if bounds.is_empty() {
        return Topology::default();
    }
    let groups = Groups::of_equal_boxes(bounds);
    let boxes = scaled(groups.firsts().map(|item| bounds[item as usize]).collect());
    let mut core_build_time = Duration::ZERO;
    let bvh = build_bvh2(&boxes, parameters(options), &mut core_build_time);
    // exact boxes
    let n = bvh.nodes.len();
    let mut exact = vec![Bounds::EMPTY; n];
    let mut order_nodes = vec![0u32];
    let mut i = 0;
    while i < order_nodes.len() {
        let node = &bvh.nodes[order_nodes[i] as usize];
        if !node.is_leaf() { order_nodes.push(node.first_index); order_nodes.push(node.first_index + 1); }
        i += 1;
    }
    for &i in order_nodes.iter().rev() {
        let node = &bvh.nodes[i as usize];
        exact[i as usize] = if node.is_leaf() {
            (node.first_index..node.first_index + node.prim_count).flat_map(|p| groups.items(bvh.primitive_indices[p as usize])).fold(Bounds::EMPTY, |b, &i| b.union(bounds[i as usize]))
        } else { exact[node.first_index as usize].union(exact[node.first_index as usize + 1]) };
    }
    let area = |b: &Bounds| { let d = b.max - b.min; d.x * d.y + d.y * d.z + d.z * d.x };
    let mut t = Topology::default();
    t.nodes.push(Node::EMPTY);
    let mut open = vec![(0usize, 0u32, 1usize)];
    while let Some((to, from, level)) = open.pop() {
        t.depth = t.depth.max(level);
        let mut children = vec![from];
        loop {
            let best = children.iter().enumerate().filter(|(_, c)| !bvh.nodes[**c as usize].is_leaf()).max_by(|a, b| area(&exact[*a.1 as usize]).total_cmp(&area(&exact[*b.1 as usize]))).map(|x| x.0);
            let Some(best) = best else { break };
            if children.len() == 8 { break }
            let c = children.swap_remove(best);
            let f = bvh.nodes[c as usize].first_index;
            children.extend([f, f + 1]);
        }
        for (slot, c) in children.into_iter().enumerate() {
            let node = &bvh.nodes[c as usize];
            if node.is_leaf() {
                let items: Vec<u32> = (node.first_index..node.first_index + node.prim_count).flat_map(|p| groups.items(bvh.primitive_indices[p as usize]).to_vec()).collect();
                let k = kind(items[0]);
                t.leaves.push(Leaf { first: t.order.len() as u32, count: items.len() as u32 });
                t.order.extend(items);
                t.nodes[to].set(slot, &exact[c as usize], Reference::new(k, t.leaves.len() as u32 - 1));
            } else {
                let new = t.nodes.len();
                t.nodes.push(Node::EMPTY);
                t.nodes[to].set(slot, &exact[c as usize], Reference::new(Kind::Node, new as u32));
                open.push((new, c, level + 1));
            }
        }
    }
    t
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

