//! KHR_materials_iridescence: colours of a thin film.

use super::materials::Reader;
use super::texture_info::TextureInfo;
use crate::Error;
use crate::material::{self, Textured};
use crate::texture::Encoding;

/// As files call it.
pub(super) const NAME: &str = "KHR_materials_iridescence";

/// The greatest index of a film that is taken as it is.
const GREATEST_IOR: f32 = 1e3;
/// The greatest thickness, a millimetre in nanometres: long before, all waves have got out of step.
const GREATEST_THICKNESS: f32 = 1e6;

/// What it says.
#[derive(serde::Deserialize)]
#[serde(rename_all = "camelCase", default, expecting = "an object")]
pub(super) struct Iridescence {
    iridescence_factor: f32,
    /// In red.
    iridescence_texture: Option<TextureInfo>,
    iridescence_ior: f32,
    /// Nanometres; may be more than the maximum.
    iridescence_thickness_minimum: f32,
    iridescence_thickness_maximum: f32,
    /// In green.
    iridescence_thickness_texture: Option<TextureInfo>,
}

impl Default for Iridescence {
    fn default() -> Iridescence {
        Iridescence {
            iridescence_factor: 0.0,
            iridescence_texture: None,
            iridescence_ior: 1.3,
            iridescence_thickness_minimum: 100.0,
            iridescence_thickness_maximum: 400.0,
            iridescence_thickness_texture: None,
        }
    }
}

impl Iridescence {
    pub(super) fn textures(&self) -> [&Option<TextureInfo>; 2] {
        [
            &self.iridescence_texture,
            &self.iridescence_thickness_texture,
        ]
    }

    /// Nothing where there is no film.
    ///
    /// # Errors
    ///
    /// It names a texture that does not exist.
    pub(super) fn read(&self, reader: &mut Reader) -> Result<Option<material::Iridescence>, Error> {
        let (strength, thickness) = (
            &self.iridescence_texture,
            &self.iridescence_thickness_texture,
        );
        let strength = Textured {
            factor: reader.share("iridescenceFactor", self.iridescence_factor),
            texture: reader.slot("iridescence", strength, Encoding::Linear)?,
        };
        let thickness_texture =
            reader.slot("iridescence thickness", thickness, Encoding::Linear)?;
        if strength.factor == 0.0 {
            return Ok(None);
        }
        let minimum = self.iridescence_thickness_minimum;
        let maximum = self.iridescence_thickness_maximum;
        Ok(Some(material::Iridescence {
            strength,
            ior: reader.between("iridescenceIor", self.iridescence_ior, 1.0, GREATEST_IOR),
            thickness: [
                reader.within("iridescenceThicknessMinimum", minimum, GREATEST_THICKNESS),
                reader.within("iridescenceThicknessMaximum", maximum, GREATEST_THICKNESS),
            ],
            thickness_texture,
        }))
    }
}
