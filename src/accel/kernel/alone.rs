//! Rays of a batch that go on alone.

use super::answer::Question;
use super::bundle::Octant;
use super::float::{Machine, Task};
use super::rays::Rays;
use super::single::{self, Level, Waiting};
use super::spread::Spread;
use crate::accel::Accel;
use crate::accel::cost::Uncounted;
use crate::accel::wide::Reference;
use crate::ray::Ray;
use std::marker::PhantomData;

/// A batch under way.
pub(super) struct Search<'a> {
    pub(super) accel: &'a Accel,
    /// As they came.
    pub(super) chunk: &'a [Ray],
    /// The same side by side.
    pub(super) rays: &'a mut Rays,
    /// Room for the whole way of one ray.
    pub(super) stack: &'a mut [Waiting],
}

/// Some rays, each followed from `start` down.
struct Alone<'a, 'b, Q> {
    search: &'a mut Search<'b>,
    octant: Octant,
    start: Reference,
    live: u64,
    question: PhantomData<Q>,
}

impl Search<'_> {
    /// Sends each ray of `live` on alone, from `start` down.
    #[inline(always)]
    pub(super) fn alone<M: Machine, Q: Question>(
        &mut self,
        octant: Octant,
        start: Reference,
        live: u64,
    ) {
        M::run(Alone::<Q> {
            search: self,
            octant,
            start,
            live,
            question: PhantomData,
        });
    }
}

impl<Q: Question> Task for Alone<'_, '_, Q> {
    type Output = ();

    #[inline(always)]
    fn run<M: Machine>(self) {
        let Search {
            accel,
            chunk,
            rays,
            stack,
        } = self.search;
        let level = Level {
            tree: &accel.world,
            meshes: &accel.meshes,
            first_number: 0,
        };
        let mut left = self.live;
        while left != 0 {
            let lane = left.trailing_zeros() as usize;
            left &= left - 1;
            let Some(ray) = chunk.get(lane) else { return };
            let wide = Spread::of(rays, self.octant, lane);
            let mut best = rays.best(lane);
            let found = single::walk::<M, Q, Uncounted, true>(
                &level,
                self.start,
                ray,
                &wide,
                &mut best,
                stack,
                &mut Uncounted,
            );
            if found {
                rays.live &= !(1 << lane);
            } else if !Q::ANY {
                rays.set_best(lane, &best);
            }
        }
    }
}
