//! The builder of the tree that rays walk: binary trees first, then the better of them with eight children a node.

mod binary;
mod collapse;
mod emit;
mod scaled;
#[cfg(test)]
mod tests;

use super::wide::{Kind, Topology};
use super::{Options, Preset};
use crate::geometry::Bounds;
use collapse::{Costs, Plan};

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
    let tree = binary::clustered(leaves, options.preset);
    let plan = Plan::new(&tree, &kind, &costs);
    emit::topology(&tree, &plan, bounds, &kind)
}
