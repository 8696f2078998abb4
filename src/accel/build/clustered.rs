//! A binary tree from the bottom up: near neighbours join (PLOC; Meister and Bittner 2018, "Parallel Locally-Ordered
//! Clustering for Bounding Volume Hierarchy Construction").
//!
//! obvhs 0.4 has it too, but there a fan of triangles, or equal boxes, makes a chain of neighbours of whom only one pair
//! wants each other, and the time grows with the square: 72 s for a fan of 100,000. Here such a chain is paired up.

use super::binary::Node;
use super::curve;
use rayon::prelude::*;

/// Where less than one in so many joins another in a round, they are paired up.
const STALLED: usize = 8;

/// A binary tree, and whether any round had to be helped.
pub(super) struct Clustered {
    /// The root first, siblings side by side.
    pub(super) nodes: Vec<Node>,
    pub(super) stalled: bool,
}

/// The tree over `leaves`. `reach` is how many neighbours on each side are
/// looked at, once the first few rounds have joined the nearest.
pub(super) fn joined(leaves: Vec<Node>, reach: usize, near_rounds: usize) -> Clustered {
    let mut current = curve::sorted(leaves);
    let Some(&first) = current.first() else {
        return Clustered {
            nodes: Vec::new(),
            stalled: false,
        };
    };
    let mut nodes = vec![first; 2 * current.len() - 1];
    let mut wanted: Vec<i8> = vec![0; current.len()];
    // The last free place: the tree fills from its leaves at the end to its root.
    let mut free = nodes.len();
    let mut round = 0;
    let mut stalled = false;
    while current.len() > 1 {
        let reach = if round < near_rounds { 1 } else { reach };
        wanted.truncate(current.len());
        wanted
            .par_iter_mut()
            .enumerate()
            .with_min_len(4096)
            .for_each(|(index, wanted)| *wanted = nearest(&current, index, reach));
        let partner = |wanted: &[i8], index: usize| index.wrapping_add_signed(wanted[index].into());
        let pairs = (0..current.len())
            .filter(|&i| partner(&wanted, partner(&wanted, i)) == i)
            .count();
        if pairs < current.len() / STALLED {
            pair_up(&mut wanted);
            stalled = true;
        }
        let mut kept = 0;
        for index in 0..current.len() {
            let other = partner(&wanted, index);
            let node = current[index];
            if other == index || partner(&wanted, other) != index {
                current[kept] = node;
            } else if index < other {
                free -= 2;
                nodes[free] = node;
                nodes[free + 1] = current[other];
                current[kept] = node.joined(&current[other], free as u32);
            } else {
                continue;
            }
            kept += 1;
        }
        current.truncate(kept);
        round += 1;
    }
    nodes[0] = current[0];
    Clustered { nodes, stalled }
}

/// How far away the neighbour is with which a node makes the smallest box.
fn nearest(nodes: &[Node], index: usize, reach: usize) -> i8 {
    let node = nodes[index];
    let (mut best, mut distance) = (f32::INFINITY, 0);
    let first = index.saturating_sub(reach);
    let end = (index + reach + 1).min(nodes.len());
    for other in (first..index).chain(index + 1..end) {
        let area = node.joint_area(&nodes[other]);
        // Of equal ones, pairs that start at an even place want each other.
        if area < best || (area == best && other == index ^ 1) {
            best = area;
            distance = (other as isize - index as isize) as i8;
        }
    }
    distance
}

/// Makes everyone want only who wants them: in order, each takes its wanted one if that is still free.
fn pair_up(wanted: &mut [i8]) {
    let mut taken = vec![false; wanted.len()];
    for index in 0..wanted.len() {
        let other = index.wrapping_add_signed(wanted[index].into());
        if taken[index] {
            continue;
        }
        if other != index && !taken[other] {
            taken[index] = true;
            taken[other] = true;
            wanted[other] = -wanted[index];
        } else {
            wanted[index] = 0;
        }
    }
}
