//! How nodes say where they stand (glTF 2.0, section 3.5.3).

use super::Warnings;
use crate::load::pose::Factors;
use glam::{DAffine3, DMat3, DVec3};
use gltf::json::Node as NodeJson;

/// A node's transform, `matrix` or `translation * rotation * scale` (glTF 2.0, section 3.5.3).
pub(super) fn to_parent(json: &NodeJson, warnings: &mut Warnings) -> DAffine3 {
    if let Some(matrix) = json.matrix {
        let [x, y, z, w] = [0, 4, 8, 12].map(|at| {
            let [a, b, c] = [0, 1, 2].map(|row| f64::from(matrix[at + row]));
            DVec3::new(a, b, c)
        });
        if [3, 7, 11, 15].map(|at| matrix[at]) != [0.0, 0.0, 0.0, 1.0] {
            warnings.add("the last row of a node's matrix is not 0 0 0 1 and is ignored");
        }
        return DAffine3::from_mat3_translation(DMat3::from_cols(x, y, z), w);
    }
    factors(json, warnings).matrix()
}

/// A node's transform in the factors that animations change; a matrix has them only as far as it does not shear.
pub(super) fn factors_of(json: &NodeJson) -> Factors {
    let mut told_already = Warnings::default();
    if json.matrix.is_some() {
        Factors::of(&to_parent(json, &mut told_already))
    } else {
        factors(json, &mut told_already)
    }
}

fn factors(json: &NodeJson, warnings: &mut Warnings) -> Factors {
    let rotation = json.rotation.map(|rotation| rotation.0);
    if rotation == Some([0.0; 4]) {
        warnings.add("a node's rotation without length is ignored");
    }
    Factors::new(json.translation, rotation, json.scale)
}
