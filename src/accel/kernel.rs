//! The way of rays through trees: the only place that knows registers.
//!
//! Everything is written once, over [`float::Float`], and compiled for each instruction set; [`Isa`] is the proof that the
//! machine has it.

#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
mod batch;
mod equation;
mod float;
mod isa;
mod packet;
mod scalar;
mod single;

pub(super) use batch::Scratch;
pub use isa::{Isa, IsaError};
pub(super) use single::Best;

use super::Accel;
use crate::ray::Ray;
use isa::Set;
use scalar::Scalar;
use single::{Any, Closest};

/// The nearest hit of every ray, into `scratch.best`, where what was found before the trees is already.
pub(super) fn closest(accel: &Accel, rays: &[Ray], scratch: &mut Scratch) {
    match accel.isa.set() {
        Set::Scalar => batch::search::<Scalar, Closest>(accel, rays, scratch),
        // SAFETY: an `Isa` of this set is made only where the CPU has it.
        #[cfg(target_arch = "x86_64")]
        Set::Avx2 => unsafe { closest_avx2(accel, rays, scratch) },
        // SAFETY: as above.
        #[cfg(target_arch = "x86_64")]
        Set::Avx512 => unsafe { closest_avx512(accel, rays, scratch) },
    }
}

/// Whether every ray meets anything opaque, into `scratch.occluded`, where what was found before the trees is already.
pub(super) fn occluded(accel: &Accel, rays: &[Ray], scratch: &mut Scratch) {
    match accel.isa.set() {
        Set::Scalar => batch::search::<Scalar, Any>(accel, rays, scratch),
        // SAFETY: an `Isa` of this set is made only where the CPU has it.
        #[cfg(target_arch = "x86_64")]
        Set::Avx2 => unsafe { occluded_avx2(accel, rays, scratch) },
        // SAFETY: as above.
        #[cfg(target_arch = "x86_64")]
        Set::Avx512 => unsafe { occluded_avx512(accel, rays, scratch) },
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,bmi1,bmi2,lzcnt,popcnt")]
fn closest_avx2(accel: &Accel, rays: &[Ray], scratch: &mut Scratch) {
    batch::search::<avx2::Avx2, Closest>(accel, rays, scratch);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,bmi1,bmi2,lzcnt,popcnt")]
fn occluded_avx2(accel: &Accel, rays: &[Ray], scratch: &mut Scratch) {
    batch::search::<avx2::Avx2, Any>(accel, rays, scratch);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,bmi1,bmi2,lzcnt,popcnt,avx512f,avx512vl,avx512dq,avx512bw")]
fn closest_avx512(accel: &Accel, rays: &[Ray], scratch: &mut Scratch) {
    batch::search::<avx512::Avx512, Closest>(accel, rays, scratch);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,bmi1,bmi2,lzcnt,popcnt,avx512f,avx512vl,avx512dq,avx512bw")]
fn occluded_avx512(accel: &Accel, rays: &[Ray], scratch: &mut Scratch) {
    batch::search::<avx512::Avx512, Any>(accel, rays, scratch);
}
