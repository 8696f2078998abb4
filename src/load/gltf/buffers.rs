//! The bytes of a file's buffers, and the views into them.

use super::document::Document;
use super::meshopt;
use super::uri::{self, Uri};
use crate::Error;
use crate::load::files;
use std::collections::HashMap;
use std::path::PathBuf;
use std::sync::Arc;

/// The buffers of a document, read.
#[derive(Debug)]
pub(super) struct Buffers<'a> {
    document: &'a Document,
    buffers: Vec<Bytes<'a>>,
    /// What compressed views hold, by their indices; for those that cannot be unpacked, why.
    unpacked: HashMap<usize, Result<Vec<u8>, String>>,
    /// How many bytes were read, each file once.
    pub(super) total_bytes: u64,
    /// Every file that was read.
    pub(super) files: Vec<PathBuf>,
}

#[derive(Clone, Debug)]
enum Bytes<'a> {
    /// A part of the model's own file.
    Chunk(&'a [u8]),
    /// A file or a data URI.
    Owned(Arc<Vec<u8>>),
    /// Neither: an extension would fill it. An error only where something needs it.
    Absent,
}

/// A view into a buffer.
#[derive(Clone, Copy, Debug)]
pub(super) struct View<'a> {
    /// All of it.
    pub(super) bytes: &'a [u8],
    /// From one element to the next, where the file says it.
    pub(super) stride: Option<usize>,
}

impl<'a> Buffers<'a> {
    /// Reads every buffer of a document. `binary` is a GLB's own.
    ///
    /// # Errors
    ///
    /// A file is missing, a URI leads elsewhere, or there are fewer bytes than the document says.
    pub(super) fn read(
        document: &'a Document,
        binary: Option<&'a [u8]>,
    ) -> Result<Buffers<'a>, Error> {
        let mut by_path: HashMap<PathBuf, Arc<Vec<u8>>> = HashMap::new();
        let mut files = Vec::new();
        let mut buffers = Vec::with_capacity(document.root.buffers.len());
        let mut total_bytes = binary.map_or(0, |chunk| chunk.len() as u64);
        for (index, buffer) in document.root.buffers.iter().enumerate() {
            let wrong = |problem: String| document.malformed(format!("buffer {index}"), problem);
            let bytes = match (&buffer.uri, binary) {
                // Nothing is where uncompressed bytes would be.
                (None, _) if meshopt::is_fallback(buffer) => Bytes::Absent,
                (None, Some(chunk)) if index == 0 => Bytes::Chunk(chunk),
                (None, _) => Bytes::Absent,
                (Some(uri), _) => match uri::resolve(uri, document).map_err(wrong)? {
                    Uri::Data(bytes) => {
                        total_bytes += bytes.len() as u64;
                        Bytes::Owned(Arc::new(bytes))
                    }
                    Uri::File(path) => {
                        let known = match by_path.get(&path) {
                            Some(known) => known.clone(),
                            None => {
                                let bytes = Arc::new(files::read(&path, &document.budget)?);
                                total_bytes += bytes.len() as u64;
                                files.push(path.clone());
                                by_path.insert(path, bytes.clone());
                                bytes
                            }
                        };
                        Bytes::Owned(known)
                    }
                },
            };
            let expected = buffer.byte_length.0;
            if let Some(found) = bytes.get().map(<[u8]>::len)
                && (found as u64) < expected
            {
                return Err(wrong(format!("is {found} bytes long, expected {expected}")));
            }
            buffers.push(bytes);
        }
        let mut buffers = Buffers {
            document,
            buffers,
            unpacked: HashMap::new(),
            total_bytes,
            files,
        };
        buffers.unpacked = meshopt::unpack(document, &buffers);
        Ok(buffers)
    }

    /// A view by its index, unpacked where it is compressed.
    ///
    /// # Errors
    ///
    /// One line: there is no such view, or no such bytes.
    pub(super) fn view(&self, index: usize) -> Result<View<'_>, String> {
        let views = &self.document.root.buffer_views;
        let count = views.len();
        let view = views
            .get(index)
            .ok_or_else(|| format!("buffer view {index} does not exist, there are {count}"))?;
        let wrong = |problem: &str| format!("buffer view {index}: {problem}");
        let bytes = match self.unpacked.get(&index) {
            Some(unpacked) => unpacked.as_deref().map_err(|problem| wrong(problem))?,
            None => {
                let start = view.byte_offset.unwrap_or_default().0;
                self.part(view.buffer.value(), start, view.byte_length.0)
                    .map_err(|problem| wrong(&problem))?
            }
        };
        Ok(View {
            bytes,
            stride: view.byte_stride.map(|stride| stride.0).filter(|&s| s > 0),
        })
    }

    /// `length` bytes of a buffer.
    ///
    /// # Errors
    ///
    /// One line: there is no such buffer, or no such bytes.
    pub(super) fn part(&self, buffer: usize, start: u64, length: u64) -> Result<&[u8], String> {
        let count = self.buffers.len();
        let bytes = self
            .buffers
            .get(buffer)
            .ok_or_else(|| format!("buffer {buffer} does not exist, there are {count}"))?;
        let bytes = bytes
            .get()
            .ok_or_else(|| format!("buffer {buffer} has neither a URI nor a GLB's binary chunk"))?;
        slice(bytes, start, length).ok_or_else(|| {
            format!(
                "{length} bytes from {start} do not fit into buffer {buffer} ({} bytes)",
                bytes.len()
            )
        })
    }
}

impl Bytes<'_> {
    fn get(&self) -> Option<&[u8]> {
        match self {
            Bytes::Chunk(bytes) => Some(bytes),
            Bytes::Owned(bytes) => Some(bytes),
            Bytes::Absent => None,
        }
    }
}

/// `length` bytes from `start`, if all of them are there.
pub(super) fn slice(bytes: &[u8], start: u64, length: u64) -> Option<&[u8]> {
    let end = usize::try_from(start.checked_add(length)?).ok()?;
    bytes.get(usize::try_from(start).ok()?..end)
}
