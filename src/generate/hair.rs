//! Thin strips in every direction: what bounding boxes fit worst.

use super::Random;
use crate::mesh::Mesh;
use glam::Vec3;

/// `strands` strips of `segments` quads that grow outward from a sphere and bend, `2 * strands * segments` triangles.
pub fn hair(strands: u32, segments: u32, seed: u64) -> Mesh {
    hair_of_width(strands, segments, 0.0024, seed)
}

/// [`hair`] of another width; the sphere's radius is 0.5, the strands are 0.48 long.
pub fn hair_of_width(strands: u32, segments: u32, width: f32, seed: u64) -> Mesh {
    let mut random = Random::new(seed);
    let mut mesh = Mesh {
        name: "hair".into(),
        ..Mesh::default()
    };
    for _ in 0..strands {
        let mut point = random.direction() * 0.5;
        let mut along = point.normalize();
        let across = along.any_orthonormal_vector() * (width / 2.0);
        for segment in 0..=segments {
            let first = mesh.positions.len() as u32;
            mesh.positions.extend([point - across, point + across]);
            if segment > 0 {
                mesh.triangles
                    .extend([[first - 2, first - 1, first], [first, first - 1, first + 1]]);
            }
            along = (along + random.direction() * 0.18 + Vec3::NEG_Y * 0.05).normalize();
            point += along * (0.48 / segments as f32);
        }
    }
    mesh
}
