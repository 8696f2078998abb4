//! The sphere.

use super::{Bounds, SurfacePoint, rounding_of};
use crate::ray::Ray;
use glam::{DVec3, Vec3};

/// All points at distance `R` from `Q_s` (paper, eq. 9).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sphere {
    /// `Q_s`.
    pub center: Vec3,
    /// `R`, above zero.
    pub radius: f32,
}

impl Sphere {
    /// The nearest root of `a t^2 + b t + e = 0` (paper, eq. 10) that the ray admits.
    ///
    /// Two positive roots give the smaller, a double root is a tangent hit, one of each sign means that the ray starts
    /// inside, complex roots and two negative ones miss. `direction` need not be unit length.
    ///
    /// The schoolbook formula loses small spheres far away. This is the stable form: the discriminant from the
    /// distance between centre and ray, the root of greater magnitude first, the other from their product
    /// (Haines, Günther and Akenine-Möller, "Precision Improvements for Ray/Sphere Intersection", Ray Tracing Gems,
    /// ch. 7); in `f64`, since a sphere of radius 1e6 serves as ground for things of size 1.
    pub fn intersect(&self, ray: &Ray, primitive: u32) -> Option<f32> {
        let (d, radius) = (ray.direction.as_dvec3(), f64::from(self.radius));
        let f = ray.origin.as_dvec3() - self.center.as_dvec3();
        let a = d.dot(d);
        let half_b = -f.dot(d);
        let nearest = f + d * (half_b / a);
        let quarter_discriminant = a * (radius * radius - nearest.dot(nearest));
        if quarter_discriminant < 0.0 || quarter_discriminant.is_nan() {
            return None;
        }
        // e = |f|^2 - R^2 as a product: no squares of nearly equal size are subtracted.
        let distance = f.length();
        let e = (distance - radius) * (distance + radius);
        let q = half_b + quarter_discriminant.sqrt().copysign(half_b);
        let (t0, t1) = if q == 0.0 { (0.0, 0.0) } else { (e / q, q / a) };
        [t0.min(t1) as f32, t0.max(t1) as f32]
            .into_iter()
            .find(|&t| ray.admits(t, primitive))
    }

    /// The point at `t` along `ray`, moved along its radius back onto the sphere.
    pub fn surface_point(&self, ray: &Ray, t: f32) -> SurfacePoint {
        let center = self.center.as_dvec3();
        let p = ray.origin.as_dvec3() + ray.direction.as_dvec3() * f64::from(t);
        let normal = (p - center).normalize_or(DVec3::Y);
        let position = (center + normal * f64::from(self.radius)).as_vec3();
        let error = rounding_of(position.abs().max_element());
        SurfacePoint {
            position,
            error,
            normal: normal.as_vec3(),
        }
    }

    /// The smallest box around the sphere.
    pub fn bounds(&self) -> Bounds {
        Bounds {
            min: self.center - self.radius,
            max: self.center + self.radius,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const UNIT: Sphere = Sphere {
        center: Vec3::ZERO,
        radius: 1.0,
    };

    fn along_x(from: f32, height: f32) -> Ray {
        Ray::new(Vec3::new(from, height, 0.0), Vec3::X, 0.0, f32::INFINITY)
    }

    #[test]
    fn two_positive_roots_give_the_smaller() {
        assert_eq!(UNIT.intersect(&along_x(-3.0, 0.0), 0), Some(2.0));
    }

    #[test]
    fn a_double_root_is_a_tangent_hit() {
        assert_eq!(UNIT.intersect(&along_x(-3.0, 1.0), 0), Some(3.0));
    }

    #[test]
    fn from_inside_the_positive_root_counts() {
        assert_eq!(UNIT.intersect(&along_x(0.5, 0.0), 0), Some(0.5));
    }

    #[test]
    fn complex_roots_miss() {
        assert_eq!(UNIT.intersect(&along_x(-3.0, 1.001), 0), None);
    }

    #[test]
    fn two_negative_roots_miss() {
        assert_eq!(UNIT.intersect(&along_x(3.0, 0.0), 0), None);
    }

    #[test]
    fn a_near_limit_inside_the_sphere_shows_its_far_side() {
        let ray = Ray {
            t_min: 2.5,
            ..along_x(-3.0, 0.0)
        };
        assert_eq!(UNIT.intersect(&ray, 0), Some(4.0));
    }

    #[test]
    fn a_small_sphere_far_away_keeps_its_edge() {
        // The closed form says hit at 0.99 R, miss at 1.01 R.
        let small = Sphere {
            center: Vec3::new(1e5, 0.0, 0.0),
            radius: 1e-2,
        };
        assert!(small.intersect(&along_x(0.0, 0.99e-2), 0).is_some());
        assert!(small.intersect(&along_x(0.0, 1.01e-2), 0).is_none());
    }

    #[test]
    fn a_direction_twice_as_long_halves_t() {
        let ray = Ray::new(Vec3::new(-3.0, 0.0, 0.0), Vec3::X * 2.0, 0.0, f32::INFINITY);
        assert_eq!(UNIT.intersect(&ray, 0), Some(1.0));
    }

    #[test]
    fn the_point_lies_on_the_sphere_again() {
        let sphere = Sphere {
            center: Vec3::new(10.0, 20.0, 30.0),
            radius: 2.0,
        };
        let ray = Ray::new(Vec3::ZERO, sphere.center.normalize(), 0.0, f32::INFINITY);
        let t = sphere.intersect(&ray, 0).unwrap_or(f32::NAN);
        let point = sphere.surface_point(&ray, t);
        assert!(((point.position - sphere.center).length() - 2.0).abs() <= point.error);
    }
}
