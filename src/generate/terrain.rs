//! Hills: a height field over a square.

use super::{Random, grid_triangles};
use crate::mesh::Mesh;
use glam::Vec3;

/// A landscape over -1..1 in x and z, of `2 * cells^2` triangles and heights of about 0.3, without normals.
///
/// Value noise in six octaves, each half as high and twice as fine as the one before (Perlin and Hoffert 1989,
/// "Hypertexture", has the sum).
pub fn terrain(cells: u32, seed: u64) -> Mesh {
    let cells = cells.clamp(1, 8192);
    let side = cells + 1;
    let mut random = Random::new(seed);
    let octaves: [Lattice; 6] =
        std::array::from_fn(|octave| Lattice::new(&mut random, 4 << octave));
    let position = |index: u32| {
        let (x, z) = (
            (index % side) as f32 / cells as f32,
            (index / side) as f32 / cells as f32,
        );
        let height: f32 = octaves
            .iter()
            .zip([0.3, 0.15, 0.075, 0.0375, 0.018_75, 0.009_375])
            .map(|(octave, high)| octave.at(x, z) * high)
            .sum();
        Vec3::new(x * 2.0 - 1.0, height, z * 2.0 - 1.0)
    };
    Mesh {
        name: "terrain".into(),
        positions: (0..side * side).map(position).collect(),
        triangles: grid_triangles(side, side),
        ..Mesh::default()
    }
}

/// Random heights on a square lattice, blended smoothly between its points.
struct Lattice {
    cells: usize,
    heights: Vec<f32>,
}

impl Lattice {
    fn new(random: &mut Random, cells: usize) -> Lattice {
        let points = (cells + 2) * (cells + 2);
        Lattice {
            cells,
            heights: (0..points).map(|_| random.next_signed()).collect(),
        }
    }

    /// The height at (`x`, `z`) in 0..1.
    fn at(&self, x: f32, z: f32) -> f32 {
        let (x, z) = (x * self.cells as f32, z * self.cells as f32);
        let (i, j) = (x as usize, z as usize);
        let smooth = |t: f32| t * t * (3.0 - 2.0 * t);
        let (u, v) = (smooth(x - i as f32), smooth(z - j as f32));
        let height = |i: usize, j: usize| self.heights[j * (self.cells + 2) + i];
        let across = |j| height(i, j) * (1.0 - u) + height(i + 1, j) * u;
        across(j) * (1.0 - v) + across(j + 1) * v
    }
}
