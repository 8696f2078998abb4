//! What a kernel needs of registers, whatever their width.
//!
//! Kernels are written once, over [`Float`], and compiled for each [`Machine`] inside an entry that has its target
//! features. Everything on the way there is `#[inline(always)]` and free of closures, which would not inherit the
//! features of their caller: that was 16 times slower.
//!
//! No operation is fused, approximate or reordered, so every machine gets the same bits.

use std::ops::{Add, Div, Mul, Sub};

/// `N` floats, worked on side by side. Masks have one bit a lane, lane 0 the lowest.
pub(super) trait Float<const N: usize>:
    Copy + Add<Output = Self> + Sub<Output = Self> + Mul<Output = Self> + Div<Output = Self>
{
    fn splat(x: f32) -> Self;
    fn load(from: &[f32; N]) -> Self;
    fn store(self, to: &mut [f32; N]);
    /// `self` where it is less, else `other`: also where either is not a number.
    fn min(self, other: Self) -> Self;
    /// `self` where it is greater, else `other`: also where either is not a number.
    fn max(self, other: Self) -> Self;
    /// Where `self <= other`; false for what is not a number.
    fn le(self, other: Self) -> u32;
    /// Where `self < other`; false for what is not a number.
    fn lt(self, other: Self) -> u32;
    /// Where `self == other`; false for what is not a number.
    fn eq(self, other: Self) -> u32;
    /// The least lane.
    fn least(self) -> f32;
    /// The greatest lane.
    fn greatest(self) -> f32;
    /// `yes` in the lanes of `mask`, `no` in the others.
    fn select(mask: u32, yes: Self, no: Self) -> Self;
}

/// An instruction set: registers for the eight children of a node or the triangles of a block, and for sixteen rays.
pub(super) trait Machine: Sized {
    type F8: Float<8>;
    type F16: Float<16>;
    type Sets: Sets;
    /// Runs a task as a function of its own that may use this machine's instructions.
    fn run<T: Task>(task: T) -> T::Output;
    /// Asks for a line of cache that will be read soon.
    fn prefetch<T>(from: &T);
    /// Eight times eight floats, rows for columns.
    fn transpose(rows: [&[f32; 8]; 8]) -> [Self::F8; 8];
}

/// Eight sets of up to 64 rays: who meets which child.
pub(super) trait Sets {
    /// Nobody.
    fn none() -> Self;
    /// The ray in `lane`, below 64, joins the sets whose bits `mask` has.
    fn add(&mut self, mask: u32, lane: usize);
    /// One bit a ray.
    fn get(self) -> [u64; 8];
}

/// What a machine runs.
pub(super) trait Task {
    type Output;
    /// Is `#[inline(always)]`, so that it becomes part of a function with the machine's instructions.
    fn run<M: Machine>(self) -> Self::Output;
}
