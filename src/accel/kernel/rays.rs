//! Up to 64 rays side by side, and what they met so far; which of them go the same way.

use super::answer::Best;
use super::float::{Float, Machine};
use crate::accel::slab::RELATIVE_PAD;
use crate::geometry::Hit;
use crate::ray::Ray;

/// The most rays that go together.
pub(super) const SIZE: usize = 64;

/// One number of each ray, in four groups of sixteen.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(super) struct Row(pub(super) [[f32; 16]; 4]);

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
    /// As in [`crate::geometry::RaySpace`], of the bundle under way.
    pub(super) slope: [Row; 2],
    pub(super) t_min: Row,
    /// The nearest hit, or the end of the ray.
    pub(super) t: Row,
    /// The bits of the nearest hit's number.
    pub(super) number: Row,
    pub(super) barycentric: [Row; 2],
    pub(super) common_origin: bool,
    /// Per axis, who goes to lesser coordinates.
    backward: [u64; 3],
    /// Per axis, whose longest it is, of equal ones the first.
    longest: [u64; 3],
    /// Who goes on after a surface that it went through.
    alone: u64,
}

/// Rays that go into one octant and along one longest axis.
pub(super) struct Bundle {
    pub(super) members: u64,
    /// Which corner of a box is near, and which far, per axis: 0 is the least.
    pub(super) near: [usize; 3],
    pub(super) far: [usize; 3],
    /// The longest last.
    pub(super) axes: [usize; 3],
}

impl Bundle {
    /// The lane of its first ray.
    #[inline(always)]
    pub(super) fn first(&self) -> usize {
        self.members.trailing_zeros() as usize
    }
}

impl Row {
    const ZERO: Row = Row([[0.0; 16]; 4]);

    #[inline(always)]
    pub(super) fn get(&self, lane: usize) -> f32 {
        self.0[lane >> 4 & 3][lane & 15]
    }

    #[inline(always)]
    fn set(&mut self, lane: usize, x: f32) {
        self.0[lane >> 4 & 3][lane & 15] = x;
    }

    #[inline(always)]
    pub(super) fn group<F: Float<16>>(&self, group: usize) -> F {
        F::load(&self.0[group & 3])
    }

    #[inline(always)]
    fn set_half<M: Machine>(&mut self, group: usize, half: usize, new: M::F8) {
        let (low, high) = self.0[group & 3].split_at_mut(8);
        let eight = if half == 0 { low } else { high };
        if let Ok(eight) = eight.try_into() {
            new.store(eight);
        }
    }

    /// Puts `new` into the lanes of `mask`.
    #[inline(always)]
    pub(super) fn replace<F: Float<16>>(&mut self, group: usize, mask: u32, new: F) {
        F::select(mask, new, self.group(group)).store(&mut self.0[group & 3]);
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
        for group in 0..4 {
            for half in 0..2 {
                let from = 16 * group + 8 * half;
                let mut eight = [floats(last); 8];
                for (eighth, ray) in eight.iter_mut().zip(rays.get(from..).unwrap_or_default()) {
                    *eighth = floats(ray);
                }
                let [ox, oy, oz, dx, dy, dz, t_min, t_max] = M::transpose(eight);
                self.origin[0].set_half::<M>(group, half, ox);
                self.origin[1].set_half::<M>(group, half, oy);
                self.origin[2].set_half::<M>(group, half, oz);
                self.direction[0].set_half::<M>(group, half, dx);
                self.direction[1].set_half::<M>(group, half, dy);
                self.direction[2].set_half::<M>(group, half, dz);
                self.t_min.set_half::<M>(group, half, t_min);
                self.t.set_half::<M>(group, half, t_max);
            }
        }
        self.number = Row([[f32::from_bits(Best::NONE); 16]; 4]);
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
                M::F16::select(backward, low, high).store(&mut self.to_near[axis].0[group]);
                M::F16::select(backward, high, low).store(&mut self.to_far[axis].0[group]);
                inverse.store(&mut self.inverse[axis].0[group]);
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
        }
        self.common_origin = same == 0xffff;
    }

    /// Of `left`, above zero, those that go the way of the first of them.
    #[inline(always)]
    pub(super) fn of_one_class(&self, left: u64) -> Bundle {
        let first = left & left.wrapping_neg();
        let longest = if self.longest[0] & first != 0 {
            0
        } else if self.longest[1] & first != 0 {
            1
        } else {
            2
        };
        let mut members = left & self.longest[longest];
        let mut near = [0; 3];
        for (near, &backward) in near.iter_mut().zip(&self.backward) {
            *near = usize::from(backward & first != 0);
            members &= if *near == 1 { backward } else { !backward };
        }
        // What goes on after a surface has a rule of its own for equal distances.
        if self.alone != 0 {
            members = if self.alone & first != 0 {
                first
            } else {
                members & !self.alone
            };
        }
        Bundle {
            members,
            near,
            far: [near[0] ^ 1, near[1] ^ 1, near[2] ^ 1],
            axes: [(longest + 1) % 3, (longest + 2) % 3, longest],
        }
    }

    /// Reckons the slopes of a bundle. Whether its rays differ so little in direction that they meet much the same boxes.
    #[inline(always)]
    pub(super) fn make_ready<M: Machine>(&mut self, bundle: &Bundle) -> bool {
        let [x, y, z] = bundle.axes;
        for group in 0..4 {
            let per_unit: M::F16 = self.inverse[z].group(group);
            let along_x: M::F16 = self.direction[x].group(group);
            let along_y: M::F16 = self.direction[y].group(group);
            (along_x * per_unit).store(&mut self.slope[0].0[group]);
            (along_y * per_unit).store(&mut self.slope[1].0[group]);
        }
        let mut spread = 0.0;
        for slope in &self.slope {
            let greatest = slope.greatest::<M::F16>(bundle.members);
            spread += greatest - slope.least::<M::F16>(bundle.members);
        }
        spread < WIDEST
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

/// The greatest sum of the ranges of both slopes with which rays still go together.
const WIDEST: f32 = 0.6;
