//! KHR_materials_anisotropy: surfaces that are rougher along their grain.

use super::materials::Reader;
use super::texture_info::TextureInfo;
use crate::Error;
use crate::material::Textured;
use crate::texture::Encoding;

/// As files call it.
pub(super) const NAME: &str = "KHR_materials_anisotropy";

/// What it says. The direction of the grain, its rotation and the texture's red and green, is not read: luch's
/// highlights are round.
#[derive(Default, serde::Deserialize)]
#[serde(rename_all = "camelCase", default, expecting = "an object")]
pub(super) struct Anisotropy {
    anisotropy_strength: f32,
    /// Strength in blue.
    anisotropy_texture: Option<TextureInfo>,
}

impl Anisotropy {
    pub(super) fn textures(&self) -> [&Option<TextureInfo>; 1] {
        [&self.anisotropy_texture]
    }

    /// Nothing where the surface has no grain.
    ///
    /// # Errors
    ///
    /// It names a texture that does not exist.
    pub(super) fn read(&self, reader: &mut Reader) -> Result<Option<Textured<f32>>, Error> {
        let strength = Textured {
            factor: reader.share("anisotropyStrength", self.anisotropy_strength),
            texture: reader.slot("anisotropy", &self.anisotropy_texture, Encoding::Linear)?,
        };
        let is_there = strength.factor > 0.0;
        Ok(is_there.then_some(strength))
    }
}
