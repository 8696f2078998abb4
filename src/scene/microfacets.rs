//! What glTF's materials are like at one point.

use super::Scene;
use super::mix::Vertex;
use crate::color::Rgb;
use crate::material::{Finish, MetallicRoughness, Model, SpecularGlossiness, Textured};
use crate::shade::iridescence::ThinFilm;
use crate::shade::metallic_roughness::{self, Dielectric};
use crate::shade::microfacet::{self, Parameters};
use crate::shade::{Reflectance, anisotropy, clearcoat, sheen, specular_glossiness};
use glam::Vec3;

/// Where in a texture a number is.
#[derive(Clone, Copy)]
enum Channel {
    Red = 0,
    Green = 1,
    Blue = 2,
    Alpha = 3,
}

/// From where, and in what colours, a surface is seen.
pub(super) struct Seen<'a> {
    pub(super) vertex: &'a Vertex,
    /// The vertex colour.
    pub(super) tint: Rgb,
    /// `n . v`.
    pub(super) cos_view: f32,
    /// Which way a clear coat faces, where that is not the surface's own way.
    pub(super) coat: Option<Facing>,
    /// The surface's own light.
    pub(super) emission: Rgb,
}

/// A unit normal toward the viewer.
#[derive(Clone, Copy)]
pub(super) struct Facing {
    pub(super) normal: Vec3,
    /// Its cosine with the way to the viewer.
    pub(super) cos_view: f32,
}

impl Scene {
    pub(super) fn metallic_roughness(&self, m: &MetallicRoughness, seen: &Seen) -> Reflectance {
        let [_, roughness, metallic, _] = m
            .metallic_roughness
            .as_ref()
            .map_or([1.0; 4], |used| self.look_up(used, seen.vertex));
        let base_color = self.color(&m.base_color, seen.vertex) * seen.tint;
        let (metallic, roughness) = (m.metallic * metallic, m.roughness * roughness);
        let ambient_access = self.ambient_access(&m.occlusion, seen.vertex);
        let parameters = |roughness, dielectric| Parameters {
            ambient_access,
            ..metallic_roughness::parameters(base_color, metallic, roughness, dielectric)
        };
        match &m.finish {
            None => microfacet::reflectance(
                parameters(roughness, Dielectric::PLAIN),
                seen.cos_view,
                seen.emission,
            ),
            Some(finish) => {
                let roughness = self.roughness_with_grain(finish, roughness, seen);
                let below = parameters(roughness, self.dielectric(finish, seen));
                self.finished(finish, below, metallic, seen)
            }
        }
    }

    /// The colour of what goes through a surface: what would be diffuse if nothing were mirrored.
    pub(super) fn body_color(&self, m: &MetallicRoughness, vertex: &Vertex) -> Rgb {
        let [r, g, b, _] = vertex.color;
        self.color(&m.base_color, vertex) * Rgb::new(r, g, b) * (1.0 - self.metallic(m, vertex))
    }

    fn metallic(&self, m: &MetallicRoughness, vertex: &Vertex) -> f32 {
        let texel = m.metallic_roughness.as_ref();
        let texel = texel.map_or(1.0, |used| self.look_up(used, vertex)[2]);
        (m.metallic * texel).clamp(0.0, 1.0)
    }

    /// The share of diffuse light from behind that comes through, whatever lies over the surface; none but where
    /// KHR_materials_diffuse_transmission says so.
    pub(super) fn diffuse_from_behind(&self, model: &Model, vertex: &Vertex) -> Rgb {
        let Model::MetallicRoughness(m) = model else {
            return Rgb::BLACK;
        };
        let through = m
            .finish
            .as_ref()
            .and_then(|f| f.diffuse_transmission.as_ref());
        through.map_or(Rgb::BLACK, |through| {
            let share = self.number(&through.share, Channel::Alpha, vertex);
            self.color(&through.color, vertex) * (share * (1.0 - self.metallic(m, vertex)))
        })
    }

    pub(super) fn specular_glossiness(&self, m: &SpecularGlossiness, seen: &Seen) -> Reflectance {
        let [r, g, b, glossiness] = m
            .specular
            .texture
            .as_ref()
            .map_or([1.0; 4], |used| self.look_up(used, seen.vertex));
        let parameters = specular_glossiness::parameters(
            self.color(&m.diffuse, seen.vertex) * seen.tint,
            m.specular.factor * Rgb::new(r, g, b),
            m.glossiness * glossiness,
        );
        let parameters = Parameters {
            ambient_access: self.ambient_access(&m.occlusion, seen.vertex),
            ..parameters
        };
        microfacet::reflectance(parameters, seen.cos_view, seen.emission)
    }

    /// The share of ambient light that arrives.
    pub(super) fn ambient_access(&self, occlusion: &Textured<f32>, vertex: &Vertex) -> f32 {
        let occluded = occlusion
            .texture
            .as_ref()
            .map_or(0.0, |used| 1.0 - self.look_up(used, vertex)[0]);
        1.0 - occlusion.factor * occluded
    }

    fn number(&self, textured: &Textured<f32>, channel: Channel, vertex: &Vertex) -> f32 {
        textured.texture.as_ref().map_or(textured.factor, |used| {
            textured.factor * self.look_up(used, vertex)[channel as usize]
        })
    }

    fn dielectric(&self, finish: &Finish, seen: &Seen) -> Dielectric {
        Dielectric::new(
            finish.ior,
            self.number(&finish.specular, Channel::Alpha, seen.vertex),
            self.color(&finish.specular_color, seen.vertex),
        )
    }

    fn roughness_with_grain(&self, finish: &Finish, roughness: f32, seen: &Seen) -> f32 {
        finish.anisotropy.as_ref().map_or(roughness, |strength| {
            let strength = self.number(strength, Channel::Blue, seen.vertex);
            anisotropy::mean_roughness(roughness, strength)
        })
    }

    /// The surface with all that lies over it.
    fn finished(
        &self,
        finish: &Finish,
        mut below: Parameters,
        metallic: f32,
        seen: &Seen,
    ) -> Reflectance {
        if let Some(through) = &finish.diffuse_transmission {
            let share = self.number(&through.share, Channel::Alpha, seen.vertex);
            let color = self.color(&through.color, seen.vertex);
            below.diffuse *= 1.0 - share;
            below.through = color * (share * (1.0 - metallic));
        }
        below.film = finish.iridescence.as_ref().map(|film| {
            let [thin, thick] = film.thickness;
            let green = film
                .thickness_texture
                .as_ref()
                .map_or(1.0, |used| self.look_up(used, seen.vertex)[1]);
            ThinFilm {
                strength: self.number(&film.strength, Channel::Red, seen.vertex),
                ior: film.ior,
                thickness: thin + (thick - thin) * green,
            }
        });
        let mut reflectance = microfacet::reflectance(below, seen.cos_view, seen.emission);
        if let Some(fibres) = &finish.sheen {
            let fibres = sheen::Sheen {
                color: self.color(&fibres.color, seen.vertex),
                roughness: self.number(&fibres.roughness, Channel::Alpha, seen.vertex),
            };
            let access = below.ambient_access;
            reflectance = sheen::over(&reflectance, fibres, seen.cos_view, access);
        }
        if let Some(coat) = &finish.clearcoat {
            let coat = clearcoat::Clearcoat {
                weight: self.number(&coat.weight, Channel::Red, seen.vertex),
                roughness: self.number(&coat.roughness, Channel::Green, seen.vertex),
                normal: seen.coat.map(|facing| facing.normal),
            };
            let access = below.ambient_access;
            let cos_view = seen.coat.map_or(seen.cos_view, |facing| facing.cos_view);
            reflectance = clearcoat::over(&reflectance, coat, cos_view, access);
        }
        reflectance
    }
}
