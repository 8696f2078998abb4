//! A floor under a model that is seen only by what it takes away: shadows.

use crate::ray::Ray;
use glam::Vec3;

/// A level floor of a colour that does not matter: where all light reaches it one sees what lies behind it, where none
/// does it is black. Its coverage is the share of light that is missing. Only rays from above meet it; light goes through
/// it from below, and shadow rays never meet it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Ground {
    /// The point under the middle of what stands on it, world space; +Y is up.
    pub center: Vec3,
    /// Up to here from its centre it is wholly there; at twice this radius it has faded away.
    pub radius: f32,
    /// The share of light that it mirrors, 0..1.
    pub reflectivity: f32,
}

/// What the ground is called where objects and materials have names.
pub const GROUND: &str = "ground";

impl Ground {
    /// Where `ray` meets it, as the ray's `t`, before `t_max`.
    pub fn meets(&self, ray: &Ray, t_max: f32) -> Option<f32> {
        let (height, d) = (ray.origin.y - self.center.y, ray.direction.y);
        // Written to be false for NaN.
        let t = -height / d;
        let falls = height > 0.0 && d < 0.0 && t > ray.t_min && t <= ray.t_max && t < t_max;
        (falls && self.presence(ray.point_at(t)) > 0.0).then_some(t)
    }

    /// How much of it is there at a point of its plane, 0..1.
    pub fn presence(&self, point: Vec3) -> f32 {
        let (x, z) = (point.x - self.center.x, point.z - self.center.z);
        let beyond = (x * x + z * z).sqrt() / self.radius - 1.0;
        let left = 1.0 - beyond.clamp(0.0, 1.0);
        left * left * (3.0 - 2.0 * left)
    }

    /// How far a point of it, found along a ray, may lie from it.
    pub fn error(&self, point: Vec3) -> f32 {
        2.0 * f32::EPSILON * point.abs().max_element()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const GROUND: Ground = Ground {
        center: Vec3::new(1.0, -2.0, 0.0),
        radius: 3.0,
        reflectivity: 0.0,
    };

    #[test]
    fn only_rays_from_above_meet_it() {
        let meets = |y: f32, d: Vec3| {
            let ray = Ray::new(Vec3::new(1.0, y, 0.0), d, 0.0, f32::INFINITY);
            GROUND.meets(&ray, f32::INFINITY)
        };
        assert_eq!(meets(3.0, Vec3::NEG_Y), Some(5.0));
        assert_eq!(meets(3.0, Vec3::Y), None);
        assert_eq!(meets(3.0, Vec3::X), None);
        assert_eq!(meets(-3.0, Vec3::Y), None);
        assert_eq!(meets(-3.0, Vec3::NEG_Y), None);
    }

    #[test]
    fn what_stands_before_it_hides_it() {
        let ray = Ray::new(Vec3::Y * 3.0, Vec3::NEG_Y, 0.0, f32::INFINITY);
        assert_eq!(GROUND.meets(&ray, 4.0), None);
        let short = Ray { t_max: 4.0, ..ray };
        assert_eq!(GROUND.meets(&short, f32::INFINITY), None);
    }

    #[test]
    fn it_fades_between_its_radius_and_twice_that() {
        let at = |x: f32| GROUND.presence(Vec3::new(1.0 + x, -2.0, 0.0));
        assert_eq!(
            [at(0.0), at(3.0), at(-4.5), at(6.0), at(100.0)],
            [1.0, 1.0, 0.5, 0.0, 0.0]
        );
    }
}
