//! A ray, and the one place where a ray is moved off the surface it leaves.

use glam::Vec3;

/// The half line `R(t) = C + t d` between two limits of `t` (paper, eq. 6).
///
/// Both limits belong to the ray. `direction` is unit length for every ray the picture is made of; inside the space
/// of an instance it is not, so that `t` means the same in both spaces. No component of it is ever `-0.0`.
#[derive(Clone, Copy, Debug, PartialEq)]
#[repr(C)]
pub struct Ray {
    /// `C`, world space.
    pub origin: Vec3,
    /// `d`.
    pub direction: Vec3,
    /// The least accepted `t`.
    pub t_min: f32,
    /// The greatest accepted `t`; infinity where there is none.
    pub t_max: f32,
    /// At exactly `t_min` only primitives with a number above this one count. A ray that went through a transparent
    /// surface goes on so, and loses no layer that coincides with the one it left.
    pub after: Option<u32>,
}

impl Ray {
    /// A ray from `origin` along `direction`, which keeps its length.
    #[inline(always)]
    pub fn new(origin: Vec3, direction: Vec3, t_min: f32, t_max: f32) -> Ray {
        // `-0.0 + 0.0` is `+0.0`: the sign of a zero would otherwise choose a slab's near plane.
        Ray {
            origin,
            direction: direction + Vec3::ZERO,
            t_min,
            t_max,
            after: None,
        }
    }

    /// A ray that leaves a surface at `point`, to `t_max` at most, and does not meet that surface again at once.
    ///
    /// `normal` is the surface's own (geometric) unit normal, on either side; `error` bounds how far `point` may lie
    /// from the true surface, in the scene's unit. The origin moves off the surface along the normal, to the side
    /// that `direction` goes to, by twice that error: wide enough for the rounding of the next intersection test,
    /// which is of the same order. (Wächter and Binder, "A Fast and Robust Method for Avoiding
    /// Self-Intersection", Ray Tracing Gems, ch. 6, has the idea; the bound here is each primitive's own.)
    pub fn leaving(point: Vec3, normal: Vec3, error: f32, direction: Vec3, t_max: f32) -> Ray {
        let side = if normal.dot(direction) < 0.0 {
            -1.0
        } else {
            1.0
        };
        // Not from 0: at the very origin of the world the error is 0, and the surface would be met at once.
        Ray::new(
            point + normal * (side * 2.0 * error),
            direction,
            f32::MIN_POSITIVE,
            t_max,
        )
    }

    /// A ray from a light at `light` to a surface, which it does not meet; the surface faces the light.
    ///
    /// `point`, `normal` (on the light's side) and `error` are the surface's as for [`Ray::leaving`]. The ray ends off
    /// the surface, higher than [`Ray::leaving`] starts: the rounding of its direction, and of the intersection test at
    /// that distance, come to it. It begins a little past the light, so that a surface that holds the light does not
    /// hide it. `None` where the light is so far that it would end too high, or so near that it would not end before
    /// the surface: then a ray has to leave the surface.
    pub fn reaching(point: Vec3, normal: Vec3, error: f32, light: Vec3) -> Option<Ray> {
        let (ray, fits) = Ray::aimed(point, normal, error, light);
        fits.then_some(ray)
    }

    /// [`Ray::reaching`], and whether there is such a ray. Without a branch, so that a loop over points becomes one over
    /// registers.
    #[inline(always)]
    pub fn aimed(point: Vec3, normal: Vec3, error: f32, light: Vec3) -> (Ray, bool) {
        let way = point - light;
        let distance = way.length_squared().sqrt();
        let of_surface = 2.0 * error;
        // One ulp for the direction's coordinates, two for the test's shear, one for its difference of positions.
        let of_way = 4.0 * f32::EPSILON * distance;
        let height = of_surface + of_way;
        // Written to be false for NaN.
        let fits = (of_way <= MOST_HEIGHT * of_surface) & (height <= LEAST_WAY * distance);
        let way = way + normal * height;
        let distance = way.length_squared().sqrt();
        let ray = Ray::new(
            light,
            way * (1.0 / distance),
            distance * AT_LIGHT,
            distance * (1.0 - 4.0 * f32::EPSILON),
        );
        (ray, fits)
    }

    /// `R(t)` (paper, eq. 6).
    pub fn point_at(&self, t: f32) -> Vec3 {
        self.origin + self.direction * t
    }

    /// Whether a hit of `primitive` at `t` lies on the ray. False for a `t` that is not a number.
    pub fn admits(&self, t: f32, primitive: u32) -> bool {
        let from_start =
            t > self.t_min || (t == self.t_min && self.after.is_none_or(|last| primitive > last));
        from_start && t <= self.t_max
    }

    /// The rest of this ray past a hit: what follows in the order of (`t`, primitive).
    pub fn beyond(&self, t: f32, primitive: u32) -> Ray {
        Ray {
            t_min: t,
            after: Some(primitive),
            ..*self
        }
    }

    /// The part of this ray inside `[near, far]`.
    pub fn clipped(&self, near: f32, far: f32) -> Ray {
        let (t_min, after) = if near > self.t_min {
            (near, None)
        } else {
            (self.t_min, self.after)
        };
        Ray {
            t_min,
            t_max: self.t_max.min(far),
            after,
            ..*self
        }
    }
}

/// The share of its way that a shadow ray keeps from its light.
pub const AT_LIGHT: f32 = 1e-6;
/// How many times higher than [`Ray::leaving`] starts a ray from a light may end: with triangles, and a bound of two
/// roundings, still below 1e-5 of their coordinates.
const MOST_HEIGHT: f32 = 16.0;
/// A ray from a light ends off the surface by this share of its way at most.
const LEAST_WAY: f32 = 0.01;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_direction_has_no_negative_zero() {
        let ray = Ray::new(Vec3::ZERO, -Vec3::Y, 0.0, 1.0);
        assert!(ray.direction.x.is_sign_positive() && ray.direction.z.is_sign_positive());
    }

    #[test]
    fn going_on_keeps_the_coincident_layers_above_the_one_left() {
        let ray = Ray::new(Vec3::ZERO, Vec3::X, 0.0, 10.0).beyond(2.0, 5);
        assert!(!ray.admits(1.9, 9) && !ray.admits(2.0, 5) && !ray.admits(2.0, 4));
        assert!(ray.admits(2.0, 6) && ray.admits(2.1, 0) && !ray.admits(f32::NAN, 9));
    }

    #[test]
    fn both_limits_belong_to_the_ray() {
        let ray = Ray::new(Vec3::ZERO, Vec3::X, 1.0, 2.0);
        assert!(ray.admits(1.0, 0) && ray.admits(2.0, 0));
    }

    #[test]
    fn a_leaving_ray_starts_on_the_side_it_goes_to() {
        let up = Ray::leaving(Vec3::ZERO, Vec3::Y, 1e-6, Vec3::Y, 1.0);
        let down = Ray::leaving(Vec3::ZERO, Vec3::Y, 1e-6, -Vec3::Y, 1.0);
        assert!(up.origin.y > 0.0 && down.origin.y < 0.0);
    }

    /// `t` at which the ray meets the plane through `point` with `normal`, in `f64`.
    fn meets(ray: &Ray, point: Vec3, normal: Vec3) -> f64 {
        let n = normal.as_dvec3();
        n.dot((point - ray.origin).as_dvec3()) / n.dot(ray.direction.as_dvec3())
    }

    /// The error of a triangle's point.
    fn error_of(point: Vec3) -> f32 {
        2.0 * f32::EPSILON * point.abs().max_element()
    }

    #[test]
    fn a_ray_from_a_light_ends_before_the_surface_at_any_angle_scale_and_place() {
        let normal = Vec3::new(0.36, 0.48, 0.8);
        let across = Vec3::new(0.8, -0.6, 0.0);
        for (scale, moved) in [(1.0, 0.0), (1e-3, 0.0), (1e3, 0.0), (1.0, 1e4)] {
            for steepness in [1.0, 0.1, 1e-2, 1e-3] {
                for step in 0..1000 {
                    let point = Vec3::new(1.0, 0.3 + step as f32 * 0.001, -0.7) * scale + moved;
                    let light = point + (across * 2.0 + normal * steepness) * scale;
                    if normal.dot(light - point) < 4.0 * error_of(point) {
                        continue; // Rounding has put this light into the surface or behind it.
                    }
                    let ray = Ray::reaching(point, normal, error_of(point), light);
                    let ray = ray.expect("near enough");
                    let (t, end) = (meets(&ray, point, normal), f64::from(ray.t_max));
                    // By more than the rounding of the test that will be made.
                    assert!(
                        t - end > end * 2e-7,
                        "{scale} {moved} {steepness}: {t} {end}"
                    );
                    // Contact shadows are kept: it ends close to the point.
                    let gap = (ray.point_at(ray.t_max) - point).length();
                    assert!(gap <= 1e-5 * (point.abs().max_element() + light.distance(point)));
                }
            }
        }
    }

    #[test]
    fn a_light_too_far_or_too_near_asks_for_a_ray_that_leaves() {
        let point = Vec3::new(1.0, 2.0, 3.0);
        let from = |light| Ray::reaching(point, Vec3::Y, error_of(point), light);
        assert!(from(point + Vec3::Y * 10.0).is_some());
        assert!(from(point + Vec3::Y * 1e6).is_none());
        assert!(from(point + Vec3::Y * 1e-5).is_none());
        assert!(from(point).is_none());
        // At the origin of the world a point has no error of its own: any way is too far.
        assert!(Ray::reaching(Vec3::ZERO, Vec3::Y, 0.0, Vec3::Y).is_none());
    }

    #[test]
    fn a_surface_that_holds_the_light_is_before_the_ray() {
        let point = Vec3::new(3.0, 0.0, 0.0);
        let ray = Ray::reaching(point, Vec3::Y, error_of(point), Vec3::Y * 4.0);
        assert!(
            ray.is_some_and(|ray| !ray.admits(0.0, 0)
                && !ray.admits(1e-6, 0)
                && ray.admits(1e-5, 0))
        );
    }
}
