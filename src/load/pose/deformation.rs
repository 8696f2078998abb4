//! What changes the shape of a mesh: morph targets and joints.

use super::{morphing, skinning};
use crate::mesh::Mesh;
use glam::{DAffine3, Vec3};

/// What belongs to a mesh that can change its shape.
#[derive(Clone, Debug, Default)]
pub(in crate::load) struct Deformation {
    /// Named by index, as weights name them.
    pub(in crate::load) targets: Vec<MorphTarget>,
    /// `influences_a_vertex` for each vertex; empty where no joint moves the mesh.
    pub(in crate::load) influences: Vec<Influence>,
    /// A multiple of 4, the same for every vertex.
    pub(in crate::load) influences_a_vertex: usize,
    /// The greatest index of a joint that moves a vertex.
    pub(in crate::load) last_joint: Option<u16>,
}

/// Another shape of a mesh, as what it adds to the first.
#[derive(Clone, Debug, Default, PartialEq)]
pub(in crate::load) struct MorphTarget {
    pub(in crate::load) positions: Vec<Offset>,
    pub(in crate::load) normals: Vec<Offset>,
    pub(in crate::load) tangents: Vec<Offset>,
}

/// A vertex and what is added to something of it.
pub(in crate::load) type Offset = (u32, Vec3);

/// How much a joint moves a vertex; the shares of a vertex add up to 1.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(in crate::load) struct Influence {
    /// An index into the joints of a skin.
    pub(in crate::load) joint: u16,
    /// 0..1.
    pub(in crate::load) weight: f32,
}

/// A skeleton to hang meshes on.
#[derive(Clone, Debug, Default)]
pub(in crate::load) struct Skin {
    /// Indices into the model's nodes.
    pub(in crate::load) joints: Vec<usize>,
    /// From the space of the mesh to that of each joint; empty where they are the same.
    pub(in crate::load) inverse_binds: Vec<DAffine3>,
}

impl Deformation {
    /// Whether there is nothing to it.
    pub(in crate::load) fn is_empty(&self) -> bool {
        self.targets.is_empty() && self.influences.is_empty()
    }

    /// Whether weights change anything.
    pub(super) fn is_morphed(&self, weights: &[f32]) -> bool {
        let mut used = self.targets.iter().zip(weights);
        used.any(|(_, &weight)| weight != 0.0)
    }

    /// The mesh with its morph targets weighted, then moved by its joints where there are matrices for them, and how
    /// many triangles are left out, since a position of theirs is no number.
    pub(super) fn posed(
        &self,
        base: &Mesh,
        weights: &[f32],
        joints: Option<&[DAffine3]>,
    ) -> (Mesh, usize) {
        let mut mesh = base.clone();
        if self.is_morphed(weights) {
            morphing::morph(&mut mesh, &self.targets, weights);
        }
        if let Some(joints) = joints.filter(|_| !self.influences.is_empty()) {
            let each = self.influences_a_vertex;
            skinning::skin(&mut mesh, &self.influences, each, joints);
        }
        let left_out = leave_out_what_is_nowhere(&mut mesh);
        (mesh, left_out)
    }
}

/// Leaves out triangles with a corner that is no finite point; how many.
fn leave_out_what_is_nowhere(mesh: &mut Mesh) -> usize {
    if mesh.positions.iter().all(|p| p.is_finite()) {
        return 0;
    }
    let before = mesh.triangles.len();
    let positions = &mesh.positions;
    let is_somewhere = |&vertex: &u32| {
        positions
            .get(vertex as usize)
            .is_some_and(|p| p.is_finite())
    };
    mesh.triangles
        .retain(|corners| corners.iter().all(is_somewhere));
    for p in &mut mesh.positions {
        if !p.is_finite() {
            *p = Vec3::ZERO;
        }
    }
    before - mesh.triangles.len()
}
