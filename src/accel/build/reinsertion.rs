//! Subtrees put where they make the tree cheaper (Meister and Bittner 2017, "Parallel Reinsertion for Bounding Volume
//! Hierarchy Optimization").

use super::binary::{Node, half_area};
use rayon::prelude::*;

/// Places looked at for one subtree. Most find theirs long before; boxes that all overlap would look everywhere.
const MOST_PLACES: u32 = 500;

/// Improves a tree: `share` of its nodes, the greatest, are looked at in the first of `rounds`, then ever fewer.
pub(super) fn improve(nodes: &mut [Node], share: f32, rounds: usize) {
    let wanted = ((nodes.len() as f32 * share) as usize).min(nodes.len().saturating_sub(1));
    if wanted == 0 || nodes.len() < 7 {
        return;
    }
    let mut parents = vec![0u32; nodes.len()];
    for (index, node) in nodes.iter().enumerate() {
        if !node.is_leaf() {
            let child = node.first_child() as usize;
            parents[child] = index as u32;
            parents[child + 1] = index as u32;
        }
    }
    let candidates = greatest(nodes, wanted);
    let mut tree = Linked { nodes, parents };
    let mut touched = vec![false; tree.nodes.len()];
    for round in 0..rounds {
        let count = (candidates.len() / (2 * round + 1)).max(1);
        let mut moves: Vec<Move> = candidates[..count]
            .par_iter()
            .with_min_len(256)
            .map_init(Vec::new, |open, &node| tree.best_move(node, open))
            .flatten_iter()
            .collect();
        moves.par_sort_unstable_by(|a, b| b.gain.total_cmp(&a.gain).then(a.from.cmp(&b.from)));
        touched.fill(false);
        for next in moves {
            let near = [
                next.from,
                next.to,
                sibling(next.from),
                tree.parents[next.from as usize],
                tree.parents[next.to as usize],
            ];
            if near.iter().all(|&node| !touched[node as usize]) {
                near.iter().for_each(|&node| touched[node as usize] = true);
                tree.make(&next);
            }
        }
    }
}

/// Some nodes of the greatest area, the greatest first, never the root.
fn greatest(nodes: &[Node], wanted: usize) -> Vec<u32> {
    let mut by_area: Vec<(f32, u32)> = (0..)
        .zip(nodes)
        .skip(1)
        .map(|(index, node)| (node.half_area(), index))
        .collect();
    let order = |a: &(f32, u32), b: &(f32, u32)| b.0.total_cmp(&a.0).then(a.1.cmp(&b.1));
    if wanted < by_area.len() {
        by_area.select_nth_unstable_by(wanted, order);
        by_area.truncate(wanted);
    }
    by_area.par_sort_unstable_by(order);
    by_area.into_iter().map(|(_, index)| index).collect()
}

/// Siblings lie at 1 and 2, 3 and 4, and so on.
fn sibling(node: u32) -> u32 {
    if node % 2 == 1 { node + 1 } else { node - 1 }
}

/// A subtree and the node whose sibling it had better be.
struct Move {
    from: u32,
    to: u32,
    /// By how much the sum of all half areas falls.
    gain: f32,
}

struct Linked<'a> {
    nodes: &'a mut [Node],
    parents: Vec<u32>,
}

impl Linked<'_> {
    /// The best place for a subtree, if that is a better one. `open` is room for a stack.
    fn best_move(&self, from: u32, open: &mut Vec<(f32, u32)>) -> Option<Move> {
        let node = self.nodes[from as usize];
        let node_area = node.half_area();
        let parent = self.parents[from as usize];
        // What is gained by taking the subtree away, above the pivot.
        let mut gained = self.nodes[parent as usize].half_area();
        let mut beside = sibling(from);
        let mut pivot = parent;
        let rest = self.nodes[beside as usize];
        let (mut rest_min, mut rest_max) = (rest.min(), rest.max());
        let mut best = Move {
            from,
            to: 0,
            gain: 0.0,
        };
        let mut places = 0;
        loop {
            open.clear();
            open.push((gained, beside));
            while let Some((gain, place)) = open.pop() {
                if gain - node_area <= best.gain {
                    continue;
                }
                places += 1;
                let at = &self.nodes[place as usize];
                let gain_here = gain - at.joint_area(&node);
                if gain_here > best.gain {
                    best.to = place;
                    best.gain = gain_here;
                }
                if !at.is_leaf() {
                    let gain = gain_here + at.half_area();
                    let child = at.first_child();
                    open.extend([(gain, child), (gain, child + 1)]);
                }
                if places > MOST_PLACES {
                    break;
                }
            }
            if pivot != parent {
                let beside = &self.nodes[beside as usize];
                rest_min = rest_min.min(beside.min());
                rest_max = rest_max.max(beside.max());
                gained += self.nodes[pivot as usize].half_area() - half_area(rest_min, rest_max);
            }
            if pivot == 0 || places > MOST_PLACES {
                break;
            }
            beside = sibling(pivot);
            pivot = self.parents[pivot as usize];
        }
        let stays = best.to == 0 || best.to == sibling(from) || best.to == parent;
        (!stays).then_some(best)
    }

    /// Takes the subtree out, its sibling in its parent's place, and puts it beside its new sibling.
    fn make(&mut self, next: &Move) {
        let (from, to) = (next.from, next.to);
        let beside = sibling(from);
        let parent = self.parents[from as usize];
        let staying = self.nodes[beside as usize];
        let joined = self.nodes[to as usize];
        self.nodes[to as usize] = joined.joined(&self.nodes[from as usize], from.min(beside));
        self.nodes[beside as usize] = joined;
        self.nodes[parent as usize] = staying;
        self.adopt(beside);
        self.adopt(parent);
        self.parents[beside as usize] = to;
        self.parents[from as usize] = to;
        self.fit_above(to);
        self.fit_above(parent);
    }

    /// Tells the children of a moved node where it is.
    fn adopt(&mut self, index: u32) {
        let node = self.nodes[index as usize];
        if !node.is_leaf() {
            let child = node.first_child() as usize;
            self.parents[child] = index;
            self.parents[child + 1] = index;
        }
    }

    /// Gives all above a node the boxes of their children.
    fn fit_above(&mut self, mut index: u32) {
        while index != 0 {
            index = self.parents[index as usize];
            let node = self.nodes[index as usize];
            let child = node.first_child() as usize;
            let fitted = self.nodes[child].joined(&self.nodes[child + 1], child as u32);
            if fitted.min() == node.min() && fitted.max() == node.max() {
                // Above, nothing changes either.
                break;
            }
            self.nodes[index as usize] = fitted;
        }
    }
}
