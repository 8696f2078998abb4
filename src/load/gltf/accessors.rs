//! Accessors: numbers in buffers, of every type, spaced, sparse or absent (glTF 2.0, section 3.6.2).
//!
//! Every bound is checked once, here; what comes out can be read at any index below `count`.

use super::buffers::{Buffers, slice};
use super::document::Document;
use gltf::json::accessor::sparse::Sparse;
use gltf::json::accessor::{Accessor, ComponentType, Type};
use gltf::json::validation::Checked;

/// The elements of an accessor.
#[derive(Debug)]
pub(super) struct Elements<'a> {
    /// How many there are.
    pub(super) count: usize,
    /// How many numbers each has.
    pub(super) components: usize,
    component: ComponentType,
    normalized: bool,
    /// Zeros where there is none.
    base: Option<Spaced<'a>>,
    /// What sparse storage changes: which element, and its bytes. Sorted, each element once.
    changes: Vec<(u32, &'a [u8])>,
}

/// Elements `stride` bytes apart.
#[derive(Clone, Copy, Debug)]
struct Spaced<'a> {
    bytes: &'a [u8],
    stride: usize,
    size: usize,
}

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
        Some(sparse) => {
            changes(sparse, buffers, count, size).map_err(|problem| format!("sparse: {problem}"))?
        }
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
fn spaced<'a>(
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

/// What sparse storage changes of `count` elements of `size` bytes.
fn changes<'a>(
    sparse: &Sparse,
    buffers: &'a Buffers,
    count: usize,
    size: usize,
) -> Result<Vec<(u32, &'a [u8])>, String> {
    let changed = sparse.count.0;
    if changed > count as u64 {
        return Err(format!("changes {changed} elements of {count}"));
    }
    let Checked::Valid(component) = sparse.indices.component_type else {
        return Err("its indices' componentType is unknown".into());
    };
    let component = component.0;
    let (indices, values) = (&sparse.indices, &sparse.values);
    let index_view = indices.buffer_view.value();
    let which = spaced(
        buffers,
        index_view,
        indices.byte_offset.0,
        changed,
        component.size(),
    )?;
    let value_view = values.buffer_view.value();
    let what = spaced(buffers, value_view, values.byte_offset.0, changed, size)?;
    let mut changes = Vec::with_capacity(changed as usize);
    for i in 0..changed as usize {
        let index = whole(which.element(i), component);
        if index as usize >= count {
            return Err(format!(
                "index {index} is past the last element ({})",
                count - 1
            ));
        }
        changes.push((index, what.element(i)));
    }
    // The format has them in order, each once; where a file does not, the last one counts.
    changes.reverse();
    changes.sort_by_key(|&(index, _)| index);
    changes.dedup_by_key(|&mut (index, _)| index);
    Ok(changes)
}

impl<'a> Spaced<'a> {
    /// Element `i`; empty past the end.
    fn element(&self, i: usize) -> &'a [u8] {
        let start = i.saturating_mul(self.stride);
        self.bytes
            .get(start..start.saturating_add(self.size))
            .unwrap_or_default()
    }
}

impl Elements<'_> {
    /// Whether its numbers are ones that vertices can be counted with.
    pub(super) fn counts(&self) -> bool {
        matches!(
            self.component,
            ComponentType::U8 | ComponentType::U16 | ComponentType::U32
        )
    }

    /// Element `i` as a whole number.
    pub(super) fn index(&self, i: usize) -> u32 {
        whole(self.element(i), self.component)
    }

    /// Element `i` as numbers, normalized integers as shares from -1 or 0 to 1; zero for those it does not have.
    pub(super) fn floats<const N: usize>(&self, i: usize) -> [f32; N] {
        let element = self.element(i);
        let size = self.component.size();
        std::array::from_fn(|c| {
            let number = element.get(c * size..).unwrap_or_default();
            float(number, self.component, self.normalized)
        })
    }

    /// The elements that may be other than zero, in rising order.
    pub(super) fn stored(&self) -> Vec<u32> {
        match self.base {
            Some(_) => (0..u32::try_from(self.count).unwrap_or(u32::MAX)).collect(),
            None => self.changes.iter().map(|&(index, _)| index).collect(),
        }
    }

    /// How many elements [`Elements::stored`] has.
    pub(super) fn stored_count(&self) -> usize {
        match self.base {
            Some(_) => self.count,
            None => self.changes.len(),
        }
    }

    /// Every number of every element, in order.
    pub(super) fn numbers(&self) -> Vec<f32> {
        let size = self.component.size();
        let mut numbers = Vec::with_capacity(self.count.saturating_mul(self.components));
        for i in 0..self.count {
            let element = self.element(i);
            numbers.extend((0..self.components).map(|c| {
                let number = element.get(c * size..).unwrap_or_default();
                float(number, self.component, self.normalized)
            }));
        }
        numbers
    }

    /// The bytes of element `i`; empty where it is zero.
    fn element(&self, i: usize) -> &[u8] {
        let changed = self
            .changes
            .binary_search_by_key(&(i as u64), |&(index, _)| u64::from(index));
        match (changed, &self.base) {
            (Ok(at), _) => self.changes.get(at).map_or(&[], |&(_, bytes)| bytes),
            (Err(_), Some(base)) => base.element(i),
            (Err(_), None) => &[],
        }
    }
}

/// The first number in `bytes`, a whole one; zero where there is none.
fn whole(bytes: &[u8], component: ComponentType) -> u32 {
    let read = match component {
        ComponentType::U8 => bytes.first().map(|&b| u32::from(b)),
        ComponentType::U16 => bytes
            .first_chunk()
            .map(|&b| u32::from(u16::from_le_bytes(b))),
        ComponentType::U32 => bytes.first_chunk().map(|&b| u32::from_le_bytes(b)),
        ComponentType::I8 | ComponentType::I16 | ComponentType::F32 => None,
    };
    read.unwrap_or_default()
}

/// The first number in `bytes`; zero where there is none.
fn float(bytes: &[u8], component: ComponentType, normalized: bool) -> f32 {
    let (value, greatest) = match component {
        ComponentType::F32 => {
            return bytes.first_chunk().map_or(0.0, |&b| f32::from_le_bytes(b));
        }
        ComponentType::U32 => {
            return bytes
                .first_chunk()
                .map_or(0.0, |&b| u32::from_le_bytes(b) as f32);
        }
        ComponentType::I8 => (bytes.first().map(|&b| f32::from(b as i8)), 127.0),
        ComponentType::U8 => (bytes.first().map(|&b| f32::from(b)), 255.0),
        ComponentType::I16 => (
            bytes
                .first_chunk()
                .map(|&b| f32::from(i16::from_le_bytes(b))),
            32_767.0,
        ),
        ComponentType::U16 => (
            bytes
                .first_chunk()
                .map(|&b| f32::from(u16::from_le_bytes(b))),
            65_535.0,
        ),
    };
    let value = value.unwrap_or_default();
    if normalized {
        (value / greatest).max(-1.0) // Two's complement has one more below than above.
    } else {
        value
    }
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn normalized_integers_become_shares() {
        let share = |bytes: &[u8], component| float(bytes, component, true);
        assert_eq!(share(&[255], ComponentType::U8), 1.0);
        assert_eq!(share(&[0x80], ComponentType::I8), -1.0);
        assert_eq!(share(&[0x81], ComponentType::I8), -1.0);
        assert_eq!(share(&[0xff, 0x7f], ComponentType::I16), 1.0);
        assert_eq!(share(&[0, 0x80], ComponentType::I16), -1.0);
        assert_eq!(share(&[0xff, 0xff], ComponentType::U16), 1.0);
        assert_eq!(float(&[7], ComponentType::U8, false), 7.0);
    }

    #[test]
    fn whole_numbers_are_little_endian() {
        let bytes = [1, 2, 3, 4];
        assert_eq!(whole(&bytes, ComponentType::U8), 1);
        assert_eq!(whole(&bytes, ComponentType::U16), 0x0201);
        assert_eq!(whole(&bytes, ComponentType::U32), 0x0403_0201);
        assert_eq!(whole(&[1, 2, 3], ComponentType::U32), 0);
    }
}
