//! What glTF's extensions add to a metallic-roughness surface.

use super::Textured;
use crate::color::Rgb;
use crate::texture::TextureUse;

/// What few materials have beyond metallic-roughness. Layers lie in this order, the lowest first: the surface, sheen,
/// clear coat.
#[derive(Clone, Debug, PartialEq)]
pub struct Finish {
    /// The index of refraction of what is not metal (KHR_materials_ior): 1 or more, infinite where colours alone say
    /// what is reflected.
    pub ior: f32,
    /// How much of what is not metal is reflected (KHR_materials_specular), 0..1; a texture's alpha multiplies it.
    pub specular: Textured<f32>,
    /// Multiplies what is not metal reflects head-on (KHR_materials_specular); may be more than 1.
    pub specular_color: Textured<Rgb>,
    /// A varnish over all of it.
    pub clearcoat: Option<Clearcoat>,
    /// Fibres that stand out of the surface.
    pub sheen: Option<Sheen>,
    /// A film as thin as a wave of light.
    pub iridescence: Option<Iridescence>,
    /// How much rougher the surface is along its grain (KHR_materials_anisotropy), 0..1; a texture's blue multiplies it.
    pub anisotropy: Option<Textured<f32>>,
    /// Diffuse light that comes through from behind.
    pub diffuse_transmission: Option<DiffuseTransmission>,
}

/// A clear dielectric layer of index 1.5 (KHR_materials_clearcoat).
#[derive(Clone, Debug, PartialEq)]
pub struct Clearcoat {
    /// How much of it there is, 0..1; a texture's red multiplies it.
    pub weight: Textured<f32>,
    /// Perceptual roughness, 0..1; a texture's green multiplies it.
    pub roughness: Textured<f32>,
}

/// Velvet's light at grazing angles (KHR_materials_sheen).
#[derive(Clone, Debug, PartialEq)]
pub struct Sheen {
    /// Black where there is none.
    pub color: Textured<Rgb>,
    /// How much the fibres' directions differ, 0..1; a texture's alpha multiplies it.
    pub roughness: Textured<f32>,
}

/// Interference in a thin film (KHR_materials_iridescence).
#[derive(Clone, Debug, PartialEq)]
pub struct Iridescence {
    /// How much of it there is, 0..1; a texture's red multiplies it.
    pub strength: Textured<f32>,
    /// The index of refraction of the film, 1 or more.
    pub ior: f32,
    /// Nanometres where the texture's green is 0 and where it is 1 or there is no texture; the first may be the greater.
    pub thickness: [f32; 2],
    /// Thickness in green.
    pub thickness_texture: Option<TextureUse>,
}

/// A thin surface that lets diffuse light through (KHR_materials_diffuse_transmission).
#[derive(Clone, Debug, PartialEq)]
pub struct DiffuseTransmission {
    /// The share of the diffuse light that goes through instead of back, 0..1; a texture's alpha multiplies it.
    pub share: Textured<f32>,
    /// Multiplies what goes through.
    pub color: Textured<Rgb>,
}

impl Finish {
    /// That of every material without extensions.
    pub const PLAIN: Finish = Finish {
        ior: 1.5,
        specular: Textured::uniform(1.0),
        specular_color: Textured::uniform(Rgb::WHITE),
        clearcoat: None,
        sheen: None,
        iridescence: None,
        anisotropy: None,
        diffuse_transmission: None,
    };

    /// Every use of a texture.
    pub fn textures(&self) -> impl Iterator<Item = &TextureUse> {
        let coat = self.clearcoat.as_ref();
        let sheen = self.sheen.as_ref();
        let film = self.iridescence.as_ref();
        let through = self.diffuse_transmission.as_ref();
        let all = [
            self.specular.texture.as_ref(),
            self.specular_color.texture.as_ref(),
            coat.and_then(|c| c.weight.texture.as_ref()),
            coat.and_then(|c| c.roughness.texture.as_ref()),
            sheen.and_then(|s| s.color.texture.as_ref()),
            sheen.and_then(|s| s.roughness.texture.as_ref()),
            film.and_then(|f| f.strength.texture.as_ref()),
            film.and_then(|f| f.thickness_texture.as_ref()),
            self.anisotropy.as_ref().and_then(|a| a.texture.as_ref()),
            through.and_then(|t| t.share.texture.as_ref()),
            through.and_then(|t| t.color.texture.as_ref()),
        ];
        all.into_iter().flatten()
    }

    /// Every use of a texture, to be changed.
    pub fn textures_mut(&mut self) -> impl Iterator<Item = &mut TextureUse> {
        let [weight, coat_roughness] = self.clearcoat.as_mut().map_or([None, None], |c| {
            [c.weight.texture.as_mut(), c.roughness.texture.as_mut()]
        });
        let [sheen, sheen_roughness] = self.sheen.as_mut().map_or([None, None], |s| {
            [s.color.texture.as_mut(), s.roughness.texture.as_mut()]
        });
        let [strength, thickness] = self.iridescence.as_mut().map_or([None, None], |f| {
            [f.strength.texture.as_mut(), f.thickness_texture.as_mut()]
        });
        let through = self.diffuse_transmission.as_mut();
        let [share, color] = through.map_or([None, None], |t| {
            [t.share.texture.as_mut(), t.color.texture.as_mut()]
        });
        let all = [
            self.specular.texture.as_mut(),
            self.specular_color.texture.as_mut(),
            weight,
            coat_roughness,
            sheen,
            sheen_roughness,
            strength,
            thickness,
            self.anisotropy.as_mut().and_then(|a| a.texture.as_mut()),
            share,
            color,
        ];
        all.into_iter().flatten()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn both_lists_of_textures_have_every_slot() {
        let mut texture = 0;
        let mut used = || {
            texture += 1;
            let (uv_set, transform) = (0, None);
            Some(TextureUse {
                texture,
                uv_set,
                transform,
            })
        };
        let mut number = || Textured {
            factor: 1.0,
            texture: used(),
        };
        let (specular, weight, coat, rough, strength, grain, share) = (
            number(),
            number(),
            number(),
            number(),
            number(),
            number(),
            number(),
        );
        let mut color = || Textured {
            factor: Rgb::WHITE,
            texture: used(),
        };
        let mut finish = Finish {
            ior: 1.5,
            specular,
            specular_color: color(),
            clearcoat: Some(Clearcoat {
                weight,
                roughness: coat,
            }),
            sheen: Some(Sheen {
                color: color(),
                roughness: rough,
            }),
            diffuse_transmission: Some(DiffuseTransmission {
                share,
                color: color(),
            }),
            iridescence: Some(Iridescence {
                strength,
                ior: 1.3,
                thickness: [100.0, 400.0],
                thickness_texture: used(),
            }),
            anisotropy: Some(grain),
        };
        let mut seen: Vec<u32> = finish.textures().map(|used| used.texture).collect();
        seen.sort_unstable();
        assert_eq!(seen, (1..=11).collect::<Vec<_>>());
        finish.textures_mut().for_each(|used| used.texture += 100);
        assert!(finish.textures().all(|used| used.texture > 100));
    }
}
