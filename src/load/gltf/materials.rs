//! Materials: metallic-roughness with its five textures, or what extensions have instead (glTF 2.0, section 3.9).
//!
//! What extensions ask, and what luch does. `R` is what a surface reflects toward the viewer, all light together, of which
//! a mirror ray stands for a part and the rest sees ambient light ([`microfacet`](crate::shade::microfacet)).
//!
//! | extension | asks | luch does |
//! | --- | --- | --- |
//! | KHR_materials_emissive_strength | emission above 1 | that |
//! | KHR_materials_unlit | a colour that light does not change | that |
//! | KHR_materials_ior | `F0 = ((n - 1) / (n + 1))^2` for what is not metal; `n = 0` is infinite | that; what is reflected is taken from diffuse light and from what goes through; rays bend by it |
//! | KHR_materials_specular | a factor for `F0` and `F90` and a colour for `F0` of what is not metal | that |
//! | KHR_materials_transmission | light goes through, spread by roughness, tinted by the base colour | a ray goes on, sharp however rough the surface is |
//! | KHR_materials_volume | bodies bend light and swallow it on its way | that where `thicknessFactor` is above 0; rays measure the way, so that the texture of thickness is not read |
//! | KHR_materials_dispersion | colours bend unlike | three rays, for red, green and blue |
//! | KHR_materials_clearcoat | a second, dielectric lobe over all the others, with its own roughness and normal | a second highlight and mirror of `F0 = 0.04`, `weight R` of the light, taken from all below it; both along the coat's own normal, a second mirror ray where that is not the base's |
//! | KHR_materials_sheen | the "Charlie" lobe of fibres, what it sends back taken from below | that, each lamp by the lobe and ambient light by its integral |
//! | KHR_materials_iridescence | thin-film interference instead of `F`, at each half vector | that, at the angle of the viewer, for dielectric and metal mixed |
//! | KHR_materials_anisotropy | a lobe that is longer along a direction | a round one, as high: the geometric mean of both `alpha` |
//! | KHR_materials_diffuse_transmission | diffuse light from behind | ambient light and that of lamps comes through, the latter as Lambert's from the other side; what goes through is taken from diffuse light |
//! | KHR_materials_pbrSpecularGlossiness | diffuse colour, `F0`, glossiness instead of metallic-roughness | that, wherever a material has it |
//! | KHR_materials_variants | materials of which a user chooses | that; a primitive's own where none is chosen |

use super::document::{Document, named};
use super::emissive_strength::{self, EmissiveStrength};
use super::materials_extensions::Extended;
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
pub(super) fn textures_used(document: &Document, extended: &[Extended]) -> BTreeSet<usize> {
    let materials = document.root.materials.iter();
    let of_extensions = extended.iter().flat_map(Extended::textures);
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
        .chain(of_extensions)
        .collect()
}

/// The materials of a file, of which `extended` says what extensions do, and the default one after them.
///
/// # Errors
///
/// A material names a texture that does not exist.
pub(super) fn all(
    document: &Document,
    extended: &[Extended],
    textures: &mut Textures,
    warnings: &mut Warnings,
) -> Result<Vec<Material>, Error> {
    let materials = document.root.materials.iter().zip(extended).enumerate();
    let mut read: Vec<Material> = Vec::with_capacity(document.root.materials.len() + 1);
    for (index, (json, extended)) in materials {
        let place = named("material", index, json.name.as_ref());
        let mut reader = Reader {
            place,
            textures,
            warnings,
        };
        read.push(reader.material(json, extended)?);
    }
    let place = String::new();
    let mut reader = Reader {
        place,
        textures,
        warnings,
    };
    read.push(reader.material(&MaterialJson::default(), &Extended::default())?);
    Ok(read)
}

/// Where one material is read from, and what it is called in messages.
pub(super) struct Reader<'a, 'd> {
    place: String,
    textures: &'a mut Textures<'d>,
    warnings: &'a mut Warnings,
}

impl Reader<'_, '_> {
    fn material(&mut self, json: &MaterialJson, extended: &Extended) -> Result<Material, Error> {
        let others = json.extensions.as_ref().map(|e| &e.others);
        let unlit = extensions::read::<Unlit>(others, materials_unlit::NAME);
        let unlit = self.valid(unlit);
        let mut transmission = None;
        let (model, coverage) = match (&unlit, &extended.specular_glossiness) {
            (Some(Unlit {}), _) => {
                let (color, coverage) = self.base_color(json)?;
                (Model::Unlit { color }, coverage)
            }
            (None, Some(glossy)) => {
                let (diffuse, coverage) = glossy.diffuse(self)?;
                let occlusion = self.occlusion(json)?;
                let model = glossy.read(diffuse, occlusion, self)?;
                (Model::SpecularGlossiness(model), coverage)
            }
            (None, None) => {
                let (base_color, coverage) = self.base_color(json)?;
                let model = self.metallic_roughness(json, base_color, extended)?;
                transmission = extended.transmission(self)?;
                (Model::MetallicRoughness(model), coverage)
            }
        };
        Ok(Material {
            name: json.name.clone().unwrap_or_default(),
            model,
            emission: self.emission(json)?,
            alpha: self.alpha(json, coverage),
            transmission,
            normal_map: self.normal_map(json)?,
            double_sided: json.double_sided,
        })
    }

    /// The base colour and its coverage.
    fn base_color(&mut self, json: &MaterialJson) -> Result<(Textured<Rgb>, Textured<f32>), Error> {
        let pbr = &json.pbr_metallic_roughness;
        let [r, g, b, a] = pbr
            .base_color_factor
            .0
            .map(|c| self.share("baseColorFactor", c));
        let texture = match &pbr.base_color_texture {
            Some(info) => self.texture("base colour", info, Encoding::Srgb)?,
            None => None,
        };
        let color = Textured {
            factor: Rgb::new(r, g, b),
            texture: texture.clone(),
        };
        Ok((color, Textured { factor: a, texture }))
    }

    fn metallic_roughness(
        &mut self,
        json: &MaterialJson,
        base_color: Textured<Rgb>,
        extended: &Extended,
    ) -> Result<MetallicRoughness, Error> {
        let pbr = &json.pbr_metallic_roughness;
        let metallic_roughness = match &pbr.metallic_roughness_texture {
            Some(info) => {
                let name = "metallic-roughness";
                self.texture(name, info, Encoding::Linear)?
            }
            None => None,
        };
        Ok(MetallicRoughness {
            base_color,
            metallic: self.share("metallicFactor", pbr.metallic_factor.0),
            roughness: self.share("roughnessFactor", pbr.roughness_factor.0),
            metallic_roughness,
            occlusion: self.occlusion(json)?,
            finish: extended.finish(self)?,
        })
    }

    fn occlusion(&mut self, json: &MaterialJson) -> Result<Textured<f32>, Error> {
        Ok(match &json.occlusion_texture {
            Some(info) => Textured {
                factor: self.share("occlusion strength", info.strength.0),
                texture: self.texture("occlusion", info, Encoding::Linear)?,
            },
            None => Textured::uniform(1.0),
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
        self.normals("normal", info, info.scale)
    }

    /// The use of a texture of normals.
    pub(super) fn normals(
        &mut self,
        kind: &str,
        info: impl Into<TextureInfo>,
        scale: f32,
    ) -> Result<Option<NormalMap>, Error> {
        let scale = scale.clamp(-super::BRIGHTEST, super::BRIGHTEST);
        let texture = self.texture(kind, info, Encoding::Linear)?;
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

    /// The use of a texture that an extension may name.
    pub(super) fn slot(
        &mut self,
        kind: &str,
        info: &Option<TextureInfo>,
        encoding: Encoding,
    ) -> Result<Option<TextureUse>, Error> {
        match info {
            Some(info) => self.texture(kind, info.clone(), encoding),
            None => Ok(None),
        }
    }

    pub(super) fn share(&mut self, field: &str, value: f32) -> f32 {
        self.within(field, value, 1.0)
    }

    /// `value`, or what is nearest to it from 0 to `most`.
    pub(super) fn within(&mut self, field: &str, value: f32, most: f32) -> f32 {
        self.between(field, value, 0.0, most)
    }

    /// `value`, or what is nearest to it from `least` to `most`.
    pub(super) fn between(&mut self, field: &str, value: f32, least: f32, most: f32) -> f32 {
        let fits = value.clamp(least, most);
        if fits != value {
            self.warn(&format!("its {field} is {value}, taken as {fits}"));
        }
        fits
    }

    /// A colour, each channel from 0 to `most`.
    pub(super) fn color(&mut self, field: &str, value: [f32; 3], most: f32) -> Rgb {
        value
            .map(|channel| self.within(field, channel, most))
            .into()
    }

    pub(super) fn warn(&mut self, problem: &str) {
        self.warnings.add(format!("{}: {problem}", self.place));
    }
}
