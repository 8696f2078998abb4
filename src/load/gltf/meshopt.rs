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
            let taken = document.budget.take(compressed.unpacked_bytes());
            taken.map_err(|problem| problem.to_string())?;
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
        self.decode(buffers.part(self.buffer, self.byte_offset, self.byte_length)?)
    }

    fn decode(&self, source: &[u8]) -> Result<Vec<u8>, String> {
        let &Compressed {
            count,
            byte_stride: stride,
            ..
        } = self;
        // What it takes was counted before.
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

#[cfg(test)]
mod tests {
    use super::*;
    use serde_json::json;

    fn decoded(
        mode: &str,
        filter: &str,
        count: usize,
        stride: usize,
        source: &[u8],
    ) -> Result<Vec<u8>, String> {
        let compressed = json!({"buffer": 0, "byteLength": source.len(), "byteStride": stride,
            "count": count, "mode": mode, "filter": filter});
        let compressed = Compressed::deserialize(compressed).map_err(|e| e.to_string())?;
        compressed.decode(source)
    }

    /// Sources and expected bytes are from meshoptimizer 1.x, its own encoder and decoder in JavaScript.
    #[test]
    fn every_mode_and_filter_gives_the_bytes_of_the_reference_decoder() {
        let tent: Vec<u8> = [
            [0.0f32, 1.0, 0.0],
            [-1.0, 0.0, -0.5],
            [1.0, 0.0, -0.5],
            [1.0, 0.0, 0.75],
            [-1.0, 0.0, 0.75],
        ]
        .iter()
        .flatten()
        .flat_map(|x| x.to_le_bytes())
        .collect();
        let sides = [0u32, 2, 1, 0, 3, 2, 0, 4, 3, 0, 1, 4];
        // The codec turns triangles, and keeps their winding.
        let turned = [0u16, 2, 1, 2, 0, 3, 3, 0, 4, 4, 0, 1];
        let words = turned.iter().flat_map(|i| i.to_le_bytes()).collect();
        let longs = sides.iter().flat_map(|i| i.to_le_bytes()).collect();
        type Case = (
            &'static str,
            &'static str,
            usize,
            usize,
            &'static [u8],
            Vec<u8>,
        );
        let cases: [Case; 8] = [
            ("ATTRIBUTES", "NONE", 5, 12, VERTICES, tent.clone()),
            (
                "ATTRIBUTES",
                "NONE",
                5,
                12,
                VERTICES_OF_VERSION_1,
                tent.clone(),
            ),
            ("ATTRIBUTES", "EXPONENTIAL", 5, 12, EXPONENTIAL, tent),
            ("TRIANGLES", "NONE", 12, 2, TRIANGLES, words),
            ("INDICES", "NONE", 12, 4, INDICES, longs),
            (
                "ATTRIBUTES",
                "OCTAHEDRAL",
                5,
                4,
                OCTAHEDRAL,
                vec![
                    0, 127, 0, 0, 0, 76, 154, 0, 76, 102, 0, 0, 0, 76, 102, 0, 180, 102, 0, 0,
                ],
            ),
            (
                "ATTRIBUTES",
                "QUATERNION",
                5,
                8,
                QUATERNION,
                vec![
                    0, 0, 0, 0, 0, 0, 255, 127, 0, 0, 205, 76, 0, 0, 101, 102, 15, 64, 250, 63,
                    250, 63, 250, 63, 255, 127, 0, 0, 0, 0, 0, 0, 0, 0, 51, 179, 0, 0, 101, 102,
                ],
            ),
            (
                "ATTRIBUTES",
                "COLOR",
                5,
                4,
                COLOR,
                vec![
                    254, 1, 0, 255, 0, 254, 0, 255, 1, 0, 255, 128, 65, 128, 191, 255, 255, 255,
                    255, 255,
                ],
            ),
        ];
        for (mode, filter, count, stride, source, expected) in cases {
            let found = decoded(mode, filter, count, stride, source);
            assert_eq!(found, Ok(expected), "{mode}, {filter}");
        }
    }

    #[test]
    fn what_is_no_stream_is_said_to_be_none() {
        let problem = |mode, count, stride, source| decoded(mode, "NONE", count, stride, source);
        for (mode, count, stride, source) in [
            ("ATTRIBUTES", 5, 12, &VERTICES[..40]),
            ("ATTRIBUTES", 5, 10, VERTICES),
            ("ATTRIBUTES", usize::MAX, 12, VERTICES),
            ("TRIANGLES", 11, 2, TRIANGLES),
            ("INDICES", 4_000_000_000, 4, INDICES),
        ] {
            let problem = problem(mode, count, stride, source);
            assert!(
                problem.is_err_and(|p| p.contains("cannot be unpacked")),
                "{mode}, {count}"
            );
        }
        let unknown = decoded("POINTS", "NONE", 5, 12, VERTICES);
        assert!(unknown.is_err_and(|p| p.contains("unknown variant `POINTS`")));
    }

    const VERTICES: &[u8] = &[
        160, 0, 0, 1, 48, 0, 0, 0, 255, 1, 60, 192, 0, 0, 129, 255, 255, 0, 0, 1, 48, 0, 0, 0, 255,
        1, 48, 0, 0, 0, 125, 0, 0, 1, 3, 0, 0, 0, 128, 1, 51, 0, 0, 0, 129, 255, 0, 0, 0, 0, 0, 0,
        0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 128, 63, 0, 0, 0, 0,
    ];
    const VERTICES_OF_VERSION_1: &[u8] = &[
        161, 218, 90, 218, 0, 2, 0, 255, 0, 129, 255, 0, 255, 0, 2, 0, 255, 0, 2, 0, 125, 0, 8, 0,
        128, 0, 129, 0, 255, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 128, 63, 0, 0, 0, 0,
        0, 0, 0,
    ];
    const EXPONENTIAL: &[u8] = &[
        160, 0, 1, 60, 192, 0, 0, 7, 16, 15, 1, 24, 64, 0, 0, 0, 0, 1, 48, 0, 0, 0, 7, 0, 0, 0, 1,
        51, 0, 0, 0, 3, 10, 1, 18, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
        0, 0, 0, 0, 0, 0, 246, 0, 4, 0, 246, 0, 0, 0, 246,
    ];
    const TRIANGLES: &[u8] = &[
        225, 254, 46, 30, 18, 240, 4, 0, 118, 135, 86, 103, 120, 169, 134, 101, 137, 104, 152, 1,
        105, 0, 0,
    ];
    const INDICES: &[u8] = &[209, 0, 8, 2, 2, 12, 2, 6, 16, 2, 10, 4, 12, 0, 0, 0, 0];
    const OCTAHEDRAL: &[u8] = &[
        160, 1, 63, 192, 0, 0, 146, 37, 107, 107, 1, 15, 192, 0, 0, 107, 37, 38, 0, 0, 0, 0, 0, 0,
        0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 127, 127, 0,
    ];
    const QUATERNION: &[u8] = &[
        160, 1, 15, 0, 0, 0, 177, 178, 1, 15, 0, 0, 0, 10, 9, 1, 63, 192, 0, 0, 109, 67, 178, 110,
        1, 55, 192, 0, 0, 12, 9, 13, 1, 15, 0, 0, 0, 177, 178, 1, 15, 0, 0, 0, 10, 9, 1, 12, 192,
        0, 0, 5, 6, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,
        0, 0, 0, 0, 0, 255, 7,
    ];
    const COLOR: &[u8] = &[
        161, 255, 0, 126, 125, 128, 254, 0, 253, 253, 128, 126, 0, 131, 130, 128, 0, 0, 0, 125,
        126, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 64, 127, 193, 255, 0,
    ];
}
