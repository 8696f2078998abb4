//! Accessors: numbers in buffers, of every type, spaced, sparse or absent (glTF 2.0, section 3.6.2).
//!
//! Every bound is checked once, here; what comes out can be read at any index below `count`.

use super::buffers::{Buffers, slice};
use super::document::Document;
use super::elements::{Elements, Spaced};
use super::sparse;
use gltf::json::accessor::{Accessor, Type};
use gltf::json::validation::Checked;

/// How many elements without bytes a file may have beside one a byte of its buffers: a short file that claims a
/// billion zeros is no model.
const FREE_ZEROS: u64 = 65_536;

/// The elements of accessor `index`, which must be of one of the types `kinds`.
///
/// # Errors
///
/// One line: an index, a type or a size is wrong.
pub(super) fn read<'a>(
    document: &Document,
    buffers: &'a Buffers,
    index: usize,
    kinds: &[Type],
) -> Result<Elements<'a>, String> {
    let accessors = &document.root.accessors;
    let accessor = accessors.get(index).ok_or_else(|| {
        let count = accessors.len();
        format!("accessor {index} does not exist, there are {count}")
    })?;
    elements(accessor, buffers, kinds).map_err(|problem| format!("accessor {index}: {problem}"))
}

fn elements<'a>(
    accessor: &Accessor,
    buffers: &'a Buffers,
    kinds: &[Type],
) -> Result<Elements<'a>, String> {
    let Checked::Valid(component) = accessor.component_type else {
        return Err("its componentType is unknown".into());
    };
    let kind = match accessor.type_ {
        Checked::Valid(kind) if kinds.contains(&kind) => kind,
        _ => {
            let expected: Vec<String> = kinds.iter().map(|&kind| name(kind)).collect();
            let found = match accessor.type_ {
                Checked::Valid(kind) => name(kind),
                Checked::Invalid => "unknown".into(),
            };
            let expected = expected.join(" or ");
            return Err(format!("its type is {found}, expected {expected}"));
        }
    };
    let component = component.0;
    let components = kind.multiplicity();
    let size = components * component.size();
    let count = accessor.count.0;
    let base = match accessor.buffer_view {
        Some(view) => {
            let offset = accessor.byte_offset.unwrap_or_default().0;
            Some(spaced(buffers, view.value(), offset, count, size)?)
        }
        None if count > buffers.total_bytes.saturating_add(FREE_ZEROS) => {
            return Err(format!(
                "has {count} elements without a buffer view, the buffers have {} bytes in all",
                buffers.total_bytes
            ));
        }
        None => None,
    };
    // No element without a byte or out of the allowance above: this fits.
    let count = usize::try_from(count).map_err(|_| format!("has {count} elements"))?;
    let changes = match &accessor.sparse {
        Some(sparse) => sparse::changes(sparse, buffers, count, size)
            .map_err(|problem| format!("sparse: {problem}"))?,
        None => Vec::new(),
    };
    Ok(Elements {
        count,
        components,
        component,
        normalized: accessor.normalized,
        base,
        changes,
    })
}

/// `count` elements of `size` bytes in a view.
pub(super) fn spaced<'a>(
    buffers: &'a Buffers,
    view_index: usize,
    offset: u64,
    count: u64,
    size: usize,
) -> Result<Spaced<'a>, String> {
    let view = buffers.view(view_index)?;
    let stride = view.stride.unwrap_or(size);
    if stride < size {
        return Err(format!(
            "its elements are {size} bytes long and {stride} bytes apart in buffer view {view_index}"
        ));
    }
    let length = match count {
        0 => Some(0),
        _ => (count - 1)
            .checked_mul(stride as u64)
            .and_then(|to_last| to_last.checked_add(size as u64)),
    };
    let bytes = length
        .and_then(|length| slice(view.bytes, offset, length))
        .ok_or_else(|| {
            format!(
                "{count} elements of {size} bytes from {offset} do not fit into buffer view {view_index} ({} bytes)",
                view.bytes.len()
            )
        })?;
    Ok(Spaced {
        bytes,
        stride,
        size,
    })
}

fn name(kind: Type) -> String {
    match kind {
        Type::Scalar => "SCALAR",
        Type::Vec2 => "VEC2",
        Type::Vec3 => "VEC3",
        Type::Vec4 => "VEC4",
        Type::Mat2 => "MAT2",
        Type::Mat3 => "MAT3",
        Type::Mat4 => "MAT4",
    }
    .into()
}
