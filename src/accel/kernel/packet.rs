//! Up to 64 rays' way through a tree, together.
//!
//! All rays of a packet go into the same octant and along the same longest axis. A node's eight children are tested
//! at once against the interval of all rays; what is popped is tested exactly, sixteen rays at a time; a triangle of a
//! leaf that the interval reaches is tested against the rays that are left. Few rays go on in a [`stream`]. (Wald,
//! Boulos and Shirley 2007, "Ray Tracing Deformable Scenes Using Dynamic Bounding Volume Hierarchies"; Tsakok 2009,
//! "Faster Incoherent Rays: Multi-BVH Ray Stream Tracing", for the test by children.) `benches/rays.rs`, `interior`:
//! primary rays were 2.5 times as fast as in streams alone.

use super::alone::Search;
use super::answer::Question;
use super::bundle::Bundle;
use super::equation::{box_of, cross, interval, minus, pick, rows, spread};
use super::float::{Float, Machine};
use super::interval::Interval;
use super::rays::{get, three};
use super::single::prefetch;
use super::spread::first;
use super::stream::{self, Few};
use crate::accel::tree::TriangleBlock;
use crate::accel::wide::{Kind, Node, Reference};

/// So many rays or fewer are faster one by one.
const FEW: u32 = 8;

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

/// A bundle on its way. Where `COMMON`, all rays have one origin, and what depends on it is reckoned once.
struct Walk<'a, 'b, M: Machine, const COMMON: bool> {
    search: &'a mut Search<'b>,
    bundle: &'a Bundle,
    axes: [usize; 3],
    all: Interval<M::F8>,
    /// Beyond this nothing is of interest to any ray.
    end: f32,
}

impl<M: Machine, const COMMON: bool> Walk<'_, '_, M, COMMON> {
    /// Which of the rays in `live` meet the box of a node's child, before their ends.
    #[inline(always)]
    fn in_box(&self, node: &Node, slot: usize, live: u64) -> u64 {
        let slot = slot & 7;
        let [low, high] = &node.corners;
        let corners = [
            [low[0][slot], low[1][slot], low[2][slot]],
            [high[0][slot], high[1][slot], high[2][slot]],
        ];
        let rays = &*self.search.rays;
        let (mut near, mut far) = (
            pick(&corners, self.bundle.octant.near),
            pick(&corners, self.bundle.octant.far),
        );
        if COMMON {
            near = minus(near, get(&rays.to_near, self.bundle.first()));
            far = minus(far, get(&rays.to_far, self.bundle.first()));
        }
        let near = spread::<M::F16, 16>(near);
        let far = spread::<M::F16, 16>(far);
        let mut inside = 0;
        for group in 0..4 {
            let members = (live >> (16 * group)) as u32 & 0xffff;
            if members == 0 {
                continue;
            }
            let (mut near, mut far) = (near, far);
            if !COMMON {
                near = minus(near, three(&rays.to_near, group));
                far = minus(far, three(&rays.to_far, group));
            }
            let (enter, leave) = interval(near, far, three(&rays.inverse, group));
            let enter = enter.max(rays.t_min.group(group));
            let met = members & enter.le(leave.min(rays.t.group(group)));
            inside |= u64::from(met) << (16 * group);
        }
        inside
    }

    /// Tests the block's triangles that the interval reaches, each against all rays of `live`. Whether any was hit.
    #[inline(always)]
    fn triangles<Q: Question>(&mut self, block: &TriangleBlock, live: u64) -> bool {
        let [a, b, c] = &block.vertices;
        let corners = box_of::<M::F8, 8>([rows(a), rows(b), rows(c)]);
        let (near, far) = (
            pick(&corners, self.bundle.octant.near),
            pick(&corners, self.bundle.octant.far),
        );
        let (to_near, to_far) = (minus(near, self.all.to_near), minus(far, self.all.to_far));
        let (_, mut reached) = self.all.meets(to_near, to_far, self.end);
        if reached == 0 {
            return false;
        }
        let (near, far) = if COMMON {
            (to_near, to_far)
        } else {
            (near, far)
        };
        let mut prepared = Prepared::EMPTY;
        for axis in 0..3 {
            near[axis].store(&mut prepared.near[axis]);
            far[axis].store(&mut prepared.far[axis]);
            let from = self.axes[axis];
            let origin = if COMMON {
                self.search.rays.origin[from].get(self.bundle.first())
            } else {
                0.0
            };
            for (prepared, vertex) in prepared.vertices.iter_mut().zip(&block.vertices) {
                let row = M::F8::load(&vertex[from]);
                let row = if COMMON {
                    row - M::F8::splat(origin)
                } else {
                    row
                };
                row.store(&mut prepared[axis]);
            }
        }
        let mut any = false;
        while reached != 0 {
            let lane = first(reached) & 7;
            reached &= reached - 1;
            let number = block.numbers[lane];
            if Q::ANY && !number.is_opaque() {
                continue;
            }
            let bits = f32::from_bits(number.get());
            for group in 0..4 {
                let members = (live & self.search.rays.live) >> (16 * group);
                let members = members as u32 & 0xffff;
                if members != 0 {
                    any |= self.triangle::<Q>(&prepared, lane, bits, group, members);
                }
            }
        }
        any
    }

    /// One triangle against sixteen rays.
    #[inline(always)]
    fn triangle<Q: Question>(
        &mut self,
        prepared: &Prepared,
        lane: usize,
        number: f32,
        group: usize,
        members: u32,
    ) -> bool {
        let rays = &mut *self.search.rays;
        let [x, y, z] = self.axes;
        let [a, b, c] = &prepared.vertices;
        let mut vertices = [at(a, lane), at(b, lane), at(c, lane)];
        if !COMMON {
            let origin = [
                rays.origin[x].group(group),
                rays.origin[y].group(group),
                rays.origin[z].group(group),
            ];
            for vertex in &mut vertices {
                *vertex = minus(*vertex, origin);
            }
        }
        let slope = [rays.slope[0].group(group), rays.slope[1].group(group)];
        let crossing = cross::<M::F16, 16>(vertices, slope);
        let inside = crossing.inside & members;
        if inside == 0 {
            return false;
        }
        let place = crossing.place(rays.inverse[z].group(group));
        let best: M::F16 = rays.t.group(group);
        let t_min: M::F16 = rays.t_min.group(group);
        let mut hit = inside & t_min.le(place.t) & place.t.le(best);
        if hit == 0 {
            return false;
        }
        let (mut near, mut far) = (at(&prepared.near, lane), at(&prepared.far, lane));
        if !COMMON {
            near = minus(near, three(&rays.to_near, group));
            far = minus(far, three(&rays.to_far, group));
        }
        let (enter, leave) = interval::<M::F16, 16>(near, far, three(&rays.inverse, group));
        hit &= enter.le(place.t) & place.t.le(leave);
        if Q::ANY {
            rays.live &= !(u64::from(hit) << (16 * group));
            return hit != 0;
        }
        // Of hits at the same `t` the lowest number wins.
        let mut equal = hit & place.t.eq(best);
        while equal != 0 {
            let lane = first(equal) & 15;
            equal &= equal - 1;
            if number.to_bits() >= rays.number.get(16 * group + lane).to_bits() {
                hit &= !(1 << lane);
            }
        }
        let [v, w] = place.barycentric;
        rays.t.replace(group, hit, place.t);
        rays.number.replace(group, hit, M::F16::splat(number));
        rays.barycentric[0].replace(group, hit, v);
        rays.barycentric[1].replace(group, hit, w);
        hit != 0
    }
}

/// A block's triangles, ready for one bundle: the longest axis last, relative to the origin where that is common.
struct Prepared {
    vertices: [[[f32; 8]; 3]; 3],
    near: [[f32; 8]; 3],
    far: [[f32; 8]; 3],
}

impl Prepared {
    const EMPTY: Prepared = Prepared {
        vertices: [[[0.0; 8]; 3]; 3],
        near: [[0.0; 8]; 3],
        far: [[0.0; 8]; 3],
    };
}

/// One lane of three rows, in all lanes.
#[inline(always)]
fn at<F: Float<16>>(rows: &[[f32; 8]; 3], lane: usize) -> [F; 3] {
    let lane = lane & 7;
    spread([rows[0][lane], rows[1][lane], rows[2][lane]])
}

/// Follows the bundle's rays down the tree. The stack has room for the whole way.
#[inline(always)]
pub(super) fn walk<M: Machine, Q: Question, const COMMON: bool>(
    search: &mut Search,
    bundle: &Bundle,
    few: &mut [Few],
    stack: &mut [Waiting64],
) {
    let accel = search.accel;
    let tree = &accel.world;
    let all = Interval::<M::F8>::new::<M::F16>(search.rays, bundle);
    let end = search.rays.t.greatest::<M::F16>(bundle.members);
    let axes = search.rays.axes(bundle.first());
    let mut walk = Walk::<M, COMMON> {
        search,
        bundle,
        axes,
        all,
        end,
    };
    let mut waiting = 0;
    let (mut next, mut live) = (Reference::ROOT, bundle.members);
    loop {
        match next.kind() {
            _ if live.count_ones() <= FEW => {
                stream::walk::<M, Q>(walk.search, bundle.octant, next, live, few);
            }
            Kind::Node => {
                let Some(node) = tree.nodes.get(next.index()) else {
                    return;
                };
                let near = rows::<M::F8, 8>(&pick(&node.corners, bundle.octant.near));
                let far = rows::<M::F8, 8>(&pick(&node.corners, bundle.octant.far));
                let near = minus(near, walk.all.to_near);
                let far = minus(far, walk.all.to_far);
                let (enter, mut met) = walk.all.meets(near, far, walk.end);
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
                    prefetch::<M>(tree, new.reference);
                }
            }
            Kind::Triangles => {
                let mut any = false;
                let mut leaf = tree.leaf(next);
                while let Some(block) = leaf.next() {
                    any |= walk.triangles::<Q>(block, live);
                }
                if any && Q::ANY && walk.search.rays.live & bundle.members == 0 {
                    return;
                }
                if any && !Q::ANY {
                    walk.end = walk.search.rays.t.greatest::<M::F16>(bundle.members);
                }
            }
            Kind::Spheres | Kind::Instances => {
                walk.search.alone::<M, Q>(bundle.octant, next, live);
            }
        }
        loop {
            if waiting == 0 {
                return;
            }
            waiting -= 1;
            let top = stack[waiting];
            live = top.live & walk.search.rays.live;
            if top.near > walk.end || live == 0 {
                continue;
            }
            live = walk.in_box(&tree.nodes[top.parent as usize], top.slot as usize, live);
            if live != 0 {
                next = top.reference;
                break;
            }
        }
    }
}
