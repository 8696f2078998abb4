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
}
