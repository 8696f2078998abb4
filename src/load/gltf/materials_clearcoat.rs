//! KHR_materials_clearcoat: a varnish over the surface.

use super::materials::Reader;
use super::texture_info::TextureInfo;
use crate::Error;
use crate::material::{self, Textured};
use crate::texture::Encoding;

/// As files call it.
pub(super) const NAME: &str = "KHR_materials_clearcoat";

/// What it says. Its normal texture is not read: the coat has the surface's normal.
#[derive(Default, serde::Deserialize)]
#[serde(rename_all = "camelCase", default, expecting = "an object")]
pub(super) struct Clearcoat {
    clearcoat_factor: f32,
    /// In red.
    clearcoat_texture: Option<TextureInfo>,
    clearcoat_roughness_factor: f32,
    /// In green.
    clearcoat_roughness_texture: Option<TextureInfo>,
}

impl Clearcoat {
    pub(super) fn textures(&self) -> [&Option<TextureInfo>; 2] {
        [&self.clearcoat_texture, &self.clearcoat_roughness_texture]
    }

    /// Nothing where there is no coat.
    ///
    /// # Errors
    ///
    /// It names a texture that does not exist.
    pub(super) fn read(&self, reader: &mut Reader) -> Result<Option<material::Clearcoat>, Error> {
        let (weight, roughness) = (&self.clearcoat_texture, &self.clearcoat_roughness_texture);
        let weight = Textured {
            factor: reader.share("clearcoatFactor", self.clearcoat_factor),
            texture: reader.slot("clearcoat", weight, Encoding::Linear)?,
        };
        let roughness = Textured {
            factor: reader.share("clearcoatRoughnessFactor", self.clearcoat_roughness_factor),
            texture: reader.slot("clearcoat roughness", roughness, Encoding::Linear)?,
        };
        let is_there = weight.factor > 0.0;
        Ok(is_there.then_some(material::Clearcoat { weight, roughness }))
    }
}
