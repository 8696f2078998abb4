//! KHR_materials_pbrSpecularGlossiness: glTF's older way to describe a surface, instead of metallic-roughness.

use super::materials::Reader;
use super::texture_info::TextureInfo;
use crate::Error;
use crate::color::Rgb;
use crate::material::{self, Textured};
use crate::texture::Encoding;

/// As files call it.
pub(super) const NAME: &str = "KHR_materials_pbrSpecularGlossiness";

/// What it says.
#[derive(serde::Deserialize)]
#[serde(rename_all = "camelCase", default, expecting = "an object")]
pub(super) struct SpecularGlossiness {
    /// The fourth is coverage.
    diffuse_factor: [f32; 4],
    /// Coverage in alpha.
    diffuse_texture: Option<TextureInfo>,
    specular_factor: [f32; 3],
    glossiness_factor: f32,
    /// Glossiness in alpha.
    specular_glossiness_texture: Option<TextureInfo>,
}

impl Default for SpecularGlossiness {
    fn default() -> SpecularGlossiness {
        SpecularGlossiness {
            diffuse_factor: [1.0; 4],
            diffuse_texture: None,
            specular_factor: [1.0; 3],
            glossiness_factor: 1.0,
            specular_glossiness_texture: None,
        }
    }
}

impl SpecularGlossiness {
    pub(super) fn textures(&self) -> [&Option<TextureInfo>; 2] {
        [&self.diffuse_texture, &self.specular_glossiness_texture]
    }

    /// Diffuse colour and coverage.
    ///
    /// # Errors
    ///
    /// It names a texture that does not exist.
    pub(super) fn diffuse(
        &self,
        reader: &mut Reader,
    ) -> Result<(Textured<Rgb>, Textured<f32>), Error> {
        let [r, g, b, a] = self.diffuse_factor;
        let texture = reader.slot("diffuse", &self.diffuse_texture, Encoding::Srgb)?;
        let diffuse = Textured {
            factor: reader.color("diffuseFactor", [r, g, b], 1.0),
            texture: texture.clone(),
        };
        let coverage = Textured {
            factor: reader.share("diffuseFactor", a),
            texture,
        };
        Ok((diffuse, coverage))
    }

    /// The rest, with what the material's own fields say of ambient light.
    ///
    /// # Errors
    ///
    /// It names a texture that does not exist.
    pub(super) fn read(
        &self,
        diffuse: Textured<Rgb>,
        occlusion: Textured<f32>,
        reader: &mut Reader,
    ) -> Result<material::SpecularGlossiness, Error> {
        let specular = &self.specular_glossiness_texture;
        Ok(material::SpecularGlossiness {
            diffuse,
            specular: Textured {
                factor: reader.color("specularFactor", self.specular_factor, 1.0),
                texture: reader.slot("specular-glossiness", specular, Encoding::Srgb)?,
            },
            glossiness: reader.share("glossinessFactor", self.glossiness_factor),
            occlusion,
        })
    }
}
