//! Textures: which image each shows, and how. What cannot be shown is left out with a warning, and the material's
//! factor stands alone.
//!
//! An image that is drawn small is averaged over what a ray sees of it (see `texture::Footprint`), whatever `minFilter`
//! asks for, but where that is the nearest pixel.

use super::document::{Document, named};
use super::images::{Decoder, Tried, image_name};
use super::texture_basisu::{self, TextureBasisu};
use super::texture_webp::{self, TextureWebp};
use super::{Buffers, Warnings, extensions};
use crate::Error;
use crate::load::TextureFacts;
use crate::texture::{Encoding, Filter, Image, Texture, Wrap};
use gltf::json::texture::{MagFilter, MinFilter, WrappingMode};
use gltf::json::validation::Checked;
use std::collections::{BTreeSet, HashMap};
use std::path::PathBuf;
use std::sync::Arc;

/// The `source` of a texture without one, as crate `gltf` has it.
const NO_SOURCE: usize = u32::MAX as usize;

/// The textures of a file, made as materials ask for them.
#[derive(Debug)]
pub(super) struct Textures<'a> {
    document: &'a Document,
    /// By texture; `None` where none is asked for, or none can be shown.
    images: Vec<Option<Arc<Image>>>,
    /// One for each texture of the file and each meaning of its numbers.
    pub(super) textures: Vec<Texture>,
    made: HashMap<(usize, bool), Option<u32>>,
    /// What `luch info` tells of each image.
    pub(super) facts: Vec<TextureFacts>,
    /// Every file that was read.
    pub(super) files: Vec<PathBuf>,
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
        let mut candidates: Vec<Vec<usize>> = vec![Vec::new(); root.textures.len()];
        for &texture in used {
            if let Some(place) = candidates.get_mut(texture) {
                *place = self::candidates(document, texture, warnings);
            }
        }
        let mut tried = Tried::new();
        let mut files = Vec::new();
        let mut decoder = Decoder::new(document, buffers);
        loop {
            // Each texture's best image that has not failed; a further round is for those whose image just did.
            let next: BTreeSet<usize> = candidates
                .iter()
                .filter_map(|images| first_usable(images, &tried))
                .filter(|image| !tried.contains_key(image))
                .collect();
            if next.is_empty() {
                break;
            }
            decoder.decode(&next, &mut tried, &mut files, warnings);
        }
        let shown = |image: usize| tried.get(&image).and_then(|found| found.as_ref().ok());
        let facts = (0..root.images.len())
            .map(|index| TextureFacts {
                name: image_name(document, index),
                size: shown(index).map(|image| (image.width, image.height)),
            })
            .collect();
        let images = candidates
            .iter()
            .map(|images| first_usable(images, &tried).and_then(shown).cloned())
            .collect();
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
        if source != NO_SOURCE {
            self.document
                .checked(name.as_str(), "image", source, root.images.len())?;
        }
        let image = self.images.get(index).cloned().flatten();
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
            // Whoever asks for the nearest pixel of the image itself, in whatever size it is drawn, gets that.
            let mipmaps =
                sampler.is_none_or(|s| s.min_filter != Some(Checked::Valid(MinFilter::Nearest)));
            self.textures.push(Texture {
                image,
                wrap,
                filter,
                mipmaps,
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

/// The images that can show a texture, the best first: an extension's, then its own.
fn candidates(document: &Document, index: usize, warnings: &mut Warnings) -> Vec<usize> {
    let root = &document.root;
    let Some(texture) = root.textures.get(index) else {
        return Vec::new();
    };
    let name = named("texture", index, texture.name.as_ref());
    let others = texture.extensions.as_ref().map(|e| &e.others);
    let basisu = extensions::read::<TextureBasisu>(others, texture_basisu::NAME);
    let webp = extensions::read::<TextureWebp>(others, texture_webp::NAME);
    let of_extensions = [
        basisu.map(|basisu| basisu.map(|basisu| basisu.source)),
        webp.map(|webp| webp.and_then(|webp| webp.source)),
    ];
    let count = root.images.len();
    let mut images = Vec::new();
    for image in of_extensions {
        match image {
            Ok(Some(image)) if image < count => images.push(image),
            Ok(None) => {}
            Ok(Some(image)) => warnings.add(format!(
                "{name}: image {image} does not exist, there are {count}: the extension is ignored"
            )),
            Err(problem) => warnings.add(format!("{name}: {problem}: the extension is ignored")),
        }
    }
    let own = texture.source.value();
    if own < count && !images.contains(&own) {
        images.push(own);
    }
    if images.is_empty() && own == NO_SOURCE {
        warnings.add(format!(
            "{name}: has no image that luch reads: it is left out"
        ));
    }
    images
}

/// The first of `images` that has not failed.
fn first_usable(images: &[usize], tried: &Tried) -> Option<usize> {
    let usable = |image: &&usize| !matches!(tried.get(image), Some(Err(_)));
    images.iter().find(usable).copied()
}
