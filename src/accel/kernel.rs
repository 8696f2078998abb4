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
mod rays;
mod scalar;
mod single;

pub(super) use batch::Scratch;
pub use isa::{Isa, IsaError};

use super::Accel;
use crate::geometry::Hit;
use crate::ray::Ray;
use isa::Set;
use scalar::Scalar;

/// The nearest hit of each ray, added to `hits`.
pub(super) fn closest(
    accel: &Accel,
    rays: &[Ray],
    scratch: &mut Scratch,
    hits: &mut Vec<Option<Hit>>,
) {
    match accel.isa.set() {
        Set::Scalar => batch::closest::<Scalar>(accel, rays, scratch, hits),
        // SAFETY: an `Isa` of this set is made only where the CPU has it.
        #[cfg(target_arch = "x86_64")]
        Set::Avx2 => unsafe { closest_avx2(accel, rays, scratch, hits) },
        // SAFETY: as above.
        #[cfg(target_arch = "x86_64")]
        Set::Avx512 => unsafe { closest_avx512(accel, rays, scratch, hits) },
    }
}

/// Whether each ray meets anything opaque, added to `occluded`.
pub(super) fn occluded(
    accel: &Accel,
    rays: &[Ray],
    scratch: &mut Scratch,
    occluded: &mut Vec<bool>,
) {
    match accel.isa.set() {
        Set::Scalar => batch::occluded::<Scalar>(accel, rays, scratch, occluded),
        // SAFETY: an `Isa` of this set is made only where the CPU has it.
        #[cfg(target_arch = "x86_64")]
        Set::Avx2 => unsafe { occluded_avx2(accel, rays, scratch, occluded) },
        // SAFETY: as above.
        #[cfg(target_arch = "x86_64")]
        Set::Avx512 => unsafe { occluded_avx512(accel, rays, scratch, occluded) },
    }
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,bmi1,bmi2,lzcnt,popcnt")]
fn closest_avx2(accel: &Accel, rays: &[Ray], scratch: &mut Scratch, hits: &mut Vec<Option<Hit>>) {
    batch::closest::<avx2::Avx2>(accel, rays, scratch, hits);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,bmi1,bmi2,lzcnt,popcnt")]
fn occluded_avx2(accel: &Accel, rays: &[Ray], scratch: &mut Scratch, occluded: &mut Vec<bool>) {
    batch::occluded::<avx2::Avx2>(accel, rays, scratch, occluded);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,bmi1,bmi2,lzcnt,popcnt,avx512f,avx512vl,avx512dq,avx512bw")]
fn closest_avx512(accel: &Accel, rays: &[Ray], scratch: &mut Scratch, hits: &mut Vec<Option<Hit>>) {
    batch::closest::<avx512::Avx512>(accel, rays, scratch, hits);
}

#[cfg(target_arch = "x86_64")]
#[target_feature(enable = "avx2,bmi1,bmi2,lzcnt,popcnt,avx512f,avx512vl,avx512dq,avx512bw")]
fn occluded_avx512(accel: &Accel, rays: &[Ray], scratch: &mut Scratch, occluded: &mut Vec<bool>) {
    batch::occluded::<avx512::Avx512>(accel, rays, scratch, occluded);
}
