//! The twin without any intrinsics: arrays, which compilers vectorise as far as they can on any machine.

use super::float::{Float, Machine, Sets, Task};
use std::ops::{Add, Div, Mul, Sub};

pub(super) struct Scalar;

#[derive(Clone, Copy)]
pub(super) struct Array<const N: usize>([f32; N]);

impl Machine for Scalar {
    type F8 = Array<8>;
    type F16 = Array<16>;
    type Sets = ScalarSets;

    fn run<T: Task>(task: T) -> T::Output {
        task.run::<Scalar>()
    }

    #[inline(always)]
    fn prefetch<T>(_: &T) {}

    #[inline(always)]
    fn transpose(rows: [&[f32; 8]; 8]) -> [Array<8>; 8] {
        let mut columns = [Array([0.0; 8]); 8];
        for (i, row) in rows.into_iter().enumerate() {
            for (column, &x) in columns.iter_mut().zip(row) {
                column.0[i] = x;
            }
        }
        columns
    }
}

/// See [`Sets`].
pub(super) struct ScalarSets([u64; 8]);

impl Sets for ScalarSets {
    #[inline(always)]
    fn none() -> Self {
        ScalarSets([0; 8])
    }

    #[inline(always)]
    fn add(&mut self, mask: u32, lane: usize) {
        for (slot, set) in self.0.iter_mut().enumerate() {
            *set |= u64::from(mask >> slot & 1) << (lane & 63);
        }
    }

    #[inline(always)]
    fn get(self) -> [u64; 8] {
        self.0
    }
}

impl<const N: usize> Array<N> {
    #[inline(always)]
    fn zip(self, other: Self, f: impl Fn(f32, f32) -> f32) -> Self {
        let mut result = self;
        for lane in 0..N {
            result.0[lane] = f(self.0[lane], other.0[lane]);
        }
        result
    }

    #[inline(always)]
    fn mask(self, other: Self, f: impl Fn(&f32, &f32) -> bool) -> u32 {
        let mut mask = 0;
        for lane in 0..N {
            mask |= u32::from(f(&self.0[lane], &other.0[lane])) << lane;
        }
        mask
    }
}

impl<const N: usize> Float<N> for Array<N> {
    #[inline(always)]
    fn splat(x: f32) -> Self {
        Array([x; N])
    }

    #[inline(always)]
    fn load(from: &[f32; N]) -> Self {
        Array(*from)
    }

    #[inline(always)]
    fn store(self, to: &mut [f32; N]) {
        *to = self.0;
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        self.zip(other, |a, b| if a < b { a } else { b })
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        self.zip(other, |a, b| if a > b { a } else { b })
    }

    #[inline(always)]
    fn le(self, other: Self) -> u32 {
        self.mask(other, f32::le)
    }

    #[inline(always)]
    fn lt(self, other: Self) -> u32 {
        self.mask(other, f32::lt)
    }

    #[inline(always)]
    fn eq(self, other: Self) -> u32 {
        self.mask(other, f32::eq)
    }

    #[inline(always)]
    fn least(self) -> f32 {
        self.0.into_iter().fold(f32::INFINITY, f32::min)
    }

    #[inline(always)]
    fn greatest(self) -> f32 {
        self.0.into_iter().fold(f32::NEG_INFINITY, f32::max)
    }

    #[inline(always)]
    fn select(mask: u32, yes: Self, no: Self) -> Self {
        let mut result = no;
        for lane in 0..N {
            if mask >> lane & 1 == 1 {
                result.0[lane] = yes.0[lane];
            }
        }
        result
    }
}

impl<const N: usize> Add for Array<N> {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        self.zip(other, f32::add)
    }
}

impl<const N: usize> Sub for Array<N> {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        self.zip(other, f32::sub)
    }
}

impl<const N: usize> Mul for Array<N> {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        self.zip(other, f32::mul)
    }
}

impl<const N: usize> Div for Array<N> {
    type Output = Self;

    #[inline(always)]
    fn div(self, other: Self) -> Self {
        self.zip(other, f32::div)
    }
}
