//! Tangents as normal maps are baked for (Mikkelsen 2008, "Simulation of Wrinkled Surfaces Revisited"); crate
//! `bevy_mikktspace` is named here alone.
//!
//! That crate walks around a vertex by recursion and compares the triangles there with each other, and compares every
//! degenerate triangle with every other one. So it never sees degenerate triangles, nor vertices with more than
//! [`MOST_AROUND`] triangles: these get the tangent of their own triangle.

use crate::mesh::Mesh;
use bevy_mikktspace::{Geometry, Ops, TangentSpace};
use glam::{Vec2, Vec3, Vec4};
use std::collections::HashMap;

/// Triangles around a vertex, for whose tangents they are averaged.
const MOST_AROUND: u32 = 512;

/// Vertices that differ in their tangent alone, of which each further one is made without looking for its like.
const MOST_TWINS: usize = 16;

/// Gives `mesh` tangents along the u of its `uv_set`. A vertex whose triangles disagree becomes several.
///
/// Nothing happens to a mesh without normals or without these texture coordinates.
pub(super) fn generate(mesh: &mut Mesh, uv_set: usize) {
    let count = mesh.positions.len();
    let has_uvs = mesh.uvs.get(uv_set).is_some_and(|uvs| uvs.len() == count);
    if mesh.normals.len() != count || !has_uvs || count == 0 {
        return;
    }
    let tangents = corner_tangents(mesh, uv_set);
    split_vertices(mesh, &tangents);
}

/// Three a triangle.
fn corner_tangents(mesh: &Mesh, uv_set: usize) -> Vec<Vec4> {
    let mut tangents: Vec<Vec4> = mesh
        .triangles
        .iter()
        .flat_map(|triangle| own_tangents(mesh, uv_set, triangle))
        .collect();
    let averaged = averaged_triangles(mesh, uv_set);
    let mut smooth = Smooth {
        mesh,
        uv_set,
        averaged: &averaged,
        tangents: &mut tangents,
    };
    // It has no variant of an error.
    let _ = bevy_mikktspace::generate_tangents(&mut smooth);
    tangents
}

/// The triangles that share their vertices' tangents with their neighbours.
fn averaged_triangles(mesh: &Mesh, uv_set: usize) -> Vec<u32> {
    let key = |vertex: u32| {
        let Corner {
            position: p,
            normal: n,
            uv,
        } = Corner::of(mesh, uv_set, vertex);
        [p.x, p.y, p.z, n.x, n.y, n.z, uv.x, uv.y].map(f32::to_bits)
    };
    let mut around: HashMap<[u32; 8], u32> = HashMap::with_capacity(mesh.positions.len());
    let mut of_vertex = vec![0; mesh.positions.len()];
    for &vertex in mesh.triangles.iter().flatten() {
        *around.entry(key(vertex)).or_default() += 1;
    }
    for (vertex, count) in of_vertex.iter_mut().enumerate() {
        *count = around.get(&key(vertex as u32)).copied().unwrap_or_default();
    }
    let is_averaged = |triangle: &[u32; 3]| {
        let [a, b, c] = triangle.map(|vertex| Corner::of(mesh, uv_set, vertex).position);
        let is_degenerate = a == b || b == c || c == a;
        let is_crowded = triangle
            .iter()
            .any(|&vertex| of_vertex.get(vertex as usize) > Some(&MOST_AROUND));
        !is_degenerate && !is_crowded
    };
    (0u32..)
        .zip(&mesh.triangles)
        .filter(|(_, triangle)| is_averaged(triangle))
        .map(|(index, _)| index)
        .collect()
}

/// A vertex of a mesh; neutral where the mesh has none.
struct Corner {
    position: Vec3,
    normal: Vec3,
    uv: Vec2,
}

impl Corner {
    fn of(mesh: &Mesh, uv_set: usize, vertex: u32) -> Corner {
        let at = vertex as usize;
        let uvs = mesh.uvs.get(uv_set);
        Corner {
            position: mesh.positions.get(at).copied().unwrap_or_default(),
            normal: mesh.normals.get(at).copied().unwrap_or(Vec3::Z),
            uv: uvs.and_then(|uvs| uvs.get(at)).copied().unwrap_or_default(),
        }
    }
}

/// The direction of growing u on a triangle by itself, made square to each corner's normal.
fn own_tangents(mesh: &Mesh, uv_set: usize, triangle: &[u32; 3]) -> [Vec4; 3] {
    let [a, b, c] = triangle.map(|vertex| Corner::of(mesh, uv_set, vertex));
    let (p1, p2) = (b.position - a.position, c.position - a.position);
    let (t1, t2) = (b.uv - a.uv, c.uv - a.uv);
    let area = t1.perp_dot(t2);
    let along = (p1 * t2.y - p2 * t1.y) * 1f32.copysign(area);
    // v grows downward and green points up, as in `set_tangent`.
    let sign = if area > 0.0 { -1.0 } else { 1.0 };
    [a, b, c].map(|corner| squared(along, corner.normal).extend(sign))
}

/// A unit vector along `t`, square to the unit vector `n`.
fn squared(t: Vec3, n: Vec3) -> Vec3 {
    (t - n * n.dot(t))
        .try_normalize()
        .unwrap_or_else(|| n.any_orthonormal_vector())
}

/// What Mikkelsen's algorithm reads and writes.
struct Smooth<'a> {
    mesh: &'a Mesh,
    uv_set: usize,
    averaged: &'a [u32],
    tangents: &'a mut [Vec4],
}

impl Smooth<'_> {
    fn corner(&self, face: usize, vert: usize) -> Corner {
        let triangle = self.averaged.get(face).map_or(0, |&index| index as usize);
        let corners = self.mesh.triangles.get(triangle).unwrap_or(&[0; 3]);
        let vertex = corners.get(vert).copied().unwrap_or_default();
        Corner::of(self.mesh, self.uv_set, vertex)
    }
}

/// The platform's arc cosine differs from machine to machine.
struct SameEverywhere;

impl Ops for SameEverywhere {
    fn sqrt(x: f32) -> f32 {
        x.sqrt()
    }

    fn acos(x: f32) -> f32 {
        libm::acos(x.into()) as f32
    }
}

impl Geometry<SameEverywhere> for Smooth<'_> {
    fn num_faces(&self) -> usize {
        self.averaged.len()
    }

    fn num_vertices_of_face(&self, _face: usize) -> usize {
        3
    }

    fn position(&self, face: usize, vert: usize) -> [f32; 3] {
        self.corner(face, vert).position.into()
    }

    fn normal(&self, face: usize, vert: usize) -> [f32; 3] {
        self.corner(face, vert).normal.into()
    }

    fn tex_coord(&self, face: usize, vert: usize) -> [f32; 2] {
        self.corner(face, vert).uv.into()
    }

    fn set_tangent(&mut self, space: Option<TangentSpace>, face: usize, vert: usize) {
        let Some(space) = space else { return };
        let normal = self.corner(face, vert).normal;
        let [x, y, z, sign] = space.tangent_encoded();
        let along = Vec3::new(x, y, z);
        let triangle = self.averaged.get(face).map_or(0, |&index| index as usize);
        if let Some(tangent) = self.tangents.get_mut(3 * triangle + vert)
            && along.is_finite()
            && along != Vec3::ZERO
        {
            // The algorithm's v grows upward, ours downward; green is up in both.
            *tangent = squared(along, normal).extend(-sign);
        }
    }
}

/// Writes a tangent to every vertex; corners of one vertex with different tangents come to be of different vertices.
fn split_vertices(mesh: &mut Mesh, tangents: &[Vec4]) {
    const NO_TWIN: u32 = u32::MAX;
    let mut given: Vec<Option<Vec4>> = vec![None; mesh.positions.len()];
    let mut twins = vec![NO_TWIN; mesh.positions.len()];
    let mut triangles = std::mem::take(&mut mesh.triangles);
    let corners = triangles.iter_mut().flatten();
    for (vertex, &tangent) in corners.zip(tangents) {
        let mut at = *vertex;
        let mut found = None;
        for _ in 0..MOST_TWINS {
            let Some(slot) = given.get_mut(at as usize) else {
                break;
            };
            if *slot.get_or_insert(tangent) == tangent {
                found = Some(at);
                break;
            }
            match twins.get(at as usize) {
                Some(&next) if next != NO_TWIN => at = next,
                _ => break,
            }
        }
        *vertex = found.unwrap_or_else(|| {
            let new = copy_vertex(mesh, *vertex as usize);
            given.push(Some(tangent));
            let rest = twins.get(at as usize).copied().unwrap_or(NO_TWIN);
            twins.push(rest);
            if let Some(twin) = twins.get_mut(at as usize) {
                *twin = new;
            }
            new
        });
    }
    mesh.triangles = triangles;
    mesh.tangents = given
        .into_iter()
        .map(|tangent| tangent.unwrap_or(Vec4::new(1.0, 0.0, 0.0, 1.0)))
        .collect();
}

/// Appends a vertex like number `vertex`.
fn copy_vertex(mesh: &mut Mesh, vertex: usize) -> u32 {
    fn copy<T: Copy>(list: &mut Vec<T>, at: usize) {
        if let Some(&item) = list.get(at) {
            list.push(item);
        }
    }
    let new = mesh.positions.len() as u32;
    copy(&mut mesh.positions, vertex);
    copy(&mut mesh.normals, vertex);
    mesh.uvs.iter_mut().for_each(|uvs| copy(uvs, vertex));
    copy(&mut mesh.colors, vertex);
    new
}
