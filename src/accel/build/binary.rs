//! The door to obvhs: a binary tree with one item a leaf, in obvhs's form.

use super::Preset;
use glam::Vec3A;
use obvhs::aabb::Aabb;
use obvhs::bvh2::Bvh2;
use obvhs::bvh2::node::Bvh2Node;
use obvhs::bvh2::reinsertion::ReinsertionOptimizer;
use obvhs::ploc::{PlocBuilder, SortPrecision};

/// A leaf with one item, or an inner node; its children lie side by side.
#[derive(Clone, Copy)]
#[repr(transparent)]
pub(super) struct Node(Bvh2Node);

/// A binary tree, its root first.
pub(super) struct Tree(Bvh2);

impl Node {
    pub(super) fn leaf(min: Vec3A, max: Vec3A, item: u32) -> Node {
        Node(Bvh2Node::new(Aabb::new(min, max), 1, item))
    }

    pub(super) fn half_area(&self) -> f32 {
        self.0.aabb().half_area()
    }
}

impl Tree {
    pub(super) fn len(&self) -> usize {
        self.0.nodes.len()
    }

    /// The item of a leaf.
    pub(super) fn item(&self, node: u32) -> Option<u32> {
        let node = &self.0.nodes[node as usize];
        node.is_leaf().then_some(node.first_index)
    }

    /// The left child of an inner node; the right one is the next.
    pub(super) fn first_child(&self, node: u32) -> u32 {
        self.0.nodes[node as usize].first_index
    }

    pub(super) fn half_area(&self, node: u32) -> f32 {
        self.0.nodes[node as usize].aabb().half_area()
    }
}

/// The tree that joins near neighbours, bottom up (PLOC: Meister and Bittner 2018), then reinsertion.
pub(super) fn clustered(leaves: Vec<Node>, preset: Preset) -> Tree {
    let leaves: Vec<Bvh2Node> = leaves.into_iter().map(|n| n.0).collect();
    let all = leaves.iter().fold(Aabb::empty(), |a, n| a.union(n.aabb()));
    let mut builder = PlocBuilder::new();
    builder.current_nodes = leaves;
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
    drop(builder);
    let ratio = match preset {
        Preset::Fastest => 0.0,
        Preset::VeryFast => 0.01,
        Preset::Fast => 0.02,
        Preset::Medium => 0.05,
        Preset::Slow => 0.2,
        Preset::VerySlow => 1.0,
    };
    ReinsertionOptimizer::default().run(&mut bvh, ratio, None);
    Tree(bvh)
}
