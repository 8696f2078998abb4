//! From the faces of one object and one material to a mesh.

use super::geometry::{Corner, Geometry, Group, NONE, NOWHERE};
use super::polygon::{Triangulator, newell_normal};
use crate::mesh::Mesh;
use glam::{DVec3, Vec2, Vec3};

/// Vertices of one position, of which each further one is made without looking for its like: a position with very many
/// normals must not take time that grows with their square.
const MOST_ALIKE: usize = 32;

/// What could not be taken over as it is, in numbers of faces or corners.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Mended {
    /// Triangles of faces with a corner that is no finite position.
    pub(super) dropped: usize,
    /// Corners without texture coordinates, in a mesh that needs them.
    pub(super) without_uv: usize,
    /// Texture coordinates that are no finite numbers.
    pub(super) broken_uvs: usize,
}

/// Makes meshes; keeps its memory from one to the next.
pub(super) struct MeshMaker<'a> {
    geometry: &'a Geometry,
    triangulator: Triangulator,
    polygon: Vec<DVec3>,
    weld: Weld,
}

/// The vertices of the current mesh.
struct Weld {
    /// The latest vertex of each position, and the mesh it belongs to.
    latest: Vec<(u32, u32)>,
    /// The corner that each vertex was made of, and the vertex of the same position before it.
    vertices: Vec<(Corner, u32)>,
    mesh_number: u32,
}

impl<'a> MeshMaker<'a> {
    pub(super) fn new(geometry: &'a Geometry) -> MeshMaker<'a> {
        MeshMaker {
            geometry,
            triangulator: Triangulator::new(),
            polygon: Vec::new(),
            weld: Weld {
                latest: vec![(0, NONE); geometry.positions.len()],
                vertices: Vec::new(),
                mesh_number: 0,
            },
        }
    }

    /// The mesh of a group; without triangles where none of its faces can be drawn. Whether it misses texture coordinates
    /// is told where it `needs_uvs`.
    pub(super) fn mesh(&mut self, group: &Group, needs_uvs: bool) -> (Mesh, Mended) {
        self.weld.mesh_number += 1;
        self.weld.vertices.clear();
        let geometry = self.geometry;
        let faces = || group.faces.iter().flat_map(Clone::clone);
        let corners = || faces().flat_map(|face| geometry.face(face));
        let has_normals = corners().any(|&corner| unit_normal(geometry, corner).is_some());
        let (mut mesh, mut mended) = (Mesh::default(), Mended::default());
        for face in faces() {
            mended.dropped += self.add_face(&mut mesh, face, has_normals);
        }
        let made_of = || self.weld.vertices.iter().map(|&(corner, _)| corner);
        if !geometry.colors.is_empty() {
            let color = |corner: Corner| geometry.colors.get(corner.position as usize).copied();
            mesh.colors
                .extend(made_of().map(|corner| color(corner).unwrap_or([1.0; 4])));
        }
        if corners().any(|corner| corner.uv != NONE) {
            mesh.uvs[0].extend(made_of().map(|corner| mended.uv(geometry, corner)));
        }
        if needs_uvs {
            mended.without_uv = corners().filter(|corner| corner.uv == NONE).count();
        }
        (mesh, mended)
    }

    /// How many faces of all meshes had too many corners to be cut rightly.
    pub(super) fn uncut(&self) -> usize {
        self.triangulator.uncut()
    }

    /// Adds a face's triangles; how many are left out.
    fn add_face(&mut self, mesh: &mut Mesh, face: u32, has_normals: bool) -> usize {
        let geometry = self.geometry;
        let corners = geometry.face(face);
        if corners.first() == Some(&NOWHERE) {
            return 0;
        }
        let polygon = corners
            .iter()
            .map(|&corner| position(geometry, corner).as_dvec3());
        self.polygon.clear();
        self.polygon.extend(polygon);
        if !self.polygon.iter().all(|p| p.is_finite()) {
            return corners.len().saturating_sub(2);
        }
        let is_bare = |&corner: &Corner| unit_normal(geometry, corner).is_none();
        let has_bare = has_normals && corners.iter().any(is_bare);
        let flat = has_bare.then(|| {
            newell_normal(&self.polygon)
                .normalize_or(DVec3::Y)
                .as_vec3()
        });
        for triangle in self.triangulator.cut(&self.polygon) {
            let vertices = triangle.map(|at| {
                let corner = corners.get(at as usize).copied().unwrap_or(NOWHERE);
                let normal = unit_normal(geometry, corner);
                let (vertex, is_new) = match (has_normals, normal) {
                    (true, Some(_)) => self.weld.vertex(corner),
                    (true, None) => (self.weld.new_vertex(corner), true),
                    (false, _) => self.weld.vertex(Corner {
                        normal: NONE,
                        ..corner
                    }),
                };
                if is_new {
                    mesh.positions.push(position(geometry, corner));
                    mesh.normals.extend(normal.or(flat).filter(|_| has_normals));
                }
                vertex
            });
            mesh.triangles.push(vertices);
        }
        0
    }
}

impl Weld {
    /// The vertex of a corner, and whether it is new: it is not where there is one of which all is the same.
    fn vertex(&mut self, corner: Corner) -> (u32, bool) {
        let mut at = self.latest_of(corner);
        for _ in 0..MOST_ALIKE {
            match self.vertices.get(at as usize) {
                Some((known, _)) if *known == corner => return (at, false),
                Some(&(_, earlier)) => at = earlier,
                None => break,
            }
        }
        (self.new_vertex(corner), true)
    }

    fn new_vertex(&mut self, corner: Corner) -> u32 {
        let new = self.vertices.len() as u32;
        self.vertices.push((corner, self.latest_of(corner)));
        if let Some(latest) = self.latest.get_mut(corner.position as usize) {
            *latest = (self.mesh_number, new);
        }
        new
    }

    fn latest_of(&self, corner: Corner) -> u32 {
        match self.latest.get(corner.position as usize) {
            Some(&(number, vertex)) if number == self.mesh_number => vertex,
            _ => NONE,
        }
    }
}

fn position(geometry: &Geometry, corner: Corner) -> Vec3 {
    let position = geometry.positions.get(corner.position as usize);
    position.copied().unwrap_or_default()
}

/// The normal that a corner names; `None` where it names none or one without a direction.
fn unit_normal(geometry: &Geometry, corner: Corner) -> Option<Vec3> {
    let normal = geometry.normals.get(corner.normal as usize).copied();
    normal.filter(|&normal| normal != Vec3::ZERO)
}

impl Mended {
    pub(super) fn and(self, other: Mended) -> Mended {
        Mended {
            dropped: self.dropped + other.dropped,
            without_uv: self.without_uv + other.without_uv,
            broken_uvs: self.broken_uvs + other.broken_uvs,
        }
    }

    /// Texture coordinates as luch has them: (0, 0) at the upper left, where OBJ has the lower left.
    fn uv(&mut self, geometry: &Geometry, corner: Corner) -> Vec2 {
        let uv = geometry.uvs.get(corner.uv as usize).copied();
        let uv = uv.unwrap_or_default();
        let flipped = Vec2::new(uv.x, 1.0 - uv.y);
        if flipped.is_finite() {
            flipped
        } else {
            self.broken_uvs += 1;
            Vec2::ZERO
        }
    }
}
