//! The subdivided icosahedron: a closed mesh of even triangles.

use crate::mesh::Mesh;
use glam::Vec3;
use std::collections::HashMap;

/// A unit sphere of `20 * 4^subdivisions` triangles around the origin, without normals. At most 12 subdivisions.
pub fn icosphere(subdivisions: u32) -> Mesh {
    let mut positions: Vec<Vec3> = icosahedron_corners();
    let mut triangles: Vec<[u32; 3]> = ICOSAHEDRON.to_vec();
    for _ in 0..subdivisions.min(12) {
        let mut midpoints = HashMap::with_capacity(triangles.len() * 3 / 2);
        let mut finer = Vec::with_capacity(triangles.len() * 4);
        for [a, b, c] in triangles {
            let mut midpoint = |p: u32, q: u32| {
                *midpoints.entry((p.min(q), p.max(q))).or_insert_with(|| {
                    positions.push((positions[p as usize] + positions[q as usize]).normalize());
                    (positions.len() - 1) as u32
                })
            };
            let (ab, bc, ca) = (midpoint(a, b), midpoint(b, c), midpoint(c, a));
            finer.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        triangles = finer;
    }
    Mesh {
        name: "icosphere".into(),
        positions,
        triangles,
        ..Mesh::default()
    }
}

/// Three golden rectangles, each square to the others.
fn icosahedron_corners() -> Vec<Vec3> {
    let golden = (1.0 + 5f32.sqrt()) / 2.0;
    let corners = [
        (-1.0, golden, 0.0),
        (1.0, golden, 0.0),
        (-1.0, -golden, 0.0),
        (1.0, -golden, 0.0),
        (0.0, -1.0, golden),
        (0.0, 1.0, golden),
        (0.0, -1.0, -golden),
        (0.0, 1.0, -golden),
        (golden, 0.0, -1.0),
        (golden, 0.0, 1.0),
        (-golden, 0.0, -1.0),
        (-golden, 0.0, 1.0),
    ];
    corners
        .into_iter()
        .map(|corner| Vec3::from(corner).normalize())
        .collect()
}

const ICOSAHEDRON: [[u32; 3]; 20] = [
    [0, 11, 5],
    [0, 5, 1],
    [0, 1, 7],
    [0, 7, 10],
    [0, 10, 11],
    [1, 5, 9],
    [5, 11, 4],
    [11, 10, 2],
    [10, 7, 6],
    [7, 1, 8],
    [3, 9, 4],
    [3, 4, 2],
    [3, 2, 6],
    [3, 6, 8],
    [3, 8, 9],
    [4, 9, 5],
    [2, 4, 11],
    [6, 2, 10],
    [8, 6, 7],
    [9, 8, 1],
];

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_surface_is_closed_and_faces_outward() {
        let sphere = icosphere(2);
        assert_eq!(sphere.triangles.len(), 320);
        // Euler: V - E + F = 2 for a closed surface without holes, with E = 3F/2.
        assert_eq!(
            sphere.positions.len() + sphere.triangles.len() / 2,
            sphere.triangles.len() + 2
        );
        for index in 0..sphere.triangles.len() as u32 {
            let triangle = sphere.triangle(index);
            assert!(triangle.normal().dot(triangle.0[0]) > 0.0);
        }
    }
}
