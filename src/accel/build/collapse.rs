//! Which nodes of a binary tree become nodes of eight children, which leaves, and which vanish: the cheapest choice.
//!
//! Dynamic programming after Ylitie, Karras and Laine 2017, "Efficient Incoherent Ray Traversal on GPUs Through Compressed
//! Wide BVHs", section 3.1: the cost `C(n, i)` of a subtree `n` as a forest of at most `i` trees, found from the leaves up.

use super::binary::Node;
use super::emit::Shape;
use crate::accel::wide::Kind;
use crate::accel::{Layout, Options};
use rayon::prelude::*;
use std::sync::atomic::{AtomicU32, Ordering::Relaxed};

/// What it costs to visit a node.
const NODE: f32 = 1.0;
/// What it costs to test a block of primitives.
const BLOCK: f32 = 1.0;
/// What each primitive in a block adds, for the memory it takes.
const PRIMITIVE: f32 = 0.03;
/// What it costs to follow an instance into its own tree.
const INSTANCE: f32 = 16.0;

/// The price of nodes and leaves: half area times cost.
pub(super) struct Costs {
    /// The most items a leaf may have.
    pub(super) leaf_size: u32,
    /// Primitives in a block.
    block: u32,
    /// An area added to each, so that memory has a price too.
    margin: f32,
}

impl Costs {
    pub(super) fn new(leaves: &[Node], options: &Options) -> Costs {
        // The weights make 72 to 85 bytes a triangle of terrain, a room and hair; in small blocks at most 75.
        let (block, weight) = match options.layout {
            Layout::Wide => (8, 0.2),
            Layout::Small => (4, 0.3),
            // One at a time.
            Layout::Bvh2 | Layout::CwBvh | Layout::List => (1, 0.0),
        };
        Costs {
            leaf_size: options.leaf_size.map_or(8, |n| u32::from(n.get())).min(16),
            block,
            margin: typical_area(leaves) * weight,
        }
    }

    fn node(&self, half_area: f32) -> f32 {
        (half_area + self.margin) * NODE
    }

    /// Infinite where there may be no such leaf.
    fn leaf(&self, half_area: f32, items: u32, kind: Option<Kind>) -> f32 {
        let cost = match kind {
            Some(Kind::Instances) if items == 1 => INSTANCE,
            Some(Kind::Triangles | Kind::Spheres) if items <= self.leaf_size => {
                items.div_ceil(self.block) as f32 * BLOCK + items as f32 * PRIMITIVE
            }
            _ => f32::INFINITY,
        };
        (half_area + self.margin) * cost
    }
}

/// The median half area of some of the boxes, positive.
fn typical_area(leaves: &[Node]) -> f32 {
    let step = (leaves.len() / 1024).max(1);
    let mut areas: Vec<f32> = leaves.iter().step_by(step).map(Node::half_area).collect();
    let middle = areas.len() / 2;
    let (_, median, _) = areas.select_nth_unstable_by(middle, f32::total_cmp);
    median.max(1e-20)
}

/// What becomes of every node of a binary tree.
pub(super) struct Plan {
    choices: Vec<AtomicU32>,
    /// The cost of the whole.
    pub(super) cost: f32,
}

/// A subtree's costs.
#[derive(Clone, Copy)]
struct Subtree {
    /// As at most one tree, two, and so on to seven.
    forest: [f32; 7],
    items: u32,
    /// What its items are, if all are the same.
    kind: Option<Kind>,
}

/// The bit of [`Plan::choices`] that says leaf; below it lie three bits for each number of trees from two to eight: how
/// many the left child gets, 0 where fewer trees are as cheap.
const LEAF: u32 = 1 << 31;

/// Subtrees that threads may take at a time. Any number gives the same plan.
const TASKS: usize = 512;

impl Plan {
    pub(super) fn new(tree: &[Node], kind: &(impl Fn(u32) -> Kind + Sync), costs: &Costs) -> Plan {
        let mut plan = Plan {
            choices: (0..tree.len()).map(|_| AtomicU32::new(0)).collect(),
            cost: 0.0,
        };
        // The top of the tree, parents first, and below it what threads take.
        let (mut top, mut open) = (Vec::new(), std::collections::VecDeque::from([0]));
        let mut bottom = Vec::new();
        while let Some(node) = open.pop_front() {
            if tree[node as usize].item().is_some() || open.len() + bottom.len() >= TASKS {
                bottom.push(node);
            } else {
                top.push(node);
                let child = tree[node as usize].first_child();
                open.extend([child, child + 1]);
            }
        }
        let done: Vec<Subtree> = bottom
            .par_iter()
            .map(|&node| plan.subtree(tree, node, kind, costs))
            .collect();
        let mut done: std::collections::HashMap<u32, Subtree> =
            bottom.into_iter().zip(done).collect();
        for &node in top.iter().rev() {
            let child = tree[node as usize].first_child();
            if let (Some(left), Some(right)) = (done.remove(&child), done.remove(&(child + 1))) {
                done.insert(node, plan.joined(tree, node, &left, &right, costs));
            }
        }
        plan.cost = done.get(&0).map_or(0.0, |root| root.forest[0]);
        plan
    }

    /// The subtree below `root`, children before their parents.
    fn subtree(
        &self,
        tree: &[Node],
        root: u32,
        kind: &impl Fn(u32) -> Kind,
        costs: &Costs,
    ) -> Subtree {
        let mut open = vec![(root, false)];
        let mut done: Vec<Subtree> = Vec::new();
        while let Some((node, children_done)) = open.pop() {
            if let Some(item) = tree[node as usize].item() {
                let kind = Some(kind(item));
                let cost = costs.leaf(tree[node as usize].half_area(), 1, kind);
                self.choices[node as usize].store(LEAF, Relaxed);
                done.push(Subtree {
                    forest: [cost; 7],
                    items: 1,
                    kind,
                });
            } else if !children_done {
                let child = tree[node as usize].first_child();
                open.extend([(node, true), (child + 1, false), (child, false)]);
            } else if let (Some(right), Some(left)) = (done.pop(), done.pop()) {
                done.push(self.joined(tree, node, &left, &right, costs));
            }
        }
        done[0]
    }

    /// The costs of a node from those of its children.
    fn joined(
        &self,
        tree: &[Node],
        node: u32,
        left: &Subtree,
        right: &Subtree,
        costs: &Costs,
    ) -> Subtree {
        let half_area = tree[node as usize].half_area();
        let items = left.items + right.items;
        let kind = left.kind.filter(|_| left.kind == right.kind);
        // At [i], `i + 1` trees: the least cost and how many of them the left child gets.
        let mut shared = [(f32::INFINITY, 1u32); 8];
        for (i, best) in shared.iter_mut().enumerate().skip(1) {
            for k in 0..i {
                let cost = left.forest[k] + right.forest[i - 1 - k];
                if cost < best.0 {
                    *best = (cost, k as u32 + 1);
                }
            }
        }
        let leaf = costs.leaf(half_area, items, kind);
        let inner = shared[7].0 + costs.node(half_area);
        let mut choice = shared[7].1 << choice_shift(8);
        let mut forest = [leaf.min(inner); 7];
        if leaf <= inner {
            choice |= LEAF;
        }
        for i in 1..7 {
            forest[i] = forest[i - 1];
            if shared[i].0 < forest[i] {
                forest[i] = shared[i].0;
                choice |= shared[i].1 << choice_shift(i as u32 + 1);
            }
        }
        self.choices[node as usize].store(choice, Relaxed);
        Subtree {
            forest,
            items,
            kind,
        }
    }

    fn share_of_left(&self, node: u32, trees: u32) -> u32 {
        self.choices[node as usize].load(Relaxed) >> choice_shift(trees) & 7
    }
}

fn choice_shift(trees: u32) -> u32 {
    3 * (trees - 2)
}

/// A binary tree and what becomes of it.
pub(super) struct Planned {
    pub(super) tree: Vec<Node>,
    pub(super) plan: Plan,
}

impl Shape for Planned {
    type Part = u32;

    fn whole(&self) -> u32 {
        0
    }

    fn is_leaf(&self, node: u32) -> bool {
        self.plan.choices[node as usize].load(Relaxed) & LEAF != 0
    }

    fn children(&self, node: u32) -> ([u32; 8], usize) {
        let (mut children, mut count) = ([0; 8], 0);
        // A subtree and how many trees it may be; no more than eight are open, as each takes one of eight.
        let (mut open, mut opened) = ([(0, 0); 8], 0);
        let split = |open: &mut [(u32, u32); 8], opened: &mut usize, node, left, trees| {
            let child = self.tree[node as usize].first_child();
            open[*opened] = (child + 1, trees - left);
            open[*opened + 1] = (child, left);
            *opened += 2;
        };
        split(
            &mut open,
            &mut opened,
            node,
            self.plan.share_of_left(node, 8),
            8,
        );
        while opened > 0 {
            opened -= 1;
            let (node, mut trees) = open[opened];
            while trees > 1 && self.plan.share_of_left(node, trees) == 0 {
                trees -= 1;
            }
            if trees == 1 {
                children[count] = node;
                count += 1;
            } else {
                let left = self.plan.share_of_left(node, trees);
                split(&mut open, &mut opened, node, left, trees);
            }
        }
        (children, count)
    }

    fn add_items(&self, node: u32, order: &mut Vec<u32>) {
        let mut open = vec![node];
        while let Some(node) = open.pop() {
            if let Some(item) = self.tree[node as usize].item() {
                order.push(item);
            } else {
                let child = self.tree[node as usize].first_child();
                open.extend([child + 1, child]);
            }
        }
    }
}
