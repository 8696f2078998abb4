//! AVX-512: sixteen lanes in a register, and masks that need no register of floats.
//!
//! Every `unsafe` here calls instructions of AVX-512 F and VL. It is sound since values of these types come to be only
//! inside the entries of [`super`], which run only where an [`super::Isa`] says that the CPU has them.

use super::float::{Float, Machine};
use std::arch::x86_64::*;
use std::ops::{Add, Div, Mul, Sub};

pub(super) struct Avx512;

#[derive(Clone, Copy)]
pub(super) struct F8(__m256);

#[derive(Clone, Copy)]
pub(super) struct F16(__m512);

impl Machine for Avx512 {
    type F8 = F8;
    type F16 = F16;

    #[inline(always)]
    fn prefetch<T>(from: &T) {
        // SAFETY: a prefetch reads nothing that a program could see; SSE is part of x86-64.
        unsafe { _mm_prefetch::<_MM_HINT_T0>(std::ptr::from_ref(from).cast()) }
    }
}

impl Float<8> for F8 {
    #[inline(always)]
    fn splat(x: f32) -> Self {
        // SAFETY: as said at the head of the file.
        unsafe { F8(_mm256_set1_ps(x)) }
    }

    #[inline(always)]
    fn load(from: &[f32; 8]) -> Self {
        // SAFETY: as said at the head of the file; the array has all that is read.
        unsafe { F8(_mm256_loadu_ps(from.as_ptr())) }
    }

    #[inline(always)]
    fn store(self, to: &mut [f32; 8]) {
        // SAFETY: as said at the head of the file; the array has room for all that is written.
        unsafe { _mm256_storeu_ps(to.as_mut_ptr(), self.0) }
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        // SAFETY: as said at the head of the file.
        unsafe { F8(_mm256_min_ps(self.0, other.0)) }
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        // SAFETY: as said at the head of the file.
        unsafe { F8(_mm256_max_ps(self.0, other.0)) }
    }

    #[inline(always)]
    fn le(self, other: Self) -> u32 {
        // SAFETY: as said at the head of the file.
        unsafe { u32::from(_mm256_cmp_ps_mask::<_CMP_LE_OQ>(self.0, other.0)) }
    }

    #[inline(always)]
    fn lt(self, other: Self) -> u32 {
        // SAFETY: as said at the head of the file.
        unsafe { u32::from(_mm256_cmp_ps_mask::<_CMP_LT_OQ>(self.0, other.0)) }
    }

    #[inline(always)]
    fn eq(self, other: Self) -> u32 {
        // SAFETY: as said at the head of the file.
        unsafe { u32::from(_mm256_cmp_ps_mask::<_CMP_EQ_OQ>(self.0, other.0)) }
    }

    #[inline(always)]
    fn least(self) -> f32 {
        // SAFETY: as said at the head of the file.
        unsafe {
            let four = _mm_min_ps(
                _mm256_castps256_ps128(self.0),
                _mm256_extractf128_ps::<1>(self.0),
            );
            let two = _mm_min_ps(four, _mm_movehl_ps(four, four));
            _mm_cvtss_f32(_mm_min_ss(two, _mm_movehdup_ps(two)))
        }
    }

    #[inline(always)]
    fn greatest(self) -> f32 {
        // SAFETY: as said at the head of the file.
        unsafe {
            let four = _mm_max_ps(
                _mm256_castps256_ps128(self.0),
                _mm256_extractf128_ps::<1>(self.0),
            );
            let two = _mm_max_ps(four, _mm_movehl_ps(four, four));
            _mm_cvtss_f32(_mm_max_ss(two, _mm_movehdup_ps(two)))
        }
    }

    #[inline(always)]
    fn select(mask: u32, yes: Self, no: Self) -> Self {
        // SAFETY: as said at the head of the file.
        unsafe { F8(_mm256_mask_blend_ps(mask as __mmask8, no.0, yes.0)) }
    }
}

impl Add for F8 {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        // SAFETY: as said at the head of the file.
        unsafe { F8(_mm256_add_ps(self.0, other.0)) }
    }
}

impl Sub for F8 {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        // SAFETY: as said at the head of the file.
        unsafe { F8(_mm256_sub_ps(self.0, other.0)) }
    }
}

impl Mul for F8 {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        // SAFETY: as said at the head of the file.
        unsafe { F8(_mm256_mul_ps(self.0, other.0)) }
    }
}

impl Div for F8 {
    type Output = Self;

    #[inline(always)]
    fn div(self, other: Self) -> Self {
        // SAFETY: as said at the head of the file.
        unsafe { F8(_mm256_div_ps(self.0, other.0)) }
    }
}

impl Float<16> for F16 {
    #[inline(always)]
    fn splat(x: f32) -> Self {
        // SAFETY: as said at the head of the file.
        unsafe { F16(_mm512_set1_ps(x)) }
    }

    #[inline(always)]
    fn load(from: &[f32; 16]) -> Self {
        // SAFETY: as said at the head of the file; the array has all that is read.
        unsafe { F16(_mm512_loadu_ps(from.as_ptr())) }
    }

    #[inline(always)]
    fn store(self, to: &mut [f32; 16]) {
        // SAFETY: as said at the head of the file; the array has room for all that is written.
        unsafe { _mm512_storeu_ps(to.as_mut_ptr(), self.0) }
    }

    #[inline(always)]
    fn min(self, other: Self) -> Self {
        // SAFETY: as said at the head of the file.
        unsafe { F16(_mm512_min_ps(self.0, other.0)) }
    }

    #[inline(always)]
    fn max(self, other: Self) -> Self {
        // SAFETY: as said at the head of the file.
        unsafe { F16(_mm512_max_ps(self.0, other.0)) }
    }

    #[inline(always)]
    fn le(self, other: Self) -> u32 {
        // SAFETY: as said at the head of the file.
        unsafe { u32::from(_mm512_cmp_ps_mask::<_CMP_LE_OQ>(self.0, other.0)) }
    }

    #[inline(always)]
    fn lt(self, other: Self) -> u32 {
        // SAFETY: as said at the head of the file.
        unsafe { u32::from(_mm512_cmp_ps_mask::<_CMP_LT_OQ>(self.0, other.0)) }
    }

    #[inline(always)]
    fn eq(self, other: Self) -> u32 {
        // SAFETY: as said at the head of the file.
        unsafe { u32::from(_mm512_cmp_ps_mask::<_CMP_EQ_OQ>(self.0, other.0)) }
    }

    #[inline(always)]
    fn least(self) -> f32 {
        // SAFETY: as said at the head of the file.
        unsafe { _mm512_reduce_min_ps(self.0) }
    }

    #[inline(always)]
    fn greatest(self) -> f32 {
        // SAFETY: as said at the head of the file.
        unsafe { _mm512_reduce_max_ps(self.0) }
    }

    #[inline(always)]
    fn select(mask: u32, yes: Self, no: Self) -> Self {
        // SAFETY: as said at the head of the file.
        unsafe { F16(_mm512_mask_blend_ps(mask as __mmask16, no.0, yes.0)) }
    }
}

impl Add for F16 {
    type Output = Self;

    #[inline(always)]
    fn add(self, other: Self) -> Self {
        // SAFETY: as said at the head of the file.
        unsafe { F16(_mm512_add_ps(self.0, other.0)) }
    }
}

impl Sub for F16 {
    type Output = Self;

    #[inline(always)]
    fn sub(self, other: Self) -> Self {
        // SAFETY: as said at the head of the file.
        unsafe { F16(_mm512_sub_ps(self.0, other.0)) }
    }
}

impl Mul for F16 {
    type Output = Self;

    #[inline(always)]
    fn mul(self, other: Self) -> Self {
        // SAFETY: as said at the head of the file.
        unsafe { F16(_mm512_mul_ps(self.0, other.0)) }
    }
}

impl Div for F16 {
    type Output = Self;

    #[inline(always)]
    fn div(self, other: Self) -> Self {
        // SAFETY: as said at the head of the file.
        unsafe { F16(_mm512_div_ps(self.0, other.0)) }
    }
}
