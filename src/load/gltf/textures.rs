//! Images and the textures that show them. What cannot be shown is left out with a warning, and the material's factor
//! stands alone.

use super::Warnings;
use super::buffers::Buffers;
use super::document::{Document, named, one_line};
use super::uri::{self, Uri};
use crate::Error;
use crate::load::{TextureFacts, files, images};
use crate::texture::{Encoding, Filter, Image, Texture, Wrap};
use gltf::json::texture::{MagFilter, WrappingMode};
use gltf::json::validation::Checked;
use rayon::prelude::*;
use std::collections::{BTreeSet, HashMap};
use std::path::PathBuf;
use std::sync::Arc;

/// The textures of a file, made as materials ask for them.
#[derive(Debug)]
pub(super) struct Textures<'a> {
    document: &'a Document,
    /// By their index in the file; `None` where an image is not asked for, or cannot be shown.
    images: Vec<Option<Arc<Image>>>,
    /// One for each texture of the file and each meaning of its numbers.
    pub(super) textures: Vec<Texture>,
    made: HashMap<(usize, bool), Option<u32>>,
    /// What `luch info` tells of each image.
    pub(super) facts: Vec<TextureFacts>,
    /// Every file that was read.
    pub(super) files: Vec<PathBuf>,
}

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

impl<'a> Textures<'a> {
    /// Decodes the images of the textures in `used`, each once and several at a time.
    pub(super) fn decode(
        document: &'a Document,
        buffers: &Buffers,
        used: &BTreeSet<usize>,
        warnings: &mut Warnings,
    ) -> Textures<'a> {
        let root = &document.root;
        let mut shown = BTreeSet::new();
        for &texture in used {
            shown.extend(
                root.textures
                    .get(texture)
                    .map(|texture| texture.source.value()),
            );
        }
        let shown: Vec<usize> = shown
            .into_iter()
            .filter(|&image| image < root.images.len())
            .collect();
        // The first image of each source is decoded for all of them.
        let mut first_of: HashMap<Source, usize> = HashMap::new();
        let mut same_as: Vec<(usize, Result<usize, String>)> = Vec::new();
        let mut work: Vec<(usize, Source)> = Vec::new();
        for image in shown {
            let first = source(document, image).map(|source| {
                *first_of.entry(source.clone()).or_insert_with(|| {
                    work.push((image, source));
                    image
                })
            });
            same_as.push((image, first));
        }
        let decoded: HashMap<usize, Result<Arc<Image>, String>> = work
            .par_iter()
            .map(|(image, source)| {
                (
                    *image,
                    decode(document, buffers, *image, source).map(Arc::new),
                )
            })
            .collect();
        let mut images: Vec<Option<Arc<Image>>> = vec![None; root.images.len()];
        for (image, first) in same_as {
            let found =
                first.and_then(|first| decoded.get(&first).cloned().unwrap_or(Err(String::new())));
            match found {
                Ok(found) => images[image] = Some(found),
                Err(problem) => warnings.add(format!(
                    "{}: {problem}: it is left out",
                    image_name(document, image)
                )),
            }
        }
        let facts = images
            .iter()
            .enumerate()
            .map(|(index, image)| TextureFacts {
                name: image_name(document, index),
                size: image.as_ref().map(|image| (image.width, image.height)),
            });
        let facts = facts.collect();
        let files = work.into_iter().filter_map(|(image, source)| match source {
            Source::File(path) if images[image].is_some() => Some(path),
            _ => None,
        });
        let files = files.collect();
        Textures {
            document,
            images,
            textures: Vec::new(),
            made: HashMap::new(),
            facts,
            files,
        }
    }

    /// The texture that shows texture `index` of the file, its numbers meaning `encoding`; `None` where its image is
    /// left out.
    ///
    /// # Errors
    ///
    /// There is no such texture, or it names an image or a sampler that does not exist.
    pub(super) fn texture(
        &mut self,
        place: &str,
        index: usize,
        encoding: Encoding,
        warnings: &mut Warnings,
    ) -> Result<Option<u32>, Error> {
        let key = (index, encoding == Encoding::Srgb);
        if let Some(&made) = self.made.get(&key) {
            return Ok(made);
        }
        let root = &self.document.root;
        let index = self
            .document
            .checked(place, "texture", index, root.textures.len())?;
        let texture = &root.textures[index];
        let name = named("texture", index, texture.name.as_ref());
        let source = texture.source.value();
        // What crate `gltf` has where the file has nothing.
        let image = if source == u32::MAX as usize {
            warnings.add(format!(
                "{name}: has no image that luch reads: it is left out"
            ));
            None
        } else {
            let source =
                self.document
                    .checked(name.as_str(), "image", source, root.images.len())?;
            self.images[source].clone()
        };
        let sampler = match texture.sampler {
            Some(sampler) => {
                let count = root.samplers.len();
                Some(
                    &root.samplers[self.document.checked(
                        name,
                        "sampler",
                        sampler.value(),
                        count,
                    )?],
                )
            }
            None => None,
        };
        let made = image.map(|image| {
            let wrap = sampler.map_or([Wrap::Repeat; 2], |s| [s.wrap_s, s.wrap_t].map(wrap));
            let nearest =
                sampler.is_some_and(|s| s.mag_filter == Some(Checked::Valid(MagFilter::Nearest)));
            let filter = if nearest {
                Filter::Nearest
            } else {
                Filter::Linear
            };
            self.textures.push(Texture {
                image,
                wrap,
                filter,
                encoding,
            });
            self.textures.len() as u32 - 1
        });
        self.made.insert(key, made);
        Ok(made)
    }
}

/// How a texture goes on beyond its edge; a mode that does not exist is the default.
fn wrap(mode: Checked<WrappingMode>) -> Wrap {
    match mode {
        Checked::Valid(WrappingMode::ClampToEdge) => Wrap::ClampToEdge,
        Checked::Valid(WrappingMode::MirroredRepeat) => Wrap::MirroredRepeat,
        Checked::Valid(WrappingMode::Repeat) | Checked::Invalid => Wrap::Repeat,
    }
}

/// The file's path, or the image's name; `image 3` where it has neither.
fn image_name(document: &Document, index: usize) -> String {
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

fn decode(
    document: &Document,
    buffers: &Buffers,
    index: usize,
    source: &Source,
) -> Result<Image, String> {
    let json = document.root.images.get(index).ok_or("does not exist")?;
    match source {
        Source::File(path) => {
            let bytes = files::read(path, &document.budget).map_err(|error| why(&error))?;
            images::decode(&path.to_string_lossy(), &bytes, &document.budget)
        }
        Source::Data(_) => match uri::resolve(json.uri.as_deref().unwrap_or_default(), document)? {
            Uri::Data(bytes) => {
                images::decode(&image_name(document, index), &bytes, &document.budget)
            }
            Uri::File(_) => Err("is no data URI".into()),
        },
        Source::View(..) => {
            let view = json.buffer_view.ok_or("has no buffer view")?;
            let view = buffers.view(view.value())?;
            images::decode(&image_name(document, index), view.bytes, &document.budget)
        }
    }
}

/// An error of a file that the sentence around it names already.
fn why(error: &Error) -> String {
    match error {
        Error::Io { doing, reason, .. } => format!("cannot {doing}: {reason}"),
        Error::Malformed { problem, .. } => problem.clone(),
        other => other.to_string(),
    }
}
