//! Up to 64 rays side by side, and what they met so far; which of them go the same way.

use super::float::{Float, Machine};
use super::single::{self, Best, Question, Waiting};
use crate::accel::primitive::Probe;
use crate::accel::slab::RELATIVE_PAD;
use crate::accel::tree::Tree;
use crate::accel::wide::Reference;
use crate::geometry::Hit;
use crate::ray::Ray;
use glam::Vec3;

/// The most rays that go together.
pub(super) const SIZE: usize = 64;

/// One number of each ray, in four groups of sixteen.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(super) struct Row(pub(super) [[f32; 16]; 4]);

/// Rays and their nearest hits so far. Lanes past the last ray repeat it.
pub(super) struct Rays {
    rays: [Ray; SIZE],
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
    extent: f32,
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

impl Row {
    const ZERO: Row = Row([[0.0; 16]; 4]);

    #[inline(always)]
    fn get(&self, lane: usize) -> f32 {
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
            rays: [Ray::new(Vec3::ZERO, Vec3::X, 0.0, 0.0); SIZE],
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
            extent: 0.0,
        }
    }

    /// Takes up to 64 rays, at least one, that have met nothing yet, in a world of this extent.
    #[inline(always)]
    pub(super) fn fill<M: Machine>(&mut self, rays: &[Ray], extent: f32) {
        let count = rays.len().min(SIZE);
        self.rays[..count].copy_from_slice(&rays[..count]);
        let last = self.rays[count.saturating_sub(1)];
        self.rays[count..].fill(last);
        for group in 0..4 {
            for lane in 0..16 {
                let ray = &self.rays[16 * group + lane];
                self.origin[0].0[group][lane] = ray.origin.x;
                self.origin[1].0[group][lane] = ray.origin.y;
                self.origin[2].0[group][lane] = ray.origin.z;
                self.direction[0].0[group][lane] = ray.direction.x;
                self.direction[1].0[group][lane] = ray.direction.y;
                self.direction[2].0[group][lane] = ray.direction.z;
                self.t_min.0[group][lane] = ray.t_min;
                self.t.0[group][lane] = ray.t_max;
            }
        }
        self.number = Row([[f32::from_bits(Best::NONE); 16]; 4]);
        self.live = u64::MAX >> (SIZE - count);
        self.extent = extent;
        self.prepare::<M>();
    }

    /// What follows from origins and directions, as [`crate::accel::slab::Slab`] has it.
    #[inline(always)]
    fn prepare<M: Machine>(&mut self) {
        let zero = M::F16::splat(0.0);
        let (least, greatest) = (M::F16::splat(f32::MIN), M::F16::splat(f32::MAX));
        let first = self.first(&self.origin);
        let mut same = 0xffff;
        for group in 0..4 {
            let origin = three::<M::F16>(&self.origin, group);
            let mut magnitude = zero;
            for axis in 0..3 {
                same &= origin[axis].eq(M::F16::splat(first[axis]));
                magnitude = magnitude.max(origin[axis].max(zero - origin[axis]));
            }
            let pad = M::F16::splat(RELATIVE_PAD) * (magnitude + M::F16::splat(self.extent));
            for axis in 0..3 {
                let direction = self.direction[axis].group::<M::F16>(group);
                let inverse = (M::F16::splat(1.0) / direction).max(least).min(greatest);
                let backward = inverse.lt(zero);
                let (low, high) = (origin[axis] - pad, origin[axis] + pad);
                M::F16::select(backward, low, high).store(&mut self.to_near[axis].0[group]);
                M::F16::select(backward, high, low).store(&mut self.to_far[axis].0[group]);
                inverse.store(&mut self.inverse[axis].0[group]);
            }
        }
        self.common_origin = same == 0xffff;
    }

    /// Of `left` those that go the way of the first of them, made ready to go together.
    #[inline(always)]
    pub(super) fn bundle<M: Machine>(&mut self, left: u64) -> Bundle {
        let first = left.trailing_zeros() as usize & 63;
        let zero = M::F16::splat(0.0);
        let mut members = 0;
        let backward = |axis: usize| self.inverse[axis].get(first) < 0.0;
        let signs = [backward(0), backward(1), backward(2)];
        let near = signs.map(usize::from);
        let longest = self.longest(first);
        for group in 0..4 {
            let mut same = 0xffff;
            let mut length = [zero; 3];
            for axis in 0..3 {
                let d = self.direction[axis].group::<M::F16>(group);
                length[axis] = d.max(zero - d);
                let inverse = self.inverse[axis].group::<M::F16>(group);
                let negative = inverse.lt(zero);
                same &= if signs[axis] { negative } else { !negative };
            }
            let [x, y, z] = length;
            let x_longest = y.le(x) & z.le(x);
            let y_longest = z.le(y) & !x_longest;
            same &= match longest {
                0 => x_longest,
                1 => y_longest,
                _ => !(x_longest | y_longest),
            };
            members |= u64::from(same & 0xffff) << (16 * group);
        }
        let axes = [(longest + 1) % 3, (longest + 2) % 3, longest];
        for group in 0..4 {
            let d: M::F16 = self.direction[axes[2]].group(group);
            for k in 0..2 {
                let slope = self.direction[axes[k]].group::<M::F16>(group) / d;
                slope.store(&mut self.slope[k].0[group]);
            }
        }
        Bundle {
            members: members & left,
            near,
            far: [near[0] ^ 1, near[1] ^ 1, near[2] ^ 1],
            axes,
        }
    }

    /// The longest axis of a ray's direction, of equal ones the first.
    #[inline(always)]
    fn longest(&self, lane: usize) -> usize {
        let [x, y, z] = [0, 1, 2].map(|axis| self.direction[axis].get(lane).abs());
        if x >= y && x >= z {
            0
        } else if y >= z {
            1
        } else {
            2
        }
    }

    /// What three rows have for the first ray.
    #[inline(always)]
    pub(super) fn first(&self, rows: &[Row; 3]) -> [f32; 3] {
        [rows[0].0[0][0], rows[1].0[0][0], rows[2].0[0][0]]
    }

    /// Whether rays differ so little in direction that they meet much the same boxes.
    #[inline(always)]
    pub(super) fn is_coherent<M: Machine>(&self, bundle: &Bundle) -> bool {
        let mut spread = 0.0;
        for slope in &self.slope {
            let greatest = slope.greatest::<M::F16>(bundle.members);
            spread += greatest - slope.least::<M::F16>(bundle.members);
        }
        spread < WIDEST
    }

    /// What a ray met so far.
    #[inline(always)]
    fn best(&self, lane: usize) -> Best {
        Best {
            t: self.t.get(lane),
            number: self.number.get(lane).to_bits(),
            barycentric: [self.barycentric[0].get(lane), self.barycentric[1].get(lane)],
        }
    }

    #[inline(always)]
    fn set_best(&mut self, lane: usize, best: &Best) {
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

    /// What a ray met.
    #[inline(always)]
    pub(super) fn hit(&self, lane: usize) -> Option<Hit> {
        self.best(lane).hit()
    }

    /// Whether a ray goes on after a surface that it went through, so that equal distances need their own care.
    #[inline(always)]
    pub(super) fn goes_on(&self) -> u64 {
        let mut lanes = 0;
        for (lane, ray) in self.rays.iter().enumerate() {
            lanes |= u64::from(ray.after.is_some()) << lane;
        }
        lanes
    }

    /// Sends each ray of `live` on alone, from `start` down.
    #[inline(always)]
    pub(super) fn alone<M: Machine, Q: Question>(
        &mut self,
        tree: &Tree,
        meshes: &[Tree],
        start: Reference,
        live: u64,
        stack: &mut [Waiting],
    ) {
        let mut left = live;
        while left != 0 {
            let lane = left.trailing_zeros() as usize & 63;
            left &= left - 1;
            let probe = Probe::new(self.rays[lane], self.extent);
            let mut best = self.best(lane);
            if single::walk::<M, Q, true>(tree, meshes, start, 0, &probe, &mut best, stack) {
                self.live &= !(1 << lane);
            } else if !Q::ANY {
                self.set_best(lane, &best);
            }
        }
    }
}

/// The greatest sum of the ranges of both slopes with which rays still go together.
const WIDEST: f32 = 0.6;
