//! The tests of single primitives: what every kernel gives, bit for bit.

use super::slab::Slab;
use crate::geometry::{Hit, Plane, RaySpace, Sphere, Triangle};
use crate::ray::Ray;
use crate::scene::InstanceSpace;

/// A ray on its search, made ready for every test.
#[derive(Clone, Copy, Debug)]
pub(super) struct Probe {
    pub(super) ray: Ray,
    pub(super) space: RaySpace,
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
}

/// A triangle's hit, held against the ray's limits and the triangle's own box.
pub(super) fn triangle(triangle: &Triangle, probe: &Probe, number: u32) -> Option<Hit> {
    let hit = triangle.intersect(&probe.space)?;
    let (near, far) = probe.slab.interval(&triangle.bounds());
    let holds = probe.ray.admits(hit.t, number) && near <= hit.t && hit.t <= far;
    holds.then_some(Hit {
        t: hit.t,
        primitive: number,
        barycentric: hit.barycentric,
    })
}

/// A sphere's hit, held against the ray's limits and the sphere's own box.
pub(super) fn sphere(sphere: &Sphere, probe: &Probe, number: u32) -> Option<Hit> {
    let (near, far) = probe.slab.interval(&sphere.bounds());
    sphere
        .intersect(&probe.ray.clipped(near, far), number)
        .map(|t| plain(t, number))
}

/// A plane's hit.
pub(super) fn plane(plane: &Plane, ray: &Ray, number: u32) -> Option<Hit> {
    plane.intersect(ray, number).map(|t| plain(t, number))
}

/// A hit of a shape that has no vertices.
fn plain(t: f32, primitive: u32) -> Hit {
    Hit {
        t,
        primitive,
        barycentric: [0.0; 2],
    }
}
