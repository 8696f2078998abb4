//! EXT_mesh_gpu_instancing: a node's mesh many times, each by a transform of its own.

use super::accessors;
use super::buffers::Buffers;
use super::document::Document;
use super::elements::Elements;
use super::extensions;
use crate::load::pose::Factors;
use glam::DAffine3;
use gltf::json::Node;
use gltf::json::accessor::Type;
use serde::Deserialize;
use std::collections::BTreeMap;

/// As files call it.
pub(super) const NAME: &str = "EXT_mesh_gpu_instancing";

/// How many parts of meshes a file may place beside one for each byte of its buffers.
const FREE_PARTS: u64 = 1 << 16;

/// Where it stands, in the model and in the scene.
const BYTES_A_PART: u64 = 512;

#[derive(Deserialize)]
struct Instancing {
    attributes: BTreeMap<String, u64>,
}

/// Reads instances, as many as the bytes of the file allow.
pub(super) struct Reader<'a> {
    document: &'a Document,
    buffers: &'a Buffers<'a>,
    /// How many parts may still be placed.
    left: u64,
}

impl<'a> Reader<'a> {
    pub(super) fn new(document: &'a Document, buffers: &'a Buffers<'a>) -> Reader<'a> {
        let left = buffers.total_bytes.saturating_add(FREE_PARTS);
        Reader {
            document,
            buffers,
            left,
        }
    }

    /// Where a node places its mesh, which has `parts` parts, in the node's own space; none where the node places it
    /// once, as nodes do.
    ///
    /// # Errors
    ///
    /// One line: an accessor is wrong, they differ in number, or there are too many.
    pub(super) fn read(
        &mut self,
        node: &Node,
        parts: usize,
    ) -> Result<Option<Vec<DAffine3>>, String> {
        let others = node.extensions.as_ref().map(|e| &e.others);
        let Some(instancing) = extensions::read::<Instancing>(others, NAME)? else {
            return Ok(None);
        };
        let translation = self.attribute(&instancing, "TRANSLATION", Type::Vec3)?;
        let rotation = self.attribute(&instancing, "ROTATION", Type::Vec4)?;
        let scale = self.attribute(&instancing, "SCALE", Type::Vec3)?;
        let given = [&translation, &rotation, &scale];
        let mut counts = given.into_iter().flatten().map(|elements| elements.count);
        // Others only say how instances look.
        let Some(count) = counts.next() else {
            return Ok(None);
        };
        if let Some(other) = counts.find(|&other| other != count) {
            return Err(format!(
                "has attributes of {count} and of {other} instances"
            ));
        }
        self.left = (count as u64)
            .checked_mul(parts.max(1) as u64)
            .and_then(|placed| self.left.checked_sub(placed))
            .ok_or_else(|| {
                format!("{count} instances of {parts} parts are many times what the buffers hold")
            })?;
        let bytes = BYTES_A_PART * count as u64 * parts.max(1) as u64;
        let taken = self.document.budget.take(bytes);
        taken.map_err(|problem| problem.to_string())?;
        let transform = |i| {
            Factors::new(
                translation.as_ref().map(|elements| elements.floats(i)),
                rotation.as_ref().map(|elements| elements.floats(i)),
                scale.as_ref().map(|elements| elements.floats(i)),
            )
            .matrix()
        };
        Ok(Some((0..count).map(transform).collect()))
    }

    fn attribute(
        &self,
        instancing: &Instancing,
        name: &str,
        kind: Type,
    ) -> Result<Option<Elements<'a>>, String> {
        let Some(&accessor) = instancing.attributes.get(name) else {
            return Ok(None);
        };
        let accessor = usize::try_from(accessor).unwrap_or(usize::MAX);
        accessors::read(self.document, self.buffers, accessor, &[kind])
            .map(Some)
            .map_err(|problem| format!("{name}: {problem}"))
    }
}
