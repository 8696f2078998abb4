//! Rays in, answers out: 64 at a time, those that go the same way together, the others alone.

use super::alone::Search;
use super::answer::{Any, Closest, Question};
use super::bundle::Bundle;
use super::float::{Machine, Task};
use super::packet::{self, Waiting64};
use super::rays::{Rays, SIZE};
use super::single::Waiting;
use super::stream::{self, Few};
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
    few: Vec<Few>,
    waiting64: Vec<Waiting64>,
}

impl Scratch {
    pub(in crate::accel) fn new() -> Scratch {
        Scratch {
            rays: Box::new(Rays::new()),
            waiting: Vec::new(),
            few: Vec::new(),
            waiting64: Vec::new(),
        }
    }

    /// Room for the whole way of one ray.
    pub(super) fn stack(&mut self, size: usize) -> &mut [Waiting] {
        self.make_room(size);
        &mut self.waiting
    }

    fn make_room(&mut self, size: usize) {
        if self.waiting.len() < size {
            self.waiting.resize(size, Waiting::NOTHING);
            self.few.resize(size, Few::NOTHING);
            self.waiting64.resize(size, Waiting64::NOTHING);
        }
    }
}

/// Adds the nearest hit of each ray to `hits`.
pub(super) struct ClosestOf<'a> {
    pub(super) accel: &'a Accel,
    pub(super) rays: &'a [Ray],
    pub(super) scratch: &'a mut Scratch,
    pub(super) hits: &'a mut Vec<Option<Hit>>,
}

/// Adds to `occluded` whether each ray meets anything opaque.
pub(super) struct OccludedOf<'a> {
    pub(super) accel: &'a Accel,
    pub(super) rays: &'a [Ray],
    pub(super) scratch: &'a mut Scratch,
    pub(super) occluded: &'a mut Vec<bool>,
}

impl Task for ClosestOf<'_> {
    type Output = ();

    #[inline(always)]
    fn run<M: Machine>(self) {
        let (accel, scratch) = (self.accel, self.scratch);
        scratch.make_room(accel.stack_size);
        for chunk in self.rays.chunks(SIZE) {
            scratch.rays.fill::<M>(chunk, accel.world.extent);
            for p in &accel.planes {
                for (lane, ray) in chunk.iter().enumerate() {
                    if let Some(hit) = primitive::plane(&p.plane, ray, p.number) {
                        scratch.rays.offer(lane, &hit);
                    }
                }
            }
            search::<M, Closest>(accel, chunk, scratch);
            let rays = &*scratch.rays;
            self.hits
                .extend((0..chunk.len()).map(|lane| rays.best(lane).hit()));
        }
    }
}

impl Task for OccludedOf<'_> {
    type Output = ();

    #[inline(always)]
    fn run<M: Machine>(self) {
        let (accel, scratch) = (self.accel, self.scratch);
        scratch.make_room(accel.stack_size);
        for chunk in self.rays.chunks(SIZE) {
            scratch.rays.fill::<M>(chunk, accel.world.extent);
            for p in &accel.planes {
                for (lane, ray) in chunk.iter().enumerate() {
                    if p.opaque && primitive::plane(&p.plane, ray, p.number).is_some() {
                        scratch.rays.live &= !(1 << lane);
                    }
                }
            }
            search::<M, Any>(accel, chunk, scratch);
            let live = scratch.rays.live;
            self.occluded
                .extend((0..chunk.len()).map(|lane| live >> lane & 1 == 0));
        }
    }
}

/// Searches the trees for `chunk`, which is in `scratch`: rays that are alike in packets, the others of an octant in a
/// stream.
#[inline(always)]
fn search<M: Machine, Q: Question>(accel: &Accel, chunk: &[Ray], scratch: &mut Scratch) {
    let Scratch {
        rays,
        waiting,
        few,
        waiting64,
    } = scratch;
    let mut search = Search {
        accel,
        chunk,
        rays,
        stack: waiting,
    };
    let mut left = search.rays.live;
    while left != 0 {
        let Bundle { members, octant } = search.rays.of_one_octant(left);
        left &= !members;
        if !accel.packets {
            search.alone::<M, Q>(octant, Reference::ROOT, members);
            continue;
        }
        let (mut rest, mut unlike) = (members, 0);
        while rest != 0 {
            let bundle = Bundle {
                members: search.rays.of_one_axis(rest),
                octant,
            };
            rest &= !bundle.members;
            if bundle.members.count_ones() < LEAST || !search.rays.are_narrow::<M>(bundle.members) {
                unlike |= bundle.members;
            } else if search.rays.common_origin {
                packet::walk::<M, Q, true>(&mut search, &bundle, few, waiting64);
            } else {
                packet::walk::<M, Q, false>(&mut search, &bundle, few, waiting64);
            }
        }
        if unlike != 0 {
            stream::walk::<M, Q>(&mut search, octant, Reference::ROOT, unlike, few);
        }
    }
}
