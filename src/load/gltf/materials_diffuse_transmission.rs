//! KHR_materials_diffuse_transmission: thin things like leaves, lit from behind.

use super::materials::Reader;
use super::texture_info::TextureInfo;
use crate::Error;
use crate::material::{self, Textured};
use crate::texture::Encoding;

/// As files call it.
pub(super) const NAME: &str = "KHR_materials_diffuse_transmission";

/// What it says.
#[derive(serde::Deserialize)]
#[serde(rename_all = "camelCase", default, expecting = "an object")]
pub(super) struct DiffuseTransmission {
    diffuse_transmission_factor: f32,
    /// In alpha.
    diffuse_transmission_texture: Option<TextureInfo>,
    diffuse_transmission_color_factor: [f32; 3],
    diffuse_transmission_color_texture: Option<TextureInfo>,
}

impl Default for DiffuseTransmission {
    fn default() -> DiffuseTransmission {
        DiffuseTransmission {
            diffuse_transmission_factor: 0.0,
            diffuse_transmission_texture: None,
            diffuse_transmission_color_factor: [1.0; 3],
            diffuse_transmission_color_texture: None,
        }
    }
}

impl DiffuseTransmission {
    pub(super) fn textures(&self) -> [&Option<TextureInfo>; 2] {
        [
            &self.diffuse_transmission_texture,
            &self.diffuse_transmission_color_texture,
        ]
    }

    /// Nothing where no light goes through.
    ///
    /// # Errors
    ///
    /// It names a texture that does not exist.
    pub(super) fn read(
        &self,
        reader: &mut Reader,
    ) -> Result<Option<material::DiffuseTransmission>, Error> {
        let [share, color] = self.textures();
        let factor = self.diffuse_transmission_factor;
        let share = Textured {
            factor: reader.share("diffuseTransmissionFactor", factor),
            texture: reader.slot("diffuse transmission", share, Encoding::Linear)?,
        };
        let factor = self.diffuse_transmission_color_factor;
        let color = Textured {
            factor: reader.color("diffuseTransmissionColorFactor", factor, 1.0),
            texture: reader.slot("diffuse transmission colour", color, Encoding::Srgb)?,
        };
        let is_there = share.factor > 0.0;
        Ok(is_there.then_some(material::DiffuseTransmission { share, color }))
    }
}
