//! Triangles of several meshes brought together, with the vertices they use and no others.

use crate::mesh::Mesh;
use glam::{Affine3, Vec3};

/// A vertex that is not in the gathered mesh yet.
const ABSENT: u32 = u32::MAX;

/// A mesh in the making.
#[derive(Default)]
pub(super) struct Gather {
    pub(super) mesh: Mesh,
    /// Of the vertices of the mesh that is being added, their numbers here.
    numbers: Vec<u32>,
    /// Which of `numbers` are not `ABSENT`: cleaning up after an instance costs what it used, not what its mesh has.
    used: Vec<usize>,
}

impl Gather {
    /// Nothing yet.
    pub(super) fn with_room_for(triangles: usize) -> Gather {
        let mut gather = Gather::default();
        gather.mesh.triangles.reserve_exact(triangles);
        gather
    }

    /// Adds some triangles of a mesh, carried by `to_world`; fronts stay fronts where that mirrors. Vertices and
    /// triangles that the mesh does not have are at the origin, as for [`Mesh::triangle`].
    pub(super) fn add(
        &mut self,
        mesh: &Mesh,
        triangles: impl Iterator<Item = usize>,
        to_world: Option<&Affine3>,
    ) {
        if self.numbers.len() < mesh.positions.len() {
            self.numbers.resize(mesh.positions.len(), ABSENT);
        }
        let mirrors = to_world.is_some_and(|space| space.matrix3.determinant() < 0.0);
        for triangle in triangles {
            let corners = mesh.triangles.get(triangle).copied().unwrap_or([ABSENT; 3]);
            let [a, b, c] = corners.map(|vertex| self.number(mesh, vertex as usize, to_world));
            self.mesh
                .triangles
                .push(if mirrors { [a, c, b] } else { [a, b, c] });
        }
        for vertex in self.used.drain(..) {
            self.numbers[vertex] = ABSENT;
        }
    }

    /// The number here of a vertex of `mesh`.
    fn number(&mut self, mesh: &Mesh, vertex: usize, to_world: Option<&Affine3>) -> u32 {
        let known = self.numbers.get(vertex).copied().unwrap_or(ABSENT);
        if known != ABSENT {
            return known;
        }
        let number = self.mesh.positions.len() as u32;
        let position = match mesh.positions.get(vertex) {
            Some(&position) => {
                self.numbers[vertex] = number;
                self.used.push(vertex);
                position
            }
            None => Vec3::ZERO,
        };
        let carried = to_world.map_or(position, |space| space.transform_point3(position));
        self.mesh.positions.push(carried);
        number
    }
}
