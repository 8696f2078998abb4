//! KHR_materials_transmission: light that goes through a surface.

use super::materials::Reader;
use super::materials_dispersion::Dispersion;
use super::materials_ior::{self, Ior};
use super::materials_volume::Volume;
use super::texture_info::TextureInfo;
use crate::Error;
use crate::material::{self, Textured};
use crate::texture::Encoding;

/// As files call it.
pub(super) const NAME: &str = "KHR_materials_transmission";

/// What it says.
#[derive(Default, serde::Deserialize)]
#[serde(rename_all = "camelCase", default, expecting = "an object")]
pub(super) struct Transmission {
    transmission_factor: f32,
    /// In red.
    transmission_texture: Option<TextureInfo>,
}

/// What other extensions say of the light that goes through.
#[derive(Clone, Copy, Default)]
pub(super) struct Beyond<'a> {
    pub(super) ior: Option<&'a Ior>,
    pub(super) volume: Option<&'a Volume>,
    pub(super) dispersion: Option<&'a Dispersion>,
}

impl Transmission {
    pub(super) fn textures(&self) -> [&Option<TextureInfo>; 1] {
        [&self.transmission_texture]
    }

    /// Nothing where no light goes through.
    ///
    /// # Errors
    ///
    /// It names a texture that does not exist.
    pub(super) fn read(
        &self,
        beyond: Beyond,
        reader: &mut Reader,
    ) -> Result<Option<material::Transmission>, Error> {
        let texture = &self.transmission_texture;
        let share = Textured {
            factor: reader.share("transmissionFactor", self.transmission_factor),
            texture: reader.slot("transmission", texture, Encoding::Linear)?,
        };
        if share.factor == 0.0 {
            return Ok(None);
        }
        Ok(Some(material::Transmission {
            share,
            ior: beyond.ior.map_or(materials_ior::DEFAULT, Ior::bending),
            dispersion: beyond.dispersion.map_or(0.0, |d| d.read(reader)),
            volume: beyond.volume.and_then(|volume| volume.read(reader)),
        }))
    }
}
