//! Materials: metallic-roughness with its five textures, or unlit (glTF 2.0, section 3.9).

use super::document::{Document, named};
use super::emissive_strength::{self, EmissiveStrength};
use super::materials_unlit::{self, Unlit};
use super::texture_info::TextureInfo;
use super::texture_transform::{self, TextureTransform};
use super::textures::Textures;
use super::{Warnings, extensions};
use crate::Error;
use crate::color::Rgb;
use crate::material::{
    Alpha, AlphaChannel, AlphaMode, Material, MetallicRoughness, Model, NormalMap, Textured,
};
use crate::texture::{Encoding, TextureUse};
use gltf::json::Material as MaterialJson;
use gltf::json::material::AlphaMode as AlphaModeJson;
use gltf::json::validation::Checked;
use std::collections::BTreeSet;

/// The textures that materials use, by their index in the file.
pub(super) fn textures_used(document: &Document) -> BTreeSet<usize> {
    let materials = document.root.materials.iter();
    materials
        .flat_map(|material| {
            let pbr = &material.pbr_metallic_roughness;
            let infos = [
                &pbr.base_color_texture,
                &pbr.metallic_roughness_texture,
                &material.emissive_texture,
            ];
            let infos = infos.map(|info| info.as_ref().map(|info| info.index));
            let normal = material.normal_texture.as_ref().map(|info| info.index);
            let occlusion = material.occlusion_texture.as_ref().map(|info| info.index);
            infos.into_iter().chain([normal, occlusion]).flatten()
        })
        .map(|index| index.value())
        .collect()
}

/// The materials of a file, and the default one after them.
///
/// # Errors
///
/// A material names a texture that does not exist.
pub(super) fn all(
    document: &Document,
    textures: &mut Textures,
    warnings: &mut Warnings,
) -> Result<Vec<Material>, Error> {
    let materials = document.root.materials.iter().enumerate();
    let mut read: Vec<Material> = Vec::with_capacity(document.root.materials.len() + 1);
    for (index, json) in materials {
        let place = named("material", index, json.name.as_ref());
        let mut reader = Reader {
            place,
            textures,
            warnings,
        };
        read.push(reader.material(json)?);
    }
    let place = String::new();
    let mut reader = Reader {
        place,
        textures,
        warnings,
    };
    read.push(reader.material(&MaterialJson::default())?);
    Ok(read)
}

struct Reader<'a, 'd> {
    place: String,
    textures: &'a mut Textures<'d>,
    warnings: &'a mut Warnings,
}

impl Reader<'_, '_> {
    fn material(&mut self, json: &MaterialJson) -> Result<Material, Error> {
        let pbr = &json.pbr_metallic_roughness;
        let [r, g, b, a] = pbr
            .base_color_factor
            .0
            .map(|c| self.share("baseColorFactor", c));
        let base_texture = match &pbr.base_color_texture {
            Some(info) => self.texture("base colour", info, Encoding::Srgb)?,
            None => None,
        };
        let base_color = Textured {
            factor: Rgb::new(r, g, b),
            texture: base_texture.clone(),
        };
        let coverage = Textured {
            factor: a,
            texture: base_texture,
        };
        let others = json.extensions.as_ref().map(|e| &e.others);
        let unlit = extensions::read::<Unlit>(others, materials_unlit::NAME);
        let model = match self.valid(unlit) {
            Some(Unlit {}) => Model::Unlit { color: base_color },
            None => Model::MetallicRoughness(self.metallic_roughness(json, base_color)?),
        };
        Ok(Material {
            name: json.name.clone().unwrap_or_default(),
            model,
            emission: self.emission(json)?,
            alpha: self.alpha(json, coverage),
            transmission: None,
            normal_map: self.normal_map(json)?,
            double_sided: json.double_sided,
        })
    }

    fn metallic_roughness(
        &mut self,
        json: &MaterialJson,
        base_color: Textured<Rgb>,
    ) -> Result<MetallicRoughness, Error> {
        let pbr = &json.pbr_metallic_roughness;
        let metallic_roughness = match &pbr.metallic_roughness_texture {
            Some(info) => {
                let name = "metallic-roughness";
                self.texture(name, info, Encoding::Linear)?
            }
            None => None,
        };
        let occlusion = match &json.occlusion_texture {
            Some(info) => Textured {
                factor: self.share("occlusion strength", info.strength.0),
                texture: self.texture("occlusion", info, Encoding::Linear)?,
            },
            None => Textured::uniform(1.0),
        };
        Ok(MetallicRoughness {
            base_color,
            metallic: self.share("metallicFactor", pbr.metallic_factor.0),
            roughness: self.share("roughnessFactor", pbr.roughness_factor.0),
            metallic_roughness,
            occlusion,
        })
    }

    fn emission(&mut self, json: &MaterialJson) -> Result<Textured<Rgb>, Error> {
        let others = json.extensions.as_ref().map(|e| &e.others);
        let strength = extensions::read::<EmissiveStrength>(others, emissive_strength::NAME);
        let strength = self.valid(strength).map_or(1.0, |e| e.emissive_strength);
        let strength = self.within("emissiveStrength", strength, super::BRIGHTEST);
        // Files from before KHR_materials_emissive_strength have factors above 1.
        let factor = json.emissive_factor.0;
        let [r, g, b] =
            factor.map(|c| self.within("emissiveFactor", c, super::BRIGHTEST) * strength);
        let texture = match &json.emissive_texture {
            Some(info) => self.texture("emissive", info, Encoding::Srgb)?,
            None => None,
        };
        let factor = Rgb::new(r, g, b);
        Ok(Textured { factor, texture })
    }

    fn alpha(&mut self, json: &MaterialJson, coverage: Textured<f32>) -> Alpha {
        let mode = match json.alpha_mode {
            Checked::Valid(AlphaModeJson::Opaque) => AlphaMode::Opaque,
            Checked::Valid(AlphaModeJson::Blend) => AlphaMode::Blend,
            Checked::Valid(AlphaModeJson::Mask) => AlphaMode::Mask {
                cutoff: json.alpha_cutoff.unwrap_or_default().0,
            },
            Checked::Invalid => {
                self.warn("its alphaMode is unknown, taken as OPAQUE");
                AlphaMode::Opaque
            }
        };
        Alpha {
            mode,
            coverage,
            channel: AlphaChannel::Alpha,
        }
    }

    fn normal_map(&mut self, json: &MaterialJson) -> Result<Option<NormalMap>, Error> {
        let Some(info) = &json.normal_texture else {
            return Ok(None);
        };
        let scale = info.scale.clamp(-super::BRIGHTEST, super::BRIGHTEST);
        let texture = self.texture("normal", info, Encoding::Linear)?;
        Ok(texture.map(|texture| NormalMap { texture, scale }))
    }

    /// The use of a texture, as any slot of the material or of an extension says it; `None` where it cannot be used,
    /// which is warned of.
    fn texture(
        &mut self,
        kind: &str,
        info: impl Into<TextureInfo>,
        encoding: Encoding,
    ) -> Result<Option<TextureUse>, Error> {
        let info = info.into();
        let place = format!("{}, {kind} texture", self.place);
        let texture = self.textures.texture(&place, info.index, encoding)?;
        let transform =
            extensions::read::<TextureTransform>(info.extensions.as_ref(), texture_transform::NAME);
        let transform = self.valid(transform).unwrap_or_default();
        let uv_set = match transform.tex_coord.unwrap_or(info.tex_coord) {
            uv_set @ (0 | 1) => uv_set as u8,
            uv_set => {
                self.warnings.add(format!(
                    "{place}: uses TEXCOORD_{uv_set}, luch reads 0 and 1: it is left out"
                ));
                return Ok(None);
            }
        };
        let transform = self.valid(transform.matrix());
        Ok(texture.map(|texture| TextureUse {
            texture,
            uv_set,
            transform,
        }))
    }

    /// What an extension says; nothing, and a warning, where that cannot be read.
    fn valid<T>(&mut self, extension: Result<Option<T>, String>) -> Option<T> {
        extension.unwrap_or_else(|problem| {
            self.warn(&format!("{problem}: the extension is ignored"));
            None
        })
    }

    fn share(&mut self, field: &str, value: f32) -> f32 {
        self.within(field, value, 1.0)
    }

    /// `value`, or what is nearest to it from 0 to `most`.
    fn within(&mut self, field: &str, value: f32, most: f32) -> f32 {
        let fits = value.clamp(0.0, most);
        if fits != value {
            self.warn(&format!("its {field} is {value}, taken as {fits}"));
        }
        fits
    }

    fn warn(&mut self, problem: &str) {
        self.warnings.add(format!("{}: {problem}", self.place));
    }
}
