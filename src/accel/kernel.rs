//! The way of rays through trees: the only place that knows registers, and pages of memory.
//!
//! Everything is written once, over [`float::Float`], and compiled for each instruction set; [`Isa`] is the proof that the
//! machine has it.

mod alone;
mod answer;
#[cfg(target_arch = "x86_64")]
mod avx2;
#[cfg(target_arch = "x86_64")]
mod avx512;
mod batch;
mod bundle;
mod counted;
mod equation;
mod float;
mod interval;
mod isa;
mod packet;
mod pages;
mod rays;
mod scalar;
mod single;
mod spread;
mod stream;

pub(super) use answer::{Any, Best, Closest, Question};
pub(super) use batch::Scratch;
pub(super) use counted::counted;
pub use isa::{Isa, IsaError};
pub(super) use pages::Pages;

use super::Accel;
use crate::geometry::Hit;
use crate::ray::Ray;
use float::{Machine, Task};
use isa::Set;
use scalar::Scalar;

/// The nearest hit of each ray, added to `hits`.
pub(super) fn closest(
    accel: &Accel,
    rays: &[Ray],
    scratch: &mut Scratch,
    hits: &mut Vec<Option<Hit>>,
) {
    run(
        accel.isa,
        batch::ClosestOf {
            accel,
            rays,
            scratch,
            hits,
        },
    );
}

/// Whether each ray meets anything opaque, added to `occluded`.
pub(super) fn occluded(
    accel: &Accel,
    rays: &[Ray],
    scratch: &mut Scratch,
    occluded: &mut Vec<bool>,
) {
    run(
        accel.isa,
        batch::OccludedOf {
            accel,
            rays,
            scratch,
            occluded,
        },
    );
}

/// The one place where an instruction set is chosen: an [`Isa`] exists only where the CPU has it.
fn run<T: Task>(isa: Isa, task: T) -> T::Output {
    match isa.set() {
        Set::Scalar => Scalar::run(task),
        #[cfg(target_arch = "x86_64")]
        Set::Avx2 => avx2::Avx2::run(task),
        #[cfg(target_arch = "x86_64")]
        Set::Avx512 => avx512::Avx512::run(task),
    }
}
