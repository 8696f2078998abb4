//! Up to 64 rays side by side, and what they met so far.

use super::answer::Best;
use super::float::{Float, Machine};
use crate::accel::slab::RELATIVE_PAD;
use crate::geometry::Hit;
use crate::ray::Ray;

/// The most rays that go together.
pub(super) const SIZE: usize = 64;

/// One number of each ray.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(super) struct Row([f32; SIZE]);

/// Rays and their nearest hits so far. Lanes past the last ray repeat it.
pub(super) struct Rays {
    /// Which lanes are rays that still look for an answer.
    pub(super) live: u64,
    pub(super) origin: [Row; 3],
    direction: [Row; 3],
    /// The padded origins: what is subtracted from near corners of boxes, and from far ones.
    pub(super) to_near: [Row; 3],
    pub(super) to_far: [Row; 3],
    pub(super) inverse: [Row; 3],
    /// As in [`crate::geometry::RaySpace`].
    pub(super) slope: [Row; 2],
    pub(super) t_min: Row,
    /// The nearest hit, or the end of the ray.
    pub(super) t: Row,
    /// The bits of the nearest hit's number.
    pub(super) number: Row,
    pub(super) barycentric: [Row; 2],
    pub(super) common_origin: bool,
    /// Per axis, who goes to lesser coordinates.
    pub(super) backward: [u64; 3],
    /// Per axis, whose longest it is, of equal ones the first.
    pub(super) longest: [u64; 3],
    /// Who goes on after a surface that it went through.
    pub(super) alone: u64,
}

impl Row {
    const ZERO: Row = Row([0.0; SIZE]);

    #[inline(always)]
    pub(super) fn get(&self, lane: usize) -> f32 {
        self.0[lane & 63]
    }

    #[inline(always)]
    fn set(&mut self, lane: usize, x: f32) {
        self.0[lane & 63] = x;
    }

    /// Four groups of sixteen.
    #[inline(always)]
    pub(super) fn group<F: Float<16>>(&self, group: usize) -> F {
        F::load(&self.0.as_chunks().0[group & 3])
    }

    #[inline(always)]
    fn set_group<F: Float<16>>(&mut self, group: usize, new: F) {
        new.store(&mut self.0.as_chunks_mut().0[group & 3]);
    }

    /// Eight groups of eight.
    #[inline(always)]
    fn set_eight<F: Float<8>>(&mut self, eight: usize, new: F) {
        new.store(&mut self.0.as_chunks_mut().0[eight & 7]);
    }

    /// Puts `new` into the lanes of `mask`.
    #[inline(always)]
    pub(super) fn replace<F: Float<16>>(&mut self, group: usize, mask: u32, new: F) {
        self.set_group(group, F::select(mask, new, self.group(group)));
    }

    /// The least of the members.
    #[inline(always)]
    pub(super) fn least<F: Float<16>>(&self, members: u64) -> f32 {
        let mut least = F::splat(f32::INFINITY);
        for group in 0..4 {
            let mask = (members >> (16 * group)) as u32 & 0xffff;
            least = least.min(F::select(mask, self.group(group), least));
        }
        least.least()
    }

    /// The greatest of the members.
    #[inline(always)]
    pub(super) fn greatest<F: Float<16>>(&self, members: u64) -> f32 {
        let mut greatest = F::splat(f32::NEG_INFINITY);
        for group in 0..4 {
            let mask = (members >> (16 * group)) as u32 & 0xffff;
            greatest = greatest.max(F::select(mask, self.group(group), greatest));
        }
        greatest.greatest()
    }
}

/// A ray's origin, direction and limits.
#[inline(always)]
fn floats(ray: &Ray) -> &[f32; 8] {
    // SAFETY: `Ray` is `repr(C)` and begins with two `Vec3`, which are three floats each, and two floats.
    unsafe { &*std::ptr::from_ref(ray).cast() }
}

/// What three rows have in a lane.
#[inline(always)]
pub(super) fn get(rows: &[Row; 3], lane: usize) -> [f32; 3] {
    [rows[0].get(lane), rows[1].get(lane), rows[2].get(lane)]
}

/// The groups of three rows.
#[inline(always)]
pub(super) fn three<F: Float<16>>(rows: &[Row; 3], group: usize) -> [F; 3] {
    [
        rows[0].group(group),
        rows[1].group(group),
        rows[2].group(group),
    ]
}

impl Rays {
    pub(super) fn new() -> Rays {
        Rays {
            live: 0,
            origin: [Row::ZERO; 3],
            direction: [Row::ZERO; 3],
            to_near: [Row::ZERO; 3],
            to_far: [Row::ZERO; 3],
            inverse: [Row::ZERO; 3],
            slope: [Row::ZERO; 2],
            t_min: Row::ZERO,
            t: Row::ZERO,
            number: Row::ZERO,
            barycentric: [Row::ZERO; 2],
            common_origin: false,
            backward: [0; 3],
            longest: [0; 3],
            alone: 0,
        }
    }

    /// Takes up to 64 rays, at least one, that have met nothing yet, in a world of this extent.
    #[inline(always)]
    pub(super) fn fill<M: Machine>(&mut self, rays: &[Ray], extent: f32) {
        let Some(last) = rays.last() else { return };
        let count = rays.len().min(SIZE);
        for eight in 0..SIZE / 8 {
            let mut from = [floats(last); 8];
            for (i, from) in from.iter_mut().enumerate() {
                if let Some(ray) = rays.get(8 * eight + i) {
                    *from = floats(ray);
                }
            }
            let [ox, oy, oz, dx, dy, dz, t_min, t_max] = M::transpose(from);
            self.origin[0].set_eight(eight, ox);
            self.origin[1].set_eight(eight, oy);
            self.origin[2].set_eight(eight, oz);
            self.direction[0].set_eight(eight, dx);
            self.direction[1].set_eight(eight, dy);
            self.direction[2].set_eight(eight, dz);
            self.t_min.set_eight(eight, t_min);
            self.t.set_eight(eight, t_max);
        }
        self.number = Row([f32::from_bits(Best::NONE); SIZE]);
        self.live = u64::MAX >> (SIZE - count);
        self.alone = 0;
        for (lane, ray) in rays.iter().enumerate() {
            self.alone |= u64::from(ray.after.is_some()) << (lane & 63);
        }
        self.prepare::<M>(extent);
    }

    /// What follows from origins and directions, as [`crate::accel::slab::Slab`] has it.
    #[inline(always)]
    fn prepare<M: Machine>(&mut self, extent: f32) {
        let zero = M::F16::splat(0.0);
        let (least, greatest) = (M::F16::splat(f32::MIN), M::F16::splat(f32::MAX));
        let first = get(&self.origin, 0);
        let mut same = 0xffff;
        self.backward = [0; 3];
        self.longest = [0; 3];
        for group in 0..4 {
            let origin = three::<M::F16>(&self.origin, group);
            let mut magnitude = zero;
            for axis in 0..3 {
                same &= origin[axis].eq(M::F16::splat(first[axis]));
                magnitude = magnitude.max(origin[axis].max(zero - origin[axis]));
            }
            let pad = M::F16::splat(RELATIVE_PAD) * (magnitude + M::F16::splat(extent));
            let direction = three::<M::F16>(&self.direction, group);
            let mut length = [zero; 3];
            for axis in 0..3 {
                let d = direction[axis];
                let inverse = (M::F16::splat(1.0) / d).max(least).min(greatest);
                let backward = inverse.lt(zero);
                let (low, high) = (origin[axis] - pad, origin[axis] + pad);
                self.to_near[axis].set_group(group, M::F16::select(backward, low, high));
                self.to_far[axis].set_group(group, M::F16::select(backward, high, low));
                self.inverse[axis].set_group(group, inverse);
                self.backward[axis] |= u64::from(backward) << (16 * group);
                length[axis] = d.max(zero - d);
            }
            let [x, y, z] = length;
            let x_longest = y.le(x) & z.le(x);
            let y_longest = z.le(y) & !x_longest;
            self.longest[0] |= u64::from(x_longest) << (16 * group);
            self.longest[1] |= u64::from(y_longest) << (16 * group);
            let z_longest = !(x_longest | y_longest) & 0xffff;
            self.longest[2] |= u64::from(z_longest) << (16 * group);
            let [x, y, z] = direction;
            let inverse = three::<M::F16>(&self.inverse, group);
            let per_unit = M::F16::select(y_longest, inverse[1], inverse[2]);
            let per_unit = M::F16::select(x_longest, inverse[0], per_unit);
            let along = M::F16::select(x_longest, y, M::F16::select(y_longest, z, x));
            let across = M::F16::select(x_longest, z, M::F16::select(y_longest, x, y));
            self.slope[0].set_group(group, along * per_unit);
            self.slope[1].set_group(group, across * per_unit);
        }
        self.common_origin = same == 0xffff;
    }

    /// The rays that have met nothing before `near`.
    #[inline(always)]
    pub(super) fn reaching<F: Float<16>>(&self, near: f32) -> u64 {
        let near = F::splat(near);
        let mut reaching = 0;
        for group in 0..4 {
            reaching |= u64::from(near.le(self.t.group(group))) << (16 * group);
        }
        reaching
    }

    /// The axes of the world in the order of a ray's own space: its longest last.
    #[inline(always)]
    pub(super) fn axes(&self, lane: usize) -> [usize; 3] {
        // Without a branch, which unlike rays would make hard to foresee.
        let is_y = (self.longest[1] >> lane & 1) as usize;
        let is_z = (self.longest[2] >> lane & 1) as usize;
        let is_x = 1 - is_y - is_z;
        [is_x + 2 * is_y, is_z + 2 * is_x, is_y + 2 * is_z]
    }

    /// What a ray met so far.
    #[inline(always)]
    pub(super) fn best(&self, lane: usize) -> Best {
        Best {
            t: self.t.get(lane),
            number: self.number.get(lane).to_bits(),
            barycentric: [self.barycentric[0].get(lane), self.barycentric[1].get(lane)],
        }
    }

    #[inline(always)]
    pub(super) fn set_best(&mut self, lane: usize, best: &Best) {
        self.t.set(lane, best.t);
        self.number.set(lane, f32::from_bits(best.number));
        self.barycentric[0].set(lane, best.barycentric[0]);
        self.barycentric[1].set(lane, best.barycentric[1]);
    }

    /// Offers a ray a hit found elsewhere.
    pub(super) fn offer(&mut self, lane: usize, hit: &Hit) {
        let mut best = self.best(lane);
        best.offer(hit.t, hit.primitive, hit.barycentric);
        self.set_best(lane, &best);
    }
}
