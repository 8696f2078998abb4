//! One ray's way through a tree: eight boxes or eight triangles at a time.
//!
//! A node's eight children are tested at once; the nearest that is met is next, the others wait on the stack, nearest
//! on top (Wald, Benthin and Boulos 2008, "Getting Rid of Packets").

use super::answer::{Best, Question};
use super::equation::rows;
use super::float::{Float, Machine};
use super::spread::{Spread, first};
use crate::accel::SharedInstance;
use crate::accel::cost::Tally;
use crate::accel::primitive::{Probe, sphere};
use crate::accel::tree::{SphereBlock, Tree, blocks};
use crate::accel::wide::{Kind, Node, Reference};
use crate::ray::Ray;

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
pub(super) fn prefetch<M: Machine>(tree: &Tree, reference: Reference) {
    match reference.kind() {
        Kind::Node => {
            if let Some(node) = tree.nodes.get(reference.index()) {
                M::prefetch(&node.corners[0][0]);
                M::prefetch(&node.corners[0][2]);
                M::prefetch(&node.corners[1][1]);
                M::prefetch(&node.children);
            }
        }
        Kind::Triangles => {
            if let Some(block) = tree.triangles.get(reference.index() >> 2) {
                M::prefetch(&block.vertices[0][0]);
                M::prefetch(&block.vertices[0][2]);
                M::prefetch(&block.vertices[1][1]);
                M::prefetch(&block.vertices[2][0]);
                M::prefetch(&block.vertices[2][2]);
            }
        }
        _ => {}
    }
}

/// A tree to walk.
pub(super) struct Level<'a> {
    pub(super) tree: &'a Tree,
    /// The trees that its instances lead to.
    pub(super) meshes: &'a [Tree],
    /// What the numbers of its primitives start from.
    pub(super) first_number: u32,
}

/// Follows the ray from `start` down; hits go to `best`. True at once where the question is [`Any`] and one is opaque.
///
/// `wide` is `ray`, which is in the tree's space. `stack` has room for this tree and the meshes' trees. `tally` is told
/// of every test.
///
/// [`Any`]: super::answer::Any
#[inline(always)]
pub(super) fn walk<M: Machine, Q: Question, T: Tally, const OUTER: bool>(
    level: &Level,
    start: Reference,
    ray: &Ray,
    wide: &Spread<M::F8>,
    best: &mut Best,
    stack: &mut [Waiting],
    tally: &mut T,
) -> bool {
    let Level {
        tree, first_number, ..
    } = *level;
    let mut waiting = 0;
    let mut next = start;
    loop {
        match next.kind() {
            Kind::Node => {
                let Some(node) = tree.nodes.get(next.index()) else {
                    return false;
                };
                tally.node();
                let (enter, mut met) = wide.children(node, least(best.t, ray.t_max));
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
                    tally.block(&block.numbers);
                    let end = least(best.t, ray.t_max);
                    if wide.triangles::<Q>(block, first_number, ray, end, best) {
                        return true;
                    }
                }
            }
            Kind::Spheres => {
                let probe = Probe::new(*ray, tree.extent);
                for block in &tree.spheres[blocks(next)] {
                    tally.block(&block.numbers);
                    if spheres::<M, Q>(block, wide, &probe, best) {
                        return true;
                    }
                }
            }
            Kind::Instances => {
                let instance = &tree.instances[next.index() >> 2];
                if OUTER
                    && (instance.opaque || !Q::ANY)
                    && inside::<M, Q, T>(level, instance, ray, best, &mut stack[waiting..], tally)
                {
                    return true;
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

/// Follows the ray through an instance's own tree.
#[inline(always)]
fn inside<M: Machine, Q: Question, T: Tally>(
    level: &Level,
    instance: &SharedInstance,
    ray: &Ray,
    best: &mut Best,
    stack: &mut [Waiting],
    tally: &mut T,
) -> bool {
    let mesh = &level.meshes[instance.mesh as usize];
    let probe = Probe::new(*ray, level.tree.extent);
    let Some(local) = probe.in_space(&instance.space, mesh.extent) else {
        return false;
    };
    local.ray.t_min <= best.t
        && walk::<M, Q, T, false>(
            &Level {
                tree: mesh,
                meshes: &[],
                first_number: instance.first_primitive,
            },
            Reference::ROOT,
            &local.ray,
            &Spread::new(&local),
            best,
            stack,
            tally,
        )
}

/// The lesser of two numbers.
#[inline(always)]
fn least(a: f32, b: f32) -> f32 {
    if a < b { a } else { b }
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
    let mut met = ray.boxes(&corners, best.t);
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
