//! One ray's way through a tree: eight boxes or eight triangles at a time.
//!
//! A node's eight children are tested at once; the nearest that is met is next, the others wait on the stack, nearest
//! on top (Wald, Benthin and Boulos 2008, "Getting Rid of Packets").

use super::answer::{Best, Question};
use super::equation::{Crossing, box_of, cross, interval, minus, pick, rows, spread};
use super::float::{Float, Machine};
use crate::accel::primitive::{Probe, sphere};
use crate::accel::tree::{SphereBlock, Tree, TriangleBlock, blocks};
use crate::accel::wide::{Kind, Node, Reference};

/// What waits to be visited, and where the ray enters it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Waiting {
    reference: Reference,
    near: f32,
}

impl Waiting {
    pub(super) const NOTHING: Waiting = Waiting {
        reference: Reference::NONE,
        near: 0.0,
    };
}

/// A ray, spread over eight lanes.
struct Spread<F> {
    /// What is subtracted from the near corners of boxes, and from the far ones: the origin, padded.
    to_near: [F; 3],
    to_far: [F; 3],
    inverse: [F; 3],
    /// Which corner of a box is near, and which far, per axis.
    near: [usize; 3],
    far: [usize; 3],
    /// The longest axis of the direction last.
    origin: [F; 3],
    axes: [usize; 3],
    slope: [F; 2],
    per_unit: F,
    t_min: F,
}

impl<F: Float<8>> Spread<F> {
    #[inline(always)]
    fn new(probe: &Probe) -> Spread<F> {
        let (slab, space, axes) = (&probe.slab, &probe.space, probe.space.axes());
        let near = slab.near();
        let far = [near[0] ^ 1, near[1] ^ 1, near[2] ^ 1];
        // The padded origin is the greater where the corner is the lesser one.
        let padded = [slab.high.to_array(), slab.low.to_array()];
        let origin = probe.ray.origin.to_array();
        Spread {
            to_near: spread(pick(&padded, near)),
            to_far: spread(pick(&padded, far)),
            inverse: spread(slab.inverse.to_array()),
            near,
            far,
            origin: spread([origin[axes[0]], origin[axes[1]], origin[axes[2]]]),
            axes,
            slope: [F::splat(space.slope().x), F::splat(space.slope().y)],
            per_unit: F::splat(space.per_unit()),
            t_min: F::splat(probe.ray.t_min),
        }
    }

    /// From where to where the ray is inside each of eight boxes.
    #[inline(always)]
    fn interval(&self, corners: &[[F; 3]; 2]) -> (F, F) {
        let near = minus(pick(corners, self.near), self.to_near);
        let far = minus(pick(corners, self.far), self.to_far);
        interval(near, far, self.inverse)
    }

    /// Where the ray enters each child, and the children that it meets before `end`.
    #[inline(always)]
    fn children(&self, node: &Node, end: f32) -> (F, u32) {
        let near = minus(rows(&pick(&node.corners, self.near)), self.to_near);
        let far = minus(rows(&pick(&node.corners, self.far)), self.to_far);
        let (enter, leave) = interval(near, far, self.inverse);
        let enter = enter.max(self.t_min);
        (enter, enter.le(leave.min(F::splat(end))))
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
        let (enter, leave) = self.interval(&box_of([rows(a), rows(b), rows(c)]));
        enter.le(t) & t.le(leave)
    }
}

/// The lowest bit of a mask that is set.
#[inline(always)]
pub(super) fn first(mask: u32) -> usize {
    mask.trailing_zeros() as usize
}

/// A child of a node, as it waits.
#[inline(always)]
fn at(node: &Node, near: &[f32; 8], slot: usize) -> Waiting {
    Waiting {
        reference: node.children[slot & 7],
        near: near[slot & 7],
    }
}

/// Asks for what a reference leads to, of which the ray will need all.
#[inline(always)]
fn prefetch<M: Machine>(tree: &Tree, reference: Reference) {
    if reference.kind() == Kind::Node
        && let Some(node) = tree.nodes.get(reference.index())
    {
        M::prefetch(&node.corners[0][0]);
        M::prefetch(&node.corners[0][2]);
        M::prefetch(&node.corners[1][1]);
        M::prefetch(&node.children);
    }
}

/// Follows the ray from `start` down; hits go to `best`. True at once where the question is [`Any`] and one is opaque.
///
/// `meshes` are the trees that instances lead to, `first_number` what the numbers of a mesh start from. `stack` has room
/// for both levels.
#[inline(always)]
pub(super) fn walk<M: Machine, Q: Question, const OUTER: bool>(
    tree: &Tree,
    meshes: &[Tree],
    start: Reference,
    first_number: u32,
    probe: &Probe,
    best: &mut Best,
    stack: &mut [Waiting],
) -> bool {
    let ray = Spread::<M::F8>::new(probe);
    let mut waiting = 0;
    let mut next = start;
    loop {
        match next.kind() {
            Kind::Node => {
                let Some(node) = tree.nodes.get(next.index()) else {
                    return false;
                };
                let (enter, mut met) = ray.children(node, best.t.min(probe.ray.t_max));
                if met != 0 {
                    let nearest = first(met);
                    met &= met - 1;
                    if met == 0 {
                        next = node.children[nearest];
                        continue;
                    }
                    let mut near = [0.0; 8];
                    enter.store(&mut near);
                    let other = first(met);
                    met &= met - 1;
                    let pair = [at(node, &near, nearest), at(node, &near, other)];
                    let swap = usize::from(pair[1].near < pair[0].near);
                    next = pair[swap].reference;
                    stack[waiting] = pair[swap ^ 1];
                    waiting += 1;
                    prefetch::<M>(tree, pair[swap ^ 1].reference);
                    if met == 0 {
                        continue;
                    }
                    // More than two: nearest on top; where any hit will do, in whatever order.
                    let bottom = waiting - 1;
                    stack[waiting] = pair[swap];
                    waiting += 1;
                    while met != 0 {
                        let new = at(node, &near, first(met));
                        met &= met - 1;
                        prefetch::<M>(tree, new.reference);
                        let mut to = waiting;
                        while !Q::ANY && to > bottom && stack[to - 1].near < new.near {
                            stack[to] = stack[to - 1];
                            to -= 1;
                        }
                        stack[to] = new;
                        waiting += 1;
                    }
                    waiting -= 1;
                    next = stack[waiting].reference;
                    continue;
                }
            }
            Kind::Triangles => {
                let mut leaf = tree.leaf(next);
                while let Some(block) = leaf.next() {
                    if triangles::<M, Q>(block, first_number, &ray, probe, best) {
                        return true;
                    }
                }
            }
            Kind::Spheres => {
                for block in &tree.spheres[blocks(next)] {
                    if spheres::<M, Q>(block, &ray, probe, best) {
                        return true;
                    }
                }
            }
            Kind::Instances => {
                let instance = &tree.instances[next.index() >> 2];
                if OUTER && (instance.opaque || !Q::ANY) {
                    let mesh = &meshes[instance.mesh as usize];
                    let local = probe.in_space(&instance.space, mesh.extent);
                    if let Some(local) = local
                        && local.ray.t_min <= best.t
                        && walk::<M, Q, false>(
                            mesh,
                            &[],
                            Reference::ROOT,
                            instance.first_primitive,
                            &local,
                            best,
                            &mut stack[waiting..],
                        )
                    {
                        return true;
                    }
                }
            }
        }
        loop {
            if waiting == 0 {
                return false;
            }
            waiting -= 1;
            // An equal distance is not pruned: of hits at the same `t` the lowest number wins, wherever it stands.
            if stack[waiting].near <= best.t {
                next = stack[waiting].reference;
                break;
            }
        }
    }
}

/// Offers the hits of a block's triangles; true where any hit will do and there is an opaque one.
#[inline(always)]
fn triangles<M: Machine, Q: Question>(
    block: &TriangleBlock,
    first_number: u32,
    ray: &Spread<M::F8>,
    probe: &Probe,
    best: &mut Best,
) -> bool {
    let crossing = ray.cross(block);
    if crossing.inside == 0 {
        return false;
    }
    let place = crossing.place(ray.per_unit);
    let end = M::F8::splat(best.t.min(probe.ray.t_max));
    let mut hit = crossing.inside & ray.t_min.le(place.t) & place.t.le(end);
    if hit == 0 {
        return false;
    }
    hit &= ray.in_own_box(block, place.t);
    let (mut t, mut v, mut w) = ([0.0; 8], [0.0; 8], [0.0; 8]);
    place.t.store(&mut t);
    place.barycentric[0].store(&mut v);
    place.barycentric[1].store(&mut w);
    while hit != 0 {
        let lane = first(hit) & 7;
        hit &= hit - 1;
        let number = block.numbers[lane];
        if (Q::ANY && !number.is_opaque())
            || !probe.ray.admits(t[lane], first_number + number.get())
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

/// Offers the hits of a block's spheres, one after another; true where any hit will do and there is an opaque one.
#[inline(always)]
fn spheres<M: Machine, Q: Question>(
    block: &SphereBlock,
    ray: &Spread<M::F8>,
    probe: &Probe,
    best: &mut Best,
) -> bool {
    let radius = M::F8::load(&block.radius);
    let [x, y, z] = rows::<M::F8, 8>(&block.center);
    let corners = [
        [x - radius, y - radius, z - radius],
        [x + radius, y + radius, z + radius],
    ];
    let (enter, leave) = ray.interval(&corners);
    let end = M::F8::splat(best.t);
    let mut met = enter.max(ray.t_min).le(leave.min(end));
    while met != 0 {
        let lane = first(met) & 7;
        met &= met - 1;
        let number = block.numbers[lane];
        if Q::ANY && !number.is_opaque() {
            continue;
        }
        if let Some(hit) = sphere(&block.sphere(lane), probe, number.get()) {
            if Q::ANY {
                return true;
            }
            best.offer(hit.t, hit.primitive, hit.barycentric);
        }
    }
    false
}
