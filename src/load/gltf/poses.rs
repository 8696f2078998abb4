//! Which nodes are posed: those whose skin fits their mesh, as long as there are not too many.

use super::Warnings;
use super::document::named;
use super::primitives::BYTES_A_VERTEX;
use crate::load::pose::Target;
use crate::load::{Budget, Model, ModelMesh};
use std::collections::HashSet;

/// What a shape has for poses.
struct Posable {
    /// Whether joints move any of it.
    bends: bool,
    /// The greatest index of a joint that moves a vertex.
    last_joint: Option<u16>,
    /// How many vertices a pose of it has.
    vertices: u64,
}

/// Takes skins from nodes whose mesh they do not fit, and poses from nodes that would come to more than `budget`
/// vertices or more than `memory` holds: a short file can show one long mesh in as many poses as it has nodes.
pub(super) fn fit(model: &mut Model, mut budget: u64, memory: &Budget, warnings: &mut Warnings) {
    let shapes = model.shapes.iter();
    let posables: Vec<Posable> = shapes.map(|shape| posable(model, shape)).collect();
    let weighted_by_curves: HashSet<usize> = model.motion.weighted_nodes().collect();
    let mut known = HashSet::new();
    let mut left_out = HashSet::new();
    for (index, node) in model.nodes.iter_mut().enumerate() {
        let Some((shape, posable)) = node.shape.and_then(|s| Some((s, posables.get(s)?))) else {
            continue;
        };
        if let Some(skin) = node.skin.and_then(|skin| model.skins.get(skin)) {
            let lacks = |last: u16| usize::from(last) >= skin.joints.len();
            let problem = if !posable.bends {
                Some("its mesh has a skin, but no joints and weights")
            } else if posable.last_joint.is_some_and(lacks) {
                Some("its mesh names joints that its skin lacks")
            } else {
                None
            };
            if let Some(problem) = problem {
                let place = named("node", index, Some(&node.name));
                warnings.add(format!("{place}: {problem}: it stands as its node does"));
                node.skin = None;
            }
        }
        let is_weighted = node.weights.is_some() || weighted_by_curves.contains(&index);
        if !known.insert((shape, node.skin, is_weighted.then_some(index))) {
            continue;
        }
        let rest = budget
            .checked_sub(posable.vertices)
            .ok_or_else(|| "all poses are many times what the buffers hold".to_owned());
        let bytes = posable.vertices.saturating_mul(BYTES_A_VERTEX);
        let taken = rest.and_then(|rest| match memory.take(bytes) {
            Ok(()) => Ok(rest),
            Err(problem) => Err(format!("a pose {problem}")),
        });
        match taken {
            Ok(rest) => budget = rest,
            Err(problem) => {
                warnings.add(format!("{problem}: one is left out"));
                (node.skin, node.weights) = (None, None);
                left_out.insert(index);
            }
        }
    }
    model.motion.tracks.retain(|track| match track.target {
        Target::NodeWeights(node) | Target::NodeWeight(node, _) => !left_out.contains(&node),
        _ => true,
    });
}

fn posable(model: &Model, shape: &ModelMesh) -> Posable {
    let mut posable = Posable {
        bends: false,
        last_joint: None,
        vertices: 0,
    };
    for part in &shape.parts {
        if let Some(deformation) = model.deformations.get(&part.mesh) {
            let mesh = model.meshes.get(part.mesh as usize);
            posable.vertices += mesh.map_or(0, |mesh| mesh.positions.len() as u64);
            posable.bends |= !deformation.influences.is_empty();
            posable.last_joint = posable.last_joint.max(deformation.last_joint);
        }
    }
    posable
}
