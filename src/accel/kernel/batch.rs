//! Rays in, answers out: 64 at a time, those that go the same way together, the others alone.

use super::float::Machine;
use super::packet::{self, Waiting64};
use super::rays::{Rays, SIZE};
use super::single::{Any, Closest, Question, Waiting};
use crate::accel::wide::Reference;
use crate::accel::{Accel, primitive};
use crate::geometry::Hit;
use crate::ray::Ray;

/// Fewer rays than this are not worth a packet.
const LEAST: u32 = 8;

/// The memory of a search, kept from batch to batch.
pub(in crate::accel) struct Scratch {
    rays: Box<Rays>,
    waiting: Vec<Waiting>,
    waiting64: Vec<Waiting64>,
}

impl Scratch {
    pub(in crate::accel) fn new() -> Scratch {
        Scratch {
            rays: Box::new(Rays::new()),
            waiting: Vec::new(),
            waiting64: Vec::new(),
        }
    }

    fn make_room(&mut self, size: usize) {
        if self.waiting.len() < size {
            self.waiting.resize(size, Waiting::NOTHING);
            self.waiting64.resize(size, Waiting64::NOTHING);
        }
    }
}

/// The nearest hit of each ray, added to `hits`.
#[inline(always)]
pub(super) fn closest<M: Machine>(
    accel: &Accel,
    rays: &[Ray],
    scratch: &mut Scratch,
    hits: &mut Vec<Option<Hit>>,
) {
    scratch.make_room(accel.stack_size);
    for chunk in rays.chunks(SIZE) {
        scratch.rays.fill::<M>(chunk, accel.world.extent);
        for p in &accel.planes {
            for (lane, ray) in chunk.iter().enumerate() {
                if let Some(hit) = primitive::plane(&p.plane, ray, p.number) {
                    scratch.rays.offer(lane, &hit);
                }
            }
        }
        search::<M, Closest>(accel, scratch);
        for lane in 0..chunk.len() {
            hits.push(scratch.rays.hit(lane));
        }
    }
}

/// Whether each ray meets anything opaque, added to `occluded`.
#[inline(always)]
pub(super) fn occluded<M: Machine>(
    accel: &Accel,
    rays: &[Ray],
    scratch: &mut Scratch,
    occluded: &mut Vec<bool>,
) {
    scratch.make_room(accel.stack_size);
    for chunk in rays.chunks(SIZE) {
        scratch.rays.fill::<M>(chunk, accel.world.extent);
        for p in &accel.planes {
            for (lane, ray) in chunk.iter().enumerate() {
                if p.opaque && primitive::plane(&p.plane, ray, p.number).is_some() {
                    scratch.rays.live &= !(1 << lane);
                }
            }
        }
        search::<M, Any>(accel, scratch);
        let live = scratch.rays.live;
        for lane in 0..chunk.len() {
            occluded.push(live >> lane & 1 == 0);
        }
    }
}

/// Searches the trees for all rays in `scratch`.
#[inline(always)]
fn search<M: Machine, Q: Question>(accel: &Accel, scratch: &mut Scratch) {
    let (world, meshes) = (&accel.world, &accel.meshes);
    let Scratch {
        rays,
        waiting,
        waiting64,
    } = scratch;
    let lone = if accel.packets { rays.goes_on() } else { u64::MAX };
    rays.alone::<M, Q>(world, meshes, Reference::ROOT, rays.live & lone, waiting);
    let mut left = rays.live & !lone;
    while left != 0 {
        let bundle = rays.bundle::<M>(left);
        left &= !bundle.members;
        if bundle.members.count_ones() < LEAST || !rays.is_coherent::<M>(&bundle) {
            rays.alone::<M, Q>(world, meshes, Reference::ROOT, bundle.members, waiting);
        } else if rays.common_origin {
            packet::walk::<M, Q, true>(world, meshes, rays, &bundle, waiting64, waiting);
        } else {
            packet::walk::<M, Q, false>(world, meshes, rays, &bundle, waiting64, waiting);
        }
    }
}
