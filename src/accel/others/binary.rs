//! A binary tree with its true boxes, as both layouts of obvhs begin.

use crate::accel::items::Items;
use crate::accel::wide::Kind;
use crate::accel::{Options, build};
use crate::geometry::Bounds;
use obvhs::aabb::Aabb;
use obvhs::bvh2::node::Bvh2Node;

/// The tree that the options ask for, before its leaves are collapsed.
pub(super) struct Binary {
    /// The root first, every child after its parent. The first index of a leaf is its item.
    pub(super) nodes: Vec<Bvh2Node>,
    /// The most inner nodes on a way from the root to a leaf.
    pub(super) depth: usize,
    /// The most items that a leaf may have.
    pub(super) leaf_size: u32,
    /// Whether the item of a leaf is an instance, node by node: those stay alone.
    pub(super) is_instance: Vec<bool>,
}

impl Binary {
    pub(super) fn new(items: &impl Items, options: &Options) -> Binary {
        let built = build::binary(items.bounds(), |index| items.kind(index), options);
        let mut tree = Binary {
            nodes: Vec::with_capacity(built.len()),
            depth: 0,
            leaf_size: options.leaf_size.map_or(8, |n| u32::from(n.get())).min(16),
            is_instance: Vec::with_capacity(built.len()),
        };
        let nothing = Bvh2Node::new(Aabb::empty(), 0, 0);
        tree.push_node(nothing, false);
        // What to lay next: a node that was built, where it lies, and how many are above it.
        let mut open = vec![(0, 0, 0)];
        while let Some((from, to, depth)) = open.pop() {
            let Some(node) = built.get(from) else {
                continue;
            };
            if let Some(item) = node.item() {
                let bounds = &items.bounds()[item as usize];
                tree.nodes[to] = Bvh2Node::new(aabb(bounds), 1, item);
                tree.is_instance[to] = items.kind(item) == Kind::Instances;
                tree.depth = tree.depth.max(depth);
            } else {
                let (child, first) = (node.first_child() as usize, tree.nodes.len());
                tree.nodes[to].first_index = first as u32;
                tree.push_node(nothing, false);
                tree.push_node(nothing, false);
                open.push((child + 1, first + 1, depth + 1));
                open.push((child, first, depth + 1));
            }
        }
        if built.is_empty() {
            tree.nodes.clear();
        }
        tree.fit();
        tree
    }

    fn push_node(&mut self, node: Bvh2Node, is_instance: bool) {
        self.nodes.push(node);
        self.is_instance.push(is_instance);
    }

    /// Gives inner nodes their boxes: backwards, the children of each are ready.
    fn fit(&mut self) {
        for index in (0..self.nodes.len()).rev() {
            let node = self.nodes[index];
            if !node.is_leaf() {
                let first = node.first_index as usize;
                let around = self.nodes[first].aabb().union(self.nodes[first + 1].aabb());
                self.nodes[index].set_aabb(around);
            }
        }
    }
}

/// A box as obvhs has it.
fn aabb(bounds: &Bounds) -> Aabb {
    Aabb::new(bounds.min.into(), bounds.max.into())
}

/// Half the area of a box, in `f64` where no scene overflows it.
pub(super) fn half_area(aabb: &Aabb) -> f64 {
    let d = (aabb.max - aabb.min).as_dvec3();
    d.x * d.y + d.y * d.z + d.z * d.x
}
