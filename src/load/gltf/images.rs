//! The images of a file: each read once and decoded once, the greatest first, several at a time.

use super::Warnings;
use super::buffers::Buffers;
use super::document::{Document, one_line};
use super::uri::{self, Uri};
use crate::Error;
use crate::load::files;
use crate::load::images::{self, Encoded};
use crate::texture::Image;
use rayon::prelude::*;
use std::borrow::Cow;
use std::collections::{BTreeSet, HashMap};
use std::path::PathBuf;
use std::sync::Arc;

/// What became of the images that were tried, by their index in the file.
pub(super) type Tried = HashMap<usize, Result<Arc<Image>, String>>;

/// Where an image's bytes are. Images with the same source are one image.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
enum Source {
    /// Its path.
    File(PathBuf),
    /// Buffer, first byte, length.
    View(usize, u64, u64),
    /// The index of the image whose data URI it is.
    Data(usize),
}

/// Decodes images, and knows which it has decoded.
pub(super) struct Decoder<'a> {
    document: &'a Document,
    buffers: &'a Buffers<'a>,
    /// The first image of each source stands for all of them.
    first_of: HashMap<Source, usize>,
}

impl<'a> Decoder<'a> {
    pub(super) fn new(document: &'a Document, buffers: &'a Buffers<'a>) -> Decoder<'a> {
        Decoder {
            document,
            buffers,
            first_of: HashMap::new(),
        }
    }

    /// Decodes `wanted`, notes in `tried` what becomes of them, and in `files` what was read.
    pub(super) fn decode(
        &mut self,
        wanted: &BTreeSet<usize>,
        tried: &mut Tried,
        files: &mut Vec<PathBuf>,
        warnings: &mut Warnings,
    ) {
        let mut same_as: Vec<(usize, Result<usize, String>)> = Vec::new();
        let mut work: Vec<(usize, Source)> = Vec::new();
        for &image in wanted {
            let first = source(self.document, image).map(|source| {
                *self.first_of.entry(source.clone()).or_insert_with(|| {
                    work.push((image, source));
                    image
                })
            });
            same_as.push((image, first));
        }
        let encoded: Vec<(usize, Result<Encoded, String>)> = work
            .par_iter()
            .map(|(image, source)| (*image, encoded(self.document, self.buffers, *image, source)))
            .collect();
        for (image, found) in images::decode_all(encoded, &self.document.budget) {
            let found = found.map(|decoded| {
                if let Some(flaw) = decoded.flaw {
                    warnings.add(format!("{}: {flaw}", image_name(self.document, image)));
                }
                Arc::new(decoded.image)
            });
            tried.insert(image, found);
        }
        files.extend(work.into_iter().filter_map(|(image, source)| match source {
            Source::File(path) if matches!(tried.get(&image), Some(Ok(_))) => Some(path),
            _ => None,
        }));
        for (image, first) in same_as {
            let found =
                first.and_then(|first| tried.get(&first).cloned().unwrap_or(Err(String::new())));
            if let Err(problem) = &found {
                warnings.add(format!(
                    "{}: {problem}: it is left out",
                    image_name(self.document, image)
                ));
            }
            tried.insert(image, found);
        }
    }
}

/// The file's path, or the image's name; `image 3` where it has neither.
pub(super) fn image_name(document: &Document, index: usize) -> String {
    let image = document.root.images.get(index);
    let path = image
        .and_then(|image| image.uri.as_deref())
        .filter(|uri| !uri.starts_with("data:"));
    let name = image.and_then(|image| image.name.as_deref());
    match path.or(name) {
        Some(name) if !name.is_empty() => one_line(name),
        _ => format!("image {index}"),
    }
}

fn source(document: &Document, index: usize) -> Result<Source, String> {
    let root = &document.root;
    let image = root.images.get(index).ok_or("does not exist")?;
    match (&image.uri, image.buffer_view) {
        (Some(uri), _) if uri.starts_with("data:") => Ok(Source::Data(index)),
        (Some(uri), _) => match uri::resolve(uri, document)? {
            Uri::File(path) => Ok(Source::File(path)),
            Uri::Data(_) => Ok(Source::Data(index)),
        },
        (None, Some(view)) => {
            let count = root.buffer_views.len();
            let index = view.value();
            let view = root
                .buffer_views
                .get(index)
                .ok_or_else(|| format!("buffer view {index} does not exist, there are {count}"))?;
            let start = view.byte_offset.unwrap_or_default().0;
            Ok(Source::View(view.buffer.value(), start, view.byte_length.0))
        }
        (None, None) => Err("has neither a URI nor a buffer view".into()),
    }
}

/// Reads an image's bytes, and of them how great it is.
fn encoded<'a>(
    document: &'a Document,
    buffers: &'a Buffers,
    index: usize,
    source: &Source,
) -> Result<Encoded<'a>, String> {
    let json = document.root.images.get(index).ok_or("does not exist")?;
    let mut name = image_name(document, index);
    let bytes = match source {
        Source::File(path) => {
            name = path.to_string_lossy().into_owned();
            Cow::Owned(files::read(path, &document.budget).map_err(|error| why(&error))?)
        }
        Source::Data(_) => match uri::resolve(json.uri.as_deref().unwrap_or_default(), document)? {
            Uri::Data(bytes) => Cow::Owned(bytes),
            Uri::File(_) => return Err("is no data URI".into()),
        },
        Source::View(..) => {
            let view = json.buffer_view.ok_or("has no buffer view")?;
            Cow::Borrowed(buffers.view(view.value())?.bytes)
        }
    };
    Encoded::new(name, bytes)
}

/// An error of a file that the sentence around it names already.
fn why(error: &Error) -> String {
    match error {
        Error::Io { doing, reason, .. } => format!("cannot {doing}: {reason}"),
        Error::Malformed { problem, .. } => problem.clone(),
        other => other.to_string(),
    }
}
