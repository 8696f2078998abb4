//! A tube along a trefoil knot.

use super::grid_triangles;
use crate::mesh::Mesh;
use glam::DVec3;
use std::f64::consts::TAU;

/// A closed tube of `2 * around * along` triangles with smooth normals, about 2 across, its front a three-fold star.
pub fn knot(along: u32, around: u32) -> Mesh {
    let mut mesh = Mesh {
        name: "knot".into(),
        ..Mesh::default()
    };
    // One more row and column than cells: the last vertices stand on the first.
    for j in 0..=along {
        let t = TAU * f64::from(j % along) / f64::from(along);
        let (center, tangent) = (
            trefoil(t),
            (trefoil(t + 1e-4) - trefoil(t - 1e-4)).normalize(),
        );
        let side = tangent.cross(DVec3::Z).normalize();
        let front = side.cross(tangent);
        for i in 0..=around {
            let angle = TAU * f64::from(i % around) / f64::from(around);
            let normal = side * libm::cos(angle) + front * libm::sin(angle);
            mesh.positions.push((center + normal * 0.2).as_vec3());
            mesh.normals.push(normal.as_vec3());
        }
    }
    mesh.triangles = grid_triangles(around + 1, along + 1);
    mesh
}

/// The trefoil `(sin t + 2 sin 2t, cos t - 2 cos 2t, -sin 3t)`, scaled to a radius of about 0.8.
fn trefoil(t: f64) -> DVec3 {
    let x = libm::sin(t) + 2.0 * libm::sin(2.0 * t);
    let y = libm::cos(t) - 2.0 * libm::cos(2.0 * t);
    DVec3::new(x, y, -libm::sin(3.0 * t)) * 0.27
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn triangles_face_the_way_their_normals_do() {
        let mesh = knot(96, 16);
        for (index, corners) in (0..).zip(&mesh.triangles) {
            let normal = mesh.normals[corners[0] as usize];
            assert!(mesh.triangle(index).normal().dot(normal) > 0.0);
        }
    }
}
