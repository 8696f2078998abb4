//! Morph targets: a mesh and what weighted offsets make of it (glTF 2.0, section 3.7.2.2).

use super::deformation::{MorphTarget, Offset};
use crate::mesh::Mesh;
use glam::Vec3;

/// Adds every target times its weight. Targets without a weight do not count.
pub(super) fn morph(mesh: &mut Mesh, targets: &[MorphTarget], weights: &[f32]) {
    let used = || targets.iter().zip(weights).filter(|(_, w)| **w != 0.0);
    let (mut turned_normals, mut turned_tangents) = (false, false);
    for (target, &weight) in used() {
        add(&mut mesh.positions, &target.positions, weight);
        add(&mut mesh.normals, &target.normals, weight);
        for &(vertex, offset) in &target.tangents {
            if let Some(tangent) = mesh.tangents.get_mut(vertex as usize) {
                *tangent += (offset * weight).extend(0.0);
            }
        }
        turned_normals |= !target.normals.is_empty();
        turned_tangents |= !target.tangents.is_empty();
    }
    if turned_normals {
        // A zero is what shading takes for "the face's own".
        mesh.normals
            .iter_mut()
            .for_each(|normal| *normal = normal.normalize_or_zero());
    }
    if turned_tangents {
        for tangent in &mut mesh.tangents {
            let along = tangent.truncate().normalize_or_zero();
            *tangent = along.extend(tangent.w);
        }
    }
}

fn add(to: &mut [Vec3], offsets: &[Offset], weight: f32) {
    for &(vertex, offset) in offsets {
        if let Some(place) = to.get_mut(vertex as usize) {
            *place += offset * weight;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec4;

    #[test]
    fn weighted_offsets_add_up_and_directions_stay_unit() {
        let mut mesh = Mesh {
            positions: vec![Vec3::ZERO, Vec3::X],
            normals: vec![Vec3::Z; 2],
            tangents: vec![Vec4::new(1.0, 0.0, 0.0, -1.0); 2],
            ..Mesh::default()
        };
        let up = MorphTarget {
            positions: vec![(1, Vec3::Y)],
            normals: vec![(1, Vec3::X - Vec3::Z)],
            tangents: vec![(0, Vec3::Y - Vec3::X)],
        };
        let aside = MorphTarget {
            positions: vec![(0, Vec3::X), (1, Vec3::X)],
            ..MorphTarget::default()
        };
        morph(&mut mesh, &[up, aside], &[0.5, -2.0]);
        assert_eq!(
            mesh.positions,
            [Vec3::new(-2.0, 0.0, 0.0), Vec3::new(-1.0, 0.5, 0.0)]
        );
        let half = Vec3::new(1.0, 0.0, 1.0).normalize();
        assert_eq!(mesh.normals[0], Vec3::Z);
        assert!((mesh.normals[1] - half).length() < 1e-6);
        let half = Vec3::new(1.0, 1.0, 0.0).normalize();
        assert!((mesh.tangents[0] - half.extend(-1.0)).length() < 1e-6);
    }

    #[test]
    fn fewer_weights_than_targets_leave_the_rest_out() {
        let mut mesh = Mesh {
            positions: vec![Vec3::ZERO],
            ..Mesh::default()
        };
        let target = MorphTarget {
            positions: vec![(0, Vec3::X)],
            ..MorphTarget::default()
        };
        morph(&mut mesh, &[target.clone(), target], &[1.0]);
        assert_eq!(mesh.positions, [Vec3::X]);
    }
}
