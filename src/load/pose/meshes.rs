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
    /// Where each of the model's own went, where one is shown as it is.
    own: Vec<Option<u32>>,
    posed: HashMap<Key, u32>,
    /// What is shown.
    pub(in crate::load) meshes: Vec<Mesh>,
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
            meshes: Vec::new(),
            left_out: 0,
        }
    }

    /// The mesh that a node shows as one of its parts, and where that stands in the model: a skin's joints carry it
    /// there themselves, wherever its node is (glTF 2.0, section 3.7.3.3).
    pub(in crate::load) fn place(&mut self, node: &PosedNode<'a>, part: &Part) -> (u32, DAffine3) {
        let model = self.pose.model;
        let Some(deformation) = model.deformations.get(&part.mesh) else {
            return (self.own(part.mesh), node.to_model);
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
            self.push(mesh)
        } else {
            self.own(part.mesh)
        };
        self.posed.insert(key, index);
        (index, to_model)
    }

    fn own(&mut self, mesh: u32) -> u32 {
        if let Some(known) = self.own[mesh as usize] {
            return known;
        }
        let index = self.push(self.pose.model.meshes[mesh as usize].clone());
        self.own[mesh as usize] = Some(index);
        index
    }

    fn push(&mut self, mesh: Mesh) -> u32 {
        self.meshes.push(mesh);
        self.meshes.len() as u32 - 1
    }
}
