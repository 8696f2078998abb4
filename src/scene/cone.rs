//! What a ray that is as wide as a cone sees of a surface (Akenine-Möller et al. 2021, "Improved Shader and Texture Level
//! of Detail Using Ray Cones").

use super::mix::Mix;
use super::{Primitive, Recent, Scene};
use crate::geometry::Hit;
use crate::mesh::normal_matrix;
use glam::{Vec2, Vec3};

/// No surface is seen at a lesser angle, as its cosine: the footprint would leave every surface.
const LEAST_COSINE: f32 = 1e-5;

/// The diameters of the ellipse that a ray of `width` along the unit vector `d` sees on a surface with unit normal `n`:
/// the long one, and the short one, which is square to it.
pub(super) fn on_surface(d: Vec3, n: Vec3, width: f32) -> [Vec3; 2] {
    let across = n.cross(d);
    let across = across
        .try_normalize()
        .unwrap_or_else(|| n.any_orthonormal_vector());
    let cosine = n.dot(d).abs().max(LEAST_COSINE);
    [across.cross(n) * (width / cosine), across * width]
}

impl Mix<'_> {
    /// What vectors on the triangle, in the mesh's space, are in each set of texture coordinates.
    pub(super) fn in_texture(&self, axes: [Vec3; 2]) -> [[Vec2; 2]; 2] {
        let [a, b, c] = self.triangle().0;
        let (e1, e2) = (b - a, c - a);
        let n = e1.cross(e2);
        let scale = 1.0 / n.length_squared();
        let weights = axes.map(|axis| {
            let (v, w) = (axis.cross(e2).dot(n), e1.cross(axis).dot(n));
            Vec2::new(v, w) * scale
        });
        self.uv_edges()
            .map(|[u1, u2]| weights.map(|weight| u1 * weight.x + u2 * weight.y))
    }
}

impl Scene {
    /// One over the radius of the surface at `hit`, above zero where it bulges toward who sees its front; from how normals
    /// turn along a triangle's edges, in the mean over directions.
    pub fn curvature(&self, hit: &Hit, recent: &mut Recent) -> f32 {
        let (instance, triangle) = match self.primitive_near(hit.primitive, recent) {
            Primitive::Sphere(sphere) => return 1.0 / self.spheres[sphere].shape.radius,
            Primitive::Plane(_) => return 0.0,
            Primitive::Triangle { instance, triangle } => (&self.instances[instance], triangle),
        };
        let mesh = self.mesh(instance.mesh);
        if mesh.normals.is_empty() {
            return 0.0;
        }
        let mix = Mix::new(mesh, triangle, hit.barycentric);
        let mut corners = mix.triangle().0;
        let mut normals = mix.corners(&mesh.normals, Vec3::ZERO);
        if let Some(space) = &instance.space {
            let matrix = space.to_world.matrix3;
            let turn = normal_matrix(&matrix.as_dmat3());
            corners = corners.map(|corner| matrix * corner);
            normals = normals.map(|n| (turn * n.as_dvec3()).normalize_or_zero().as_vec3());
        }
        let along = |i: usize, j: usize| {
            let edge = corners[j] - corners[i];
            let curvature = (normals[j] - normals[i]).dot(edge) / edge.length_squared();
            if curvature.is_finite() {
                curvature
            } else {
                0.0
            }
        };
        (along(0, 1) + along(1, 2) + along(2, 0)) / 3.0
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn head_on_a_footprint_is_round_and_slanted_it_is_longer_by_the_cosine() {
        let [long, short] = on_surface(Vec3::NEG_Y, Vec3::Y, 0.5);
        assert!((long.length() - 0.5).abs() < 1e-6 && (short.length() - 0.5).abs() < 1e-6);
        assert!(long.dot(short).abs() < 1e-6 && long.y == 0.0);
        // cos = 0.6.
        let [long, short] = on_surface(Vec3::new(0.8, -0.6, 0.0), Vec3::Y, 0.3);
        assert!((long.abs() - Vec3::X * 0.5).length() < 1e-6);
        assert!((short.abs() - Vec3::Z * 0.3).length() < 1e-6);
    }
}
