//! The door to obvhs, whose PLOC joins near neighbours as [`super::clustered`] does.
//!
//! obvhs 0.4 has traps, which are met here: equal boxes and fans make its rounds join one pair each, so that its time
//! grows with the square; areas overflow at the ends of the number range, so it sees boxes moved into -1..1; it panics on
//! nothing. Its reinsertion has a stack of fixed size and no limit on its search, so the tree gets ours.

use super::binary::Node;
use super::{clustered, curve};
use crate::accel::Preset;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::node::Bvh2Node;
use obvhs::ploc::{PlocBuilder, SortPrecision};

/// The most equal boxes that obvhs gets to see side by side.
const MOST_EQUAL: usize = 64;

/// The nodes over `leaves`, the root first and siblings side by side: obvhs's, or our own where obvhs would stall.
pub(super) fn joined(leaves: Vec<Node>, preset: Preset) -> Vec<Node> {
    let leaves = curve::sorted(leaves);
    let tried = clustered::joined(leaves.clone(), 2, 0);
    if leaves.len() < 3 || tried.stalled || longest_run(&leaves) > MOST_EQUAL {
        return tried.nodes;
    }
    drop(tried);
    let mut builder = PlocBuilder::new();
    builder.current_nodes = leaves
        .iter()
        .map(|leaf| {
            let bounds = Aabb::new(leaf.min(), leaf.max());
            Bvh2Node::new(bounds, 1, leaf.item().unwrap_or_default())
        })
        .collect();
    let all = (leaves.iter()).fold(Aabb::empty(), |all, leaf| {
        all.union(&Aabb::new(leaf.min(), leaf.max()))
    });
    let mut bvh = Bvh2::default();
    let precision = SortPrecision::U64;
    match preset {
        Preset::Fastest | Preset::VeryFast => {
            builder.build_ploc_from_leaves::<1, false>(&mut bvh, all, precision, 0)
        }
        Preset::Fast => builder.build_ploc_from_leaves::<6, false>(&mut bvh, all, precision, 2),
        Preset::Medium | Preset::Slow => {
            builder.build_ploc_from_leaves::<14, false>(&mut bvh, all, precision, 3)
        }
        Preset::VerySlow => {
            builder.build_ploc_from_leaves::<24, false>(&mut bvh, all, precision, 1)
        }
    }
    let ours = |node: &Bvh2Node| {
        let (min, max) = (node.aabb().min, node.aabb().max);
        if node.is_leaf() {
            Node::leaf(min, max, node.first_index)
        } else {
            Node::inner(min, max, node.first_index)
        }
    };
    bvh.nodes.iter().map(ours).collect()
}

/// How many equal boxes follow each other at most.
fn longest_run(leaves: &[Node]) -> usize {
    let same = |a: &Node, b: &Node| a.min() == b.min() && a.max() == b.max();
    leaves.chunk_by(same).map(<[Node]>::len).max().unwrap_or(0)
}
