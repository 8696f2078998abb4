//! The finished tree: what a plan says, with the exact boxes.

use super::binary;
use super::collapse::Plan;
use crate::accel::wide::{Kind, Leaf, Node, Reference, Topology};
use crate::geometry::Bounds;
use glam::Vec3;
use rayon::prelude::*;

/// Subtrees that threads may take at a time.
const TASKS: usize = 256;

/// A subtree to lay: its node in the binary tree, the depth above it, and where it hangs.
#[derive(Clone, Copy)]
struct Open {
    from: u32,
    depth: usize,
    parent: u32,
    slot: u8,
}

/// Everything the plan keeps of `tree`, a child soon after its parent.
pub(super) fn topology(
    tree: &[binary::Node],
    plan: &Plan,
    bounds: &[Bounds],
    kind: &(impl Fn(u32) -> Kind + Sync),
) -> Topology {
    let writer = Writer {
        tree,
        plan,
        bounds,
        kind,
    };
    let mut top = Topology::default();
    let mut open = std::collections::VecDeque::new();
    if plan.is_leaf(0) {
        top.nodes.push(Node::EMPTY);
        top.depth = 1;
        writer.lay_leaf(&mut top, 0, 0, 0);
    } else {
        open.push_back(Open {
            from: 0,
            depth: 0,
            parent: u32::MAX,
            slot: 0,
        });
    }
    while open.len() < TASKS
        && let Some(next) = open.pop_front()
    {
        open.extend(writer.lay_node(&mut top, next));
    }
    let open: Vec<Open> = open.into();
    let parts: Vec<Topology> = open.par_iter().map(|&root| writer.part(root)).collect();
    joined(top, &open, parts)
}

struct Writer<'a, F> {
    tree: &'a [binary::Node],
    plan: &'a Plan,
    bounds: &'a [Bounds],
    kind: &'a F,
}

impl<F: Fn(u32) -> Kind> Writer<'_, F> {
    /// A subtree by itself, its boxes all known.
    fn part(&self, root: Open) -> Topology {
        let mut part = Topology::default();
        let mut open = vec![Open {
            parent: u32::MAX,
            ..root
        }];
        while let Some(next) = open.pop() {
            let first = open.len();
            open.extend(self.lay_node(&mut part, next));
            open[first..].reverse();
        }
        let count = part.nodes.len();
        fit(&mut part.nodes, count);
        part
    }

    /// Adds a node and its leaves; returns its other children.
    fn lay_node(&self, part: &mut Topology, open: Open) -> impl Iterator<Item = Open> + use<'_, F> {
        let index = part.nodes.len() as u32;
        part.nodes.push(Node::EMPTY);
        part.depth = part.depth.max(open.depth + 1);
        if let Some(parent) = part.nodes.get_mut(open.parent as usize) {
            parent.children[open.slot as usize] = Reference::new(Kind::Node, index);
        }
        let (children, count) = self.plan.children(self.tree, open.from);
        for (slot, &child) in children[..count].iter().enumerate() {
            if self.plan.is_leaf(child) {
                self.lay_leaf(part, index, slot, child);
            }
        }
        (0..count)
            .map(move |slot| Open {
                from: children[slot],
                depth: open.depth + 1,
                parent: index,
                slot: slot as u8,
            })
            .filter(|child| !self.plan.is_leaf(child.from))
    }

    /// Adds a leaf of all items below `from`.
    fn lay_leaf(&self, part: &mut Topology, parent: u32, slot: usize, from: u32) {
        let first = part.order.len();
        let (mut open, mut around) = (vec![from], Bounds::EMPTY);
        while let Some(node) = open.pop() {
            if let Some(item) = self.tree[node as usize].item() {
                part.order.push(item);
                around = around.union(self.bounds[item as usize]);
            } else {
                let child = self.tree[node as usize].first_child();
                open.extend([child + 1, child]);
            }
        }
        let reference = Reference::new((self.kind)(part.order[first]), part.leaves.len() as u32);
        part.leaves.push(Leaf {
            first: first as u32,
            count: (part.order.len() - first) as u32,
        });
        part.nodes[parent as usize].set(slot, &around, reference);
    }
}

/// Gives every child of the first `count` nodes its box, if it is a node itself. Children follow their parents, so
/// backwards each is ready.
fn fit(nodes: &mut [Node], count: usize) {
    for index in (0..count).rev() {
        for slot in 0..8 {
            let child = nodes[index].children[slot];
            if child.kind() == Kind::Node && child != Reference::NONE {
                let around = around(&nodes[child.index()]);
                nodes[index].set(slot, &around, child);
            }
        }
    }
}

/// The box around all children.
fn around(node: &Node) -> Bounds {
    let least = |axis: usize| {
        node.corners[0][axis]
            .iter()
            .copied()
            .fold(f32::INFINITY, f32::min)
    };
    let most = |axis: usize| {
        node.corners[1][axis]
            .iter()
            .copied()
            .fold(f32::NEG_INFINITY, f32::max)
    };
    Bounds {
        min: Vec3::new(least(0), least(1), least(2)),
        max: Vec3::new(most(0), most(1), most(2)),
    }
}

/// The top of the tree and the parts below it, in one.
fn joined(mut whole: Topology, open: &[Open], parts: Vec<Topology>) -> Topology {
    let count = |of: fn(&Topology) -> usize| parts.iter().map(of).sum::<usize>();
    whole.nodes.reserve_exact(count(|part| part.nodes.len()));
    whole.leaves.reserve_exact(count(|part| part.leaves.len()));
    whole.order.reserve_exact(count(|part| part.order.len()));
    let top = whole.nodes.len();
    for (root, part) in open.iter().zip(parts) {
        let nodes = whole.nodes.len() as u32;
        let leaves = whole.leaves.len() as u32;
        let items = whole.order.len() as u32;
        whole.nodes[root.parent as usize].children[root.slot as usize] =
            Reference::new(Kind::Node, nodes);
        let moved = |child: Reference| match child.kind() {
            _ if child == Reference::NONE => child,
            Kind::Node => Reference::new(Kind::Node, child.index() as u32 + nodes),
            kind => Reference::new(kind, child.index() as u32 + leaves),
        };
        whole.nodes.extend(part.nodes.iter().map(|node| Node {
            children: node.children.map(moved),
            ..*node
        }));
        whole.leaves.extend(part.leaves.iter().map(|leaf| Leaf {
            first: leaf.first + items,
            ..*leaf
        }));
        whole.order.extend_from_slice(&part.order);
        whole.depth = whole.depth.max(part.depth);
    }
    fit(&mut whole.nodes, top);
    whole.sah_cost = sah_cost(&whole);
    whole
}

/// The surface-area cost, a node and a primitive costing 1 each.
fn sah_cost(whole: &Topology) -> f32 {
    let Some(root) = whole.nodes.first() else {
        return 0.0;
    };
    let half_area = |b: &Bounds| {
        let d = b.max.as_dvec3() - b.min.as_dvec3();
        d.x * d.y + d.y * d.z + d.z * d.x
    };
    let of_root = half_area(&around(root));
    let sum: f64 = whole
        .nodes
        .iter()
        .map(|node| {
            (0..8)
                .filter(|&slot| node.children[slot] != Reference::NONE)
                .map(|slot| {
                    let corner = |planes: &[[f32; 8]; 3]| {
                        Vec3::new(planes[0][slot], planes[1][slot], planes[2][slot])
                    };
                    let around = Bounds {
                        min: corner(&node.corners[0]),
                        max: corner(&node.corners[1]),
                    };
                    let child = node.children[slot];
                    let cost = match child.kind() {
                        Kind::Node => 1,
                        _ => whole.leaves[child.index()].count,
                    };
                    half_area(&around) * f64::from(cost)
                })
                .sum::<f64>()
        })
        .sum();
    if of_root > 0.0 {
        (1.0 + sum / of_root) as f32
    } else {
        0.0
    }
}
