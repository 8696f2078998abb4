//! The meshes of a model at one moment: its own where nothing changes their shape, posed ones where something does.

use super::{Pose, PosedNode};
use crate::load::Part;
use crate::mesh::Mesh;
use glam::DAffine3;
use std::collections::HashMap;

/// The meshes that a pose shows, made as nodes ask for them.
#[derive(Debug)]
pub(in crate::load) struct PosedMeshes<'p, 'a> {
    pose: &'p Pose<'a>,
    /// Which mesh of the scene each of the model's own is to be, where one is shown as it is.
    pub(in crate::load) own: Vec<Option<u32>>,
    posed: HashMap<Key, u32>,
    /// Triangles that are left out, since a position of theirs is no number at this moment.
    pub(in crate::load) left_out: usize,
}

/// What tells posed meshes apart: the mesh, the skin, and the node where that has weights of its own.
type Key = (u32, Option<usize>, Option<usize>);

impl<'p, 'a> PosedMeshes<'p, 'a> {
    /// None yet.
    pub(in crate::load) fn of(pose: &'p Pose<'a>) -> PosedMeshes<'p, 'a> {
        PosedMeshes {
            pose,
            own: vec![None; pose.model.meshes.len()],
            posed: HashMap::new(),
            left_out: 0,
        }
    }

    /// Which of the scene's meshes a node shows as one of its parts, and where that stands in the model: a skin's joints carry it
    /// there themselves, wherever its node is (glTF 2.0, section 3.7.3.3).
    pub(in crate::load) fn place(
        &mut self,
        node: &PosedNode<'a>,
        part: &Part,
        scene: &mut Vec<Mesh>,
    ) -> (u32, DAffine3) {
        let model = self.pose.model;
        let Some(deformation) = model.deformations.get(&part.mesh) else {
            return (self.own(part.mesh, scene), node.to_model);
        };
        let skin = node
            .node
            .skin
            .filter(|_| !deformation.influences.is_empty());
        let to_model = if skin.is_some() {
            DAffine3::IDENTITY
        } else {
            node.to_model
        };
        let (weights, weighted) = self.pose.weights(node);
        let key = (part.mesh, skin, weighted);
        if let Some(&known) = self.posed.get(&key) {
            return (known, to_model);
        }
        let index = if skin.is_some() || deformation.is_morphed(weights) {
            let joints = skin.and_then(|skin| self.pose.joints.get(skin));
            let base = &model.meshes[part.mesh as usize];
            let (mesh, left_out) = deformation.posed(base, weights, joints.map(Vec::as_slice));
            self.left_out += left_out;
            push(mesh, scene)
        } else {
            self.own(part.mesh, scene)
        };
        self.posed.insert(key, index);
        (index, to_model)
    }

    fn own(&mut self, mesh: u32, scene: &mut Vec<Mesh>) -> u32 {
        let known = &mut self.own[mesh as usize];
        *known.get_or_insert_with(|| push(Mesh::default(), scene))
    }
}

fn push(mesh: Mesh, scene: &mut Vec<Mesh>) -> u32 {
    scene.push(mesh);
    scene.len() as u32 - 1
}
