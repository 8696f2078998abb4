//! How surfaces answer light: pure functions of directions.

pub mod blinn_phong;
pub mod flat;
pub mod lambert;
pub mod metallic_roughness;
pub mod mirror;
pub mod phong;
pub mod refraction;

use crate::color::Rgb;
use glam::Vec3;

/// A surface at one point, every texture looked up: what the shading formulas need.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Reflectance {
    /// `k_d`.
    pub diffuse: Rgb,
    /// `k_s`.
    pub specular: Rgb,
    /// `s`, the exponent of the highlight.
    pub shininess: f32,
    /// The share of the mirror ray's light that comes back.
    pub reflectivity: Rgb,
    /// The share of constant ambient light that comes back; the paper's surfaces have `k_d` here.
    pub ambient: Rgb,
    /// Light of the surface's own.
    pub emission: Rgb,
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
        specular: Rgb::BLACK,
        shininess: 0.0,
        reflectivity: Rgb::BLACK,
        ambient: Rgb::BLACK,
        emission: Rgb::BLACK,
    };
}

impl Shading {
    /// What one light adds at a point: zero where it stands behind the surface.
    ///
    /// `n`, `l`, `v` are unit vectors that point away from the surface; `e` is the light's irradiance.
    #[inline(always)]
    pub fn reflected(self, surface: &Reflectance, n: Vec3, l: Vec3, v: Vec3, e: Rgb) -> Rgb {
        match self {
            Shading::Flat => Rgb::BLACK,
            Shading::Lambert => lambert::reflected(surface, n, l, e),
            Shading::Phong => phong::reflected(surface, n, l, v, e),
            Shading::BlinnPhong => blinn_phong::reflected(surface, n, l, v, e),
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
            reflectivity: Rgb::BLACK,
            ambient: Rgb::grey(0.5),
            emission: Rgb::BLACK,
        }
    }
}
