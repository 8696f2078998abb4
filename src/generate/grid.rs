//! A regular block of spheres.

use crate::geometry::Sphere;
use glam::Vec3;

/// `side^3` spheres that fill the cube -1..1 without touching.
pub fn grid(side: u32) -> Vec<Sphere> {
    let cell = 2.0 / side as f32;
    let coordinate = |i: u32| (i as f32 + 0.5) * cell - 1.0;
    let center = |n: u32| {
        Vec3::new(
            coordinate(n % side),
            coordinate(n / side % side),
            coordinate(n / side / side),
        )
    };
    (0..side.pow(3))
        .map(|n| Sphere {
            center: center(n),
            radius: cell * 0.4,
        })
        .collect()
}
