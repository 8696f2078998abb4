//! What a surface is made of, as its file says it.

mod finish;

pub use finish::{Clearcoat, DiffuseTransmission, Finish, Iridescence, Sheen};

use crate::color::Rgb;
use crate::texture::{Checker, TextureUse};

/// A material: how it answers light, and where it is there at all.
#[derive(Clone, Debug, PartialEq)]
pub struct Material {
    /// As in the file; may be empty.
    pub name: String,
    /// How it answers light.
    pub model: Model,
    /// Light of its own.
    pub emission: Textured<Rgb>,
    /// Where it is there at all.
    pub alpha: Alpha,
    /// Light that goes through it.
    pub transmission: Option<Transmission>,
    /// Bends shading normals.
    pub normal_map: Option<NormalMap>,
    /// Whether camera and mirror rays see it from behind, too. Shadow rays always do.
    pub double_sided: bool,
}

/// A factor, and a texture that multiplies it.
#[derive(Clone, Debug, PartialEq)]
pub struct Textured<T> {
    /// In linear light, or a plain number.
    pub factor: T,
    /// Which channels count depends on what is textured.
    pub texture: Option<TextureUse>,
}

impl<T> Textured<T> {
    /// The same everywhere.
    pub const fn uniform(factor: T) -> Textured<T> {
        Textured {
            factor,
            texture: None,
        }
    }
}

/// The ways a material can be described.
#[derive(Clone, Debug, PartialEq)]
pub enum Model {
    /// Diffuse, specular, shininess, reflectivity: scene files and MTL.
    Phong(Phong),
    /// Base colour, metalness, roughness: glTF.
    MetallicRoughness(MetallicRoughness),
    /// Diffuse colour, specular colour, glossiness: glTF's older way (KHR_materials_pbrSpecularGlossiness).
    SpecularGlossiness(SpecularGlossiness),
    /// A colour that light does not change (KHR_materials_unlit).
    Unlit {
        /// Shown as it is.
        color: Textured<Rgb>,
    },
}

/// The parameters of the paper's surfaces.
#[derive(Clone, Debug, PartialEq)]
pub struct Phong {
    /// `k_d`.
    pub diffuse: Textured<Rgb>,
    /// `k_s`.
    pub specular: Textured<Rgb>,
    /// The exponent of the highlight, zero or more.
    pub shininess: f32,
    /// The share of the mirror ray's light that comes back.
    pub reflectivity: Rgb,
    /// A second diffuse colour in squares; planes only.
    pub checker: Option<Checker>,
}

/// glTF's metallic-roughness parameters (glTF 2.0, section 3.9.2).
#[derive(Clone, Debug, PartialEq)]
pub struct MetallicRoughness {
    /// Albedo of what is not metal, mirror colour of what is.
    pub base_color: Textured<Rgb>,
    /// 0 or 1, or between where textures blend.
    pub metallic: f32,
    /// Perceptual roughness, 0..1.
    pub roughness: f32,
    /// Multiplies both: roughness in green, metalness in blue.
    pub metallic_roughness: Option<TextureUse>,
    /// How much a texture's red keeps ambient light away, 0..1.
    pub occlusion: Textured<f32>,
    /// What extensions add; few materials have any.
    pub finish: Option<Box<Finish>>,
}

/// The parameters of KHR_materials_pbrSpecularGlossiness.
#[derive(Clone, Debug, PartialEq)]
pub struct SpecularGlossiness {
    /// Albedo, before the specular colour takes its share.
    pub diffuse: Textured<Rgb>,
    /// What is reflected head-on.
    pub specular: Textured<Rgb>,
    /// 1 less the perceptual roughness, 0..1; the specular texture's alpha multiplies it.
    pub glossiness: f32,
    /// How much a texture's red keeps ambient light away, 0..1.
    pub occlusion: Textured<f32>,
}

/// Where a material is there at all.
#[derive(Clone, Debug, PartialEq)]
pub struct Alpha {
    /// How coverage is read.
    pub mode: AlphaMode,
    /// The coverage, multiplied by the vertex colour's alpha.
    pub coverage: Textured<f32>,
    /// Where in `coverage.texture` it is.
    pub channel: AlphaChannel,
}

impl Alpha {
    /// There everywhere.
    pub const OPAQUE: Alpha = Alpha {
        mode: AlphaMode::Opaque,
        coverage: Textured::uniform(1.0),
        channel: AlphaChannel::Alpha,
    };
}

/// How coverage is read (glTF 2.0, section 3.9.4).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AlphaMode {
    /// It is not: fully there.
    Opaque,
    /// Fully there where coverage reaches the cutoff, elsewhere not at all.
    Mask {
        /// Compared with `coverage >= cutoff`.
        cutoff: f32,
    },
    /// A share of the light from behind passes.
    Blend,
}

/// Where in a texture coverage is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum AlphaChannel {
    /// In its alpha (glTF).
    Alpha,
    /// In its red (MTL's `map_d`, a grey picture).
    Red,
}

/// A texture of tangent-space normals (glTF 2.0, section 3.9.3).
#[derive(Clone, Debug, PartialEq)]
pub struct NormalMap {
    /// Red to the tangent, green to the bitangent, blue to the normal.
    pub texture: TextureUse,
    /// Multiplies red and green.
    pub scale: f32,
}

/// Light that goes through a surface and what lies behind it (KHR_materials_transmission, _ior, _volume, _dispersion).
#[derive(Clone, Debug, PartialEq)]
pub struct Transmission {
    /// How much of the light that would be diffuse goes through instead, 0..1; a texture's red multiplies it.
    pub share: Textured<f32>,
    /// The index of refraction of what lies behind the surface; below 1 for a bubble in something denser.
    pub ior: f32,
    /// 20 divided by Abbe's number; 0 bends every colour alike.
    pub dispersion: f32,
    /// What lies behind the surface, up to the surface where light leaves it; `None` where the surface is a thin sheet,
    /// behind which light goes straight on.
    pub volume: Option<Volume>,
}

/// What light loses on its way through a body (KHR_materials_volume).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Volume {
    /// What white light has become after the distance.
    pub attenuation_color: Rgb,
    /// In the scene's unit; infinity where nothing is lost.
    pub attenuation_distance: f32,
}

impl Volume {
    /// The share of light that is left after a way of `length`: Beer's law, `attenuation_color^(length / distance)`
    /// (KHR_materials_volume).
    pub fn transmittance(&self, length: f32) -> Rgb {
        if self.attenuation_distance == f32::INFINITY {
            return Rgb::WHITE;
        }
        let exponent = length.max(0.0) / self.attenuation_distance;
        let left = |channel: f32| libm::powf(channel, exponent);
        self.attenuation_color.map(left)
    }
}

impl Material {
    /// A double-sided matt surface without texture.
    pub fn matt(name: impl Into<String>, diffuse: Rgb) -> Material {
        let phong = Phong {
            diffuse: Textured::uniform(diffuse),
            specular: Textured::uniform(Rgb::BLACK),
            shininess: 32.0,
            reflectivity: Rgb::BLACK,
            checker: None,
        };
        Material {
            name: name.into(),
            model: Model::Phong(phong),
            emission: Textured::uniform(Rgb::BLACK),
            alpha: Alpha::OPAQUE,
            transmission: None,
            normal_map: None,
            double_sided: true,
        }
    }

    /// Whether a ray that meets the front of this material anywhere ends there: the one bit that acceleration knows.
    pub fn is_opaque(&self) -> bool {
        self.alpha.mode == AlphaMode::Opaque && self.transmits().is_none()
    }

    /// What lets light through, where anything does. A colour that light does not change lets none through, whatever
    /// its file says, and an index of 0 is glTF's word for a surface that mirrors everything (KHR_materials_ior).
    pub fn transmits(&self) -> Option<&Transmission> {
        let lit = !matches!(self.model, Model::Unlit { .. });
        let transmission = self.transmission.as_ref();
        transmission.filter(|t| lit && t.share.factor > 0.0 && t.ior > 0.0)
    }

    /// What lies behind the surface, where it bounds a body that light goes through.
    pub fn volume(&self) -> Option<&Volume> {
        self.transmits()?.volume.as_ref()
    }

    /// What keeps ambient light away, where the model of the material has such a thing.
    pub fn occlusion(&self) -> Option<&Textured<f32>> {
        match &self.model {
            Model::MetallicRoughness(m) => Some(&m.occlusion),
            Model::SpecularGlossiness(m) => Some(&m.occlusion),
            Model::Phong(_) | Model::Unlit { .. } => None,
        }
    }

    /// Every use of a texture.
    pub fn textures(&self) -> impl Iterator<Item = &TextureUse> {
        let of_model: [Option<&TextureUse>; 3] = match &self.model {
            Model::Phong(m) => [
                m.diffuse.texture.as_ref(),
                m.specular.texture.as_ref(),
                None,
            ],
            Model::MetallicRoughness(m) => [
                m.base_color.texture.as_ref(),
                m.metallic_roughness.as_ref(),
                m.occlusion.texture.as_ref(),
            ],
            Model::SpecularGlossiness(m) => [
                m.diffuse.texture.as_ref(),
                m.specular.texture.as_ref(),
                m.occlusion.texture.as_ref(),
            ],
            Model::Unlit { color } => [color.texture.as_ref(), None, None],
        };
        let of_all = [
            self.emission.texture.as_ref(),
            self.transmission
                .as_ref()
                .and_then(|t| t.share.texture.as_ref()),
            self.alpha.coverage.texture.as_ref(),
            self.normal_map.as_ref().map(|map| &map.texture),
        ];
        let finish = match &self.model {
            Model::MetallicRoughness(m) => m.finish.as_deref(),
            _ => None,
        };
        let of_finish = finish.into_iter().flat_map(Finish::textures);
        of_model
            .into_iter()
            .chain(of_all)
            .flatten()
            .chain(of_finish)
    }

    /// Every use of a texture, to be changed.
    pub fn textures_mut(&mut self) -> impl Iterator<Item = &mut TextureUse> {
        let mut finish = None;
        let of_model: [Option<&mut TextureUse>; 3] = match &mut self.model {
            Model::Phong(m) => [
                m.diffuse.texture.as_mut(),
                m.specular.texture.as_mut(),
                None,
            ],
            Model::MetallicRoughness(m) => {
                finish = m.finish.as_deref_mut();
                [
                    m.base_color.texture.as_mut(),
                    m.metallic_roughness.as_mut(),
                    m.occlusion.texture.as_mut(),
                ]
            }
            Model::SpecularGlossiness(m) => [
                m.diffuse.texture.as_mut(),
                m.specular.texture.as_mut(),
                m.occlusion.texture.as_mut(),
            ],
            Model::Unlit { color } => [color.texture.as_mut(), None, None],
        };
        let of_all = [
            self.emission.texture.as_mut(),
            self.transmission
                .as_mut()
                .and_then(|t| t.share.texture.as_mut()),
            self.alpha.coverage.texture.as_mut(),
            self.normal_map.as_mut().map(|map| &mut map.texture),
        ];
        let of_finish = finish.into_iter().flat_map(Finish::textures_mut);
        of_model
            .into_iter()
            .chain(of_all)
            .flatten()
            .chain(of_finish)
    }
}
