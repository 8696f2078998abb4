//! Where in a scene there is something of some kind.

use super::slab::Slab;
use crate::geometry::Bounds;
use crate::ray::Ray;
use crate::scene::Scene;

/// Where a ray may meet something of a kind.
#[derive(Clone, Copy, Debug)]
pub(super) enum Somewhere {
    /// Outside of every box: a plane is of that kind.
    Anywhere,
    /// In a box, which may be empty.
    Within(Bounds),
}

impl Somewhere {
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
    use glam::Vec3;

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
}
