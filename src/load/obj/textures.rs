//! The textures of a model: found, decoded once and at the same time, used by many materials.
//!
//! Materials are made twice: first only to learn which images they want.

use super::bump;
use super::find::{Finder, Found};
use super::map::Map;
use super::pbr;
use super::text::shown;
use crate::load::images::{self, Decoded, Encoded};
use crate::load::{Budget, TextureFacts, Warnings, files};
use crate::material::{AlphaChannel, NormalMap};
use crate::texture::{Encoding, Filter, Image, Pixels, Texture, TextureUse, Wrap};
use glam::{Mat3, Vec3};
use rayon::prelude::*;
use std::collections::{HashMap, HashSet};
use std::path::PathBuf;
use std::sync::Arc;

/// All textures of a model, and where to look for more.
#[derive(Default)]
pub(super) struct Textures {
    pub(super) budget: Budget,
    /// Of the MTL at hand, then of the OBJ.
    pub(super) folders: Vec<PathBuf>,
    pub(super) finder: Finder,
    pub(super) list: Vec<Texture>,
    pub(super) facts: Vec<TextureFacts>,
    pub(super) files: Vec<PathBuf>,
    pub(super) warnings: Warnings,
    /// Files by where they really lie, each with a path to it, that were asked for and not decoded yet.
    wanted: Vec<(PathBuf, PathBuf)>,
    /// Files that were, by where they really lie.
    decoded: HashMap<PathBuf, Result<Decoded, String>>,
    /// What every file that was used became.
    images: HashMap<PathBuf, Option<Arc<Image>>>,
    /// Normals by the file of their heights, whether it repeats, and the channel.
    from_heights: HashMap<(String, bool, Option<u8>), Arc<Image>>,
    /// Roughness with metalness, by the file and the channel of both.
    packed: HashMap<(Channel, Channel), Arc<Image>>,
    missing: HashSet<String>,
}

/// A file's name, and `-imfchan`.
type Channel = (String, Option<u8>);

impl Textures {
    /// None yet; their memory comes from the budget.
    pub(super) fn new(finder: Finder, budget: &Budget) -> Textures {
        Textures {
            finder,
            budget: budget.clone(),
            ..Textures::default()
        }
    }

    /// A texture of colours; `None`, and a warning, where it cannot be had.
    pub(super) fn color(&mut self, map: Option<&Map>) -> Option<TextureUse> {
        let map = map?;
        let image = self.image(map)?;
        Some(self.used(image, map, Encoding::Srgb))
    }

    /// A texture of numbers that are no colours.
    pub(super) fn amount(&mut self, map: Option<&Map>) -> Option<TextureUse> {
        let map = map?;
        let image = self.image(map)?;
        Some(self.used(image, map, Encoding::Linear))
    }

    /// A texture of coverage, and where in it that is: in an alpha that says something, or else in a grey picture.
    pub(super) fn coverage(&mut self, map: Option<&Map>) -> Option<(TextureUse, AlphaChannel)> {
        let map = map?;
        let image = self.image(map)?;
        let channel = match map.channel {
            Some(b'm') => AlphaChannel::Alpha,
            None if has_transparency(&image) => AlphaChannel::Alpha,
            _ => AlphaChannel::Red,
        };
        Some((self.used(image, map, Encoding::Linear), channel))
    }

    /// Normals: `norm`, or else `bump`, whose heights become normals.
    pub(super) fn normals(&mut self, norm: Option<&Map>, bump: Option<&Map>) -> Option<NormalMap> {
        let (map, image) = match (norm, bump) {
            (Some(map), _) => (map, self.image(map)?),
            (None, map) => {
                let map = map?;
                let image = self.image(map)?;
                let has_normals = bump::looks_like_normals(&image);
                let image = if has_normals {
                    image
                } else {
                    self.normals_of(&image, map)
                };
                (map, image)
            }
        };
        Some(NormalMap {
            texture: self.used(image, map, Encoding::Linear),
            scale: map.bump_multiplier,
        })
    }

    /// Roughness in green and metalness in blue, from a picture of each.
    pub(super) fn roughness_and_metal(
        &mut self,
        roughness: Option<&Map>,
        metal: Option<&Map>,
    ) -> Option<TextureUse> {
        let mut with_image = |map: Option<&'_ Map>| {
            let map = map?;
            Some((self.image(map)?, map.clone()))
        };
        let (roughness, metal) = (with_image(roughness), with_image(metal));
        let map = roughness.as_ref().or(metal.as_ref())?.1.clone();
        if let (Some((_, one)), Some((_, other))) = (&roughness, &metal)
            && (one.scale, one.offset, one.clamps) != (other.scale, other.offset, other.clamps)
        {
            self.warnings
                .add("map_Pm has other options than map_Pr, whose options both have");
        }
        let part = |from: &Option<(Arc<Image>, Map)>| match from {
            Some((image, map)) => (image.name.clone(), map.channel),
            None => (String::new(), None),
        };
        let key = (part(&roughness), part(&metal));
        let image = match self.packed.get(&key) {
            Some(known) => known.clone(),
            None => {
                fn of(from: &Option<(Arc<Image>, Map)>) -> Option<(&Image, Option<u8>)> {
                    let (image, map) = from.as_ref()?;
                    Some((image, map.channel))
                }
                let name = format!("{} {}", key.0.0, key.1.0);
                let image = Arc::new(pbr::packed(name, of(&roughness), of(&metal))?);
                self.packed.insert(key, image.clone());
                image
            }
        };
        Some(self.used(image, &map, Encoding::Linear))
    }

    fn normals_of(&mut self, heights: &Image, map: &Map) -> Arc<Image> {
        let key = (heights.name.clone(), map.clamps, map.channel);
        let normals = self.from_heights.entry(key).or_insert_with(|| {
            let height = bump::height_of(map.channel);
            Arc::new(bump::normals_from_heights(heights, height, map.clamps))
        });
        normals.clone()
    }

    fn used(&mut self, image: Arc<Image>, map: &Map, encoding: Encoding) -> TextureUse {
        let wrap = if map.clamps {
            [Wrap::ClampToEdge; 2]
        } else {
            [Wrap::Repeat; 2]
        };
        let known = self.list.iter().position(|texture| {
            Arc::ptr_eq(&texture.image, &image)
                && texture.wrap == wrap
                && texture.encoding == encoding
        });
        let texture = known.unwrap_or_else(|| {
            self.list.push(Texture {
                image,
                wrap,
                filter: Filter::Linear,
                mipmaps: true,
                encoding,
            });
            self.list.len() - 1
        });
        TextureUse {
            texture: texture as u32,
            uv_set: 0,
            transform: transform(map),
        }
    }

    fn image(&mut self, map: &Map) -> Option<Arc<Image>> {
        let shown = shown(map.name.as_bytes());
        let path = match self.finder.find(&map.name, &self.folders) {
            Found::AsNamed(path) => path,
            Found::Elsewhere(path) => {
                let there = path.display();
                self.warnings.add(format!(
                    "texture \"{shown}\" is not there; {there} is taken"
                ));
                path
            }
            absent => {
                self.warnings.add(match absent {
                    Found::Refused(why) => format!("texture \"{shown}\" {why}; it is not used"),
                    _ => format!("texture \"{shown}\" is missing and not used"),
                });
                if self.missing.insert(map.name.clone()) {
                    self.facts.push(TextureFacts {
                        name: map.name.clone(),
                        size: None,
                    });
                }
                return None;
            }
        };
        // However many names it goes by.
        let key = path.canonicalize().unwrap_or_else(|_| path.clone());
        if let Some(known) = self.images.get(&key) {
            return known.clone();
        }
        let Some(decoded) = self.decoded.remove(&key) else {
            if !self.wanted.iter().any(|(known, _)| *known == key) {
                self.wanted.push((key, path));
            }
            return None;
        };
        let name = path.to_string_lossy().into_owned();
        let image = match decoded {
            Ok(decoded) => {
                if let Some(flaw) = decoded.flaw {
                    self.warnings.add(format!("{name}: {flaw}"));
                }
                self.files.push(path);
                Some(Arc::new(decoded.image))
            }
            Err(problem) => {
                self.warnings
                    .add(format!("{problem}; the texture is not used"));
                None
            }
        };
        self.facts.push(TextureFacts {
            name,
            size: image.as_ref().map(|image| (image.width, image.height)),
        });
        self.images.insert(key, image.clone());
        image
    }

    /// None again, with every image decoded that was asked for and was not there.
    pub(super) fn with_wanted(self) -> Textures {
        let budget = self.budget;
        let read = self.wanted.into_par_iter().map(|(key, path)| {
            let name = path.to_string_lossy().into_owned();
            let bytes = files::read(&path, &budget).map_err(|error| error.to_string());
            (key, name, bytes)
        });
        let mut decoded = HashMap::new();
        let mut encoded = Vec::new();
        let mut names = HashMap::new();
        for (key, name, bytes) in read.collect::<Vec<_>>() {
            match bytes {
                Ok(bytes) => {
                    encoded.push((key.clone(), Encoded::new(name.clone(), bytes.into())));
                    names.insert(key, name);
                }
                Err(problem) => drop(decoded.insert(key, Err(problem))),
            }
        }
        for (key, found) in images::decode_all(encoded, &budget) {
            let name = names.remove(&key).unwrap_or_default();
            let found = found.map_err(|problem| format!("{name}: {problem}"));
            decoded.insert(key, found);
        }
        Textures {
            budget,
            finder: self.finder,
            decoded,
            ..Textures::default()
        }
    }
}

/// Whether any pixel is not opaque.
fn has_transparency(image: &Image) -> bool {
    match &image.pixels {
        Pixels::Eight(pixels) => pixels.iter().any(|&[_, _, _, a]| a < u8::MAX),
        Pixels::Sixteen(pixels) => pixels.iter().any(|&[_, _, _, a]| a < u16::MAX),
    }
}

/// Scale, then offset, which MTL counts from the lower left and luch from the upper left.
fn transform(map: &Map) -> Option<Mat3> {
    let ([su, sv], [ou, ov]) = (map.scale, map.offset);
    let is_plain = map.scale == [1.0; 2] && map.offset == [0.0; 2];
    (!is_plain).then(|| {
        Mat3::from_cols(
            Vec3::new(su, 0.0, 0.0),
            Vec3::new(0.0, sv, 0.0),
            Vec3::new(ou, 1.0 - sv - ov, 1.0),
        )
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

    use super::*;
    use glam::Vec2;

    #[test]
    fn scale_and_offset_work_from_the_lower_left() {
        let map = Map {
            name: String::new(),
            scale: [2.0, 3.0],
            offset: [0.25, 0.5],
            clamps: false,
            bump_multiplier: 1.0,
            channel: None,
        };
        let (u, v) = (0.4, 0.3);
        let found = transform(&map)
            .unwrap()
            .transform_point2(Vec2::new(u, 1.0 - v));
        let expected = Vec2::new(2.0 * u + 0.25, 1.0 - (3.0 * v + 0.5));
        assert!((found - expected).length() < 1e-6);
    }
}
