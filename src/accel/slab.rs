//! A ray against boxes.

use crate::geometry::Bounds;
use crate::ray::Ray;
use glam::Vec3;

/// How far a hit may lie outside the box of its primitive, relative to the coordinates: four times the rounding
/// errors of the triangle test (about 16 half units in the last place), and a power of two.
pub(super) const RELATIVE_PAD: f32 = 1.0 / 262_144.0;

/// A ray, made ready for the slab test (Kay and Kajiya 1986, "Ray Tracing Complex Scenes").
///
/// Boxes are tested as if grown by a pad that follows the coordinates, so that a primitive's own box holds every hit
/// that rounding lets its test find. Each step of the test is monotonic in the corners of the box, also after
/// rounding: a box around another one has an interval around the other's. So a hit inside its primitive's interval is
/// inside that of every node above it, and no traversal order can lose it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Slab {
    /// The origin, less the pad.
    pub(super) low: Vec3,
    /// The origin and the pad.
    pub(super) high: Vec3,
    /// `1/d`; where the ray is parallel to the slab the greatest finite number, since `0 * infinity` is none.
    pub(super) inverse: Vec3,
}

impl Slab {
    /// For boxes whose greatest absolute coordinate is `extent`.
    pub(super) fn new(ray: &Ray, extent: f32) -> Slab {
        let pad = RELATIVE_PAD * (ray.origin.abs().max_element() + extent);
        Slab {
            low: ray.origin - pad,
            high: ray.origin + pad,
            inverse: ray.direction.recip().clamp(Vec3::MIN, Vec3::MAX),
        }
    }

    /// Per axis, which corner of a box the ray comes to first: 0 is the least.
    pub(super) fn near(&self) -> [usize; 3] {
        self.inverse.to_array().map(|x| usize::from(x < 0.0))
    }

    /// From where to where the ray's line is inside a box; empty (`near > far`) where it misses.
    pub(super) fn interval(&self, bounds: &Bounds) -> (f32, f32) {
        let (mut near, mut far) = (f32::NEG_INFINITY, f32::INFINITY);
        for axis in 0..3 {
            let to_min = (bounds.min[axis] - self.high[axis]) * self.inverse[axis];
            let to_max = (bounds.max[axis] - self.low[axis]) * self.inverse[axis];
            let (enter, leave) = if self.inverse[axis] >= 0.0 {
                (to_min, to_max)
            } else {
                (to_max, to_min)
            };
            near = near.max(enter);
            far = far.min(leave);
        }
        (near, far)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const UNIT: Bounds = Bounds {
        min: Vec3::ZERO,
        max: Vec3::ONE,
    };

    fn interval(origin: Vec3, direction: Vec3) -> (f32, f32) {
        Slab::new(&Ray::new(origin, direction, 0.0, f32::INFINITY), 1.0).interval(&UNIT)
    }

    #[test]
    fn a_ray_through_the_middle_is_inside_for_the_length_of_the_box() {
        let (near, far) = interval(Vec3::new(-1.0, 0.5, 0.5), Vec3::X);
        assert!((near - 1.0).abs() < 1e-5 && (far - 2.0).abs() < 1e-5);
    }

    #[test]
    fn a_parallel_ray_in_a_face_is_inside_and_one_beside_it_is_not() {
        for face in [0.0, 1.0] {
            let (near, far) = interval(Vec3::new(-1.0, face, 0.5), Vec3::X);
            assert!(near <= far);
        }
        let (near, far) = interval(Vec3::new(-1.0, 1.001, 0.5), Vec3::X);
        assert!(near > far);
    }

    #[test]
    fn a_box_around_another_has_an_interval_around_the_others() {
        let inner = Bounds {
            min: Vec3::splat(0.3),
            max: Vec3::splat(0.300_000_1),
        };
        for direction in [
            Vec3::ONE,
            Vec3::new(1.0, 1e-30, 0.7),
            Vec3::new(-0.3, 0.2, -1e-8),
        ] {
            let slab = Slab::new(
                &Ray::new(Vec3::splat(0.3) - direction, direction, 0.0, 9.0),
                1.0,
            );
            let ((a, b), (c, d)) = (slab.interval(&UNIT), slab.interval(&inner));
            assert!(a <= c && d <= b);
        }
    }
}
