//! The builder of the tree that rays walk: binary trees first, then the better of them with eight children a node; or, in a
//! hurry, eight children a node at once.

mod binary;
mod binned;
mod clustered;
mod collapse;
mod curve;
mod emit;
mod obvhs;
mod reinsertion;
mod scaled;
#[cfg(test)]
mod tests;

use super::wide::{Kind, Topology};
use super::{Builder, Options, Preset};
use crate::geometry::Bounds;
pub(super) use binary::Node;
use collapse::{Costs, Plan, Planned};
use curve::Curve;

/// The tree over `bounds`, whose items are of some kind each; empty where there are none.
///
/// The same for any number of threads.
pub(super) fn build(
    bounds: &[Bounds],
    kind: impl Fn(u32) -> Kind + Sync,
    options: &Options,
) -> Topology {
    if bounds.is_empty() {
        return Topology::default();
    }
    let leaves = scaled::leaves(bounds);
    let costs = Costs::new(&leaves, options);
    let effort = Effort::of(options.preset);
    if matches!(effort.trees, Trees::Curve) && options.builder == Builder::Own {
        let curve = Curve {
            places: curve::order(&leaves),
            leaf_size: costs.leaf_size,
            kind: &kind,
        };
        drop(leaves);
        return emit::topology(&curve, bounds, &kind);
    }
    let shape = planned(leaves, &kind, &costs, &effort, options);
    emit::topology(&shape, bounds, &kind)
}

/// The binary tree over `bounds` alone, for layouts that are not ours: one item a leaf, the root first, its boxes in a
/// space of their own. Where [`build`] would make no binary tree, that of the next preset.
pub(super) fn binary(
    bounds: &[Bounds],
    kind: impl Fn(u32) -> Kind + Sync,
    options: &Options,
) -> Vec<Node> {
    if bounds.is_empty() {
        return Vec::new();
    }
    let leaves = scaled::leaves(bounds);
    let costs = Costs::new(&leaves, options);
    let effort = match Effort::of(options.preset) {
        Effort {
            trees: Trees::Curve,
            ..
        } => Effort::of(Preset::VeryFast),
        effort => effort,
    };
    planned(leaves, &kind, &costs, &effort, options).tree
}

/// The binary tree that the options ask for, and what becomes of its nodes.
fn planned(
    leaves: Vec<Node>,
    kind: &(impl Fn(u32) -> Kind + Sync),
    costs: &Costs,
    effort: &Effort,
    options: &Options,
) -> Planned {
    let planned = |mut tree: Vec<Node>| {
        reinsertion::improve(&mut tree, effort.reinserted, effort.rounds);
        let plan = Plan::new(&tree, kind, costs);
        Planned { tree, plan }
    };
    // Neither tree is the better for all scenes: the first is for rooms full of things, the second for landscapes and hair.
    let clustered =
        |leaves| planned(clustered::joined(leaves, effort.reach, effort.near_rounds).nodes);
    let binned = |mut leaves: Vec<Node>| {
        let nodes = binned::split(&mut leaves);
        drop(leaves);
        planned(nodes)
    };
    match effort.trees {
        _ if options.builder == Builder::Obvhs => planned(obvhs::joined(leaves, options.preset)),
        Trees::Curve | Trees::Clustered => clustered(leaves),
        Trees::Binned => binned(leaves),
        Trees::Both => {
            let copy = leaves.clone();
            let (a, b) = rayon::join(|| clustered(leaves), || binned(copy));
            if a.plan.cost < b.plan.cost { a } else { b }
        }
    }
}

/// Which trees are built.
enum Trees {
    /// Stretches of a curve, at once with eight children a node.
    Curve,
    /// A binary tree from the bottom up.
    Clustered,
    /// A binary tree from the top down.
    Binned,
    /// Both, of which the better is kept.
    Both,
}

/// What a preset does.
struct Effort {
    trees: Trees,
    /// Neighbours looked at on each side, after some rounds that look only at the nearest.
    reach: usize,
    near_rounds: usize,
    /// The share of all nodes for which reinsertion looks for a better place at first, and its rounds.
    reinserted: f32,
    rounds: usize,
}

impl Effort {
    fn of(preset: Preset) -> Effort {
        let (trees, reach, near_rounds, reinserted, rounds) = match preset {
            Preset::Fastest => (Trees::Curve, 0, 0, 0.0, 0),
            Preset::VeryFast => (Trees::Clustered, 2, 2, 0.01, 4),
            Preset::Fast => (Trees::Binned, 0, 0, 0.01, 4),
            Preset::Medium => (Trees::Both, 14, 3, 0.03, 8),
            Preset::Slow => (Trees::Both, 24, 2, 0.2, 16),
            Preset::VerySlow => (Trees::Both, 32, 1, 1.0, 16),
        };
        Effort {
            trees,
            reach,
            near_rounds,
            reinserted,
            rounds,
        }
    }
}
