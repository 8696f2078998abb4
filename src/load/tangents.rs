//! MikkTSpace tangents, for meshes with a normal map whose file has none (glTF 2.0, section 3.7.2.1). Alone names
//! `bevy_mikktspace`.
//!
//! Mikkelsen 2008, "Simulation of Wrinkled Surfaces Revisited".

use crate::mesh::Mesh;
use bevy_mikktspace::{Geometry, Ops, TangentSpace, generate_tangents};
use glam::{Mat3, Vec3, Vec4};
use std::collections::HashMap;

/// How many corners may meet in one point. MikkTSpace calls itself once for each, on the thread's stack, and its time
/// grows with their square; a real mesh has about six.
const MOST_AT_A_POINT: u32 = 2_000;

/// Too many corners of a mesh meet in one point.
#[derive(Debug, PartialEq)]
pub(super) struct TooCrowded;

/// Gives `mesh` tangents along +u of texture coordinates `uv_set`, after the `transform` of the normal map: a map that
/// is turned on the mesh takes its tangents along, as in three.js and in the Khronos viewer (glTF-Sample-Renderer, pull
/// request 16). Vertices whose corners differ in tangent are split: which of the old ones each of the new ones was.
///
/// # Errors
///
/// Too many of its corners meet in one point; the mesh stays as it is.
pub(super) fn add(
    mesh: &mut Mesh,
    uv_set: usize,
    transform: Option<&Mat3>,
) -> Result<Vec<usize>, TooCrowded> {
    if most_at_a_point(mesh) > MOST_AT_A_POINT {
        return Err(TooCrowded);
    }
    // MikkTSpace searches all of a mesh for each triangle that has two corners in one point. No ray meets those.
    let faces = (0..mesh.triangles.len())
        .filter(|&triangle| {
            let [a, b, c] = [0, 1, 2].map(|corner| position(mesh, triangle, corner));
            a != b && b != c && c != a
        })
        .collect();
    let tangents = vec![[Vec4::ZERO; 3]; mesh.triangles.len()];
    let mut corners = Corners {
        mesh,
        uv_set,
        transform,
        faces,
        tangents,
    };
    // Its error has no values.
    let done = generate_tangents(&mut corners);
    let tangents = corners.tangents;
    done.map_err(|_| TooCrowded)?;
    let (split, old_vertices) = split(std::mem::take(mesh), &tangents);
    *mesh = split;
    Ok(old_vertices)
}

fn most_at_a_point(mesh: &Mesh) -> u32 {
    let mut counts: HashMap<[u32; 3], u32> = HashMap::new();
    for triangle in 0..mesh.triangles.len() {
        for corner in 0..3 {
            let at = position(mesh, triangle, corner)
                .to_array()
                .map(f32::to_bits);
            *counts.entry(at).or_default() += 1;
        }
    }
    counts.into_values().max().unwrap_or(0)
}

/// The geometry as MikkTSpace asks for it: corner by corner.
struct Corners<'a> {
    mesh: &'a Mesh,
    uv_set: usize,
    transform: Option<&'a Mat3>,
    /// The triangles it is told of.
    faces: Vec<usize>,
    /// Of all triangles.
    tangents: Vec<[Vec4; 3]>,
}

impl Corners<'_> {
    fn triangle(&self, face: usize) -> usize {
        self.faces.get(face).copied().unwrap_or_default()
    }

    fn vertex(&self, face: usize, corner: usize) -> usize {
        vertex(self.mesh, self.triangle(face), corner)
    }
}

/// The same bits on every machine: the standard library's arc cosine is the platform's.
struct Libm;

impl Ops for Libm {
    fn sqrt(x: f32) -> f32 {
        x.sqrt()
    }

    fn acos(x: f32) -> f32 {
        libm::acos(f64::from(x)) as f32
    }
}

impl Geometry<Libm> for Corners<'_> {
    fn num_faces(&self) -> usize {
        self.faces.len()
    }

    fn num_vertices_of_face(&self, _: usize) -> usize {
        3
    }

    fn position(&self, face: usize, corner: usize) -> [f32; 3] {
        position(self.mesh, self.triangle(face), corner).to_array()
    }

    fn normal(&self, face: usize, corner: usize) -> [f32; 3] {
        let normals = &self.mesh.normals;
        let normal = match normals.get(self.vertex(face, corner)) {
            Some(&normal) => normal,
            None => {
                let [a, b, c] = [0, 1, 2].map(|i| position(self.mesh, self.triangle(face), i));
                (b - a).cross(c - a).normalize_or_zero()
            }
        };
        // No -0.0: it welds what has the same bits.
        (normal + Vec3::ZERO).to_array()
    }

    fn tex_coord(&self, face: usize, corner: usize) -> [f32; 2] {
        let uv = self
            .mesh
            .uvs
            .get(self.uv_set)
            .and_then(|set| set.get(self.vertex(face, corner)));
        let uv = match (uv, self.transform) {
            (Some(&uv), Some(transform)) => transform.transform_point2(uv),
            (uv, _) => uv.copied().unwrap_or_default(),
        };
        // glTF's v runs down the image, the green of its normal maps up it (section 3.9.3).
        [uv.x + 0.0, 0.0 - uv.y]
    }

    fn set_tangent(&mut self, space: Option<TangentSpace>, face: usize, corner: usize) {
        let triangle = self.triangle(face);
        let place = self
            .tangents
            .get_mut(triangle)
            .and_then(|t| t.get_mut(corner));
        if let (Some(space), Some(place)) = (space, place) {
            let tangent = Vec4::from(space.tangent_encoded());
            if tangent.is_finite() {
                *place = tangent;
            }
        }
    }
}

fn vertex(mesh: &Mesh, triangle: usize, corner: usize) -> usize {
    let corners = mesh.triangles.get(triangle).copied().unwrap_or_default();
    corners.get(corner).map_or(0, |&vertex| vertex as usize)
}

/// Without -0.0: it welds what has the same bits.
fn position(mesh: &Mesh, triangle: usize, corner: usize) -> Vec3 {
    let position = mesh.positions.get(vertex(mesh, triangle, corner));
    position.copied().unwrap_or_default() + Vec3::ZERO
}

/// `mesh` with one vertex for each pair of an old vertex and a tangent, and which of the old ones each was.
fn split(mesh: Mesh, tangents: &[[Vec4; 3]]) -> (Mesh, Vec<usize>) {
    let mut known: HashMap<(u32, [u32; 4]), u32> = HashMap::new();
    let mut old_vertices: Vec<usize> = Vec::with_capacity(mesh.positions.len());
    let mut new = Mesh {
        name: mesh.name,
        triangles: mesh.triangles,
        ..Mesh::default()
    };
    for (corners, tangents) in new.triangles.iter_mut().zip(tangents) {
        for (corner, tangent) in corners.iter_mut().zip(tangents) {
            let key = (*corner, tangent.to_array().map(f32::to_bits));
            let next = old_vertices.len() as u32;
            let old = *corner as usize;
            *corner = *known.entry(key).or_insert_with(|| {
                old_vertices.push(old);
                new.tangents.push(*tangent);
                next
            });
        }
    }
    new.positions = picked(&mesh.positions, &old_vertices);
    new.normals = picked(&mesh.normals, &old_vertices);
    new.colors = picked(&mesh.colors, &old_vertices);
    new.uvs = mesh.uvs.map(|set| picked(&set, &old_vertices));
    (new, old_vertices)
}

/// What `which` says, where there is anything.
fn picked<T: Copy>(from: &[T], which: &[usize]) -> Vec<T> {
    which.iter().filter_map(|&i| from.get(i).copied()).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec2;

    /// A square in the plane z = 0 whose image stands upright: u to the right, v down.
    fn square() -> Mesh {
        let uvs = [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]].map(Vec2::from);
        let positions = [[0.0, 0.0], [1.0, 0.0], [1.0, 1.0], [0.0, 1.0]];
        Mesh {
            positions: positions.map(|[x, y]| Vec3::new(x, y, 0.0)).to_vec(),
            triangles: vec![[0, 1, 2], [0, 2, 3]],
            normals: vec![Vec3::Z; 4],
            uvs: [uvs.to_vec(), Vec::new()],
            ..Mesh::default()
        }
    }

    fn with_tangents(mut mesh: Mesh) -> Mesh {
        assert!(add(&mut mesh, 0, None).is_ok());
        mesh
    }

    #[test]
    fn the_tangent_runs_along_u_and_the_bitangent_up_the_image() {
        let mesh = with_tangents(square());
        assert_eq!(mesh.tangents, [Vec4::new(1.0, 0.0, 0.0, 1.0); 4]);
        assert_eq!(mesh.positions, square().positions);
    }

    #[test]
    fn a_mirrored_image_turns_the_bitangents_sign() {
        let mut mirrored = square();
        for uv in &mut mirrored.uvs[0] {
            uv.x = -uv.x;
        }
        let mesh = with_tangents(mirrored);
        assert_eq!(mesh.tangents, [Vec4::new(-1.0, 0.0, 0.0, -1.0); 4]);
    }

    #[test]
    fn a_map_that_is_turned_takes_its_tangents_along() {
        // KHR_texture_transform with a rotation of a quarter: u' = v, v' = -u. The image's right is the mesh's down.
        let turned = Mat3::from_cols(-Vec3::Y, Vec3::X, Vec3::Z);
        let mut mesh = square();
        assert!(add(&mut mesh, 0, Some(&turned)).is_ok());
        assert_eq!(mesh.tangents, [Vec4::new(0.0, -1.0, 0.0, 1.0); 4]);
        assert_eq!(mesh.uvs, square().uvs);
    }

    #[test]
    fn a_flat_mesh_gets_tangents_for_each_face() {
        let mut bent = square();
        bent.normals.clear();
        bent.positions[3].z = 1.0;
        let mesh = with_tangents(bent);
        assert_eq!((mesh.positions.len(), mesh.tangents.len()), (6, 6));
        assert!(mesh.normals.is_empty());
        for (triangle, corners) in mesh.triangles.iter().enumerate() {
            let normal = mesh.triangle(triangle as u32).normal();
            for &corner in corners {
                assert!(mesh.tangents[corner as usize].truncate().dot(normal).abs() < 1e-6);
            }
        }
    }

    #[test]
    fn a_triangle_without_area_keeps_its_vertices_and_gets_no_tangent() {
        let mut mesh = square();
        mesh.triangles.push([0, 0, 1]);
        let mesh = with_tangents(mesh);
        let tangent = mesh.tangents[mesh.triangles[2][0] as usize];
        assert_eq!((mesh.triangles.len(), tangent), (3, Vec4::ZERO));
    }

    #[test]
    fn a_crowded_point_is_refused_not_recursed_into() {
        let mut fan = square();
        fan.triangles = vec![[0, 1, 2]; 2_001];
        assert_eq!(add(&mut fan, 0, None), Err(TooCrowded));
        assert!(fan.tangents.is_empty());
    }
}
