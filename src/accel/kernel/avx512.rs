//! AVX-512: sixteen lanes in a register, and masks that need no register of floats.
//!
//! Every `unsafe` here calls instructions of AVX-512 F and VL. It is sound since values of these types come to be only
//! inside [`Machine::run`], which [`super`] calls only where an [`super::Isa`] says that the CPU has them.

use super::float::{Float, Machine, Sets, Task};
use std::arch::x86_64::*;
use std::ops::{Add, Div, Mul, Sub};

pub(super) struct Avx512;

#[derive(Clone, Copy)]
pub(super) struct F8(__m256);

#[derive(Clone, Copy)]
pub(super) struct F16(__m512);

/// See [`Sets`].
pub(super) struct Sets8(__m512i);

impl Machine for Avx512 {
    type F8 = F8;
    type F16 = F16;
    type Sets = Sets8;

    #[inline(always)]
    fn run<T: Task>(task: T) -> T::Output {
        #[target_feature(enable = "avx2,bmi1,bmi2,lzcnt,popcnt,avx512f,avx512vl,avx512dq,avx512bw")]
        fn with_features<T: Task>(task: T) -> T::Output {
            task.run::<Avx512>()
        }
        // SAFETY: as said at the head of the file.
        unsafe { with_features(task) }
    }

    #[inline(always)]
    fn prefetch<T>(from: &T) {
        // SAFETY: a prefetch reads nothing that a program could see; SSE is part of x86-64.
        unsafe { _mm_prefetch::<_MM_HINT_T0>(std::ptr::from_ref(from).cast()) }
    }

    #[inline(always)]
    fn transpose(rows: [&[f32; 8]; 8]) -> [F8; 8] {
        let [a, b, c, d, e, f, g, h] = rows.map(F8::load);
        let upper = quarters([a, b, c, d]);
        let lower = quarters([e, f, g, h]);
        let mut columns = [a; 8];
        for k in 0..4 {
            // SAFETY: as said at the head of the file.
            unsafe {
                columns[k] = F8(_mm256_permute2f128_ps::<0x20>(upper[k].0, lower[k].0));
                columns[k + 4] = F8(_mm256_permute2f128_ps::<0x31>(upper[k].0, lower[k].0));
            }
        }
        columns
    }
}

/// Four rows, each of whose halves becomes columns of four.
#[inline(always)]
fn quarters([a, b, c, d]: [F8; 4]) -> [F8; 4] {
    // SAFETY: as said at the head of the file.
    unsafe {
        let (ab, ab_high) = (_mm256_unpacklo_ps(a.0, b.0), _mm256_unpackhi_ps(a.0, b.0));
        let (cd, cd_high) = (_mm256_unpacklo_ps(c.0, d.0), _mm256_unpackhi_ps(c.0, d.0));
        [
            F8(_mm256_shuffle_ps::<0b01_00_01_00>(ab, cd)),
            F8(_mm256_shuffle_ps::<0b11_10_11_10>(ab, cd)),
            F8(_mm256_shuffle_ps::<0b01_00_01_00>(ab_high, cd_high)),
            F8(_mm256_shuffle_ps::<0b11_10_11_10>(ab_high, cd_high)),
        ]
    }
}

impl Sets for Sets8 {
    #[inline(always)]
    fn none() -> Self {
        // SAFETY: as said at the head of the file.
        unsafe { Sets8(_mm512_setzero_si512()) }
    }

    #[inline(always)]
    fn add(&mut self, mask: u32, lane: usize) {
        // SAFETY: as said at the head of the file.
        unsafe {
            let ray = _mm512_set1_epi64(1 << (lane & 63));
            self.0 = _mm512_mask_or_epi64(self.0, mask as __mmask8, self.0, ray);
        }
    }

    #[inline(always)]
    fn get(self) -> [u64; 8] {
        let mut sets = [0; 8];
        // SAFETY: as said at the head of the file; the array has room for all that is written.
        unsafe { _mm512_storeu_si512(sets.as_mut_ptr().cast(), self.0) }
        sets
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
