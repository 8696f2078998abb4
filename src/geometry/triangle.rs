//! The triangle.

use super::{Bounds, SurfacePoint, error_bound};
use crate::ray::Ray;
use glam::Vec3;

/// Three vertices, counter-clockwise seen from the front.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle(pub [Vec3; 3]);

/// What of a ray every triangle test needs.
#[derive(Clone, Copy, Debug)]
pub struct RaySpace {
    origin: Vec3,
    direction: Vec3,
    /// `d / (d . d)`: the dot product with it is a distance along the ray, in units of `t`.
    per_t: Vec3,
}

impl RaySpace {
    /// The part of a ray that its limits do not change.
    pub fn new(ray: &Ray) -> RaySpace {
        let d = ray.direction;
        RaySpace {
            origin: ray.origin,
            direction: d,
            per_t: d / d.dot(d),
        }
    }
}

/// Where the line of a ray crosses a triangle.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TriangleHit {
    /// Along the ray, not yet held against its limits.
    pub t: f32,
    /// The weights of the second and the third vertex.
    pub barycentric: [f32; 2],
}

impl Triangle {
    /// Where the line of a ray crosses the triangle, from either side, edges and vertices included.
    ///
    /// With the vertices relative to the ray's origin, an edge from `p` to `q` has the line at the side given by the
    /// sign of `((q - p) x (q + p)) . d`, twice the Plücker product of both lines. The neighbour across the edge
    /// reckons the same products with the sign turned, bit for bit, so no line slips between the two: watertight. The
    /// difference and the sum keep the error relative to the edge (the plain `p x q` does not). An edge-on or empty
    /// triangle has three zeros and is missed; comparisons are written to be false for NaN.
    /// (Shevtsov, Soupikov and Kapustin 2007, "Ray-Triangle Intersection Algorithm for Modern CPU Architectures", has
    /// the Plücker form.)
    ///
    /// `t` is the vertices' distance along the ray, weighted like the point, so that it never leaves the triangle's
    /// own range, however grazing the ray.
    pub fn intersect(&self, ray: &RaySpace) -> Option<TriangleHit> {
        let [a, b, c] = self.0.map(|vertex| vertex - ray.origin);
        let d = ray.direction;
        let weight_a = (c - b).cross(c + b).dot(d);
        let weight_b = (a - c).cross(a + c).dot(d);
        let weight_c = (b - a).cross(b + a).dot(d);
        let inside = (weight_a >= 0.0 && weight_b >= 0.0 && weight_c >= 0.0)
            || (weight_a <= 0.0 && weight_b <= 0.0 && weight_c <= 0.0);
        let sum = weight_a + weight_b + weight_c;
        if !inside || sum == 0.0 {
            return None;
        }
        let (v, w) = (weight_b / sum, weight_c / sum);
        let u = 1.0 - v - w;
        let t = u * a.dot(ray.per_t) + v * b.dot(ray.per_t) + w * c.dot(ray.per_t);
        Some(TriangleHit {
            t,
            barycentric: [v, w],
        })
    }

    /// The point with barycentric weights (`1 - v - w`, `v`, `w`).
    pub fn surface_point(&self, [v, w]: [f32; 2]) -> SurfacePoint {
        let [a, b, c] = self.0;
        let position = a * (1.0 - v - w) + b * v + c * w;
        let magnitude = self.bounds().extent();
        SurfacePoint {
            position,
            error: error_bound(magnitude),
            normal: self.normal(),
        }
    }

    /// The unit normal of the front; `+Y` where the triangle has no area.
    pub fn normal(&self) -> Vec3 {
        let [a, b, c] = self.0;
        // Scaled first: the cross product of edges of 1e-20 would be zero.
        let (e1, e2) = (b - a, c - a);
        let size = e1.abs().max(e2.abs()).max_element();
        (e1 / size).cross(e2 / size).normalize_or(Vec3::Y)
    }

    /// Half the length of the cross product of two edges.
    pub fn area(&self) -> f32 {
        let [a, b, c] = self.0;
        (b - a).cross(c - a).length() * 0.5
    }

    /// The smallest box around the vertices.
    pub fn bounds(&self) -> Bounds {
        let [a, b, c] = self.0;
        Bounds {
            min: a.min(b).min(c),
            max: a.max(b).max(c),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn cross(triangle: &Triangle, origin: Vec3, direction: Vec3) -> Option<TriangleHit> {
        triangle.intersect(&RaySpace::new(&Ray::new(
            origin,
            direction,
            0.0,
            f32::INFINITY,
        )))
    }

    const RIGHT: Triangle = Triangle([Vec3::ZERO, Vec3::X, Vec3::Y]);

    #[test]
    fn barycentrics_and_t_are_those_of_the_point() {
        let hit =
            cross(&RIGHT, Vec3::new(0.25, 0.5, 3.0), Vec3::NEG_Z).map(|h| (h.t, h.barycentric));
        assert_eq!(hit, Some((3.0, [0.25, 0.5])));
    }

    #[test]
    fn both_sides_edges_and_vertices_are_hit() {
        for point in [
            Vec3::ZERO,
            Vec3::X,
            Vec3::Y,
            Vec3::new(0.5, 0.5, 0.0),
            Vec3::new(0.5, 0.0, 0.0),
        ] {
            assert!(cross(&RIGHT, point + Vec3::Z, Vec3::NEG_Z).is_some());
            assert!(cross(&RIGHT, point - Vec3::Z, Vec3::Z).is_some());
        }
        assert!(cross(&RIGHT, Vec3::new(0.51, 0.51, 1.0), Vec3::NEG_Z).is_none());
    }

    #[test]
    fn an_edge_on_or_empty_triangle_is_missed() {
        assert!(cross(&RIGHT, Vec3::new(-1.0, 0.25, 0.0), Vec3::X).is_none());
        let empty = Triangle([Vec3::ZERO, Vec3::X, Vec3::X * 2.0]);
        assert!(cross(&empty, Vec3::new(0.5, 0.0, 1.0), Vec3::NEG_Z).is_none());
        let point = Triangle([Vec3::ONE; 3]);
        assert!(cross(&point, Vec3::new(1.0, 1.0, 4.0), Vec3::NEG_Z).is_none());
    }

    #[test]
    fn numbers_that_are_not_miss() {
        let broken = Triangle([Vec3::NAN, Vec3::X, Vec3::Y]);
        assert!(cross(&broken, Vec3::new(0.2, 0.2, 1.0), Vec3::NEG_Z).is_none());
    }

    #[test]
    fn t_stays_within_the_triangle_at_a_grazing_ray() {
        let hit = cross(
            &RIGHT,
            Vec3::new(-10.0, 0.25, 1e-6),
            Vec3::new(1.0, 0.0, -9.8e-8),
        );
        assert!(hit.is_none_or(|h| (9.99..=11.01).contains(&h.t)));
    }

    #[test]
    fn a_tiny_triangle_has_a_normal() {
        assert_eq!(Triangle(RIGHT.0.map(|p| p * 1e-25)).normal(), Vec3::Z);
    }
}
