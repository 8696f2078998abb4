//! Search: which primitive a ray meets first, and whether it meets any.
//!
//! Two questions, for one ray and for a batch: [`Accel::intersect`] and [`Accel::occluded`]. The answers are those of
//! [`linear`], which tries every primitive in order, bit for bit.

mod build;
mod bvh;
pub mod linear;
mod primitive;
mod slab;
mod tree;
mod wide;

use crate::geometry::{Hit, Plane};
use crate::ray::Ray;
use crate::scene::{InstanceSpace, Scene};
use primitive::{MeshTriangle, Probe, WorldPrimitive, WorldShape};
use std::num::NonZeroU8;
use std::time::{Duration, Instant};
use tree::{Stack, Tree};

/// How a tree is built.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Options {
    /// How much time the build takes for how good a tree.
    pub preset: Preset,
    /// The most primitives a leaf may have; the preset's own choice where it is `None`.
    pub leaf_size: Option<NonZeroU8>,
    /// How the tree lies in memory.
    pub layout: Layout,
}

/// How a tree lies in memory.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Layout {
    /// Primitives in blocks of eight.
    #[default]
    Wide,
    /// Primitives in blocks of four, which fill better.
    Small,
}

/// How much time the build takes for how good a tree: obvhs's presets.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Preset {
    /// Seconds count, rays do not.
    Fastest,
    /// Between its neighbours.
    VeryFast,
    /// Between its neighbours.
    Fast,
    /// The best total for one picture.
    #[default]
    Medium,
    /// Between its neighbours.
    Slow,
    /// For many pictures of one scene.
    VerySlow,
}

/// A scene's primitives, ready to be searched.
///
/// Spheres and triangles in world space share one tree. Each mesh that instances share has a tree of its own, and the
/// instances one above those. Planes have no bounds and stand beside.
#[derive(Clone, Debug)]
pub struct Accel {
    planes: Vec<NumberedPlane>,
    world: Tree<WorldPrimitive>,
    meshes: Vec<Tree<MeshTriangle>>,
    instances: Tree<SharedInstance>,
    has_transparent: bool,
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
    /// Nodes of all trees.
    pub nodes: usize,
    /// Those of them that are leaves.
    pub leaves: usize,
    /// Nodes on the longest way from a root to a leaf, both levels added.
    pub depth: usize,
    /// Nodes and primitives as they lie in memory.
    pub bytes: usize,
    /// The surface-area cost of the tree over the world, a node and a primitive costing 1 each
    /// (MacDonald and Booth 1990, "Heuristics for ray tracing using space subdivision").
    pub sah_cost: f32,
    /// From the scene to the finished trees.
    pub build_time: Duration,
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

        let mut in_world: Vec<WorldPrimitive> = (0..)
            .zip(scene.spheres())
            .map(|(number, s)| WorldPrimitive {
                shape: WorldShape::Sphere(s.shape),
                number,
                opaque: opaque(s.material),
            })
            .collect();
        let mut meshes: Vec<Tree<MeshTriangle>> =
            scene.meshes().iter().map(|_| Tree::default()).collect();
        let mut shared = Vec::new();
        for instance in scene.instances() {
            let (mesh, first_primitive) = (scene.mesh(instance.mesh), instance.first_primitive);
            let opaque = opaque(instance.material);
            let triangles =
                (0..mesh.triangles.len() as u32).map(|index| (index, mesh.triangle(index)));
            match instance.space {
                None => in_world.extend(triangles.map(|(index, triangle)| WorldPrimitive {
                    shape: WorldShape::Triangle(triangle),
                    number: first_primitive + index,
                    opaque,
                })),
                Some(space) => {
                    let tree = &mut meshes[instance.mesh as usize];
                    if tree.is_empty() {
                        let triangles =
                            triangles.map(|(index, triangle)| MeshTriangle { triangle, index });
                        *tree = bvh::build(triangles.collect(), options);
                    }
                    shared.push(SharedInstance {
                        space,
                        mesh: instance.mesh,
                        first_primitive,
                        opaque,
                    });
                }
            }
        }
        let mut accel = Accel {
            planes,
            world: bvh::build(in_world, options),
            meshes,
            instances: bvh::build(shared, options),
            has_transparent: (0..scene.materials().len() as u32).any(|material| !opaque(material)),
            statistics: Statistics::default(),
        };
        accel.statistics = Statistics {
            build_time: start.elapsed(),
            ..accel.measure()
        };
        accel
    }

    /// The nearest primitive on the ray; of several at the same `t` the one with the lowest number.
    pub fn intersect(&self, ray: &Ray) -> Option<Hit> {
        self.nearest(ray, &mut Stacks::default())
    }

    /// [`Accel::intersect`] for each ray, into `hits`, which is cleared first.
    pub fn intersect_all(&self, rays: &[Ray], hits: &mut Vec<Option<Hit>>) {
        let mut stacks = Stacks::default();
        hits.clear();
        hits.extend(rays.iter().map(|ray| self.nearest(ray, &mut stacks)));
    }

    /// Whether the ray meets any opaque primitive.
    pub fn occluded(&self, ray: &Ray) -> bool {
        self.any(ray, &mut Stacks::default())
    }

    /// [`Accel::occluded`] for each ray, into `occluded`, which is cleared first.
    pub fn occluded_all(&self, rays: &[Ray], occluded: &mut Vec<bool>) {
        let mut stacks = Stacks::default();
        occluded.clear();
        occluded.extend(rays.iter().map(|ray| self.any(ray, &mut stacks)));
    }

    /// Whether any material of the scene lets some light through, so that [`Accel::occluded`] is not the whole answer.
    pub fn has_transparent(&self) -> bool {
        self.has_transparent
    }

    /// What was built, and what it took.
    pub fn statistics(&self) -> &Statistics {
        &self.statistics
    }

    fn nearest(&self, ray: &Ray, stacks: &mut Stacks) -> Option<Hit> {
        let mut probe = Probe::new(*ray, self.world.extent());
        let mut best = None;
        for p in &self.planes {
            probe.offer(primitive::plane(&p.plane, &probe.ray, p.number), &mut best);
        }
        self.world
            .nearest(&mut probe, &mut stacks.outer, |item, probe| {
                probe.offer(item.intersect(probe), &mut best)
            });
        let mut probe = probe.with_extent(self.instances.extent());
        self.instances
            .nearest(&mut probe, &mut stacks.outer, |instance, probe| {
                let mesh = &self.meshes[instance.mesh as usize];
                let Some(mut local) = probe.in_space(&instance.space, mesh.extent()) else {
                    return;
                };
                let first = instance.first_primitive;
                mesh.nearest(&mut local, &mut stacks.inner, |item, local| {
                    local.offer(item.intersect(local, first), &mut best);
                });
                probe.shorten(best);
            });
        best
    }

    fn any(&self, ray: &Ray, stacks: &mut Stacks) -> bool {
        let probe = Probe::new(*ray, self.world.extent());
        let plane_hit =
            |p: &NumberedPlane| p.opaque && primitive::plane(&p.plane, ray, p.number).is_some();
        if self.planes.iter().any(plane_hit) {
            return true;
        }
        if self.world.any(&probe, &mut stacks.outer, |item, probe| {
            item.opaque && item.intersect(probe).is_some()
        }) {
            return true;
        }
        let probe = probe.with_extent(self.instances.extent());
        self.instances
            .any(&probe, &mut stacks.outer, |instance, probe| {
                let mesh = &self.meshes[instance.mesh as usize];
                let first = instance.first_primitive;
                instance.opaque
                    && probe
                        .in_space(&instance.space, mesh.extent())
                        .is_some_and(|local| {
                            mesh.any(&local, &mut stacks.inner, |item, local| {
                                item.intersect(local, first).is_some()
                            })
                        })
            })
    }

    fn measure(&self) -> Statistics {
        let of_meshes = self.meshes.iter().map(Tree::measure);
        let deepest_mesh = of_meshes.clone().map(|m| m.depth).max().unwrap_or(0);
        let (world, instances) = (self.world.measure(), self.instances.measure());
        let all = of_meshes.fold(world, |a, b| a.with(&b)).with(&instances);
        let depth = world.depth.max(if instances.depth > 0 {
            instances.depth + deepest_mesh
        } else {
            0
        });
        let sah_cost = if world.nodes > 0 {
            world.sah_cost
        } else {
            instances.sah_cost
        };
        Statistics {
            depth,
            sah_cost,
            ..all
        }
    }
}

impl Statistics {
    fn with(self, other: &Statistics) -> Statistics {
        Statistics {
            nodes: self.nodes + other.nodes,
            leaves: self.leaves + other.leaves,
            bytes: self.bytes + other.bytes,
            ..self
        }
    }
}

/// The memory of a traversal, reused from ray to ray.
#[derive(Default)]
struct Stacks {
    outer: Stack,
    inner: Stack,
}
