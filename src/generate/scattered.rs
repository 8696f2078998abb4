//! Spheres and triangles scattered through a cube: no order that a tree could find, and much overlap.
//!
//! Their area in all is the same at any count, so that a ray through the cube meets as many.

use super::Random;
use crate::geometry::Sphere;
use crate::mesh::Mesh;
use glam::Vec3;

/// The radius of a single sphere; a ray through the cube meets one or two of many.
const OF_SPHERES: f32 = 1.5;
/// The radius of a single triangle's sphere.
const OF_TRIANGLES: f32 = 2.4;

/// `count` spheres of one size in the cube -1..1.
pub fn scattered_spheres(count: u32, seed: u64) -> Vec<Sphere> {
    let mut random = Random::new(seed);
    let radius = radius(OF_SPHERES, count);
    let mut sphere = || Sphere {
        center: center(&mut random, radius),
        radius,
    };
    (0..count).map(|_| sphere()).collect()
}

/// `count` triangles in the cube -1..1, each with its corners on a sphere of one size, anywhere on it.
pub fn scattered_triangles(count: u32, seed: u64) -> Mesh {
    let mut random = Random::new(seed);
    let radius = radius(OF_TRIANGLES, count);
    let corners = (0..count).flat_map(|_| {
        let center = center(&mut random, radius);
        [(); 3].map(|()| center + random.direction() * radius)
    });
    Mesh {
        name: "scattered triangles".into(),
        positions: corners.collect(),
        triangles: (0..count).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
        ..Mesh::default()
    }
}

/// In all, `count` have as much area as one.
fn radius(of_one: f32, count: u32) -> f32 {
    of_one / (count.max(1) as f32).sqrt()
}

/// A point as far as `radius` inside the cube, as far as it is large enough.
fn center(random: &mut Random, radius: f32) -> Vec3 {
    random.in_cube() * (1.0 - radius).max(0.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn all_lie_in_the_cube_and_have_the_same_area_at_any_count() {
        for count in [10, 5000] {
            let spheres = scattered_spheres(count, 1);
            let area: f32 = spheres.iter().map(|s| s.radius * s.radius).sum();
            assert!((area - OF_SPHERES * OF_SPHERES).abs() < 1e-3);
            let reach = spheres
                .iter()
                .map(|s| s.center.abs().max_element() + s.radius);
            assert!(reach.fold(0.0, f32::max) <= 1.0 + 1e-6);
            assert!(scattered_triangles(count, 1).reach() <= 1.0 + 1e-6);
        }
    }
}
