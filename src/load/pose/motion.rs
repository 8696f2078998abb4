//! What moves in a model: curves, and what each changes.

use super::curve::Curve;
use super::{CameraProperty, LightProperty, MaterialProperty};
use glam::{DAffine3, DQuat, DVec3};
use std::collections::BTreeMap;

/// What the chosen animations of a model do.
#[derive(Clone, Debug, Default)]
pub(in crate::load) struct Motion {
    /// The later over the earlier.
    pub(in crate::load) tracks: Vec<Track>,
    /// Where the nodes that tracks move stand without them.
    pub(in crate::load) rest: BTreeMap<usize, Factors>,
}

impl Motion {
    /// The nodes that curves weight the morph targets of.
    pub(in crate::load) fn weighted_nodes(&self) -> impl Iterator<Item = usize> {
        self.tracks.iter().filter_map(|track| match track.target {
            Target::NodeWeights(node) | Target::NodeWeight(node, _) => Some(node),
            _ => None,
        })
    }
}

/// A curve, and what it changes.
#[derive(Clone, Debug)]
pub(in crate::load) struct Track {
    pub(in crate::load) target: Target,
    pub(in crate::load) curve: Curve,
}

/// What a curve changes. Nodes, materials, lights, cameras and shapes by their index in the model.
#[derive(Clone, Debug, PartialEq)]
pub(in crate::load) enum Target {
    /// Of a node.
    Translation(usize),
    /// Of a node.
    Rotation(usize),
    /// Of a node.
    Scale(usize),
    /// Whether a node and what is below it is seen: 0 or not.
    Visibility(usize),
    /// How much each morph target counts in what a node shows.
    NodeWeights(usize),
    /// One of those.
    NodeWeight(usize, usize),
    /// How much each morph target counts in a shape, where a node does not say it.
    ShapeWeights(usize),
    /// One of those.
    ShapeWeight(usize, usize),
    /// Of a material.
    Material(usize, MaterialProperty),
    /// Of a light.
    Light(usize, LightProperty),
    /// Of a camera.
    Camera(usize, CameraProperty),
}

/// A node's transform in the factors that animations change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::load) struct Factors {
    pub(in crate::load) translation: DVec3,
    /// Of unit length.
    pub(in crate::load) rotation: DQuat,
    pub(in crate::load) scale: DVec3,
}

impl Factors {
    /// What a file says; a rotation without length is none.
    pub(in crate::load) fn new(
        translation: Option<[f32; 3]>,
        rotation: Option<[f32; 4]>,
        scale: Option<[f32; 3]>,
    ) -> Factors {
        let vector = |v: [f32; 3]| DVec3::from(v.map(f64::from));
        let rotation = rotation.filter(|rotation| *rotation != [0.0; 4]);
        let turn = |rotation: [f32; 4]| DQuat::from_array(rotation.map(f64::from)).normalize();
        Factors {
            translation: translation.map_or(DVec3::ZERO, vector),
            rotation: rotation.map_or(DQuat::IDENTITY, turn),
            scale: scale.map_or(DVec3::ONE, vector),
        }
    }

    /// The factors of a matrix; of one that flattens, its translation only.
    pub(in crate::load) fn of(matrix: &DAffine3) -> Factors {
        if matrix.matrix3.determinant() == 0.0 {
            return Factors {
                translation: matrix.translation,
                rotation: DQuat::IDENTITY,
                scale: DVec3::ONE,
            };
        }
        let (scale, rotation, translation) = matrix.to_scale_rotation_translation();
        Factors {
            translation,
            rotation,
            scale,
        }
    }

    /// `translation * rotation * scale` (glTF 2.0, section 3.5.3).
    pub(in crate::load) fn matrix(&self) -> DAffine3 {
        DAffine3::from_scale_rotation_translation(self.scale, self.rotation, self.translation)
    }
}
