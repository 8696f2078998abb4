//! KHR_materials_sheen: fibres that stand out of a cloth.

use super::materials::Reader;
use super::texture_info::TextureInfo;
use crate::Error;
use crate::color::Rgb;
use crate::material::{self, Textured};
use crate::texture::Encoding;

/// As files call it.
pub(super) const NAME: &str = "KHR_materials_sheen";

/// What it says.
#[derive(Default, serde::Deserialize)]
#[serde(rename_all = "camelCase", default, expecting = "an object")]
pub(super) struct Sheen {
    sheen_color_factor: [f32; 3],
    sheen_color_texture: Option<TextureInfo>,
    sheen_roughness_factor: f32,
    /// In alpha.
    sheen_roughness_texture: Option<TextureInfo>,
}

impl Sheen {
    pub(super) fn textures(&self) -> [&Option<TextureInfo>; 2] {
        [&self.sheen_color_texture, &self.sheen_roughness_texture]
    }

    /// Nothing where it is black.
    ///
    /// # Errors
    ///
    /// It names a texture that does not exist.
    pub(super) fn read(&self, reader: &mut Reader) -> Result<Option<material::Sheen>, Error> {
        let (color, roughness) = (&self.sheen_color_texture, &self.sheen_roughness_texture);
        let color = Textured {
            factor: reader.color("sheenColorFactor", self.sheen_color_factor, 1.0),
            texture: reader.slot("sheen colour", color, Encoding::Srgb)?,
        };
        let roughness = Textured {
            factor: reader.share("sheenRoughnessFactor", self.sheen_roughness_factor),
            texture: reader.slot("sheen roughness", roughness, Encoding::Linear)?,
        };
        let is_there = color.factor != Rgb::BLACK;
        Ok(is_there.then_some(material::Sheen { color, roughness }))
    }
}
