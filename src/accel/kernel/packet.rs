//! Up to 64 rays' way through a tree, together.
//!
//! All rays of a packet go into the same octant and along the same longest axis. A node's eight children are tested
//! at once against the interval of all rays; what is popped is tested exactly, sixteen rays at a time; a triangle of a
//! leaf that the interval reaches is tested against the rays that are left. Few rays go on alone. (Wald, Boulos and
//! Shirley 2007, "Ray Tracing Deformable Scenes Using Dynamic Bounding Volume Hierarchies"; Tsakok 2009, "Faster
//! Incoherent Rays: Multi-BVH Ray Stream Tracing", for the test by children.)

use super::equation::{box_of, cross, interval, minus, pick, rows, spread};
use super::float::{Float, Machine};
use super::single::{self, Best, Question, Waiting, first};
use crate::accel::primitive::Probe;
use crate::accel::slab::RELATIVE_PAD;
use crate::accel::tree::{Tree, TriangleBlock, blocks};
use crate::accel::wide::{Kind, Node, Reference};
use crate::ray::Ray;
use glam::Vec3;

/// The most rays of a packet.
pub(super) const SIZE: usize = 64;
/// So many rays or fewer are faster alone.
const FEW: u32 = 3;

/// One number of each ray, in four groups of sixteen.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
struct Row([[f32; 16]; 4]);

impl Row {
    const ZERO: Row = Row([[0.0; 16]; 4]);

    #[inline(always)]
    fn set(&mut self, lane: usize, x: f32) {
        self.0[lane >> 4 & 3][lane & 15] = x;
    }

    #[inline(always)]
    fn get(&self, lane: usize) -> f32 {
        self.0[lane >> 4 & 3][lane & 15]
    }

    #[inline(always)]
    fn group<F: Float<16>>(&self, group: usize) -> F {
        F::load(&self.0[group & 3])
    }

    #[inline(always)]
    fn least<F: Float<16>>(&self) -> f32 {
        let (a, b) = (self.group::<F>(0), self.group::<F>(1));
        a.min(b).min(self.group::<F>(2).min(self.group(3))).least()
    }

    #[inline(always)]
    fn greatest<F: Float<16>>(&self) -> f32 {
        let (a, b) = (self.group::<F>(0), self.group::<F>(1));
        a.max(b)
            .max(self.group::<F>(2).max(self.group(3)))
            .greatest()
    }
}

/// Rays that go together, and their nearest hits so far. Lanes past the last ray repeat the first.
pub(super) struct Packet {
    rays: [Ray; SIZE],
    /// Which lanes are rays, and have no answer yet.
    live: u64,
    /// The padded origins: what is subtracted from near corners, and from far ones.
    to_near: [Row; 3],
    to_far: [Row; 3],
    inverse: [Row; 3],
    origin: [Row; 3],
    slope: [Row; 2],
    t_min: Row,
    /// The nearest hit, or the end of the ray.
    t: Row,
    numbers: [u32; SIZE],
    barycentric: [Row; 2],
    near: [usize; 3],
    far: [usize; 3],
    axes: [usize; 3],
    extent: f32,
}

/// What waits to be visited, by whom, and where to find its box.
#[derive(Clone, Copy, Debug)]
pub(super) struct Waiting64 {
    reference: Reference,
    near: f32,
    live: u64,
    parent: u32,
    slot: u32,
}

impl Waiting64 {
    pub(super) const NOTHING: Waiting64 = Waiting64 {
        reference: Reference::NONE,
        near: 0.0,
        live: 0,
        parent: 0,
        slot: 0,
    };
}

/// The interval of all rays of a packet, spread over eight lanes.
struct Interval<F> {
    to_near: [F; 3],
    to_far: [F; 3],
    least_inverse: [F; 3],
    greatest_inverse: [F; 3],
    t_min: F,
}

impl<F: Float<8>> Interval<F> {
    #[inline(always)]
    fn new<F16: Float<16>>(packet: &Packet) -> Interval<F> {
        let zero = F::splat(0.0);
        let mut all = Interval {
            to_near: [zero; 3],
            to_far: [zero; 3],
            least_inverse: [zero; 3],
            greatest_inverse: [zero; 3],
            t_min: F::splat(packet.t_min.least::<F16>()),
        };
        for axis in 0..3 {
            // The origin that makes the interval begin earliest and end last.
            let (near, far) = (&packet.to_near[axis], &packet.to_far[axis]);
            let (to_near, to_far) = if packet.near[axis] == 0 {
                (near.greatest::<F16>(), far.least::<F16>())
            } else {
                (near.least::<F16>(), far.greatest::<F16>())
            };
            all.to_near[axis] = F::splat(to_near);
            all.to_far[axis] = F::splat(to_far);
            all.least_inverse[axis] = F::splat(packet.inverse[axis].least::<F16>());
            all.greatest_inverse[axis] = F::splat(packet.inverse[axis].greatest::<F16>());
        }
        all
    }

    /// Where any ray enters each of eight boxes at the earliest, and the boxes that any could meet before `end`.
    #[inline(always)]
    fn meets(&self, near: [F; 3], far: [F; 3], end: f32) -> (F, u32) {
        let (near, far) = (minus(near, self.to_near), minus(far, self.to_far));
        let (mut enter, mut leave) = (self.t_min, F::splat(end));
        for axis in 0..3 {
            let (least, greatest) = (self.least_inverse[axis], self.greatest_inverse[axis]);
            enter = enter.max((near[axis] * least).min(near[axis] * greatest));
            leave = leave.min((far[axis] * least).max(far[axis] * greatest));
        }
        (enter, enter.le(leave))
    }
}

impl Packet {
    pub(super) fn new() -> Packet {
        Packet {
            rays: [Ray::new(Vec3::ZERO, Vec3::X, 0.0, 0.0); SIZE],
            live: 0,
            to_near: [Row::ZERO; 3],
            to_far: [Row::ZERO; 3],
            inverse: [Row::ZERO; 3],
            origin: [Row::ZERO; 3],
            slope: [Row::ZERO; 2],
            t_min: Row::ZERO,
            t: Row::ZERO,
            numbers: [Best::NONE; SIZE],
            barycentric: [Row::ZERO; 2],
            near: [0; 3],
            far: [1; 3],
            axes: [0, 1, 2],
            extent: 0.0,
        }
    }

    /// Takes the rays with these indices, at most 64, of one class (see [`super::batch`]), and what they met so far.
    #[inline(always)]
    pub(super) fn fill<M: Machine>(
        &mut self,
        rays: &[Ray],
        members: &[u8],
        best: &[Best],
        extent: f32,
    ) {
        let mut direction = [Row::ZERO; 3];
        let count = members.len().min(SIZE);
        let first = members.first().copied().unwrap_or(0);
        for lane in 0..SIZE {
            let member = usize::from(if lane < count { members[lane] } else { first });
            let (ray, best) = (&rays[member], &best[member]);
            self.rays[lane] = *ray;
            let (o, d) = (ray.origin.to_array(), ray.direction.to_array());
            for axis in 0..3 {
                self.origin[axis].set(lane, o[axis]);
                direction[axis].set(lane, d[axis]);
            }
            self.t_min.set(lane, ray.t_min);
            self.t.set(lane, best.t);
            self.numbers[lane] = best.number;
            self.barycentric[0].set(lane, best.barycentric[0]);
            self.barycentric[1].set(lane, best.barycentric[1]);
        }
        self.live = u64::MAX >> (SIZE - count);
        self.extent = extent;
        let probe = Probe::new(self.rays[0], extent);
        self.near = probe.slab.near();
        self.far = [self.near[0] ^ 1, self.near[1] ^ 1, self.near[2] ^ 1];
        self.axes = probe.space.axes();
        let [x, y, z] = self.axes;
        let zero = M::F16::splat(0.0);
        for group in 0..4 {
            let mut magnitude = zero;
            for axis in 0..3 {
                let o = self.origin[axis].group::<M::F16>(group);
                magnitude = magnitude.max(o.max(zero - o));
            }
            let pad = M::F16::splat(RELATIVE_PAD) * (magnitude + M::F16::splat(extent));
            for axis in 0..3 {
                let o = self.origin[axis].group::<M::F16>(group);
                let (low, high) = (o - pad, o + pad);
                let (near, far) = if self.near[axis] == 0 {
                    (high, low)
                } else {
                    (low, high)
                };
                near.store(&mut self.to_near[axis].0[group]);
                far.store(&mut self.to_far[axis].0[group]);
                let inverse = M::F16::splat(1.0) / direction[axis].group(group);
                let clamped = inverse
                    .max(M::F16::splat(f32::MIN))
                    .min(M::F16::splat(f32::MAX));
                clamped.store(&mut self.inverse[axis].0[group]);
            }
            let d: M::F16 = direction[z].group(group);
            (direction[x].group::<M::F16>(group) / d).store(&mut self.slope[0].0[group]);
            (direction[y].group::<M::F16>(group) / d).store(&mut self.slope[1].0[group]);
        }
    }

    /// The rays that were found occluded.
    pub(super) fn answered(&self, lane: usize) -> bool {
        self.live >> lane & 1 == 0
    }

    /// What the ray in a lane met.
    pub(super) fn best(&self, lane: usize) -> Best {
        Best {
            t: self.t.get(lane),
            number: self.numbers[lane & 63],
            barycentric: [self.barycentric[0].get(lane), self.barycentric[1].get(lane)],
        }
    }

    #[inline(always)]
    fn three<F: Float<16>>(rows: &[Row; 3], group: usize) -> [F; 3] {
        [
            rows[0].group(group),
            rows[1].group(group),
            rows[2].group(group),
        ]
    }

    /// Which of the rays in `live` meet the box of a node's child, before their ends.
    #[inline(always)]
    fn in_box<M: Machine>(&self, node: &Node, slot: usize, live: u64) -> u64 {
        let slot = slot & 7;
        let [low, high] = &node.corners;
        let corners = [
            [low[0][slot], low[1][slot], low[2][slot]],
            [high[0][slot], high[1][slot], high[2][slot]],
        ];
        let near = spread::<M::F16, 16>(pick(&corners, self.near));
        let far = spread::<M::F16, 16>(pick(&corners, self.far));
        let mut inside = 0;
        for group in 0..4 {
            let members = (live >> (16 * group)) as u32 & 0xffff;
            if members == 0 {
                continue;
            }
            let near = minus(near, Packet::three(&self.to_near, group));
            let far = minus(far, Packet::three(&self.to_far, group));
            let (enter, leave) = interval(near, far, Packet::three(&self.inverse, group));
            let enter = enter.max(self.t_min.group(group));
            let met = members & enter.le(leave.min(self.t.group(group)));
            inside |= u64::from(met) << (16 * group);
        }
        inside
    }

    /// Tests the block's triangles that the interval reaches, each against all rays of `live`. Whether any was hit.
    #[inline(always)]
    fn triangles<M: Machine, Q: Question>(
        &mut self,
        block: &TriangleBlock,
        all: &Interval<M::F8>,
        live: u64,
        end: f32,
    ) -> bool {
        let [a, b, c] = &block.vertices;
        let corners = box_of::<M::F8, 8>([rows(a), rows(b), rows(c)]);
        let (_, mut reached) = all.meets(pick(&corners, self.near), pick(&corners, self.far), end);
        let mut any = false;
        let [x, y, z] = self.axes;
        while reached != 0 {
            let lane = first(reached) & 7;
            reached &= reached - 1;
            let number = block.numbers[lane];
            if Q::ANY && !number.is_opaque() {
                continue;
            }
            let triangle = block.triangle(lane);
            let bounds = triangle.bounds();
            let corners = [bounds.min.to_array(), bounds.max.to_array()];
            let vertices = [
                [a[x][lane], a[y][lane], a[z][lane]],
                [b[x][lane], b[y][lane], b[z][lane]],
                [c[x][lane], c[y][lane], c[z][lane]],
            ];
            for group in 0..4 {
                let members = (live & self.live) >> (16 * group);
                let members = members as u32 & 0xffff;
                if members == 0 {
                    continue;
                }
                let origin = [
                    self.origin[x].group(group),
                    self.origin[y].group(group),
                    self.origin[z].group(group),
                ];
                let relative = [
                    minus(spread::<M::F16, 16>(vertices[0]), origin),
                    minus(spread::<M::F16, 16>(vertices[1]), origin),
                    minus(spread::<M::F16, 16>(vertices[2]), origin),
                ];
                let slope = [self.slope[0].group(group), self.slope[1].group(group)];
                let crossing = cross(relative, slope);
                if crossing.inside & members == 0 {
                    continue;
                }
                let place = crossing.place(self.inverse[z].group(group));
                let best: M::F16 = self.t.group(group);
                let mut hit = crossing.inside
                    & members
                    & self.t_min.group::<M::F16>(group).le(place.t)
                    & place.t.le(best);
                if hit == 0 {
                    continue;
                }
                let near = minus(
                    spread(pick(&corners, self.near)),
                    Packet::three(&self.to_near, group),
                );
                let far = minus(
                    spread(pick(&corners, self.far)),
                    Packet::three(&self.to_far, group),
                );
                let (enter, leave) =
                    interval::<M::F16, 16>(near, far, Packet::three(&self.inverse, group));
                hit &= enter.le(place.t) & place.t.le(leave);
                if Q::ANY {
                    self.live &= !(u64::from(hit) << (16 * group));
                    any = true;
                    continue;
                }
                // Of hits at the same `t` the lowest number wins.
                let mut equal = hit & place.t.eq(best);
                while equal != 0 {
                    let lane = first(equal);
                    equal &= equal - 1;
                    if number.get() >= self.numbers[16 * group + lane & 63] {
                        hit &= !(1 << lane);
                    }
                }
                any |= hit != 0;
                M::F16::select(hit, place.t, best).store(&mut self.t.0[group]);
                for (row, new) in self.barycentric.iter_mut().zip(place.barycentric) {
                    M::F16::select(hit, new, row.group(group)).store(&mut row.0[group]);
                }
                while hit != 0 {
                    self.numbers[16 * group + first(hit) & 63] = number.get();
                    hit &= hit - 1;
                }
            }
        }
        any
    }

    /// Sends each ray of `live` on alone, from `start` down.
    #[inline(always)]
    fn alone<M: Machine, Q: Question>(
        &mut self,
        tree: &Tree,
        meshes: &[Tree],
        start: Reference,
        live: u64,
        stack: &mut [Waiting],
    ) {
        let mut left = live;
        while left != 0 {
            let lane = left.trailing_zeros() as usize & 63;
            left &= left - 1;
            let probe = Probe::new(self.rays[lane], self.extent);
            let mut best = self.best(lane);
            if single::walk::<M, Q, true>(tree, meshes, start, 0, &probe, &mut best, stack) {
                self.live &= !(1 << lane);
            } else if !Q::ANY {
                self.t.set(lane, best.t);
                self.numbers[lane] = best.number;
                self.barycentric[0].set(lane, best.barycentric[0]);
                self.barycentric[1].set(lane, best.barycentric[1]);
            }
        }
    }
}

/// Follows the packet's rays down the tree. `meshes` are the trees that instances lead to; both stacks have room for the
/// whole way.
#[inline(always)]
pub(super) fn walk<M: Machine, Q: Question>(
    tree: &Tree,
    meshes: &[Tree],
    packet: &mut Packet,
    stack: &mut [Waiting64],
    stack_of_one: &mut [Waiting],
) {
    let all = Interval::<M::F8>::new::<M::F16>(packet);
    let mut end = packet.t.greatest::<M::F16>();
    let mut waiting = 0;
    let (mut next, mut live) = (Reference::ROOT, packet.live);
    loop {
        match next.kind() {
            _ if live.count_ones() <= FEW => {
                packet.alone::<M, Q>(tree, meshes, next, live, stack_of_one);
            }
            Kind::Node => {
                let Some(node) = tree.nodes.get(next.index()) else {
                    return;
                };
                let near = rows::<M::F8, 8>(&pick(&node.corners, packet.near));
                let far = rows::<M::F8, 8>(&pick(&node.corners, packet.far));
                let (enter, mut met) = all.meets(near, far, end);
                let mut nears = [0.0; 8];
                enter.store(&mut nears);
                let bottom = waiting;
                while met != 0 {
                    let slot = first(met) & 7;
                    met &= met - 1;
                    let new = Waiting64 {
                        reference: node.children[slot],
                        near: nears[slot],
                        live,
                        parent: next.index() as u32,
                        slot: slot as u32,
                    };
                    let mut at = waiting;
                    while at > bottom && stack[at - 1].near < new.near {
                        stack[at] = stack[at - 1];
                        at -= 1;
                    }
                    stack[at] = new;
                    waiting += 1;
                }
            }
            Kind::Triangles => {
                let mut any = false;
                for block in &tree.triangles[blocks(next)] {
                    any |= packet.triangles::<M, Q>(block, &all, live, end);
                }
                if any && Q::ANY && packet.live == 0 {
                    return;
                }
                if any && !Q::ANY {
                    end = packet.t.greatest::<M::F16>();
                }
            }
            Kind::Spheres | Kind::Instances => {
                packet.alone::<M, Q>(tree, meshes, next, live, stack_of_one);
            }
        }
        loop {
            if waiting == 0 {
                return;
            }
            waiting -= 1;
            let top = stack[waiting];
            live = top.live & packet.live;
            if top.near > end || live == 0 {
                continue;
            }
            live = packet.in_box::<M>(&tree.nodes[top.parent as usize], top.slot as usize, live);
            if live != 0 {
                next = top.reference;
                break;
            }
        }
    }
}
