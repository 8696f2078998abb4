//! A mesh of more triangles and the same shape.

use super::weld::welded;
use super::{MOST_TRIANGLES, thinned};
use crate::generate::Random;
use crate::mesh::Mesh;
use rayon::slice::ParallelSliceMut;

/// The seed of the choice which edges are split in the last round.
const SEED: u64 = 4;
/// An edge, or a corner of a triangle, without a vertex in its middle.
const WHOLE: u32 = u32::MAX;

/// The mesh with `count` triangles, or a few more: each triangle split into four at the middles of its edges, round
/// after round. In the last one, only as many edges are split as are needed, a random choice that is always the same,
/// and a triangle falls into one more than it has split edges. Since neighbours share the middle of their edge, no gap
/// opens: a closed surface stays closed. An edge more splits all the triangles that have it: with two to an edge,
/// `count` is passed by one at most.
///
/// Vertices in the same place become one; vertices have no more than positions. A mesh that has `count` triangles
/// already, or none, stays as it is. At most [`MOST_TRIANGLES`] are made.
pub fn subdivided(mesh: &Mesh, count: usize) -> Mesh {
    let count = count.min(MOST_TRIANGLES);
    let mut finer = thinned(mesh, mesh.triangles.len());
    if finer.triangles.is_empty() || finer.triangles.len() >= count {
        return finer;
    }
    finer = welded(finer);
    while finer.triangles.len() < count {
        let missing = count - finer.triangles.len();
        finer = split(finer, missing);
    }
    finer
}

/// The mesh with about `missing` triangles more, or four times as many where that is less.
fn split(mesh: Mesh, missing: usize) -> Mesh {
    let mut positions = mesh.positions;
    let edges = edges(&mesh.triangles);
    // Of each triangle's three edges, from its first, second and third corner on: the vertex in the middle.
    let mut middles = vec![[WHOLE; 3]; mesh.triangles.len()];
    let mut random = Random::new(SEED);
    // Selection sampling (Knuth, "The Art of Computer Programming", vol. 2, 3.4.2, algorithm S): each edge with the
    // probability that as many as are missing still come from those that are left, in one pass.
    let mut left = edges.len();
    let mut missing = missing.min(left);
    for same in edges.chunk_by(|a, b| a.ends == b.ends) {
        if f64::from(random.next_f32()) * (left as f64) < missing as f64 {
            let [p, q] = same[0].ends.map(|end| positions[end as usize]);
            for edge in same {
                middles[edge.triangle as usize][usize::from(edge.side)] = positions.len() as u32;
            }
            // Halved one by one: the sum of two large coordinates might not be finite.
            positions.push(p * 0.5 + q * 0.5);
            missing = missing.saturating_sub(same.len());
        }
        left -= same.len();
    }
    let made = middles
        .as_flattened()
        .iter()
        .filter(|&&m| m != WHOLE)
        .count();
    let mut triangles = Vec::with_capacity(mesh.triangles.len() + made);
    for (&corners, &middles) in mesh.triangles.iter().zip(&middles) {
        split_triangle(corners, middles, &mut triangles);
    }
    Mesh {
        positions,
        triangles,
        ..Mesh::default()
    }
}

/// An edge of one triangle.
#[derive(Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
struct Edge {
    /// Its vertices, the lower number first.
    ends: [u32; 2],
    triangle: u32,
    /// 0 to 2: from which corner on.
    side: u8,
}

/// The edges of all triangles, so that those between the same vertices follow each other.
fn edges(triangles: &[[u32; 3]]) -> Vec<Edge> {
    let of_triangle = |(triangle, &[a, b, c]): (u32, &[u32; 3])| {
        let sides = [(0, a, b), (1, b, c), (2, c, a)];
        sides.map(|(side, p, q)| Edge {
            ends: [p.min(q), p.max(q)],
            triangle,
            side,
        })
    };
    // Filled to its exact size: of ten million triangles, this is half a gigabyte.
    let mut edges = Vec::with_capacity(triangles.len() * 3);
    edges.extend((0..).zip(triangles).flat_map(of_triangle));
    edges.par_sort_unstable();
    edges
}

/// Adds the parts of a triangle, which face the way it does.
fn split_triangle(corners: [u32; 3], middles: [u32; 3], parts: &mut Vec<[u32; 3]>) {
    let [a, b, c] = corners;
    let [ab, bc, ca] = middles;
    match middles.map(|middle| middle != WHOLE) {
        [false, false, false] => parts.push(corners),
        [true, true, true] => {
            parts.extend([[a, ab, ca], [ab, b, bc], [ca, bc, c], [ab, bc, ca]]);
        }
        [true, false, false] => parts.extend([[a, ab, c], [ab, b, c]]),
        [true, true, false] => parts.extend([[ab, b, bc], [a, ab, bc], [a, bc, c]]),
        // The others are these, turned.
        [false, true, _] => split_triangle([b, c, a], [bc, ca, ab], parts),
        [_, false, true] => split_triangle([c, a, b], [ca, ab, bc], parts),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::generate::{icosphere, terrain};
    use glam::Vec3;

    fn area(mesh: &Mesh) -> f64 {
        let corners = (0..mesh.triangles.len() as u32).map(|index| mesh.triangle(index).0);
        let doubled = corners.map(|corners| {
            let [a, b, c] = corners.map(|p| p.as_dvec3());
            (b - a).cross(c - a).length()
        });
        doubled.sum::<f64>() / 2.0
    }

    /// How many triangles have each edge.
    fn owners(mesh: &Mesh) -> Vec<usize> {
        let edges = edges(&mesh.triangles);
        let same = edges.chunk_by(|a, b| a.ends == b.ends);
        same.map(<[Edge]>::len).collect()
    }

    #[test]
    fn a_closed_surface_gets_the_count_and_stays_closed() {
        for count in [20, 21, 22, 35, 79, 80, 81, 1000, 5120, 5121] {
            let finer = subdivided(&icosphere(0), count);
            let passed_by = finer.triangles.len() - count;
            assert!(passed_by <= 1);
            assert!(owners(&finer).iter().all(|&owners| owners == 2));
            // Euler, for a surface without holes.
            assert_eq!(
                finer.positions.len() + finer.triangles.len() / 2,
                finer.triangles.len() + 2
            );
        }
    }

    #[test]
    fn the_area_and_the_front_stay() {
        let (sphere, finer) = (icosphere(1), subdivided(&icosphere(1), 3001));
        let close = (area(&finer) / area(&sphere) - 1.0).abs();
        assert!(close < 1e-5);
        for index in 0..finer.triangles.len() as u32 {
            let triangle = finer.triangle(index);
            assert!(triangle.normal().dot(triangle.0[0]) > 0.0);
        }
    }

    #[test]
    fn a_border_stays_a_border() {
        let finer = subdivided(&terrain(4, 1), 77);
        assert!((77..=78).contains(&finer.triangles.len()));
        assert!(owners(&finer).iter().all(|&owners| owners <= 2));
        assert!((area(&finer) / area(&terrain(4, 1)) - 1.0).abs() < 1e-5);
        // Seen from above, the border is 8 long; a gap between two triangles would have a border of its own.
        let ends = edges(&finer.triangles);
        let border = ends
            .chunk_by(|a, b| a.ends == b.ends)
            .filter(|same| same.len() == 1);
        let length: f32 = border
            .map(|edge| {
                let [p, q] = edge[0].ends.map(|end| finer.positions[end as usize]);
                ((p - q) * Vec3::new(1.0, 0.0, 1.0)).length()
            })
            .sum();
        assert!((length - 8.0).abs() < 1e-5);
    }

    #[test]
    fn faces_with_vertices_of_their_own_do_not_come_apart() {
        let sphere = icosphere(1);
        let corners = sphere.triangles.iter().flatten();
        let apart = Mesh {
            positions: corners.map(|&i| sphere.positions[i as usize]).collect(),
            triangles: (0..80).map(|i| [3 * i, 3 * i + 1, 3 * i + 2]).collect(),
            ..Mesh::default()
        };
        assert!(
            owners(&subdivided(&apart, 501))
                .iter()
                .all(|&owners| owners == 2)
        );
    }

    #[test]
    fn triangles_without_area_and_edges_of_many_are_split_like_others() {
        let fan = Mesh {
            positions: (0..50).map(|i| Vec3::splat(i as f32)).collect(),
            triangles: (0..50).map(|i| [0, 1, i]).collect(),
            ..Mesh::default()
        };
        let count = subdivided(&fan, 120).triangles.len();
        assert!((120..200).contains(&count));
    }

    #[test]
    fn the_last_round_is_spread_over_the_whole() {
        let finer = subdivided(&terrain(32, 1), 4096);
        let center = |index| finer.triangle(index).0.iter().sum::<Vec3>().x;
        let left = (0..4096).filter(|&index| center(index) < 0.0).count();
        assert!((1950..2150).contains(&left));
    }
}
