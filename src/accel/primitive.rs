//! The tests of single primitives, which every way of searching shares.

use super::slab::Slab;
use crate::geometry::{Bounds, Hit, Plane, RaySpace, Sphere, Triangle};
use crate::ray::Ray;
use crate::scene::InstanceSpace;

/// A ray on its search, made ready for every test.
#[derive(Clone, Copy, Debug)]
pub(super) struct Probe {
    /// Its end comes nearer with every hit.
    pub(super) ray: Ray,
    space: RaySpace,
    pub(super) slab: Slab,
}

impl Probe {
    /// For primitives whose greatest absolute coordinate is `extent`.
    pub(super) fn new(ray: Ray, extent: f32) -> Probe {
        Probe {
            ray,
            space: RaySpace::new(&ray),
            slab: Slab::new(&ray, extent),
        }
    }

    /// The same ray for primitives of another extent.
    pub(super) fn with_extent(self, extent: f32) -> Probe {
        Probe {
            slab: Slab::new(&self.ray, extent),
            ..self
        }
    }

    /// The part of this ray inside an instance, in the space of its mesh; `None` where there is none.
    pub(super) fn in_space(&self, space: &InstanceSpace, mesh_extent: f32) -> Option<Probe> {
        let (near, far) = self.slab.interval(&space.bounds);
        let ray = self.ray.clipped(near, far);
        if ray.t_min > ray.t_max {
            return None;
        }
        let origin = space.to_object.transform_point3(ray.origin);
        let direction = space.to_object.transform_vector3(ray.direction);
        let local = Ray {
            after: ray.after,
            ..Ray::new(origin, direction, ray.t_min, ray.t_max)
        };
        Some(Probe::new(local, mesh_extent))
    }

    /// Takes a hit that comes before the best so far, and looks no further than it from then on.
    pub(super) fn offer(&mut self, hit: Option<Hit>, best: &mut Option<Hit>) {
        if let Some(hit) = hit
            && best.is_none_or(|best| hit.precedes(&best))
        {
            *best = Some(hit);
            self.shorten(*best);
        }
    }

    /// Looks no further than `best` from now on.
    pub(super) fn shorten(&mut self, best: Option<Hit>) {
        if let Some(best) = best {
            self.ray.t_max = self.ray.t_max.min(best.t);
        }
    }

    /// A triangle's hit, held against the ray's limits and the triangle's own box.
    fn triangle(&self, triangle: &Triangle, number: u32) -> Option<Hit> {
        let hit = triangle.intersect(&self.space)?;
        let (near, far) = self.slab.interval(&triangle.bounds());
        let holds = self.ray.admits(hit.t, number) && near <= hit.t && hit.t <= far;
        holds.then_some(Hit {
            t: hit.t,
            primitive: number,
            barycentric: hit.barycentric,
        })
    }
}

/// A plane's hit.
pub(super) fn plane(plane: &Plane, ray: &Ray, number: u32) -> Option<Hit> {
    plane.intersect(ray, number).map(|t| Hit {
        t,
        primitive: number,
        barycentric: [0.0; 2],
    })
}

/// A sphere or a triangle in world space.
#[derive(Clone, Copy, Debug)]
pub(super) struct WorldPrimitive {
    pub(super) shape: WorldShape,
    /// Among the scene's primitives.
    pub(super) number: u32,
    pub(super) opaque: bool,
}

/// What can stand in the tree over the world.
#[derive(Clone, Copy, Debug)]
pub(super) enum WorldShape {
    Triangle(Triangle),
    Sphere(Sphere),
}

/// A triangle in the space of its mesh.
#[derive(Clone, Copy, Debug)]
pub(super) struct MeshTriangle {
    pub(super) triangle: Triangle,
    /// Among the mesh's triangles.
    pub(super) index: u32,
}

impl WorldPrimitive {
    /// Where the probe meets it.
    pub(super) fn intersect(&self, probe: &Probe) -> Option<Hit> {
        match &self.shape {
            WorldShape::Triangle(triangle) => probe.triangle(triangle, self.number),
            WorldShape::Sphere(sphere) => {
                let (near, far) = probe.slab.interval(&sphere.bounds());
                let t = sphere.intersect(&probe.ray.clipped(near, far), self.number)?;
                Some(Hit {
                    t,
                    primitive: self.number,
                    barycentric: [0.0; 2],
                })
            }
        }
    }
}

impl MeshTriangle {
    /// Where the probe, in the space of the mesh, meets it; `first` is the number of the mesh's first triangle.
    pub(super) fn intersect(&self, probe: &Probe, first: u32) -> Option<Hit> {
        probe.triangle(&self.triangle, first + self.index)
    }
}

/// What has a box: what trees are made of.
pub(super) trait Bounded {
    fn bounds(&self) -> Bounds;
}

impl Bounded for WorldPrimitive {
    fn bounds(&self) -> Bounds {
        match &self.shape {
            WorldShape::Triangle(triangle) => triangle.bounds(),
            WorldShape::Sphere(sphere) => sphere.bounds(),
        }
    }
}

impl Bounded for MeshTriangle {
    fn bounds(&self) -> Bounds {
        self.triangle.bounds()
    }
}

impl Bounded for super::SharedInstance {
    fn bounds(&self) -> Bounds {
        self.space.bounds
    }
}
