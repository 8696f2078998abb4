//! How surfaces answer light: pure functions of directions.

pub mod anisotropy;
pub mod blinn_phong;
pub mod clearcoat;
pub mod facets;
pub mod flat;
pub mod gloss;
pub mod iridescence;
pub mod lambert;
mod layers;
pub mod metallic_roughness;
pub mod microfacet;
pub mod mirror;
pub mod phong;
pub mod refraction;
pub mod sheen;
pub mod specular_glossiness;

pub use layers::{Coat, Layers};

use crate::color::Rgb;
use facets::Facets;
use glam::Vec3;

/// A surface at one point, every texture looked up: what the shading formulas need.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reflectance {
    /// `k_d`.
    pub diffuse: Rgb,
    /// The colour of diffuse light before anything is reflected: what [`Shading::Flat`] shows.
    pub color: Rgb,
    /// `k_s`.
    pub specular: Rgb,
    /// `s`, the exponent of the highlight.
    pub shininess: f32,
    /// A highlight by its facets instead of `k_s` and `s`, which then count for nothing.
    pub facets: Option<Facets>,
    /// The share of the mirror ray's light that comes back.
    pub reflectivity: Rgb,
    /// How rough the mirror is that `reflectivity` stands for, 0..1 as glTF has it.
    pub mirror_roughness: f32,
    /// The share that comes back of light from everywhere, as the lobe about the mirrored direction gathers it: what
    /// the mirror ray leaves out.
    pub gloss: Rgb,
    /// How rough the surface of that lobe is, 0..1 as glTF has it.
    pub roughness: f32,
    /// The share of constant ambient light that comes back, the gloss included but not the mirror; the paper's surfaces
    /// have `k_d` here.
    pub ambient: Rgb,
    /// Light of the surface's own.
    pub emission: Rgb,
    /// Highlights over the surface's own; few have any.
    pub layers: Option<Layers>,
}

/// The shading models.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Shading {
    /// The diffuse colour alone: no light, shadow, emission or mirror.
    Flat,
    /// Diffuse light, no highlight.
    Lambert,
    /// A highlight about the mirrored light.
    Phong,
    /// A highlight about the half vector.
    #[default]
    BlinnPhong,
}

impl Reflectance {
    /// No light comes back, none comes from it.
    pub const BLACK: Reflectance = Reflectance {
        diffuse: Rgb::BLACK,
        color: Rgb::BLACK,
        specular: Rgb::BLACK,
        shininess: 0.0,
        facets: None,
        reflectivity: Rgb::BLACK,
        mirror_roughness: 0.0,
        gloss: Rgb::BLACK,
        roughness: 0.0,
        ambient: Rgb::BLACK,
        emission: Rgb::BLACK,
        layers: None,
    };
}

impl Shading {
    /// What one light adds at a point: zero where it stands behind the surface.
    ///
    /// `n`, `l`, `v` are unit vectors that point away from the surface; `e` is the light's irradiance.
    #[inline(always)]
    pub fn reflected(self, surface: &Reflectance, n: Vec3, l: Vec3, v: Vec3, e: Rgb) -> Rgb {
        let base = match (self, &surface.facets) {
            (Shading::Flat, _) => Rgb::BLACK,
            (Shading::Lambert, _) => lambert::reflected(surface, n, l, e),
            (_, Some(facets)) => {
                lambert::reflected(surface, n, l, e) + facets::reflected(facets, n, l, v, e)
            }
            (Shading::Phong, None) => phong::reflected(surface, n, l, v, e),
            (Shading::BlinnPhong, None) => blinn_phong::reflected(surface, n, l, v, e),
        };
        match (&surface.layers, self) {
            (Some(layers), Shading::Phong | Shading::BlinnPhong) => {
                base + layers.reflected(n, l, v, e)
            }
            _ => base,
        }
    }
}

#[cfg(test)]
pub(crate) mod test_surface {
    use super::*;

    /// A grey surface with a white highlight.
    pub(crate) fn glossy(shininess: f32) -> Reflectance {
        Reflectance {
            diffuse: Rgb::grey(0.5),
            specular: Rgb::WHITE,
            shininess,
            ambient: Rgb::grey(0.5),
            ..Reflectance::BLACK
        }
    }
}
