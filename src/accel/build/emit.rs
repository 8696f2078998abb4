//! The finished tree: what a shape says, with the exact boxes.

use crate::accel::wide::{Kind, Leaf, Node, Reference, Topology};
use crate::geometry::Bounds;
use glam::Vec3;
use rayon::prelude::*;

/// Subtrees that threads may take at a time.
const TASKS: usize = 256;

/// What becomes a tree: parts that are leaves, or have parts of their own.
pub(super) trait Shape: Sync {
    /// A subtree.
    type Part: Copy + Send + Sync;
    fn whole(&self) -> Self::Part;
    fn is_leaf(&self, part: Self::Part) -> bool;
    /// The parts of one that is no leaf, and how many.
    fn children(&self, part: Self::Part) -> ([Self::Part; 8], usize);
    /// Adds all that is in a leaf, of one kind.
    fn add_items(&self, part: Self::Part, order: &mut Vec<u32>);
}

/// A subtree to lay: the depth above it, and where it hangs.
#[derive(Clone, Copy)]
struct Open<P> {
    from: P,
    depth: usize,
    parent: u32,
    slot: u8,
}

/// The tree of this shape, a child soon after its parent.
pub(super) fn topology<S: Shape>(
    shape: &S,
    bounds: &[Bounds],
    kind: &(impl Fn(u32) -> Kind + Sync),
) -> Topology {
    let writer = Writer {
        shape,
        bounds,
        kind,
    };
    let mut top = Topology::default();
    let mut open = std::collections::VecDeque::new();
    let whole = shape.whole();
    if shape.is_leaf(whole) {
        top.nodes.push(Node::EMPTY);
        top.depth = 1;
        writer.lay_leaf(&mut top, 0, 0, whole);
    } else {
        open.push_back(Open {
            from: whole,
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
    let open: Vec<Open<S::Part>> = open.into();
    let parts: Vec<Topology> = open.par_iter().map(|&root| writer.part(root)).collect();
    joined(top, &open, parts)
}

struct Writer<'a, S, K> {
    shape: &'a S,
    bounds: &'a [Bounds],
    kind: &'a K,
}

impl<S: Shape, K: Fn(u32) -> Kind> Writer<'_, S, K> {
    /// A subtree by itself, its boxes all known.
    fn part(&self, root: Open<S::Part>) -> Topology {
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
    fn lay_node(
        &self,
        part: &mut Topology,
        open: Open<S::Part>,
    ) -> impl Iterator<Item = Open<S::Part>> + use<'_, S, K> {
        let index = part.nodes.len() as u32;
        part.nodes.push(Node::EMPTY);
        part.depth = part.depth.max(open.depth + 1);
        if let Some(parent) = part.nodes.get_mut(open.parent as usize) {
            parent.children[open.slot as usize] = Reference::new(Kind::Node, index);
        }
        let (children, count) = self.shape.children(open.from);
        for (slot, &child) in children[..count].iter().enumerate() {
            if self.shape.is_leaf(child) {
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
            .filter(|child| !self.shape.is_leaf(child.from))
    }

    /// Adds a leaf of all items of `from`.
    fn lay_leaf(&self, part: &mut Topology, parent: u32, slot: usize, from: S::Part) {
        let first = part.order.len();
        self.shape.add_items(from, &mut part.order);
        let items = part.order[first..].iter();
        let around = items
            .map(|&item| self.bounds[item as usize])
            .fold(Bounds::EMPTY, Bounds::union);
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
fn joined<P>(mut whole: Topology, open: &[Open<P>], parts: Vec<Topology>) -> Topology {
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
