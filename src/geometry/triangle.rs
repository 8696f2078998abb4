//! The triangle.

use super::{Bounds, SurfacePoint};
use crate::ray::Ray;
use glam::{Vec2, Vec3, Vec3Swizzles};

/// Three vertices, counter-clockwise seen from the front.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Triangle(pub [Vec3; 3]);

/// What of a ray every triangle test needs: the shear that makes it the third axis.
#[derive(Clone, Copy, Debug)]
pub struct RaySpace {
    origin: Vec3,
    /// The axis along which the direction is longest, which becomes the third.
    longest: Axis,
    slope: Vec2,
    per_unit: f32,
}

#[derive(Clone, Copy, Debug)]
enum Axis {
    X,
    Y,
    Z,
}

impl RaySpace {
    /// The part of a ray that its limits do not change.
    pub fn new(ray: &Ray) -> RaySpace {
        let length = ray.direction.abs();
        let longest = if length.x >= length.y && length.x >= length.z {
            Axis::X
        } else if length.y >= length.z {
            Axis::Y
        } else {
            Axis::Z
        };
        let d = longest.last(ray.direction);
        let per_unit = (1.0 / d.z).clamp(f32::MIN, f32::MAX);
        RaySpace {
            origin: ray.origin,
            longest,
            slope: d.xy() * per_unit,
            per_unit,
        }
    }

    /// The axes of the world in the order of this space: 0 is X.
    pub(crate) fn axes(&self) -> [usize; 3] {
        match self.longest {
            Axis::X => [1, 2, 0],
            Axis::Y => [2, 0, 1],
            Axis::Z => [0, 1, 2],
        }
    }

    /// What each unit along the third axis moves the ray along the first and the second.
    pub(crate) fn slope(&self) -> Vec2 {
        self.slope
    }

    /// `t` for each unit along the third axis.
    pub(crate) fn per_unit(&self) -> f32 {
        self.per_unit
    }

    /// A point in this space: its distance from the ray along two axes, and where along the third it is.
    fn place(&self, point: Vec3) -> Vec3 {
        let p = self.longest.last(point - self.origin);
        (p.xy() - self.slope * p.z).extend(p.z)
    }
}

impl Axis {
    /// `v` with this axis last, the others in turn.
    fn last(self, v: Vec3) -> Vec3 {
        match self {
            Axis::X => v.yzx(),
            Axis::Y => v.zxy(),
            Axis::Z => v,
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
    /// In the space where the ray is the third axis, an edge from `p` to `q` has the ray at the side given by the sign
    /// of `p_x q_y - p_y q_x`. The neighbour across the edge reckons the same with the sign turned, bit for bit, and
    /// around a vertex the errors are relative to its own distance from the ray: no line slips between two triangles
    /// or through a vertex. (Woop, Benthin and Wald 2013, "Watertight Ray/Triangle Intersection". The Plücker form
    /// `((p - q) x (p + q)) . d`, tried here first, let rays through at the vertices of an icosphere.) An edge-on or
    /// empty triangle has three zeros and is missed; comparisons are written to be false for NaN.
    ///
    /// `t` is the vertices' `t`, weighted like the point, so that it never leaves the triangle's own range, however
    /// grazing the ray.
    pub fn intersect(&self, ray: &RaySpace) -> Option<TriangleHit> {
        let [a, b, c] = self.0.map(|vertex| ray.place(vertex));
        let weight_a = b.x * c.y - b.y * c.x;
        let weight_b = c.x * a.y - c.y * a.x;
        let weight_c = a.x * b.y - a.y * b.x;
        let inside = (weight_a >= 0.0 && weight_b >= 0.0 && weight_c >= 0.0)
            || (weight_a <= 0.0 && weight_b <= 0.0 && weight_c <= 0.0);
        let sum = weight_a + weight_b + weight_c;
        if !inside || sum == 0.0 {
            return None;
        }
        let reciprocal = 1.0 / sum;
        let (v, w) = (weight_b * reciprocal, weight_c * reciprocal);
        let z = (1.0 - v - w) * a.z + v * b.z + w * c.z;
        Some(TriangleHit {
            t: z * ray.per_unit,
            barycentric: [v, w],
        })
    }

    /// The point with barycentric weights (`1 - v - w`, `v`, `w`).
    pub fn surface_point(&self, barycentric: [f32; 2]) -> SurfacePoint {
        let (point, sure) = self.point_and_normal(barycentric);
        let normal = if sure { point.normal } else { self.normal() };
        SurfacePoint { normal, ..point }
    }

    /// [`Triangle::surface_point`], and whether its normal is one: else the triangle is so small or large that
    /// [`Triangle::normal`] has to find it. Without a branch, so that a loop over triangles becomes one over registers.
    #[inline(always)]
    pub fn point_and_normal(&self, [v, w]: [f32; 2]) -> (SurfacePoint, bool) {
        let [a, b, c] = self.0;
        let position = a * (1.0 - v - w) + b * v + c * w;
        // Three products, two sums and the weights' own roundings.
        let greater = |x: f32, y: f32| if x > y { x } else { y };
        let of_vertices = |x: f32, y: f32, z: f32| greater(greater(x.abs(), y.abs()), z.abs());
        let magnitude = greater(
            greater(of_vertices(a.x, b.x, c.x), of_vertices(a.y, b.y, c.y)),
            of_vertices(a.z, b.z, c.z),
        );
        let n = (b - a).cross(c - a);
        let squared = n.length_squared();
        let point = SurfacePoint {
            position,
            error: 2.0 * f32::EPSILON * magnitude,
            normal: n * (1.0 / squared.sqrt()),
        };
        (point, (squared > 1e-30) & (squared < 1e30))
    }

    /// The unit normal of the front; `+Y` where the triangle has no area.
    pub fn normal(&self) -> Vec3 {
        let [a, b, c] = self.0;
        // Scaled first, by a power of two, which rounds nothing: the cross product of edges of 1e-20 would be zero.
        let (e1, e2) = (b - a, c - a);
        let size = e1.abs().max(e2.abs()).max_element();
        let size = f32::from_bits(size.to_bits() & f32::INFINITY.to_bits());
        let n = (e1 / size).cross(e2 / size);
        let squared = n.length_squared();
        if squared > 0.0 {
            n * (1.0 / squared.sqrt())
        } else {
            Vec3::Y
        }
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
