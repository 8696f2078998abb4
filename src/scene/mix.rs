//! What lies between the vertices of a triangle.

use super::PlacedInstance;
use crate::geometry::Triangle;
use crate::mesh::Mesh;
use crate::texture::{Footprint, Image, Taps, TextureUse};
use glam::{Vec2, Vec3, Vec4};
use std::cell::Cell;
use std::ops::{Add, Mul};

/// What a material gives its textures: what is interpolated over a primitive, neutral where the mesh says nothing.
pub(super) struct Vertex {
    pub(super) uvs: [Vec2; 2],
    /// What the ray sees around them.
    pub(super) footprints: [Footprint; 2],
    pub(super) color: [f32; 4],
    /// The last of [`Vertex::taps`], and which set and size it is of: most materials have textures of one size.
    taps: Cell<Option<(Size, Taps)>>,
}

/// A set of texture coordinates, and the width and height of an image.
type Size = (u8, u32, u32);

impl Vertex {
    /// Where the mesh says nothing.
    pub(super) fn neutral() -> Vertex {
        Vertex {
            uvs: [Vec2::ZERO; 2],
            footprints: [Footprint::POINT; 2],
            color: [1.0; 4],
            taps: Cell::new(None),
        }
    }

    /// Where an image is looked up.
    pub(super) fn taps(&self, used: &TextureUse, image: &Image) -> Taps {
        let footprint = self.footprints[usize::from(used.uv_set != 0)];
        if let Some(transform) = used.transform {
            let axes = footprint.axes.map(|axis| transform.transform_vector2(axis));
            return Footprint { axes }.taps(image.width, image.height);
        }
        let asked = (used.uv_set, image.width, image.height);
        match self.taps.get() {
            Some((known, taps)) if known == asked => taps,
            _ => {
                let taps = footprint.taps(image.width, image.height);
                self.taps.set(Some((asked, taps)));
                taps
            }
        }
    }
}

/// A point of a triangle, by the weights of its corners.
pub(super) struct Mix<'a> {
    mesh: &'a Mesh,
    corners: [u32; 3],
    weights: [f32; 3],
}

impl<'a> Mix<'a> {
    #[inline]
    pub(super) fn new(mesh: &'a Mesh, triangle: u32, [v, w]: [f32; 2]) -> Mix<'a> {
        let corners = mesh.triangles.get(triangle as usize).copied();
        Mix {
            mesh,
            corners: corners.unwrap_or_default(),
            weights: [1.0 - v - w, v, w],
        }
    }

    /// What belongs to the three corners; `missing` where the mesh does not say.
    #[inline]
    pub(super) fn corners<T: Copy>(&self, values: &[T], missing: T) -> [T; 3] {
        let [a, b, c] = self.corners;
        let of = |corner: u32| values.get(corner as usize).copied().unwrap_or(missing);
        [of(a), of(b), of(c)]
    }

    /// The mean of what belongs to the corners.
    #[inline]
    fn mixed<T: Copy + Add<Output = T> + Mul<f32, Output = T>>(&self, values: &[T], zero: T) -> T {
        let ([a, b, c], [wa, wb, wc]) = (self.corners(values, zero), self.weights);
        a * wa + b * wb + c * wc
    }

    /// The interpolated normal, the triangle's own where the mesh has none; in the mesh's space.
    #[inline]
    pub(super) fn normal(&self, of_triangle: Vec3) -> Vec3 {
        if self.mesh.normals.is_empty() {
            return of_triangle;
        }
        self.mixed(&self.mesh.normals, of_triangle)
            .normalize_or(of_triangle)
    }

    /// The tangent square to `normal`, both in world space, and a whole sign: interpolation keeps neither. Zero where
    /// the mesh has none.
    pub(super) fn tangent(&self, normal: Vec3, instance: &PlacedInstance) -> Vec4 {
        let tangent = self.mixed(&self.mesh.tangents, Vec4::ZERO);
        let sign = 1f32.copysign(tangent.w);
        let t = tangent.truncate();
        let Some(space) = &instance.space else {
            return square_to(normal, t).extend(sign);
        };
        let matrix = space.to_world.matrix3;
        let sign = if matrix.determinant() < 0.0 {
            -sign
        } else {
            sign
        };
        square_to(normal, matrix * t).extend(sign)
    }

    #[inline]
    pub(super) fn triangle(&self) -> Triangle {
        Triangle(self.corners(&self.mesh.positions, Vec3::ZERO))
    }

    #[inline]
    pub(super) fn has_colors(&self) -> bool {
        !self.mesh.colors.is_empty()
    }

    /// The edges from the first corner to the second and to the third, in each set of texture coordinates.
    pub(super) fn uv_edges(&self) -> [[Vec2; 2]; 2] {
        self.mesh.uvs.each_ref().map(|uvs| {
            let [a, b, c] = self.corners(uvs, Vec2::ZERO);
            [b - a, c - a]
        })
    }

    /// The first set of texture coordinates; zero where the mesh has none.
    pub(super) fn uv(&self) -> Vec2 {
        let [first, _] = &self.mesh.uvs;
        self.mixed(first, Vec2::ZERO)
    }

    /// What textures are looked up with, at a point.
    pub(super) fn vertex(&self) -> Vertex {
        let [_, second] = &self.mesh.uvs;
        let mut vertex = Vertex::neutral();
        vertex.uvs[0] = self.uv();
        if !second.is_empty() {
            vertex.uvs[1] = self.mixed(second, Vec2::ZERO);
        }
        if self.has_colors() {
            let [a, b, c] = self.corners(&self.mesh.colors, [1.0; 4]).map(Vec4::from);
            let [wa, wb, wc] = self.weights;
            vertex.color = (a * wa + b * wb + c * wc).to_array();
        }
        vertex
    }
}

/// The part of `t` that is square to a unit normal, of unit length; zero where there is none.
fn square_to(normal: Vec3, t: Vec3) -> Vec3 {
    (t - normal * normal.dot(t)).normalize_or_zero()
}
