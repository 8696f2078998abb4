//! A binary tree of boxes, and the way of a ray through it.

use super::Statistics;
use super::primitive::Probe;
use crate::geometry::Bounds;

/// Boxes within boxes down to leaves of items. Empty by default.
#[derive(Clone, Debug)]
pub(super) struct Tree<Item> {
    nodes: Vec<Node>,
    /// In the order of the leaves.
    items: Vec<Item>,
    depth: usize,
}

/// A box and what is in it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Node {
    pub(super) bounds: Bounds,
    /// The first of both children (the second follows it), or of the leaf's items.
    pub(super) first: u32,
    /// The number of the leaf's items; 0 for what is no leaf.
    pub(super) count: u32,
}

/// Nodes still to be visited, with the distance at which the ray enters them. Grows as deep as the tree is, however deep.
pub(super) type Stack = Vec<(u32, f32)>;

impl<Item> Default for Tree<Item> {
    fn default() -> Tree<Item> {
        Tree {
            nodes: Vec::new(),
            items: Vec::new(),
            depth: 0,
        }
    }
}

impl<Item> Tree<Item> {
    /// A tree whose root is the first node, with `depth` nodes on its longest way down; children follow their parents.
    pub(super) fn new(nodes: Vec<Node>, items: Vec<Item>, depth: usize) -> Tree<Item> {
        Tree {
            nodes,
            items,
            depth,
        }
    }

    /// Whether nothing is in it.
    pub(super) fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// The greatest absolute coordinate of anything in it.
    pub(super) fn extent(&self) -> f32 {
        self.nodes.first().map_or(0.0, |root| root.bounds.extent())
    }

    /// Visits every item whose leaf the probe can still reach, nearer nodes first. `visit` shortens the probe.
    pub(super) fn nearest(
        &self,
        probe: &mut Probe,
        stack: &mut Stack,
        mut visit: impl FnMut(&Item, &mut Probe),
    ) {
        let Some(root) = self.nodes.first() else {
            return;
        };
        stack.clear();
        if let Some(near) = entered(root, probe) {
            stack.push((0, near));
        }
        while let Some((index, near)) = stack.pop() {
            // An equal distance is not pruned: of hits at the same `t` the lowest number wins, wherever it stands.
            if near > probe.ray.t_max {
                continue;
            }
            let mut node = &self.nodes[index as usize];
            while node.count == 0 {
                let (left, right) = (node.first, node.first + 1);
                let children = (
                    entered(&self.nodes[left as usize], probe),
                    entered(&self.nodes[right as usize], probe),
                );
                node = match children {
                    (Some(a), Some(b)) => {
                        let (near_child, far_child) = if a <= b {
                            (left, (right, b))
                        } else {
                            (right, (left, a))
                        };
                        stack.push(far_child);
                        &self.nodes[near_child as usize]
                    }
                    (Some(_), None) => &self.nodes[left as usize],
                    (None, Some(_)) => &self.nodes[right as usize],
                    (None, None) => break,
                };
            }
            for item in self.leaf(node) {
                visit(item, probe);
            }
        }
    }

    /// Whether `test` holds for any item whose leaf the probe reaches; stops at the first.
    pub(super) fn any(
        &self,
        probe: &Probe,
        stack: &mut Stack,
        mut test: impl FnMut(&Item, &Probe) -> bool,
    ) -> bool {
        let Some(root) = self.nodes.first() else {
            return false;
        };
        stack.clear();
        if entered(root, probe).is_some() {
            stack.push((0, 0.0));
        }
        while let Some((index, _)) = stack.pop() {
            let node = &self.nodes[index as usize];
            if node.count == 0 {
                let children = [node.first, node.first + 1];
                stack.extend(
                    children
                        .into_iter()
                        .filter_map(|c| Some((c, entered(&self.nodes[c as usize], probe)?))),
                );
            } else if self.leaf(node).iter().any(|item| test(item, probe)) {
                return true;
            }
        }
        false
    }

    /// The items of a leaf; none for a node that is not one.
    fn leaf(&self, node: &Node) -> &[Item] {
        let first = if node.count == 0 {
            0
        } else {
            node.first as usize
        };
        &self.items[first..first + node.count as usize]
    }

    /// Counts, bytes and cost; no time.
    pub(super) fn measure(&self) -> Statistics {
        let leaves = self.nodes.iter().filter(|node| node.count > 0).count();
        let root_area = self
            .nodes
            .first()
            .map_or(0.0, |root| half_area(&root.bounds));
        let weighted = self
            .nodes
            .iter()
            .map(|n| half_area(&n.bounds) * (1.0 + f64::from(n.count)));
        let cost = if root_area > 0.0 {
            weighted.sum::<f64>() / root_area
        } else {
            0.0
        };
        Statistics {
            nodes: self.nodes.len(),
            leaves,
            depth: self.depth,
            bytes: size_of_val(self.nodes.as_slice()) + size_of_val(self.items.as_slice()),
            sah_cost: cost as f32,
            build_time: std::time::Duration::ZERO,
        }
    }
}

/// Where the probe enters a node that it can still reach.
fn entered(node: &Node, probe: &Probe) -> Option<f32> {
    let (near, far) = probe.slab.interval(&node.bounds);
    let (near, far) = (near.max(probe.ray.t_min), far.min(probe.ray.t_max));
    (near <= far).then_some(near)
}

fn half_area(bounds: &Bounds) -> f64 {
    let d = bounds.max.as_dvec3() - bounds.min.as_dvec3();
    d.x * d.y + d.y * d.z + d.z * d.x
}
