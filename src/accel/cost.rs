//! What a ray costs: the nodes and primitives that it is tested against.
//!
//! Counted for one ray on its own way, whatever else is in its batch. Packets share such tests, so that what is counted
//! depends on no batch, instruction set or tile, and is not what a batch took.

use super::kernel::{Any, Best, Closest};
use super::tree::Number;
use super::{Accel, SCRATCH, kernel};
use crate::geometry::Hit;
use crate::ray::Ray;

/// What one ray was tested against, at both levels where there are instances.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tests {
    /// Nodes whose children's boxes were tested.
    pub nodes: u32,
    /// Triangles and spheres of the leaves that were tested. Planes are not counted, since they stand beside the tree.
    pub primitives: u32,
}

/// What a search tells of its tests.
pub(super) trait Tally {
    /// The boxes of a node's children were tested.
    fn node(&mut self);
    /// A block was tested, in which primitives have these numbers.
    fn block(&mut self, numbers: &[Number]);
    /// One primitive was tested.
    fn primitive(&mut self);
}

/// Counts nothing and takes no time.
pub(super) struct Uncounted;

impl Tally for Uncounted {
    #[inline(always)]
    fn node(&mut self) {}

    #[inline(always)]
    fn block(&mut self, _: &[Number]) {}

    #[inline(always)]
    fn primitive(&mut self) {}
}

impl Tally for Tests {
    fn node(&mut self) {
        self.nodes = self.nodes.saturating_add(1);
    }

    fn block(&mut self, numbers: &[Number]) {
        self.primitives = self.primitives.saturating_add(Number::count(numbers));
    }

    fn primitive(&mut self) {
        self.primitives = self.primitives.saturating_add(1);
    }
}

impl Accel {
    /// [`Accel::intersect`], and what the ray was tested against.
    pub fn intersect_counted(&self, ray: &Ray) -> (Option<Hit>, Tests) {
        let (mut best, mut tests) = (Best::nothing(ray), Tests::default());
        self.offer_planes(ray, &mut best);
        match &self.others {
            Some(others) => others.follow::<Closest, _>(ray, &mut best, &mut tests),
            None => SCRATCH.with_borrow_mut(|scratch| {
                kernel::counted::<Closest>(self, ray, scratch, &mut best, &mut tests)
            }),
        };
        (best.hit(), tests)
    }

    /// [`Accel::occluded`], and what the ray was tested against until the answer was known.
    pub fn occluded_counted(&self, ray: &Ray) -> (bool, Tests) {
        let (mut best, mut tests) = (Best::nothing(ray), Tests::default());
        let occluded = self.meets_opaque_plane(ray)
            || match &self.others {
                Some(others) => others.follow::<Any, _>(ray, &mut best, &mut tests),
                None => SCRATCH.with_borrow_mut(|scratch| {
                    kernel::counted::<Any>(self, ray, scratch, &mut best, &mut tests)
                }),
            };
        (occluded, tests)
    }
}
