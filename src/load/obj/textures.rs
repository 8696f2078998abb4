//! The textures of a model: found, decoded once, used by many materials.

use super::bump;
use super::find::{Finder, Found};
use super::map::Map;
use super::text::shown;
use crate::load::{Budget, TextureFacts, Warnings, files, images};
use crate::material::{AlphaChannel, NormalMap};
use crate::texture::{Encoding, Filter, Image, Pixels, Texture, TextureUse, Wrap};
use glam::{Mat3, Vec3};
use std::collections::{HashMap, HashSet};
use std::path::PathBuf;
use std::sync::Arc;

/// All textures of a model, and where to look for more.
#[derive(Default)]
pub(super) struct Textures {
    budget: Budget,
    /// Of the MTL at hand, then of the OBJ.
    pub(super) folders: Vec<PathBuf>,
    pub(super) finder: Finder,
    pub(super) list: Vec<Texture>,
    pub(super) facts: Vec<TextureFacts>,
    pub(super) files: Vec<PathBuf>,
    pub(super) warnings: Warnings,
    /// What every file that was tried became.
    images: HashMap<PathBuf, Option<Arc<Image>>>,
    /// Normals by the file of their heights, whether it repeats, and the channel.
    from_heights: HashMap<(String, bool, Option<u8>), Arc<Image>>,
    missing: HashSet<String>,
}

impl Textures {
    /// None yet; their memory comes from the budget.
    pub(super) fn within(budget: &Budget) -> Textures {
        Textures {
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

    /// Decodes an image, if there is the memory for it and as much again three times on the way.
    fn decode(&self, name: &str, bytes: &[u8]) -> Result<images::Decoded, String> {
        let needs = 4 * images::header(name, bytes)?.bytes_decoded();
        let taken = self.budget.take(needs);
        taken.map_err(|problem| problem.to_string())?;
        images::decode(name, bytes)
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
            Found::Missing => {
                self.warnings
                    .add(format!("texture \"{shown}\" is missing and not used"));
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
        let name = path.to_string_lossy().into_owned();
        let decoded = files::read(&path, &self.budget)
            .map_err(|error| error.to_string())
            .and_then(|bytes| {
                self.files.push(path.clone());
                self.decode(&name, &bytes)
                    .map_err(|problem| format!("{name}: {problem}"))
            });
        let image = match decoded {
            Ok(decoded) => {
                if let Some(flaw) = decoded.flaw {
                    self.warnings.add(format!("{name}: {flaw}"));
                }
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
