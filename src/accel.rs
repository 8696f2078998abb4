//! Search: which primitive a ray meets first, and whether it meets any.
//!
//! Two questions, for one ray and for a batch: [`Accel::intersect`] and [`Accel::occluded`]. The answers are those of
//! [`linear`], which tries every primitive in order, bit for bit. A batch is faster the more its rays go the same way: the
//! camera's through a tile of pixels, those from one light.

mod build;
mod cost;
mod items;
#[expect(
    unsafe_code,
    reason = "registers and pages; every block says why it is sound"
)]
mod kernel;
pub mod linear;
mod options;
mod others;
mod primitive;
mod slab;
mod somewhere;
mod tree;
mod wide;

pub use cost::Tests;
pub use kernel::{Isa, IsaError};
pub use options::{Builder, Layout, Options, Preset};
pub use somewhere::Shadow;

use crate::geometry::{Hit, Plane};
use crate::ray::Ray;
use crate::scene::{InstanceSpace, Scene};
use glam::Vec3;
use items::{ItemsOfWorld, of_shared};
use kernel::{Best, Scratch};
use others::{Other, Others};
use somewhere::Somewhere;
use std::cell::RefCell;
use std::time::{Duration, Instant};
use tree::Tree;

/// A scene's primitives, ready to be searched.
///
/// Spheres and triangles in world space, and instances of shared meshes, stand in one tree; each shared mesh has a tree of
/// its own. Planes have no bounds and stand beside.
#[derive(Clone, Debug)]
pub struct Accel {
    planes: Vec<NumberedPlane>,
    world: Tree,
    meshes: Vec<Tree>,
    /// What stands in the place of these trees where another layout was asked for: they are empty then.
    others: Option<Others>,
    isa: Isa,
    packets: bool,
    transparent: Somewhere,
    anything: Somewhere,
    /// The most that a search leaves on its stack.
    stack_size: usize,
    statistics: Statistics,
}

/// A plane, which no box can hold, with its number.
#[derive(Clone, Copy, Debug)]
struct NumberedPlane {
    plane: Plane,
    number: u32,
    opaque: bool,
}

/// An instance of a mesh that has a tree of its own.
#[derive(Clone, Copy, Debug)]
struct SharedInstance {
    space: InstanceSpace,
    mesh: u32,
    first_primitive: u32,
    opaque: bool,
}

/// What was built, and what it took.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Statistics {
    /// Nodes of all trees that have children: up to eight each, two in [`Layout::Bvh2`].
    pub nodes: usize,
    /// Their leaves.
    pub leaves: usize,
    /// Nodes on the longest way from a root to a leaf, both levels added.
    pub depth: usize,
    /// Nodes, leaves and primitives as they lie in memory.
    pub bytes: usize,
    /// The surface-area cost of the tree over the world, a node and a primitive costing 1 each; without a tree, all
    /// primitives
    /// (MacDonald and Booth 1990, "Heuristics for ray tracing using space subdivision").
    pub sah_cost: f32,
    /// From the scene to the finished trees.
    pub build_time: Duration,
}

thread_local! {
    static SCRATCH: RefCell<Scratch> = RefCell::new(Scratch::new());
}

impl Accel {
    /// Builds the trees of a scene; an empty scene has empty ones.
    pub fn build(scene: &Scene, options: &Options) -> Accel {
        let start = Instant::now();
        let opaque = |material: u32| scene.material(material).is_opaque();
        let first_plane = scene.spheres().len() as u32;
        let planes = (first_plane..)
            .zip(scene.planes())
            .map(|(number, p)| NumberedPlane {
                plane: p.shape,
                number,
                opaque: opaque(p.material),
            })
            .collect();
        let mut accel = Accel {
            planes,
            meshes: Vec::new(),
            world: Tree::default(),
            others: None,
            isa: options.isa,
            packets: options.packets,
            transparent: Somewhere::transparent(scene),
            anything: Somewhere::anything(scene),
            stack_size: 0,
            statistics: Statistics::default(),
        };
        let world = || ItemsOfWorld::new(scene);
        match options.layout {
            Layout::Wide | Layout::Small => {
                accel.meshes = of_shared(scene, |mesh| Tree::of(mesh, options));
                accel.world = Tree::of(&world(), options);
            }
            Layout::Bvh2 | Layout::CwBvh | Layout::List => {
                accel.others = Some(Others {
                    meshes: of_shared(scene, |mesh| Other::of(mesh, options)),
                    world: Other::of(&world(), options),
                });
            }
        }
        let of_meshes = accel.meshes.iter().map(Tree::stack_size).max();
        accel.stack_size = accel.world.stack_size() + of_meshes.unwrap_or(0);
        accel.statistics = Statistics {
            build_time: start.elapsed(),
            ..accel.measure()
        };
        accel
    }

    /// The nearest primitive on the ray; of several at the same `t` the one with the lowest number.
    pub fn intersect(&self, ray: &Ray) -> Option<Hit> {
        let mut hits = Vec::new();
        self.intersect_all(std::slice::from_ref(ray), &mut hits);
        hits.pop().flatten()
    }

    /// [`Accel::intersect`] for each ray, into `hits`, which is cleared first.
    pub fn intersect_all(&self, rays: &[Ray], hits: &mut Vec<Option<Hit>>) {
        hits.clear();
        hits.reserve(rays.len());
        match &self.others {
            Some(others) => hits.extend(rays.iter().map(|ray| others.intersect(self, ray))),
            None => SCRATCH.with_borrow_mut(|scratch| kernel::closest(self, rays, scratch, hits)),
        }
    }

    /// Whether the ray meets any opaque primitive.
    pub fn occluded(&self, ray: &Ray) -> bool {
        let mut occluded = Vec::new();
        self.occluded_all(std::slice::from_ref(ray), &mut occluded);
        occluded.pop().unwrap_or(false)
    }

    /// [`Accel::occluded`] for each ray, into `occluded`, which is cleared first.
    pub fn occluded_all(&self, rays: &[Ray], occluded: &mut Vec<bool>) {
        occluded.clear();
        occluded.reserve(rays.len());
        match &self.others {
            Some(others) => occluded.extend(rays.iter().map(|ray| others.occluded(self, ray))),
            None => {
                SCRATCH.with_borrow_mut(|scratch| kernel::occluded(self, rays, scratch, occluded));
            }
        }
    }

    /// Whether anything in the scene lets some light through, so that [`Accel::occluded`] is not the whole answer.
    pub fn has_transparent(&self) -> bool {
        !self.transparent.is_nowhere()
    }

    /// False only where a ray meets nothing: quick, and not exact.
    pub fn may_meet(&self, ray: &Ray) -> bool {
        self.anything.may_be_met(ray)
    }

    /// Where on the plane `y = height` things may stand before a light that is infinitely far in the unit direction
    /// `to_light`, which points up: quick, and not exact.
    pub fn shadow(&self, height: f32, to_light: Vec3) -> Shadow {
        self.anything.shadow(height, to_light)
    }

    /// Whether the ray may meet such a thing; it does not where this is false.
    pub fn may_meet_transparent(&self, ray: &Ray) -> bool {
        self.transparent.may_be_met(ray)
    }

    /// The instruction set of the kernels that search.
    pub fn isa(&self) -> Isa {
        self.isa
    }

    /// What was built, and what it took.
    pub fn statistics(&self) -> &Statistics {
        &self.statistics
    }

    /// How many leaves of all trees hold one primitive or instance, how many two, and so on.
    pub fn leaf_sizes(&self) -> Vec<u64> {
        let mut sizes = Vec::new();
        for tree in self.meshes.iter().chain([&self.world]) {
            tree.add_leaf_sizes(&mut sizes);
        }
        for other in self.others.iter().flat_map(Others::all) {
            other.add_leaf_sizes(&mut sizes);
        }
        sizes
    }

    /// Offers a ray the planes that it meets.
    fn offer_planes(&self, ray: &Ray, best: &mut Best) {
        for p in &self.planes {
            if let Some(hit) = primitive::plane(&p.plane, ray, p.number) {
                best.offer(hit.t, hit.primitive, hit.barycentric);
            }
        }
    }

    fn meets_opaque_plane(&self, ray: &Ray) -> bool {
        let mut opaque = self.planes.iter().filter(|p| p.opaque);
        opaque.any(|p| primitive::plane(&p.plane, ray, p.number).is_some())
    }

    fn measure(&self) -> Statistics {
        let mut all = self.world.statistics();
        let mut meshes: Vec<Statistics> = self.meshes.iter().map(Tree::statistics).collect();
        if let Some(others) = &self.others {
            all = others.world.statistics();
            meshes = others.meshes.iter().map(Other::statistics).collect();
        }
        all.depth += meshes.iter().map(|mesh| mesh.depth).max().unwrap_or(0);
        for mesh in meshes {
            all.nodes += mesh.nodes;
            all.leaves += mesh.leaves;
            all.bytes += mesh.bytes;
        }
        all
    }
}
