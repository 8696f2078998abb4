//! Linear blend skinning: vertices moved by the weighted sum of their joints' matrices (glTF 2.0, section 3.7.3).
//!
//! Magnenat-Thalmann, Laperrière and Thalmann 1988, "Joint-Dependent Local Deformations for Hand Animation and Object
//! Grasping".

use super::deformation::Influence;
use crate::mesh::{Mesh, normal_matrix};
use glam::{DAffine3, DMat3, DVec3};

/// Moves every vertex by its joints; `each` of `influences` belong to a vertex. Fronts stay fronts where joints mirror.
pub(super) fn skin(mesh: &mut Mesh, influences: &[Influence], each: usize, joints: &[DAffine3]) {
    let mirroring: Vec<bool> = joints
        .iter()
        .map(|joint| joint.matrix3.determinant() < 0.0)
        .collect();
    let may_mirror = mirroring.contains(&true);
    let mut mirrored: Vec<bool> = Vec::new();
    for (vertex, influences) in influences.chunks_exact(each.max(1)).enumerate() {
        let matrix = blended(influences, joints);
        if let Some(p) = mesh.positions.get_mut(vertex) {
            *p = matrix.transform_point3(p.as_dvec3()).as_vec3();
        }
        if let Some(n) = mesh.normals.get_mut(vertex) {
            let turned = normal_matrix(&matrix.matrix3) * n.as_dvec3();
            *n = turned.normalize_or_zero().as_vec3();
        }
        let mirrors = may_mirror && matrix.matrix3.determinant() < 0.0;
        if let Some(t) = mesh.tangents.get_mut(vertex) {
            let along = (matrix.matrix3 * t.truncate().as_dvec3()).normalize_or_zero();
            *t = along.as_vec3().extend(if mirrors { -t.w } else { t.w });
        }
        if may_mirror {
            mirrored.push(mirrors);
        }
    }
    if may_mirror {
        let is_mirrored = |vertex: u32| mirrored.get(vertex as usize) == Some(&true);
        for triangle in &mut mesh.triangles {
            if triangle
                .iter()
                .filter(|&&vertex| is_mirrored(vertex))
                .count()
                >= 2
            {
                triangle.swap(1, 2);
            }
        }
    }
}

/// The weighted sum of joint matrices.
fn blended(influences: &[Influence], joints: &[DAffine3]) -> DAffine3 {
    let mut sum = DAffine3 {
        matrix3: DMat3::ZERO,
        translation: DVec3::ZERO,
    };
    for influence in influences {
        if let Some(joint) = joints.get(usize::from(influence.joint))
            && influence.weight != 0.0
        {
            let weight = f64::from(influence.weight);
            sum.matrix3 += joint.matrix3 * weight;
            sum.translation += joint.translation * weight;
        }
    }
    sum
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::{Vec3, Vec4};

    fn one_triangle() -> Mesh {
        Mesh {
            positions: vec![Vec3::ZERO, Vec3::X, Vec3::Y],
            triangles: vec![[0, 1, 2]],
            normals: vec![Vec3::new(1.0, 0.0, 1.0).normalize(); 3],
            tangents: vec![Vec4::new(0.0, 1.0, 0.0, 1.0); 3],
            ..Mesh::default()
        }
    }

    fn influence(joint: u16, weight: f32) -> Influence {
        Influence { joint, weight }
    }

    #[test]
    fn a_vertex_between_two_joints_goes_half_way_with_each() {
        let joints = [
            DAffine3::IDENTITY,
            DAffine3::from_translation(DVec3::new(0.0, 0.0, 4.0)),
        ];
        let mut mesh = one_triangle();
        let of_vertices = [(1.0, 0.0), (0.5, 0.5), (0.25, 0.75)];
        let influences: Vec<Influence> = of_vertices
            .iter()
            .flat_map(|&(a, b)| [influence(0, a), influence(1, b)])
            .collect();
        skin(&mut mesh, &influences, 2, &joints);
        assert_eq!(
            mesh.positions,
            [
                Vec3::ZERO,
                Vec3::new(1.0, 0.0, 2.0),
                Vec3::new(0.0, 1.0, 3.0)
            ]
        );
    }

    #[test]
    fn a_stretched_normal_follows_the_inverse_transpose() {
        let stretch = DAffine3::from_scale(DVec3::new(2.0, 1.0, 1.0));
        let mut mesh = one_triangle();
        skin(&mut mesh, &[influence(0, 1.0); 3], 1, &[stretch]);
        let expected = Vec3::new(0.5, 0.0, 1.0).normalize();
        assert!((mesh.normals[0] - expected).length() < 1e-6);
    }

    #[test]
    fn a_front_that_joints_mirror_stays_a_front() {
        let mirror = DAffine3::from_scale(DVec3::new(-1.0, 1.0, 1.0));
        let mut mesh = one_triangle();
        skin(&mut mesh, &[influence(0, 1.0); 3], 1, &[mirror]);
        assert_eq!(mesh.triangle(0).normal(), Vec3::Z);
        assert_eq!(mesh.tangents[0], Vec4::new(0.0, 1.0, 0.0, -1.0));
    }
}
