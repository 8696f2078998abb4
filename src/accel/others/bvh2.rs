//! obvhs's binary tree.
//!
//! Walked in the order of its `ray_traverse`: both children are tested, the nearer is next, the other waits. Its own box
//! test loses hits that rounding puts just outside a box, and hits at the very distance of the best so far; this one is
//! that of [`crate::accel::slab`], of the same few operations.

use super::binary::{Binary, half_area};
use super::{Search, Shape};
use crate::accel::Statistics;
use crate::accel::cost::Tally;
use crate::accel::kernel::Question;
use crate::accel::primitive::Probe;
use glam::Vec3A;
use obvhs::aabb::Aabb;
use obvhs::bvh2::node::Bvh2Node;
use obvhs::fast_stack;
use obvhs::faststack::FastStack;

/// A tree whose leaves are ranges of items.
#[derive(Clone, Debug)]
pub(super) struct Bvh2 {
    nodes: Vec<Bvh2Node>,
    /// Without the bytes of the items.
    pub(super) statistics: Statistics,
}

/// What of a binary tree becomes a leaf: the cheapest by surface area, a node and an item costing 1 each.
struct Leaves {
    /// Items below each node.
    items: Vec<u32>,
    is_leaf: Vec<bool>,
    cost: f64,
}

impl Leaves {
    fn new(tree: &Binary) -> Leaves {
        let count = tree.nodes.len();
        let (mut items, mut is_leaf) = (vec![1; count], vec![true; count]);
        let mut costs = vec![0.0; count];
        let mut may_join: Vec<bool> = tree.is_instance.iter().map(|instance| !instance).collect();
        for (index, node) in tree.nodes.iter().enumerate().rev() {
            let area = half_area(node.aabb());
            costs[index] = area;
            if !node.is_leaf() {
                let children = [node.first_index as usize, node.first_index as usize + 1];
                items[index] = children.iter().map(|&child| items[child]).sum();
                may_join[index] =
                    children.iter().all(|&child| may_join[child]) && items[index] <= tree.leaf_size;
                let split = area + children.iter().map(|&child| costs[child]).sum::<f64>();
                let joined = area * f64::from(items[index]);
                is_leaf[index] = may_join[index] && joined <= split;
                costs[index] = if is_leaf[index] { joined } else { split };
            }
        }
        Leaves {
            items,
            is_leaf,
            cost: costs.first().copied().unwrap_or(0.0),
        }
    }
}

/// The tree with its leaves collapsed, and the items in their order.
pub(super) fn of(tree: &Binary) -> (Shape, Vec<u32>) {
    let leaves = Leaves::new(tree);
    let Some(root) = tree.nodes.first() else {
        return (Shape::List, Vec::new());
    };
    let of_root = half_area(root.aabb());
    let mut statistics = Statistics::default();
    if of_root > 0.0 {
        statistics.sah_cost = (leaves.cost / of_root) as f32;
    }
    let (mut nodes, mut order) = (vec![*root], Vec::new());
    let mut open = vec![(0, 0, 0)];
    let mut below = Vec::new();
    while let Some((from, to, depth)) = open.pop() {
        let first = tree.nodes[from].first_index as usize;
        if leaves.is_leaf[from] {
            nodes[to].prim_count = leaves.items[from];
            nodes[to].first_index = order.len() as u32;
            statistics.leaves += 1;
            statistics.depth = statistics.depth.max(depth);
            below.push(from);
            while let Some(index) = below.pop() {
                let node = &tree.nodes[index];
                let first = node.first_index as usize;
                if node.is_leaf() {
                    order.push(node.first_index);
                } else {
                    below.extend([first + 1, first]);
                }
            }
        } else {
            let children = nodes.len();
            nodes.extend_from_slice(&tree.nodes[first..first + 2]);
            nodes[to].first_index = children as u32;
            statistics.nodes += 1;
            open.push((first + 1, children + 1, depth + 1));
            open.push((first, children, depth + 1));
        }
    }
    nodes.shrink_to_fit();
    statistics.bytes = size_of_val(nodes.as_slice());
    (Shape::Bvh2(Bvh2 { nodes, statistics }), order)
}

/// A ray against boxes, with the bits of [`crate::accel::slab::Slab`].
struct Boxes {
    low: Vec3A,
    high: Vec3A,
    inverse: Vec3A,
    t_min: f32,
}

/// Where a ray enters a box that it does not meet: not a number, so that no comparison with it holds.
const NOWHERE: f32 = f32::NAN;

impl Boxes {
    fn new(probe: &Probe) -> Boxes {
        Boxes {
            low: probe.slab.low.into(),
            high: probe.slab.high.into(),
            inverse: probe.slab.inverse.into(),
            t_min: probe.ray.t_min,
        }
    }

    /// Where the ray enters a box, or [`NOWHERE`].
    #[inline(always)]
    fn enter(&self, aabb: &Aabb) -> f32 {
        // The padded origin makes the first the lesser where the direction is positive, and the greater where not.
        let to_min = (aabb.min - self.high) * self.inverse;
        let to_max = (aabb.max - self.low) * self.inverse;
        let near = to_min.min(to_max).max_element().max(self.t_min);
        let far = to_min.max(to_max).min_element();
        if near <= far { near } else { NOWHERE }
    }
}

impl Bvh2 {
    /// Items in each leaf.
    pub(super) fn leaf_sizes(&self) -> impl Iterator<Item = u32> {
        let leaves = self.nodes.iter().filter(|node| node.is_leaf());
        leaves.map(|node| node.prim_count)
    }

    /// Follows a ray; true at once where any hit will do and one is opaque.
    pub(super) fn walk<Q: Question, T: Tally>(&self, search: &mut Search<Q, T>) -> bool {
        // A node leaves at most one other behind.
        fast_stack!(u32, (96, 192), self.statistics.depth, stack, {
            self.walk_with(&mut stack, search)
        })
    }

    fn walk_with<Q: Question, T: Tally>(
        &self,
        stack: &mut impl FastStack<u32>,
        search: &mut Search<Q, T>,
    ) -> bool {
        let boxes = Boxes::new(search.probe);
        let Some(root) = self.nodes.first() else {
            return false;
        };
        if root.is_leaf() {
            return search.test(items(root));
        }
        let mut next = root.first_index;
        loop {
            let Some([left, right]) = self.nodes.get(next as usize..next as usize + 2) else {
                return false;
            };
            search.tally.node();
            let mut near = (left, boxes.enter(left.aabb()));
            let mut other = (right, boxes.enter(right.aabb()));
            if other.1 < near.1 {
                std::mem::swap(&mut near, &mut other);
            }
            let mut onward = [None; 2];
            for (slot, (node, enter)) in [near, other].into_iter().enumerate() {
                // An equal distance is not pruned: of hits at the same `t` the lowest number wins.
                if enter <= search.best.t {
                    if !node.is_leaf() {
                        onward[slot] = Some(node.first_index);
                    } else if search.test(items(node)) {
                        return true;
                    }
                }
            }
            next = match onward {
                [Some(near), other] => {
                    if let Some(other) = other {
                        stack.push(other);
                    }
                    near
                }
                [None, Some(other)] => other,
                [None, None] => match stack.pop() {
                    Some(waiting) => waiting,
                    None => return false,
                },
            };
        }
    }
}

/// The items of a leaf.
fn items(leaf: &Bvh2Node) -> std::ops::Range<usize> {
    let first = leaf.first_index as usize;
    first..first + leaf.prim_count as usize
}
