//! Sparse storage: what differs from an accessor's base or from zero (glTF 2.0, section 3.6.2.3).

use super::accessors::spaced;
use super::buffers::Buffers;
use super::elements::whole;
use gltf::json::accessor::sparse::Sparse;
use gltf::json::validation::Checked;

/// What sparse storage changes of `count` elements of `size` bytes: which element, and its bytes. Sorted, each element
/// once.
///
/// # Errors
///
/// One line: an index or a size is wrong.
pub(super) fn changes<'a>(
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
