//! Skins: which joints there are, and how much each moves each vertex (glTF 2.0, section 3.7.3).

use super::accessors;
use super::buffers::Buffers;
use super::document::{Document, named};
use super::elements::Elements;
use super::kept::Kept;
use super::primitives::Reader;
use super::{Warnings, meshes};
use crate::Error;
use crate::load::pose::{Deformation, Influence, Skin};
use glam::{DAffine3, DMat3, DVec3};
use gltf::json::accessor::Type;
use gltf::json::mesh::Semantic;

/// Weights whose sum is further from 1 are worth a warning: 8-bit ones that were rounded one by one are nearer.
const SUM_TOLERANCE: f32 = 0.01;

/// The skins of a file, by their index in it; `None` for one that cannot be used.
pub(super) fn all(
    document: &Document,
    buffers: &Buffers,
    warnings: &mut Warnings,
) -> Vec<Option<Skin>> {
    let skins = document.root.skins.iter().enumerate();
    let mut budget = meshes::budget(buffers);
    skins
        .map(|(index, json)| {
            let skin = one(document, buffers, json, &mut budget);
            if let Err(problem) = &skin {
                let place = named("skin", index, json.name.as_ref());
                warnings.add(format!(
                    "{place}: {problem}: its meshes stand as their nodes do"
                ));
            }
            skin.ok()
        })
        .collect()
}

/// A skin; what it reads is taken from `budget`, since many can be of the same bytes.
fn one(
    document: &Document,
    buffers: &Buffers,
    json: &gltf::json::Skin,
    budget: &mut u64,
) -> Result<Skin, String> {
    let nodes = document.root.nodes.len();
    let joints: Vec<usize> = json.joints.iter().map(|joint| joint.value()).collect();
    if let Some(joint) = joints.iter().find(|&&joint| joint >= nodes) {
        return Err(format!(
            "joint node {joint} does not exist, there are {nodes}"
        ));
    }
    let Some(accessor) = json.inverse_bind_matrices else {
        return Ok(Skin {
            joints,
            inverse_binds: Vec::new(),
        });
    };
    let wrong = |problem: String| format!("inverse bind matrices: {problem}");
    if *budget == 0 {
        return Err(wrong("are many times what the buffers hold".into()));
    }
    let matrices =
        accessors::read(document, buffers, accessor.value(), &[Type::Mat4]).map_err(wrong)?;
    let read = joints.len() + matrices.stored_count();
    *budget = budget.saturating_sub(read as u64);
    if matrices.count < joints.len() {
        let (found, expected) = (matrices.count, joints.len());
        return Err(wrong(format!("has {found} elements for {expected} joints")));
    }
    let bytes = size_of::<DAffine3>() as u64 * joints.len() as u64;
    let taken = document.budget.take(bytes);
    taken.map_err(|problem| wrong(problem.to_string()))?;
    let inverse_binds: Vec<DAffine3> = (0..joints.len())
        .map(|i| affine(&matrices.floats::<16>(i)))
        .collect();
    if !inverse_binds.iter().all(DAffine3::is_finite) {
        return Err(wrong("are not of finite numbers".into()));
    }
    Ok(Skin {
        joints,
        inverse_binds,
    })
}

/// A matrix column by column, but for its last row, which is 0 0 0 1.
fn affine(matrix: &[f32; 16]) -> DAffine3 {
    let column = |at: usize| {
        let [x, y, z] = [at, at + 1, at + 2].map(|i| f64::from(matrix[i]));
        DVec3::new(x, y, z)
    };
    let linear = DMat3::from_cols(column(0), column(4), column(8));
    DAffine3::from_mat3_translation(linear, column(12))
}

/// Four joints with their weights.
const BYTES_A_SET: u64 = 32;

impl Reader<'_> {
    /// The joints and weights of the primitive's vertices, into `deformation`. What cannot be read is a warning, and
    /// no joint moves the mesh.
    ///
    /// # Errors
    ///
    /// They are more than `budget` (vertices, once for each set), from which they are taken.
    pub(super) fn influences(
        &self,
        deformation: &mut Deformation,
        kept: &Kept,
        count: usize,
        budget: &mut u64,
        warnings: &mut Warnings,
    ) -> Result<(), Error> {
        let mut sets = Vec::new();
        let attributes = self.primitive.attributes.len() as u32;
        for number in 0..attributes {
            match self.set(number, count) {
                Ok(Some(set)) => sets.push(set),
                Ok(None) => break,
                Err(problem) => {
                    warnings.add(format!("{}: {problem}: no joint moves it", self.place));
                    return Ok(());
                }
            }
        }
        if sets.is_empty() {
            return Ok(());
        }
        let vertices = kept.count();
        self.spend(budget, vertices.saturating_mul(sets.len()), BYTES_A_SET)?;
        let each = sets.len() * 4;
        let mut influences = vec![Influence::default(); vertices * each];
        let mut mended = Mended::default();
        for (vertex, i) in kept.vertices().into_iter().enumerate() {
            let place = influences.get_mut(vertex * each..(vertex + 1) * each);
            let of_vertex = place.unwrap_or_default();
            for (four, (joints, weights)) in of_vertex.chunks_exact_mut(4).zip(&sets) {
                let (joints, weights) = (
                    joints.floats::<4>(i as usize),
                    weights.floats::<4>(i as usize),
                );
                for (influence, (joint, weight)) in
                    four.iter_mut().zip(joints.into_iter().zip(weights))
                {
                    *influence = mended.influence(joint, weight);
                }
            }
            mended.share(of_vertex);
        }
        mended.tell(warnings);
        deformation.last_joint = influences.iter().map(|influence| influence.joint).max();
        deformation.influences = influences;
        deformation.influences_a_vertex = each;
        Ok(())
    }

    /// A set of joints and of weights, if the primitive has it.
    fn set(
        &self,
        number: u32,
        count: usize,
    ) -> Result<Option<(Elements<'_>, Elements<'_>)>, String> {
        let attribute = |semantic: Semantic, name: &str| {
            let name = format!("{name}_{number}");
            self.attribute(&semantic, &name, &[Type::Vec4], count)
                .map_err(|error| match error {
                    Error::Malformed { problem, .. } => format!("{name}: {problem}"),
                    other => other.to_string(),
                })
        };
        let joints = attribute(Semantic::Joints(number), "JOINTS")?;
        let weights = attribute(Semantic::Weights(number), "WEIGHTS")?;
        match (joints, weights) {
            (Some(joints), Some(_)) if !joints.counts() => Err(format!(
                "JOINTS_{number}: are signed or fractions, expected unsigned integers"
            )),
            (Some(joints), Some(weights)) => Ok(Some((joints, weights))),
            (None, None) => Ok(None),
            _ => Err(format!("has one of JOINTS_{number} and WEIGHTS_{number}")),
        }
    }
}

/// Influences for vertices that were split: `old_vertices` says which of the old ones each of the new ones was.
pub(super) fn split(deformation: &mut Deformation, old_vertices: &[usize]) {
    let each = deformation.influences_a_vertex;
    let of_vertex = |old: usize| deformation.influences.get(old * each..(old + 1) * each);
    deformation.influences = old_vertices
        .iter()
        .flat_map(|&old| of_vertex(old).unwrap_or_default())
        .copied()
        .collect();
}

/// What was wrong with weights and could be mended.
#[derive(Default)]
struct Mended {
    negative: usize,
    unequal_to_one: usize,
    none: usize,
}

impl Mended {
    fn influence(&mut self, joint: f32, weight: f32) -> Influence {
        // Unused places of a vertex may name any joint.
        if weight > 0.0 && weight.is_finite() {
            let joint = joint as u16;
            return Influence { joint, weight };
        }
        self.negative += usize::from(weight != 0.0);
        Influence::default()
    }

    /// Makes the weights of a vertex add up to 1.
    fn share(&mut self, of_vertex: &mut [Influence]) {
        let sum: f32 = of_vertex.iter().map(|influence| influence.weight).sum();
        if !(sum > 0.0 && sum.is_finite()) {
            self.none += 1;
            // As other viewers do: all of it to the first joint.
            if let Some(first) = of_vertex.first_mut() {
                first.weight = 1.0;
            }
            of_vertex.iter_mut().skip(1).for_each(|i| i.weight = 0.0);
            return;
        }
        self.unequal_to_one += usize::from((sum - 1.0).abs() > SUM_TOLERANCE);
        of_vertex.iter_mut().for_each(|i| i.weight /= sum);
    }

    fn tell(&self, warnings: &mut Warnings) {
        for (message, count) in [
            (
                "a joint's weight that is negative or no number is taken as 0",
                self.negative,
            ),
            (
                "the joints' weights of a vertex do not add up to 1 and are scaled",
                self.unequal_to_one,
            ),
            (
                "a vertex without joints' weights goes with its first joint",
                self.none,
            ),
        ] {
            warnings.add_times(message, count);
        }
    }
}
