//! One ray's way, counted.

use super::answer::{Best, Question};
use super::batch::Scratch;
use super::scalar::Scalar;
use super::single::{self, Level};
use super::spread::Spread;
use crate::accel::Accel;
use crate::accel::cost::Tests;
use crate::accel::primitive::Probe;
use crate::accel::wide::Reference;
use crate::ray::Ray;

/// The way of a ray that goes alone, by the kernel without intrinsics: the others make the same tests.
pub(in crate::accel) fn counted<Q: Question>(
    accel: &Accel,
    ray: &Ray,
    scratch: &mut Scratch,
    best: &mut Best,
    tests: &mut Tests,
) -> bool {
    let level = Level {
        tree: &accel.world,
        meshes: &accel.meshes,
        first_number: 0,
    };
    let wide = Spread::new(&Probe::new(*ray, accel.world.extent));
    let stack = scratch.stack(accel.stack_size);
    single::walk::<Scalar, Q, Tests, true>(&level, Reference::ROOT, ray, &wide, best, stack, tests)
}
