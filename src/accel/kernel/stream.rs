//! A few rays' way through a tree, together: each is tested by itself, but against a node that is there already.
//!
//! Rays of one octant that are too unlike, or too few, for a packet's interval. A single ray waits for each test before
//! it knows the next; tests of different rays wait for nothing. (Tsakok 2009, "Faster Incoherent Rays: Multi-BVH Ray
//! Stream Tracing"; Barringer and Akenine-Moeller 2014, "Dynamic Ray Stream Traversal".) `benches/rays.rs`, `mesh`:
//! next to Embree's, incoherent rays went from 0.88 to 1.3, mirror rays from 1.5 to 1.9 and more.

use super::alone::Search;
use super::answer::Question;
use super::bundle::Octant;
use super::float::{Float, Machine, Sets, Task};
use super::rays::Rays;
use super::single::prefetch;
use super::spread::{Slabs, Spread, first, sides};
use crate::accel::tree::TriangleBlock;
use crate::accel::wide::{Kind, Node, Reference};
use std::marker::PhantomData;

/// What waits to be visited, and by whom; `near` is where the first of them enters it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Few {
    reference: Reference,
    near: f32,
    live: u64,
}

impl Few {
    pub(super) const NOTHING: Few = Few {
        reference: Reference::NONE,
        near: 0.0,
        live: 0,
    };
}

/// Rays of one octant, on their way from `start` down.
struct Stream<'a, 'b, Q> {
    search: &'a mut Search<'b>,
    octant: Octant,
    start: Reference,
    live: u64,
    stack: &'a mut [Few],
    question: PhantomData<Q>,
}

/// Follows the rays of `live`, all of `octant`, from `start` down. The stack has room for the whole way.
#[inline(always)]
pub(super) fn walk<M: Machine, Q: Question>(
    search: &mut Search,
    octant: Octant,
    start: Reference,
    live: u64,
    stack: &mut [Few],
) {
    M::run(Stream::<Q> {
        search,
        octant,
        start,
        live,
        stack,
        question: PhantomData,
    });
}

impl<Q: Question> Task for Stream<'_, '_, Q> {
    type Output = ();

    #[inline(always)]
    fn run<M: Machine>(self) {
        let Stream {
            search,
            octant,
            start,
            mut live,
            stack,
            ..
        } = self;
        let tree = &search.accel.world;
        let mut waiting = 0;
        let mut next = start;
        loop {
            match next.kind() {
                _ if live.is_power_of_two() => search.alone::<M, Q>(octant, next, live),
                Kind::Node => {
                    let Some(node) = tree.nodes.get(next.index()) else {
                        return;
                    };
                    let (sets, nears, mut any) = meets::<M>(search.rays, octant, node, live);
                    let bottom = waiting;
                    while any != 0 {
                        let slot = first(any) & 7;
                        any &= any - 1;
                        let new = Few {
                            reference: node.children[slot],
                            near: nears[slot],
                            live: sets[slot],
                        };
                        let mut at = waiting;
                        while at > bottom && stack[at - 1].near < new.near {
                            stack[at] = stack[at - 1];
                            at -= 1;
                        }
                        stack[at] = new;
                        waiting += 1;
                        prefetch::<M>(tree, new.reference);
                    }
                }
                Kind::Triangles => {
                    let mut leaf = tree.leaf(next);
                    while let Some(block) = leaf.next() {
                        triangles::<M, Q>(search, octant, block, live & search.rays.live);
                    }
                }
                Kind::Spheres | Kind::Instances => search.alone::<M, Q>(octant, next, live),
            }
            loop {
                if waiting == 0 {
                    return;
                }
                waiting -= 1;
                let top = stack[waiting];
                live = top.live & search.rays.live;
                if !Q::ANY {
                    live &= search.rays.reaching::<M::F16>(top.near);
                }
                if live != 0 {
                    next = top.reference;
                    break;
                }
            }
        }
    }
}

/// Which rays of `live`, all of `octant`, meet each child of a node; where the first of them enters it; and the children
/// that any meets.
#[inline(always)]
fn meets<M: Machine>(
    rays: &Rays,
    octant: Octant,
    node: &Node,
    mut live: u64,
) -> ([u64; 8], [f32; 8], u32) {
    let sides = sides::<M::F8>(node, octant);
    let (mut sets, mut any) = (M::Sets::none(), 0);
    let mut nearest = M::F8::splat(f32::INFINITY);
    while live != 0 {
        let lane = live.trailing_zeros() as usize;
        live &= live - 1;
        let (enter, met) = Slabs::<M::F8>::of(rays, lane).meets(sides, rays.t.get(lane));
        sets.add(met, lane);
        any |= met;
        nearest = M::F8::select(met, enter.min(nearest), nearest);
    }
    let mut nears = [0.0; 8];
    nearest.store(&mut nears);
    (sets.get(), nears, any)
}

/// Tests each ray of `live`, all of `octant`, against the block's triangles.
#[inline(always)]
fn triangles<M: Machine, Q: Question>(
    search: &mut Search,
    octant: Octant,
    block: &TriangleBlock,
    mut live: u64,
) {
    while live != 0 {
        let lane = live.trailing_zeros() as usize;
        live &= live - 1;
        let Some(ray) = search.chunk.get(lane) else {
            return;
        };
        let wide = Spread::<M::F8>::of(search.rays, octant, lane);
        let before = search.rays.best(lane);
        let mut best = before;
        if wide.triangles::<Q>(block, 0, ray, before.t, &mut best) {
            search.rays.live &= !(1 << lane);
        } else if !Q::ANY && best.number != before.number {
            search.rays.set_best(lane, &best);
        }
    }
}
