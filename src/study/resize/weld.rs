//! Vertices of one place made one.

use crate::mesh::Mesh;
use glam::Vec3;
use rayon::slice::ParallelSliceMut;

/// The same triangles, over vertices no two of which are in the same place: where a file has a vertex for each face
/// that meets there, the faces become neighbours.
pub(super) fn welded(mesh: Mesh) -> Mesh {
    // Adding zero makes a zero of either sign the same.
    let place = |position: &Vec3| (*position + Vec3::ZERO).to_array().map(f32::to_bits);
    let mut order: Vec<([u32; 3], u32)> = mesh.positions.iter().map(place).zip(0..).collect();
    order.par_sort_unstable();
    let mut positions = Vec::new();
    let mut numbers = vec![0; order.len()];
    for same in order.chunk_by(|(a, _), (b, _)| a == b) {
        for &(place, vertex) in same {
            if vertex == same[0].1 {
                positions.push(Vec3::from(place.map(f32::from_bits)));
            }
            numbers[vertex as usize] = positions.len() as u32 - 1;
        }
    }
    let mut triangles = mesh.triangles;
    for vertex in triangles.iter_mut().flatten() {
        *vertex = numbers[*vertex as usize];
    }
    Mesh {
        positions,
        triangles,
        ..Mesh::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_seam_closes_and_triangles_stay_in_place() {
        let (a, b, c, d) = (Vec3::ZERO, Vec3::X, Vec3::Y, Vec3::ONE);
        let apart = Mesh {
            positions: vec![a, b, c, d, c, b * -1.0 * -1.0, -a],
            triangles: vec![[0, 1, 2], [3, 4, 5], [6, 5, 2]],
            ..Mesh::default()
        };
        let welded = welded(apart.clone());
        assert_eq!(welded.positions.len(), 4);
        for triangle in 0..3 {
            assert_eq!(welded.triangle(triangle), apart.triangle(triangle));
        }
    }
}
