//! The sphereflake: spheres on spheres (Haines 1987, "A Proposal for Standard Graphics Environments").

use crate::geometry::Sphere;
use glam::Vec3;

/// A unit sphere with nine of a third its size on it, and so on for `depth` generations: `(9^(depth+1) - 1) / 8` in all.
pub fn sphereflake(depth: u32) -> Vec<Sphere> {
    let mut spheres = Vec::new();
    let mut open = vec![(
        Sphere {
            center: Vec3::ZERO,
            radius: 1.0,
        },
        Vec3::Y,
        depth,
    )];
    while let Some((sphere, up, generations)) = open.pop() {
        spheres.push(sphere);
        if generations > 0 {
            open.extend(children(up).map(|direction| {
                let radius = sphere.radius / 3.0;
                let center = sphere.center + direction * (sphere.radius + radius);
                (Sphere { center, radius }, direction, generations - 1)
            }));
        }
    }
    spheres
}

/// Six directions around the equator of `up` and three above them.
fn children(up: Vec3) -> impl Iterator<Item = Vec3> {
    let (e1, e2) = up.any_orthonormal_pair();
    let around = move |turn: f32, height: f32| {
        let angle = turn * std::f32::consts::TAU;
        let level = (1.0 - height * height).sqrt();
        e1 * (libm::cosf(angle) * level) + e2 * (libm::sinf(angle) * level) + up * height
    };
    let equator = (0..6).map(move |i| around(i as f32 / 6.0, 0.0));
    let above = (0..3).map(move |i| around((i as f32 + 0.25) / 3.0, 0.8));
    equator.chain(above)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn two_generations_are_ninety_one_spheres() {
        assert_eq!(sphereflake(2).len(), 91);
    }
}
