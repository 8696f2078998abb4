//! One ray, spread over eight lanes, against eight boxes or eight triangles.

use super::answer::{Best, Question};
use super::bundle::Octant;
use super::equation::{Crossing, box_of, cross, interval, minus, pick, rows, spread};
use super::float::Float;
use super::rays::{Rays, get};
use crate::accel::primitive::Probe;
use crate::accel::tree::TriangleBlock;
use crate::accel::wide::Node;
use crate::ray::Ray;

/// What the slab test needs of a ray, each number in all lanes.
pub(super) struct Slabs<F> {
    /// What is subtracted from the near corners of boxes, and from the far ones: the origin, padded.
    to_near: [F; 3],
    to_far: [F; 3],
    inverse: [F; 3],
    t_min: F,
}

/// A ray, each of its numbers in all lanes.
pub(super) struct Spread<F> {
    pub(super) slabs: Slabs<F>,
    octant: Octant,
    /// The longest axis of the direction last.
    origin: [F; 3],
    axes: [usize; 3],
    slope: [F; 2],
    per_unit: F,
}

/// The near rows of eight boxes, then the far ones.
#[inline(always)]
pub(super) fn sides<F: Float<8>>(node: &Node, octant: Octant) -> [[F; 3]; 2] {
    let near = rows(&pick(&node.corners, octant.near));
    let far = rows(&pick(&node.corners, octant.far));
    [near, far]
}

impl<F: Float<8>> Slabs<F> {
    /// Of a ray among others.
    #[inline(always)]
    pub(super) fn of(rays: &Rays, lane: usize) -> Slabs<F> {
        Slabs {
            to_near: spread(get(&rays.to_near, lane)),
            to_far: spread(get(&rays.to_far, lane)),
            inverse: spread(get(&rays.inverse, lane)),
            t_min: F::splat(rays.t_min.get(lane)),
        }
    }

    /// From where to where the ray is inside each of eight boxes.
    #[inline(always)]
    fn interval(&self, [near, far]: [[F; 3]; 2]) -> (F, F) {
        interval(
            minus(near, self.to_near),
            minus(far, self.to_far),
            self.inverse,
        )
    }

    /// Where the ray enters each box, and the boxes that it meets before `end`.
    #[inline(always)]
    pub(super) fn meets(&self, sides: [[F; 3]; 2], end: f32) -> (F, u32) {
        let (enter, leave) = self.interval(sides);
        let enter = enter.max(self.t_min);
        (enter, enter.le(leave.min(F::splat(end))))
    }
}

impl<F: Float<8>> Spread<F> {
    /// Of a ray by itself.
    #[inline(always)]
    pub(super) fn new(probe: &Probe) -> Spread<F> {
        let (slab, space, axes) = (&probe.slab, &probe.space, probe.space.axes());
        let octant = Octant::new(slab.near());
        // The padded origin is the greater where the corner is the lesser one.
        let padded = [slab.high.to_array(), slab.low.to_array()];
        let origin = probe.ray.origin.to_array();
        Spread {
            slabs: Slabs {
                to_near: spread(pick(&padded, octant.near)),
                to_far: spread(pick(&padded, octant.far)),
                inverse: spread(slab.inverse.to_array()),
                t_min: F::splat(probe.ray.t_min),
            },
            octant,
            origin: spread([origin[axes[0]], origin[axes[1]], origin[axes[2]]]),
            axes,
            slope: [F::splat(space.slope().x), F::splat(space.slope().y)],
            per_unit: F::splat(space.per_unit()),
        }
    }

    /// Of a ray among others, which goes into `octant`.
    #[inline(always)]
    pub(super) fn of(rays: &Rays, octant: Octant, lane: usize) -> Spread<F> {
        let axes = rays.axes(lane);
        let [x, y, z] = axes;
        let slope = [&rays.slope[0], &rays.slope[1]];
        Spread {
            slabs: Slabs::of(rays, lane),
            octant,
            origin: spread([
                rays.origin[x].get(lane),
                rays.origin[y].get(lane),
                rays.origin[z].get(lane),
            ]),
            axes,
            slope: [F::splat(slope[0].get(lane)), F::splat(slope[1].get(lane))],
            per_unit: F::splat(rays.inverse[z].get(lane)),
        }
    }

    /// Where the ray enters each child, and the children that it meets before `end`.
    #[inline(always)]
    pub(super) fn children(&self, node: &Node, end: f32) -> (F, u32) {
        self.slabs.meets(sides(node, self.octant), end)
    }

    /// Which of eight boxes, given by their corners, the ray meets before `end`.
    #[inline(always)]
    pub(super) fn boxes(&self, corners: &[[F; 3]; 2], end: f32) -> u32 {
        let sides = [
            pick(corners, self.octant.near),
            pick(corners, self.octant.far),
        ];
        self.slabs.meets(sides, end).1
    }

    #[inline(always)]
    fn cross(&self, block: &TriangleBlock) -> Crossing<F> {
        let [x, y, z] = self.axes;
        let mut vertices = [self.origin; 3];
        for (vertex, rows) in vertices.iter_mut().zip(&block.vertices) {
            let row = [F::load(&rows[x]), F::load(&rows[y]), F::load(&rows[z])];
            *vertex = minus(row, self.origin);
        }
        cross(vertices, self.slope)
    }

    /// In which lanes `t` is inside the triangle's own box, as the slab test sees it.
    #[inline(always)]
    fn in_own_box(&self, block: &TriangleBlock, t: F) -> u32 {
        let [a, b, c] = &block.vertices;
        let corners = box_of([rows(a), rows(b), rows(c)]);
        let near = pick(&corners, self.octant.near);
        let far = pick(&corners, self.octant.far);
        let (enter, leave) = self.slabs.interval([near, far]);
        enter.le(t) & t.le(leave)
    }

    /// Offers the hits of a block's triangles, whose numbers start from `first_number`, up to `end`; true where any hit
    /// will do and there is an opaque one. `ray` is this one.
    #[inline(always)]
    pub(super) fn triangles<Q: Question>(
        &self,
        block: &TriangleBlock,
        first_number: u32,
        ray: &Ray,
        end: f32,
        best: &mut Best,
    ) -> bool {
        let crossing = self.cross(block);
        if crossing.inside == 0 {
            return false;
        }
        let place = crossing.place(self.per_unit);
        let mut hit = crossing.inside & self.slabs.t_min.le(place.t) & place.t.le(F::splat(end));
        if hit == 0 {
            return false;
        }
        hit &= self.in_own_box(block, place.t);
        let (mut t, mut v, mut w) = ([0.0; 8], [0.0; 8], [0.0; 8]);
        place.t.store(&mut t);
        place.barycentric[0].store(&mut v);
        place.barycentric[1].store(&mut w);
        while hit != 0 {
            let lane = first(hit) & 7;
            hit &= hit - 1;
            let number = block.numbers[lane];
            if (Q::ANY && !number.is_opaque()) || !ray.admits(t[lane], first_number + number.get())
            {
                continue;
            }
            if Q::ANY {
                return true;
            }
            best.offer(t[lane], first_number + number.get(), [v[lane], w[lane]]);
        }
        false
    }
}

/// The lowest bit of a mask that is set.
#[inline(always)]
pub(super) fn first(mask: u32) -> usize {
    mask.trailing_zeros() as usize
}
