//! Triangle meshes.

use crate::geometry::{Bounds, Triangle};
use glam::{DAffine3, DMat3, Vec2, Vec3, Vec4};
use rayon::iter::{IndexedParallelIterator, IntoParallelRefMutIterator, ParallelIterator};

/// Triangles over shared vertices. What belongs to vertices is empty or as long as `positions`.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Mesh {
    /// As in the file, for messages.
    pub name: String,
    /// In the mesh's own space.
    pub positions: Vec<Vec3>,
    /// Three indices into the vertices each, counter-clockwise seen from the front.
    pub triangles: Vec<[u32; 3]>,
    /// Unit shading normals; where empty, the triangles are flat.
    pub normals: Vec<Vec3>,
    /// Unit tangents along +u; `w` is the sign of the bitangent `w (n x t)`.
    pub tangents: Vec<Vec4>,
    /// Two sets of texture coordinates, (0, 0) at the image's upper left corner.
    pub uvs: [Vec<Vec2>; 2],
    /// Linear colour and alpha, which multiply the material's.
    pub colors: Vec<[f32; 4]>,
}

impl Mesh {
    /// Triangle number `index`; empty at the origin where there is no such triangle.
    pub fn triangle(&self, index: u32) -> Triangle {
        self.triangles
            .get(index as usize)
            .map_or(Triangle([Vec3::ZERO; 3]), |corners| self.corners(corners))
    }

    fn corners(&self, corners: &[u32; 3]) -> Triangle {
        let at = |i: u32| self.positions.get(i as usize).copied().unwrap_or_default();
        let [a, b, c] = *corners;
        Triangle([at(a), at(b), at(c)])
    }

    /// The smallest box around the triangles' vertices.
    pub fn bounds(&self) -> Bounds {
        let corners = self
            .triangles
            .iter()
            .flat_map(|corners| self.corners(corners).0);
        Bounds::around(corners)
    }

    /// The greatest absolute coordinate of any vertex; NaN where one is not a number.
    pub fn reach(&self) -> f32 {
        let coordinates = self.positions.iter().flat_map(|p| p.abs().to_array());
        coordinates.fold(0.0, |reach, x| {
            if reach >= x || reach.is_nan() {
                reach
            } else {
                x
            }
        })
    }

    /// What its vertices and triangles take, in bytes.
    pub fn bytes(&self) -> u64 {
        let [first, second] = &self.uvs;
        let lists = [
            size_of_val(self.positions.as_slice()),
            size_of_val(self.triangles.as_slice()),
            size_of_val(self.normals.as_slice()),
            size_of_val(self.tangents.as_slice()),
            size_of_val(first.as_slice()),
            size_of_val(second.as_slice()),
            size_of_val(self.colors.as_slice()),
        ];
        lists.into_iter().map(|bytes| bytes as u64).sum()
    }

    /// This mesh carried into another space; the fronts stay fronts where `transform` mirrors.
    pub fn transformed(mut self, transform: &DAffine3) -> Mesh {
        let matrix = transform.matrix3;
        let turn = normal_matrix(&matrix);
        each(&mut self.positions, |p| {
            *p = transform.transform_point3(p.as_dvec3()).as_vec3();
        });
        each(&mut self.normals, |n| {
            *n = (turn * n.as_dvec3()).normalize_or_zero().as_vec3();
        });
        let mirrors = matrix.determinant() < 0.0;
        each(&mut self.tangents, |t| {
            let along = (matrix * t.truncate().as_dvec3())
                .normalize_or_zero()
                .as_vec3();
            *t = along.extend(if mirrors { -t.w } else { t.w });
        });
        if mirrors {
            self.triangles
                .iter_mut()
                .for_each(|[_, b, c]| std::mem::swap(b, c));
        }
        self
    }
}

/// Does `change` to each, many at a time.
fn each<T: Send>(all: &mut [T], change: impl Fn(&mut T) + Send + Sync) {
    /// Fewer are not worth a thread.
    const PIECE: usize = 1 << 14;
    all.par_iter_mut().with_min_len(PIECE).for_each(change);
}

/// What carries normals where `matrix` carries points: the inverse transpose, but for length. From cofactors, so that
/// a matrix that flattens still has one; the sign keeps outward outward.
pub fn normal_matrix(matrix: &DMat3) -> DMat3 {
    let (x, y, z) = (matrix.x_axis, matrix.y_axis, matrix.z_axis);
    let cofactors = DMat3::from_cols(y.cross(z), z.cross(x), x.cross(y));
    if matrix.determinant() < 0.0 {
        -cofactors
    } else {
        cofactors
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::DVec3;

    fn one_triangle() -> Mesh {
        Mesh {
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
            triangles: vec![[0, 1, 2]],
            normals: vec![Vec3::Z; 3],
            tangents: vec![Vec4::new(1.0, 0.0, 0.0, 1.0); 3],
            ..Mesh::default()
        }
    }

    #[test]
    fn a_mirrored_front_stays_a_front() {
        let mirrored =
            one_triangle().transformed(&DAffine3::from_scale(DVec3::new(-1.0, 1.0, 1.0)));
        assert_eq!(mirrored.triangle(0).normal(), Vec3::Z);
        assert_eq!(
            (mirrored.normals[0], mirrored.tangents[0]),
            (Vec3::Z, Vec4::new(-1.0, 0.0, 0.0, -1.0))
        );
    }

    #[test]
    fn a_slanted_normal_follows_the_inverse_transpose() {
        // The plane x + z = 0, twice as wide in x, is x/2 + z = 0.
        let matrix = DMat3::from_diagonal(DVec3::new(2.0, 1.0, 1.0));
        let n = (normal_matrix(&matrix) * DVec3::new(1.0, 0.0, 1.0)).normalize();
        assert!((n - DVec3::new(0.5, 0.0, 1.0).normalize()).length() < 1e-12);
    }

    #[test]
    fn a_vertex_that_is_not_used_does_not_widen_the_box() {
        let mut mesh = one_triangle();
        mesh.positions.push(Vec3::splat(100.0));
        assert_eq!(mesh.bounds().max, Vec3::new(1.0, 1.0, 0.0));
    }
}
