//! Rays in, answers out: which of a batch go together, and which alone.

use super::float::Machine;
use super::packet::{self, Packet, SIZE, Waiting64};
use super::single::{self, Best, Question, Waiting};
use crate::accel::Accel;
use crate::accel::primitive::Probe;
use crate::accel::wide::Reference;
use crate::ray::Ray;

/// Fewer rays than this are not worth a packet.
const LEAST: usize = 8;
/// Octants times longest axes.
const CLASSES: usize = 32;

/// The memory of a search, kept from batch to batch.
pub(in crate::accel) struct Scratch {
    packet: Box<Packet>,
    waiting: Vec<Waiting>,
    waiting64: Vec<Waiting64>,
    /// The answers so far; what was found before the trees goes in here.
    pub(in crate::accel) best: Vec<Best>,
    /// Which rays are occluded.
    pub(in crate::accel) occluded: Vec<bool>,
}

impl Scratch {
    pub(in crate::accel) fn new() -> Scratch {
        Scratch {
            packet: Box::new(Packet::new()),
            waiting: Vec::new(),
            waiting64: Vec::new(),
            best: Vec::new(),
            occluded: Vec::new(),
        }
    }

    fn make_room(&mut self, accel: &Accel) {
        let inner = accel.meshes.iter().map(|mesh| mesh.stack_size()).max();
        let size = accel.world.stack_size() + inner.unwrap_or(0);
        if self.waiting.len() < size {
            self.waiting.resize(size, Waiting::NOTHING);
            self.waiting64.resize(size, Waiting64::NOTHING);
        }
    }
}

/// The signs of a direction and its longest axis: rays of one class can go in one packet.
#[inline(always)]
fn class(ray: &Ray) -> u8 {
    let d = ray.direction;
    let (x, y, z) = (d.x.abs(), d.y.abs(), d.z.abs());
    let axis = if x >= y && x >= z {
        0
    } else if y >= z {
        1
    } else {
        2
    };
    u8::from(d.x < 0.0) | u8::from(d.y < 0.0) << 1 | u8::from(d.z < 0.0) << 2 | axis << 3
}

/// Searches for every ray what the trees have; the answers are in `scratch`, where those from before are, too.
#[inline(always)]
pub(super) fn search<M: Machine, Q: Question>(accel: &Accel, rays: &[Ray], scratch: &mut Scratch) {
    if accel.world.is_empty() {
        return;
    }
    scratch.make_room(accel);
    for (at, chunk) in rays.chunks(SIZE).enumerate() {
        let from = at * SIZE;
        let mut members = [[0u8; SIZE]; 1];
        let mut classes = [0u8; SIZE];
        let mut present = 0u32;
        for (index, ray) in chunk.iter().enumerate() {
            let done = Q::ANY && scratch.occluded[from + index];
            let lone = ray.after.is_some() || !accel.packets;
            classes[index] = class(ray) | u8::from(lone) << 6 | u8::from(done) << 7;
            present |= 1 << (class(ray) & 31);
        }
        for class in 0..CLASSES as u8 {
            if present >> class & 1 == 0 {
                continue;
            }
            let mut count = 0;
            for (index, &c) in classes[..chunk.len()].iter().enumerate() {
                members[0][count & 63] = index as u8;
                count += usize::from(c == class);
            }
            let members = &members[0][..count.min(SIZE)];
            if count < LEAST {
                for &member in members {
                    one::<M, Q>(accel, chunk, from, usize::from(member), scratch);
                }
                continue;
            }
            let Scratch {
                packet,
                waiting,
                waiting64,
                best,
                occluded,
            } = scratch;
            packet.fill::<M>(chunk, members, &best[from..], accel.world.extent);
            packet::walk::<M, Q>(&accel.world, &accel.meshes, packet, waiting64, waiting);
            for (lane, &member) in members.iter().enumerate() {
                let index = from + usize::from(member);
                if Q::ANY {
                    occluded[index] = packet.answered(lane);
                } else {
                    best[index] = packet.best(lane);
                }
            }
        }
        for (index, &c) in classes[..chunk.len()].iter().enumerate() {
            if c >> 6 == 1 {
                one::<M, Q>(accel, chunk, from, index, scratch);
            }
        }
    }
}

#[inline(always)]
fn one<M: Machine, Q: Question>(
    accel: &Accel,
    chunk: &[Ray],
    from: usize,
    index: usize,
    scratch: &mut Scratch,
) {
    let probe = Probe::new(chunk[index], accel.world.extent);
    let best = &mut scratch.best[from + index];
    let (world, meshes) = (&accel.world, &accel.meshes);
    let stack = &mut scratch.waiting;
    let found = single::walk::<M, Q, true>(world, meshes, Reference::ROOT, 0, &probe, best, stack);
    if Q::ANY {
        scratch.occluded[from + index] = found;
    }
}
