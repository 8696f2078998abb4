//! All rays of a bundle against eight boxes at once.

use super::bundle::Bundle;
use super::float::Float;
use super::rays::Rays;

/// The interval of all rays of a bundle, spread over eight lanes.
pub(super) struct Interval<F> {
    pub(super) to_near: [F; 3],
    pub(super) to_far: [F; 3],
    least_inverse: [F; 3],
    greatest_inverse: [F; 3],
    t_min: F,
}

impl<F: Float<8>> Interval<F> {
    #[inline(always)]
    pub(super) fn new<F16: Float<16>>(rays: &Rays, bundle: &Bundle) -> Interval<F> {
        let zero = F::splat(0.0);
        let members = bundle.members;
        let mut all = Interval {
            to_near: [zero; 3],
            to_far: [zero; 3],
            least_inverse: [zero; 3],
            greatest_inverse: [zero; 3],
            t_min: F::splat(rays.t_min.least::<F16>(members)),
        };
        for axis in 0..3 {
            // The origin that makes the interval begin earliest and end last.
            let (near, far) = (&rays.to_near[axis], &rays.to_far[axis]);
            let (to_near, to_far) = if rays.common_origin {
                (near.get(bundle.first()), far.get(bundle.first()))
            } else if bundle.octant.near[axis] == 0 {
                (near.greatest::<F16>(members), far.least::<F16>(members))
            } else {
                (near.least::<F16>(members), far.greatest::<F16>(members))
            };
            all.to_near[axis] = F::splat(to_near);
            all.to_far[axis] = F::splat(to_far);
            let inverse = &rays.inverse[axis];
            all.least_inverse[axis] = F::splat(inverse.least::<F16>(members));
            all.greatest_inverse[axis] = F::splat(inverse.greatest::<F16>(members));
        }
        all
    }

    /// Where any ray enters each of eight boxes at the earliest, and the boxes that any could meet before `end`, given
    /// how far the near and far corners are from the origin.
    #[inline(always)]
    pub(super) fn meets(&self, near: [F; 3], far: [F; 3], end: f32) -> (F, u32) {
        let (mut enter, mut leave) = (self.t_min, F::splat(end));
        for axis in 0..3 {
            let (least, greatest) = (self.least_inverse[axis], self.greatest_inverse[axis]);
            enter = enter.max((near[axis] * least).min(near[axis] * greatest));
            leave = leave.min((far[axis] * least).max(far[axis] * greatest));
        }
        (enter, enter.le(leave))
    }
}
