//! The infinite plane.

use super::{SurfacePoint, error_bound};
use crate::ray::Ray;
use glam::{DVec3, Vec3};

/// All points `P` with `n . (P - Q) = 0` (paper, eq. 7).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Plane {
    /// `Q`, a point of the plane.
    pub point: Vec3,
    /// `n`, unit length.
    pub normal: Vec3,
}

impl Plane {
    /// The `t` at which the ray meets the plane: `t = n . (Q - C) / (n . d)` (paper, eq. 8), where the ray admits
    /// it. A ray parallel to the plane misses it, also one that runs inside it.
    pub fn intersect(&self, ray: &Ray, primitive: u32) -> Option<f32> {
        let t = self.double_t(ray) as f32;
        // False for the 0/0 of a ray inside the plane, and for the x/0 of a parallel one.
        (t.is_finite() && ray.admits(t, primitive)).then_some(t)
    }

    /// In `f64`: near the horizon neighbouring rays land far apart.
    fn double_t(&self, ray: &Ray) -> f64 {
        let n = self.normal.as_dvec3();
        let to_plane = self.point.as_dvec3() - ray.origin.as_dvec3();
        n.dot(to_plane) / n.dot(ray.direction.as_dvec3())
    }

    /// Where the ray meets the plane, before it is rounded to 32 bits.
    pub fn double_position(&self, ray: &Ray) -> DVec3 {
        ray.origin.as_dvec3() + ray.direction.as_dvec3() * self.double_t(ray)
    }

    /// The point where `ray` meets the plane.
    pub fn surface_point(&self, ray: &Ray) -> SurfacePoint {
        let position = self.double_position(ray).as_vec3();
        let error = error_bound(position.abs().max_element());
        SurfacePoint {
            position,
            error,
            normal: self.normal,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const FLOOR: Plane = Plane {
        point: Vec3::new(3.0, -1.0, 8.0),
        normal: Vec3::Y,
    };

    #[test]
    fn a_slanted_ray_meets_the_floor_where_trigonometry_says() {
        let ray = Ray::new(
            Vec3::ZERO,
            Vec3::new(3.0, -4.0, 0.0) / 5.0,
            0.0,
            f32::INFINITY,
        );
        assert!((FLOOR.intersect(&ray, 0).unwrap_or(f32::NAN) - 1.25).abs() < 1e-6);
    }

    #[test]
    fn parallel_rays_and_planes_behind_are_missed() {
        let parallel = Ray::new(Vec3::ZERO, Vec3::X, 0.0, f32::INFINITY);
        let inside = Ray::new(Vec3::new(0.0, -1.0, 0.0), Vec3::X, 0.0, f32::INFINITY);
        let behind = Ray::new(Vec3::ZERO, Vec3::Y, 0.0, f32::INFINITY);
        for ray in [parallel, inside, behind] {
            assert_eq!(FLOOR.intersect(&ray, 0), None);
        }
    }

    #[test]
    fn the_point_lies_on_the_plane_again() {
        let ray = Ray::new(
            Vec3::new(0.1, 0.7, 0.3),
            Vec3::new(0.9, -0.1, 0.2).normalize(),
            0.0,
            f32::INFINITY,
        );
        assert_eq!(FLOOR.surface_point(&ray).position.y, -1.0);
    }
}
