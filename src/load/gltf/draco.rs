//! KHR_draco_mesh_compression: the triangles and attributes of a primitive in a stream that crate `draco-core` reads.
//!
//! A stream says of itself how much it holds. What it may hold is bounded by what is left of the file's budget of
//! corners and vertices (see `meshes.rs`), before memory is taken for it.

use super::buffers::Buffers;
use super::document::{Document, one_line};
use super::elements::Elements;
use super::extensions;
use draco_core::{
    DataType, DecodeLimits, DecoderBuffer, Mesh, MeshDecoder, PointAttribute, PointIndex,
};
use gltf::json::accessor::{Accessor, ComponentType, Type};
use gltf::json::mesh::Primitive;
use gltf::json::validation::Checked;
use serde::Deserialize;
use std::collections::BTreeMap;

/// As files call it.
pub(super) const NAME: &str = "KHR_draco_mesh_compression";

/// How many bytes a corner or a vertex may have: twice all attributes that glTF names have together, for what decoding
/// takes beside.
const BYTES_AN_ELEMENT: u64 = 256;

/// What a primitive says of its stream.
#[derive(Clone, Deserialize, PartialEq, Eq, Hash)]
#[serde(rename_all = "camelCase")]
pub(super) struct Compressed {
    buffer_view: usize,
    /// Which attribute of the stream is which of the primitive.
    attributes: BTreeMap<String, u32>,
}

/// What was in a stream.
pub(super) struct Unpacked {
    pub(super) triangles: Vec<[u32; 3]>,
    points: usize,
    attributes: BTreeMap<String, Attribute>,
}

/// An attribute, tightly packed.
struct Attribute {
    bytes: Vec<u8>,
    components: usize,
    component: ComponentType,
    normalized: bool,
}

/// Where the geometry of a primitive is, if it is compressed.
///
/// # Errors
///
/// The parser's words.
pub(super) fn of(primitive: &Primitive) -> Result<Option<Compressed>, String> {
    let others = primitive.extensions.as_ref().map(|e| &e.others);
    extensions::read(others, NAME)
}

/// Whether the primitive's accessors have bytes of their own, so that it can be read without its stream.
pub(super) fn is_optional(document: &Document, primitive: &Primitive) -> bool {
    let has_bytes = |index: usize| {
        let accessor = document.root.accessors.get(index);
        // One that does not exist is left to be an error.
        accessor.is_none_or(|a| a.buffer_view.is_some() || a.sparse.is_some())
    };
    let accessors = primitive.attributes.values().chain(&primitive.indices);
    accessors.into_iter().all(|index| has_bytes(index.value()))
}

impl Compressed {
    /// Reads the stream. It may have as many corners and vertices as `budget` says, from which its bytes are taken, so
    /// that reading it again and again comes to an end.
    ///
    /// # Errors
    ///
    /// One line: the stream is wrong or too long, or lacks an attribute.
    pub(super) fn unpack(
        &self,
        document: &Document,
        buffers: &Buffers,
        primitive: &Primitive,
        budget: &mut u64,
    ) -> Result<Unpacked, String> {
        let stream = buffers.view(self.buffer_view)?.bytes;
        *budget = budget
            .checked_sub(stream.len() as u64)
            .ok_or("the streams up to here are many times what the buffers hold")?;
        let memory = document.budget.left() / BYTES_AN_ELEMENT;
        let most = memory.min(*budget);
        let limits = DecodeLimits::default()
            .with_max_points(most)
            .with_max_faces(most / 3)
            .with_max_decoded_bytes(most.saturating_mul(BYTES_AN_ELEMENT) / 2);
        let mut mesh = Mesh::new();
        MeshDecoder::new()
            .decode(
                &mut DecoderBuffer::new(stream).with_limits(limits),
                &mut mesh,
            )
            .map_err(|error| format!("cannot be read: {}", one_line(error.message())))?;
        let mut attributes = BTreeMap::new();
        for (semantic, index) in &primitive.attributes {
            let Checked::Valid(semantic) = semantic else {
                continue;
            };
            let semantic = semantic.to_string();
            let accessor = document.root.accessors.get(index.value());
            let (Some(id), Some(accessor)) = (self.attributes.get(&semantic), accessor) else {
                continue;
            };
            let attribute = mesh
                .attribute_by_unique_id(*id)
                .ok_or_else(|| format!("has no attribute {id}, which is to be {semantic}"))?;
            let attribute = Attribute::of(attribute, mesh.num_points(), accessor);
            let attribute = attribute.map_err(|problem| format!("{semantic}: {problem}"))?;
            attributes.insert(semantic, attribute);
        }
        let triangles = mesh.faces().iter().map(|face| face.map(|point| point.0));
        Ok(Unpacked {
            triangles: triangles.collect(),
            points: mesh.num_points(),
            attributes,
        })
    }
}

impl Unpacked {
    /// An attribute by the name that glTF gives it, which must be of one of the types `kinds`; none where the stream
    /// does not have it.
    ///
    /// # Errors
    ///
    /// One line: it is of another type.
    pub(super) fn attribute(
        &self,
        semantic: &str,
        kinds: &[Type],
    ) -> Result<Option<Elements<'_>>, String> {
        let Some(attribute) = self.attributes.get(semantic) else {
            return Ok(None);
        };
        let components = attribute.components;
        if !kinds.iter().any(|kind| kind.multiplicity() == components) {
            return Err(format!(
                "has {components} numbers for each vertex in {NAME}"
            ));
        }
        Ok(Some(Elements::packed(
            &attribute.bytes,
            self.points,
            components,
            attribute.component,
            attribute.normalized,
        )))
    }
}

impl Attribute {
    /// An attribute as its accessor has it: the stream says which numbers there are, the accessor what they stand for.
    fn of(
        attribute: &PointAttribute,
        points: usize,
        accessor: &Accessor,
    ) -> Result<Attribute, String> {
        let Checked::Valid(component) = accessor.component_type else {
            return Err("its componentType is unknown".into());
        };
        let from = attribute.data_type();
        // Floats are what they are, whatever their accessor says.
        let stays = matches!(
            from,
            DataType::Float32 | DataType::Float64 | DataType::Invalid
        );
        let (component, normalized) = if stays {
            (ComponentType::F32, false)
        } else {
            (component.0, accessor.normalized)
        };
        let components = usize::from(attribute.num_components());
        let width = from.byte_length();
        let size = components * width;
        let data = attribute.buffer().data();
        let stride = usize::try_from(attribute.byte_stride()).unwrap_or(size);
        let values = (0..points).map(|point| {
            let value = attribute.mapped_index(PointIndex(point as u32)).0 as usize;
            let start = value.saturating_mul(stride);
            data.get(start..start.saturating_add(size))
        });
        let is_same = matches!(
            (from, component),
            (DataType::Float32, ComponentType::F32)
                | (DataType::Uint8, ComponentType::U8)
                | (DataType::Int8, ComponentType::I8)
                | (DataType::Uint16, ComponentType::U16)
                | (DataType::Int16, ComponentType::I16)
                | (DataType::Uint32, ComponentType::U32)
        );
        let mut bytes = Vec::with_capacity(points * components * component.size());
        for (point, value) in values.enumerate() {
            let value = value.ok_or_else(|| format!("lacks a value for point {point}"))?;
            if is_same {
                bytes.extend_from_slice(value);
            } else {
                value.chunks_exact(width.max(1)).for_each(|bytes_of_one| {
                    push(&mut bytes, number(bytes_of_one, from), component)
                });
            }
        }
        Ok(Attribute {
            bytes,
            components,
            component,
            normalized,
        })
    }
}

/// A number of the stream's type. 64 bits hold those of all types that glTF has.
fn number(bytes: &[u8], kind: DataType) -> f64 {
    fn of<const N: usize>(bytes: &[u8], read: impl Fn([u8; N]) -> f64) -> f64 {
        bytes.first_chunk().map_or(0.0, |&bytes| read(bytes))
    }
    match kind {
        DataType::Invalid => 0.0,
        DataType::Int8 => of(bytes, |b| i8::from_le_bytes(b).into()),
        DataType::Uint8 | DataType::Bool => of(bytes, |b| u8::from_le_bytes(b).into()),
        DataType::Int16 => of(bytes, |b| i16::from_le_bytes(b).into()),
        DataType::Uint16 => of(bytes, |b| u16::from_le_bytes(b).into()),
        DataType::Int32 => of(bytes, |b| i32::from_le_bytes(b).into()),
        DataType::Uint32 => of(bytes, |b| u32::from_le_bytes(b).into()),
        DataType::Int64 => of(bytes, |b| i64::from_le_bytes(b) as f64),
        DataType::Uint64 => of(bytes, |b| u64::from_le_bytes(b) as f64),
        DataType::Float32 => of(bytes, |b| f32::from_le_bytes(b).into()),
        DataType::Float64 => of(bytes, f64::from_le_bytes),
    }
}

/// Appends `number` as the nearest of an accessor's type.
fn push(bytes: &mut Vec<u8>, number: f64, component: ComponentType) {
    match component {
        ComponentType::I8 => bytes.extend((number as i8).to_le_bytes()),
        ComponentType::U8 => bytes.extend((number as u8).to_le_bytes()),
        ComponentType::I16 => bytes.extend((number as i16).to_le_bytes()),
        ComponentType::U16 => bytes.extend((number as u16).to_le_bytes()),
        ComponentType::U32 => bytes.extend((number as u32).to_le_bytes()),
        ComponentType::F32 => bytes.extend((number as f32).to_le_bytes()),
    }
}
