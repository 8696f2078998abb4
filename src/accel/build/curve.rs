//! Items along a Z curve (Morton 1966), whose stretches are subtrees (Lauterbach et al. 2009, "Fast BVH Construction on
//! GPUs"): the tree that is there soonest.

use super::binary::Node;
use super::emit::Shape;
use crate::accel::wide::Kind;
use rayon::prelude::*;

/// Where an item's center lies along the curve.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) struct Place {
    code: u64,
    pub(super) item: u32,
}

/// The items of `leaves`, numbered from 0, in the order of the curve.
pub(super) fn order(leaves: &[Node]) -> Vec<Place> {
    let mut places: Vec<Place> = leaves
        .par_iter()
        .enumerate()
        .map(|(index, leaf)| Place {
            code: code(leaf),
            item: index as u32,
        })
        .collect();
    places.par_sort_unstable();
    places
}

/// `leaves` in the order of the curve.
pub(super) fn sorted(leaves: Vec<Node>) -> Vec<Node> {
    order(&leaves)
        .par_iter()
        .map(|place| leaves[place.item as usize])
        .collect()
}

/// The bits of a center's coordinates, 20 each, in turn.
fn code(leaf: &Node) -> u64 {
    // The boxes lie in -1..1, so the sums in -2..2.
    let center = (leaf.min() + leaf.max() + 2.0) * ((1 << 18) as f32);
    let spread = |coordinate: f32| {
        let mut bits = (coordinate as u64).min((1 << 20) - 1);
        bits = (bits | bits << 32) & 0x001f_0000_0000_ffff;
        bits = (bits | bits << 16) & 0x001f_0000_ff00_00ff;
        bits = (bits | bits << 8) & 0x100f_00f0_0f00_f00f;
        bits = (bits | bits << 4) & 0x10c3_0c30_c30c_30c3;
        (bits | bits << 2) & 0x1249_2492_4924_9249
    };
    spread(center.x) << 2 | spread(center.y) << 1 | spread(center.z)
}

/// The tree whose subtrees are stretches of the curve.
pub(super) struct Curve<'a, K> {
    pub(super) places: Vec<Place>,
    /// The most items a leaf may have.
    pub(super) leaf_size: u32,
    pub(super) kind: &'a K,
}

/// A stretch: its first place, and the first after it.
#[derive(Clone, Copy)]
pub(super) struct Stretch {
    first: u32,
    end: u32,
}

impl<K: Fn(u32) -> Kind> Curve<'_, K> {
    fn of(&self, part: Stretch) -> &[Place] {
        &self.places[part.first as usize..part.end as usize]
    }

    /// Where the codes of a stretch begin to differ in their highest bit that does; its middle where all are equal.
    fn split(&self, part: Stretch) -> u32 {
        let places = self.of(part);
        let highest = match places {
            [first, .., last] => (first.code ^ last.code).checked_ilog2(),
            _ => None,
        };
        let left = highest.map_or(places.len() / 2, |bit| {
            places.partition_point(|place| place.code >> bit & 1 == 0)
        });
        part.first + left as u32
    }
}

impl<K: Fn(u32) -> Kind + Sync> Shape for Curve<'_, K> {
    type Part = Stretch;

    fn whole(&self) -> Stretch {
        Stretch {
            first: 0,
            end: self.places.len() as u32,
        }
    }

    fn is_leaf(&self, part: Stretch) -> bool {
        let count = part.end - part.first;
        if count > self.leaf_size.max(1) {
            return false;
        }
        let mut kinds = self.of(part).iter().map(|place| (self.kind)(place.item));
        let first = kinds.next();
        count <= 1 || first != Some(Kind::Instances) && kinds.all(|kind| Some(kind) == first)
    }

    /// The longest stretch is split until there are eight, or only leaves.
    fn children(&self, part: Stretch) -> ([Stretch; 8], usize) {
        let (mut children, mut count) = ([part; 8], 1);
        while count < 8 {
            let longest = (0..count)
                .filter(|&slot| !self.is_leaf(children[slot]))
                .max_by_key(|&slot| children[slot].end - children[slot].first);
            let Some(slot) = longest else { break };
            let middle = self.split(children[slot]);
            children[count] = Stretch {
                first: middle,
                ..children[slot]
            };
            children[slot].end = middle;
            count += 1;
        }
        (children, count)
    }

    fn add_items(&self, part: Stretch, order: &mut Vec<u32>) {
        order.extend(self.of(part).iter().map(|place| place.item));
    }
}
