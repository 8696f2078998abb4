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
            let nine = (0..9).filter_map(|number| child_of(&sphere, up, number));
            open.extend(nine.map(|(child, up)| (child, up, generations - 1)));
        }
    }
    spheres
}

/// The first `count` spheres, generation after generation; of the last one, an even share, if it is not whole.
pub fn sphereflake_of(count: u32) -> Vec<Sphere> {
    let root = Sphere {
        center: Vec3::ZERO,
        radius: 1.0,
    };
    let mut spheres = Vec::new();
    let mut generation = vec![(root, Vec3::Y)];
    loop {
        spheres.extend(generation.iter().map(|(sphere, _)| *sphere));
        let missing = count as usize - spheres.len().min(count as usize);
        if missing == 0 {
            spheres.truncate(count as usize);
            return spheres;
        }
        // Only those that are taken are made: a whole generation might be nine times as many.
        let next = generation.len() * 9;
        let share = missing.min(next);
        generation = (0..share)
            .filter_map(|i| {
                let child = (i as u64 * next as u64 / share as u64) as usize;
                let (parent, up) = generation.get(child / 9)?;
                child_of(parent, *up, child % 9)
            })
            .collect();
    }
}

/// One of the nine spheres on another, and its own way up.
fn child_of(parent: &Sphere, up: Vec3, number: usize) -> Option<(Sphere, Vec3)> {
    let direction = children(up).nth(number)?;
    let radius = parent.radius / 3.0;
    let center = parent.center + direction * (parent.radius + radius);
    Some((Sphere { center, radius }, direction))
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

    #[test]
    fn generation_by_generation_the_spheres_are_the_same() {
        let sorted = |mut spheres: Vec<Sphere>| {
            let key = |s: &Sphere| [s.center.x, s.center.y, s.center.z, s.radius].map(f32::to_bits);
            spheres.sort_by_key(key);
            spheres
        };
        assert_eq!(sorted(sphereflake_of(820)), sorted(sphereflake(3)));
    }

    #[test]
    fn any_number_of_spheres_can_be_had() {
        for count in [0, 1, 2, 9, 10, 11, 500, 1000] {
            assert_eq!(sphereflake_of(count).len(), count as usize);
        }
    }
}
