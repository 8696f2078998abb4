//! KHR_materials_specular: how much, and in what colour, what is not metal reflects.

use super::materials::Reader;
use super::texture_info::TextureInfo;
use crate::Error;
use crate::color::Rgb;
use crate::material::Textured;
use crate::texture::Encoding;

/// As files call it.
pub(super) const NAME: &str = "KHR_materials_specular";

/// What it says.
#[derive(serde::Deserialize)]
#[serde(rename_all = "camelCase", default, expecting = "an object")]
pub(super) struct Specular {
    specular_factor: f32,
    /// In alpha.
    specular_texture: Option<TextureInfo>,
    /// May be above 1.
    specular_color_factor: [f32; 3],
    specular_color_texture: Option<TextureInfo>,
}

impl Default for Specular {
    fn default() -> Specular {
        Specular {
            specular_factor: 1.0,
            specular_texture: None,
            specular_color_factor: [1.0; 3],
            specular_color_texture: None,
        }
    }
}

impl Specular {
    pub(super) fn textures(&self) -> [&Option<TextureInfo>; 2] {
        [&self.specular_texture, &self.specular_color_texture]
    }

    /// Factor and colour.
    ///
    /// # Errors
    ///
    /// It names a texture that does not exist.
    pub(super) fn read(
        &self,
        reader: &mut Reader,
    ) -> Result<(Textured<f32>, Textured<Rgb>), Error> {
        let (factor, color) = (&self.specular_texture, &self.specular_color_texture);
        let factor = Textured {
            factor: reader.share("specularFactor", self.specular_factor),
            texture: reader.slot("specular", factor, Encoding::Linear)?,
        };
        let most = super::BRIGHTEST;
        let color = Textured {
            factor: reader.color("specularColorFactor", self.specular_color_factor, most),
            texture: reader.slot("specular colour", color, Encoding::Srgb)?,
        };
        Ok((factor, color))
    }
}
