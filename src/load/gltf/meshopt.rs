//! EXT_meshopt_compression and KHR_meshopt_compression: buffer views that crate `meshoptimizer-rs` unpacks, each once.
//!
//! The second has one filter more than the first, and a newer version of the codec for vertices. Files of the first
//! that use these are read as well.

use super::buffers::Buffers;
use super::document::Document;
use super::extensions;
use gltf::json::Buffer;
use meshoptimizer_rs::codec::{
    decode_filter_color, decode_filter_exp, decode_filter_oct, decode_filter_quat,
    decode_index_buffer, decode_index_sequence, decode_vertex_buffer,
};
use meshoptimizer_rs::{Limits, Workspace};
use rayon::iter::{IntoParallelIterator, ParallelIterator};
use serde::Deserialize;
use std::collections::HashMap;

/// As files call them.
pub(super) const NAMES: [&str; 2] = ["KHR_meshopt_compression", "EXT_meshopt_compression"];

/// How many bytes a file's views may unpack to for each byte of its buffers. The first version of the codec can say no
/// more; the second can, of vertices that are all alike.
const UNPACKED_A_BYTE: u64 = 64;
/// And how many beside.
const FREE_BYTES: u64 = 16 << 20;

/// What a compressed view says of itself.
#[derive(Deserialize)]
#[serde(rename_all = "camelCase")]
struct Compressed {
    buffer: usize,
    #[serde(default)]
    byte_offset: u64,
    byte_length: u64,
    /// From one element to the next, unpacked.
    byte_stride: usize,
    count: usize,
    mode: Mode,
    #[serde(default)]
    filter: Filter,
}

#[derive(Clone, Copy, Deserialize)]
#[serde(rename_all = "UPPERCASE")]
enum Mode {
    Attributes,
    Triangles,
    Indices,
}

#[derive(Clone, Copy, Default, Deserialize)]
#[serde(rename_all = "UPPERCASE")]
enum Filter {
    #[default]
    None,
    Octahedral,
    Quaternion,
    Exponential,
    Color,
}

/// Whether a buffer is only there for programs that do not know the extension.
pub(super) fn is_fallback(buffer: &Buffer) -> bool {
    let others = buffer.extensions.as_ref().map(|e| &e.others);
    let says_so = |name: &str| others?.get(name)?.get("fallback")?.as_bool();
    NAMES.iter().any(|name| says_so(name) == Some(true))
}

/// What the document's compressed views hold, by their indices; for those that cannot be unpacked, why.
pub(super) fn unpack(
    document: &Document,
    buffers: &Buffers,
) -> HashMap<usize, Result<Vec<u8>, String>> {
    let mut left = buffers
        .total_bytes
        .saturating_mul(UNPACKED_A_BYTE)
        .saturating_add(FREE_BYTES);
    let mut found = Vec::new();
    for (index, view) in document.root.buffer_views.iter().enumerate() {
        let others = view.extensions.as_ref().map(|e| &e.others);
        let read = |name: &&str| extensions::read::<Compressed>(others, name).transpose();
        let Some((name, compressed)) = NAMES.iter().find_map(|name| Some((name, read(name)?)))
        else {
            continue;
        };
        let compressed = compressed.and_then(|compressed| {
            left = left
                .checked_sub(compressed.unpacked_bytes())
                .ok_or("the views up to here unpack to many times what the buffers hold")?;
            Ok(compressed)
        });
        found.push((index, name, compressed));
    }
    found
        .into_par_iter()
        .map(|(index, name, compressed)| {
            let unpacked = compressed.and_then(|compressed| compressed.unpack(buffers));
            (
                index,
                unpacked.map_err(|problem| format!("{name}: {problem}")),
            )
        })
        .collect()
}

impl Compressed {
    fn unpacked_bytes(&self) -> u64 {
        (self.count as u64).saturating_mul(self.byte_stride as u64)
    }

    fn unpack(&self, buffers: &Buffers) -> Result<Vec<u8>, String> {
        let &Compressed {
            count,
            byte_stride: stride,
            ..
        } = self;
        let source = buffers.part(self.buffer, self.byte_offset, self.byte_length)?;
        // What it takes was counted above.
        let mut workspace = Workspace::new(Limits {
            max_bytes: usize::MAX,
            max_work: u64::MAX,
        });
        let workspace = &mut workspace;
        let unpacked = match self.mode {
            Mode::Attributes => decode_vertex_buffer(count, stride, source, workspace),
            Mode::Triangles => decode_index_buffer(count, stride, source, workspace),
            Mode::Indices => decode_index_sequence(count, stride, source, workspace),
        };
        unpacked
            .and_then(|mut bytes| {
                match self.filter {
                    Filter::None => Ok(()),
                    Filter::Octahedral => decode_filter_oct(&mut bytes, count, stride, workspace),
                    Filter::Quaternion => decode_filter_quat(&mut bytes, count, stride, workspace),
                    Filter::Exponential => decode_filter_exp(&mut bytes, count, stride, workspace),
                    Filter::Color => decode_filter_color(&mut bytes, count, stride, workspace),
                }?;
                Ok(bytes)
            })
            .map_err(|error| {
                format!("{count} elements of {stride} bytes cannot be unpacked: {error}")
            })
    }
}
