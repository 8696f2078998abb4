//! Where in a scene there is something of some kind.

use super::slab::Slab;
use crate::geometry::Bounds;
use crate::ray::Ray;
use crate::scene::Scene;
use glam::{Vec2, Vec3, Vec3Swizzles};

/// Where a ray may meet something of a kind.
#[derive(Clone, Copy, Debug)]
pub(super) enum Somewhere {
    /// Outside of every box: a plane is of that kind.
    Anywhere,
    /// In a box, which may be empty.
    Within(Bounds),
}

/// Where on a level plane something may stand before a light that is infinitely far.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Shadow {
    /// The least x and z.
    min: Vec2,
    /// The greatest.
    max: Vec2,
}

/// How far rounding may move a shadow's edge, as a share of the coordinates it is found with.
const ROUNDING: f32 = 1e-5;

impl Shadow {
    /// No shadow.
    pub const NOWHERE: Shadow = Shadow {
        min: Vec2::INFINITY,
        max: Vec2::NEG_INFINITY,
    };

    const ANYWHERE: Shadow = Shadow {
        min: Vec2::NEG_INFINITY,
        max: Vec2::INFINITY,
    };

    /// False only where nothing stands between a point of the plane and the light.
    #[inline]
    pub fn may_hold(&self, point: Vec3) -> bool {
        let (x, z) = (point.x, point.z);
        // Written to be true for NaN, and without a branch.
        !((x < self.min.x) | (x > self.max.x) | (z < self.min.y) | (z > self.max.y))
    }

    /// The least that holds both.
    pub fn union(self, other: Shadow) -> Shadow {
        Shadow {
            min: self.min.min(other.min),
            max: self.max.max(other.max),
        }
    }
}

impl Somewhere {
    /// The shadow that things of the kind may throw on the plane `y = height`, `to_light` being a unit vector that points
    /// up.
    pub(super) fn shadow(&self, height: f32, to_light: Vec3) -> Shadow {
        let Somewhere::Within(bounds) = self else {
            return Shadow::ANYWHERE;
        };
        if bounds.is_empty() || bounds.max.y <= height {
            return Shadow::NOWHERE;
        }
        // What lies at a height above the plane is moved away from the light, by its height.
        let slope = to_light.xz() / to_light.y;
        let [bottom, top] = [bounds.min.y.max(height), bounds.max.y].map(|y| slope * (y - height));
        let greatest = bounds
            .min
            .abs()
            .max(bounds.max.abs())
            .max_element()
            .max(height.abs());
        let reach = 1.0 + slope.length();
        let margin = ROUNDING * greatest * reach * reach;
        if !margin.is_finite() {
            return Shadow::ANYWHERE;
        }
        Shadow {
            min: bounds.min.xz() - bottom.max(top) - margin,
            max: bounds.max.xz() - bottom.min(top) + margin,
        }
    }

    /// What lets light through.
    pub(super) fn transparent(scene: &Scene) -> Somewhere {
        Somewhere::of(scene, |material| !scene.material(material).is_opaque())
    }

    /// Everything.
    pub(super) fn anything(scene: &Scene) -> Somewhere {
        Somewhere::of(scene, |_| true)
    }

    fn of(scene: &Scene, counts: impl Fn(u32) -> bool) -> Somewhere {
        if scene.planes().iter().any(|plane| counts(plane.material)) {
            return Somewhere::Anywhere;
        }
        let spheres = scene.spheres().iter().filter(|s| counts(s.material));
        let instances = scene.instances().iter();
        let instances = instances.filter(|i| counts(i.material));
        let of_instances = instances.map(|instance| match &instance.space {
            Some(space) => space.bounds,
            None => scene.mesh(instance.mesh).bounds(),
        });
        let all = spheres.map(|s| s.shape.bounds()).chain(of_instances);
        Somewhere::Within(all.fold(Bounds::EMPTY, Bounds::union))
    }

    pub(super) fn is_nowhere(&self) -> bool {
        matches!(self, Somewhere::Within(bounds) if bounds.is_empty())
    }

    /// False only where a ray meets nothing of the kind.
    pub(super) fn may_be_met(&self, ray: &Ray) -> bool {
        let Somewhere::Within(bounds) = self else {
            return true;
        };
        let (near, far) = Slab::new(ray, bounds.extent()).interval(bounds);
        // Written to be true for NaN.
        !(near > far || near > ray.t_max || far < ray.t_min)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_ray_may_meet_what_lies_between_its_ends() {
        let glass = Somewhere::Within(Bounds::around([Vec3::NEG_ONE, Vec3::ONE]));
        let meets = |x: f32, t_min: f32, t_max: f32| {
            let origin = Vec3::new(x, 0.0, 5.0);
            glass.may_be_met(&Ray::new(origin, Vec3::NEG_Z, t_min, t_max))
        };
        assert!(meets(0.0, 0.0, f32::INFINITY) && meets(1.0, 4.0, 4.5) && meets(-1.0, 6.0, 7.0));
        assert!(!meets(1.1, 0.0, f32::INFINITY) && !meets(0.0, 0.0, 3.9) && !meets(0.0, 6.1, 9.0));
        let ray = Ray::new(Vec3::ZERO, Vec3::X, 0.0, f32::INFINITY);
        assert!(Somewhere::Anywhere.may_be_met(&ray));
        assert!(Somewhere::Within(Bounds::EMPTY).is_nowhere());
    }

    #[test]
    fn a_shadow_lies_away_from_the_light_as_far_as_things_are_high() {
        let cube = Somewhere::Within(Bounds::around([Vec3::NEG_ONE, Vec3::ONE]));
        // Half as high as it is far: 2 and 4 above the plane move by 4 and 8.
        let shadow = cube.shadow(-3.0, Vec3::new(2.0, 1.0, 0.0).normalize());
        let holds = |x: f32, z: f32| shadow.may_hold(Vec3::new(x, -3.0, z));
        assert!(holds(-9.0, 0.0) && holds(-3.0, 0.0) && holds(-5.0, 1.0));
        assert!(!holds(-9.01, 0.0) && !holds(-2.99, 0.0) && !holds(-5.0, 1.01));
    }

    #[test]
    fn what_lies_below_a_plane_throws_no_shadow_on_it_and_a_plane_throws_it_anywhere() {
        let cube = Somewhere::Within(Bounds::around([Vec3::NEG_ONE, Vec3::ONE]));
        assert!(!cube.shadow(1.0, Vec3::Y).may_hold(Vec3::Y));
        assert!(Somewhere::Anywhere.shadow(1.0, Vec3::Y).may_hold(Vec3::Y));
        // Just above the horizon.
        let grazing = Vec3::new(1.0, 1e-40, 0.0);
        assert!(
            cube.shadow(-1.0, grazing)
                .may_hold(Vec3::new(-1e30, -1.0, 0.0))
        );
    }

    #[test]
    fn outside_of_its_shadow_no_ray_to_the_light_meets_a_thing() {
        let box_ = Bounds::around([Vec3::new(3.0, 0.0, -7.0), Vec3::new(5.0, 2.5, -4.0)]);
        let thing = Somewhere::Within(box_);
        for step in 1..40u8 {
            let angle = f32::from(step) * 0.6;
            let l = Vec3::new(libm::cosf(angle), f32::from(step) * 0.05, libm::sinf(angle));
            let l = l.normalize();
            let shadow = thing.shadow(-1.0, l);
            for (x, z) in (-50i8..50).flat_map(|x| (-50i8..50).map(move |z| (x, z))) {
                let point = Vec3::new(f32::from(x), -1.0, f32::from(z));
                let ray = Ray::new(point, l, f32::MIN_POSITIVE, f32::INFINITY);
                assert!(
                    shadow.may_hold(point) || !thing.may_be_met(&ray),
                    "{point} {l}"
                );
            }
        }
    }
}
