//! Morph targets: other shapes of a primitive, as offsets that weights add to the first (glTF 2.0, section 3.7.2.2).
//!
//! Offsets of positions, normals and tangents are read, those of texture coordinates and colours are not.

use super::Warnings;
use super::accessors;
use super::document::Document;
use super::kept::Kept;
use super::primitives::Reader;
use crate::Error;
use crate::load::pose::{MorphTarget, Offset};
use crate::mesh::Mesh;
use glam::Vec3;
use gltf::json::Index;
use gltf::json::accessor::{Accessor, Type};

/// How many primitives of a mesh are asked for their number of targets, which is the same in all of them (glTF 2.0,
/// section 3.7.2.2): every node and channel asks anew.
const PRIMITIVES_ASKED: usize = 16;

/// How many morph targets the mesh of a node has.
///
/// # Errors
///
/// One line: it has none, or there is no mesh.
pub(super) fn targets_of_node(document: &Document, node: usize) -> Result<usize, String> {
    let node = document.root.nodes.get(node);
    let mesh = node.and_then(|node| node.mesh);
    let mesh = mesh.ok_or("weights a node that has no mesh")?;
    targets_of_mesh(document, mesh.value())
}

/// How many morph targets a mesh has.
///
/// # Errors
///
/// One line: it has none, or there is no such mesh.
pub(super) fn targets_of_mesh(document: &Document, mesh: usize) -> Result<usize, String> {
    let meshes = &document.root.meshes;
    let mesh = meshes
        .get(mesh)
        .ok_or_else(|| format!("mesh {mesh} does not exist, there are {}", meshes.len()))?;
    let targets = mesh.primitives.iter().take(PRIMITIVES_ASKED);
    let targets = targets.filter_map(|primitive| primitive.targets.as_ref().map(Vec::len));
    match targets.max() {
        Some(count) if count > 0 => Ok(count),
        _ => Err("weights a mesh that has no morph targets".into()),
    }
}

/// Weights that a file gives, those that belong to a morph target of mesh `mesh`. Where there are fewer, the others
/// count as 0.
pub(super) fn fitting(
    document: &Document,
    given: &[f32],
    mesh: usize,
    warnings: &mut Warnings,
) -> Vec<f32> {
    let targets = targets_of_mesh(document, mesh).unwrap_or(0);
    if given.len() != targets {
        warnings.add("there are more or fewer weights than morph targets");
    }
    given.iter().take(targets).copied().collect()
}

/// A vertex, and what is added to it.
const BYTES_AN_OFFSET: u64 = 16;

impl Reader<'_> {
    /// The morph targets of the primitive, for the vertices of `mesh`; `count` is how many vertices the file has.
    ///
    /// # Errors
    ///
    /// They are more than `budget` (elements that are stored), from which they are taken. A target that cannot be read
    /// is empty, with a warning.
    pub(super) fn morph_targets(
        &self,
        mesh: &Mesh,
        kept: &Kept,
        count: usize,
        budget: &mut u64,
        warnings: &mut Warnings,
    ) -> Result<Vec<MorphTarget>, Error> {
        let mut targets = Vec::new();
        for (number, json) in self.primitive.targets.iter().flatten().enumerate() {
            let mut target = MorphTarget::default();
            let parts = [
                ("POSITION", json.positions, true, &mut target.positions),
                (
                    "NORMAL",
                    json.normals,
                    !mesh.normals.is_empty(),
                    &mut target.normals,
                ),
                (
                    "TANGENT",
                    json.tangents,
                    !mesh.tangents.is_empty(),
                    &mut target.tangents,
                ),
            ];
            for (name, accessor, is_needed, place) in parts {
                let Some(accessor) = accessor.filter(|_| is_needed) else {
                    continue;
                };
                match self.offsets(accessor, kept, count, budget) {
                    Ok(offsets) => *place = offsets,
                    Err(Refusal::TooMany(error)) => return Err(error),
                    Err(Refusal::Problem(problem)) => warnings.add(format!(
                        "{}, target {number}, {name}: {problem}: it is ignored",
                        self.place
                    )),
                }
            }
            targets.push(target);
        }
        Ok(targets)
    }

    /// What an accessor adds to the vertices that are kept, but for zeros.
    fn offsets(
        &self,
        accessor: Index<Accessor>,
        kept: &Kept,
        count: usize,
        budget: &mut u64,
    ) -> Result<Vec<Offset>, Refusal> {
        let index = accessor.value();
        let elements = accessors::read(self.document, self.buffers, index, &[Type::Vec3])
            .map_err(Refusal::Problem)?;
        self.spend(budget, elements.stored_count(), BYTES_AN_OFFSET)
            .map_err(Refusal::TooMany)?;
        if elements.count != count {
            let problem = format!("has {} elements for {count} positions", elements.count);
            return Err(Refusal::Problem(problem));
        }
        let mut offsets = Vec::new();
        for i in elements.stored() {
            let offset = Vec3::from(elements.floats::<3>(i as usize));
            if !offset.is_finite() {
                return Err(Refusal::Problem("has offsets that are no numbers".into()));
            }
            if offset != Vec3::ZERO
                && let Some(vertex) = kept.place_of(i)
            {
                offsets.push((vertex, offset));
            }
        }
        offsets.shrink_to_fit();
        Ok(offsets)
    }
}

/// Why offsets are not read.
enum Refusal {
    /// They are wrong: a line.
    Problem(String),
    /// They are many times what the buffers hold.
    TooMany(Error),
}

/// Targets for vertices that were split: `old_vertices` says which of the old ones each of the new ones was.
pub(super) fn split(targets: &mut [MorphTarget], old_vertices: &[usize]) {
    for target in targets {
        for offsets in [
            &mut target.positions,
            &mut target.normals,
            &mut target.tangents,
        ] {
            // Their vertices rise.
            let offset_of = |old: usize| {
                let at = offsets.binary_search_by_key(&old, |&(vertex, _)| vertex as usize);
                at.ok().map(|at| offsets[at].1)
            };
            let news = (0u32..).zip(old_vertices);
            *offsets = news
                .filter_map(|(new, &old)| offset_of(old).map(|offset| (new, offset)))
                .collect();
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_vertex_that_is_split_keeps_its_offsets() {
        let mut targets = [MorphTarget {
            positions: vec![(0, Vec3::X), (2, Vec3::Y)],
            ..MorphTarget::default()
        }];
        split(&mut targets, &[2, 0, 1, 2]);
        assert_eq!(
            targets[0].positions,
            [(0, Vec3::Y), (1, Vec3::X), (3, Vec3::Y)]
        );
    }
}
