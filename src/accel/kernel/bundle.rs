//! Which rays go together.

use super::float::Machine;
use super::rays::Rays;

/// The greatest sum of the ranges of both slopes with which rays are tested against boxes as one.
const WIDEST: f32 = 0.6;

/// A direction's signs: which corner of a box is near, and which far, per axis. 0 is the least.
#[derive(Clone, Copy, Debug)]
pub(super) struct Octant {
    pub(super) near: [usize; 3],
    pub(super) far: [usize; 3],
}

/// Rays that go into one octant.
#[derive(Clone, Copy, Debug)]
pub(super) struct Bundle {
    pub(super) members: u64,
    pub(super) octant: Octant,
}

impl Octant {
    #[inline(always)]
    pub(super) fn new(near: [usize; 3]) -> Octant {
        Octant {
            near,
            far: [near[0] ^ 1, near[1] ^ 1, near[2] ^ 1],
        }
    }
}

impl Bundle {
    /// The lane of its first ray.
    #[inline(always)]
    pub(super) fn first(&self) -> usize {
        self.members.trailing_zeros() as usize
    }
}

impl Rays {
    /// Of `left`, above zero, those that go into the octant of the first of them. What goes on after a surface has a rule
    /// of its own for equal distances, and is by itself.
    #[inline(always)]
    pub(super) fn of_one_octant(&self, left: u64) -> Bundle {
        let first = left & left.wrapping_neg();
        let mut members = if self.alone & first != 0 {
            first
        } else {
            left & !self.alone
        };
        let mut near = [0; 3];
        for (near, &backward) in near.iter_mut().zip(&self.backward) {
            *near = usize::from(backward & first != 0);
            members &= if *near == 1 { backward } else { !backward };
        }
        Bundle {
            members,
            octant: Octant::new(near),
        }
    }

    /// Of `rest`, above zero, those whose direction is longest along the same axis as that of the first of them.
    #[inline(always)]
    pub(super) fn of_one_axis(&self, rest: u64) -> u64 {
        let [_, _, longest] = self.axes(rest.trailing_zeros() as usize);
        rest & self.longest[longest]
    }

    /// Whether rays that have a longest axis in common differ so little in direction that they meet much the same boxes.
    #[inline(always)]
    pub(super) fn are_narrow<M: Machine>(&self, members: u64) -> bool {
        let mut spread = 0.0;
        for slope in &self.slope {
            spread += slope.greatest::<M::F16>(members) - slope.least::<M::F16>(members);
        }
        spread < WIDEST
    }
}
