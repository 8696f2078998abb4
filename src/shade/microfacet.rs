//! From what physically based materials are at a point to the quantities a Whitted renderer has.
//!
//! | quantity | formula | source |
//! | --- | --- | --- |
//! | `alpha` | `roughness^2` | glTF 2.0, appendix B.2.3 |
//! | exponent `s` | `2 / alpha^2 - 2` | Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces", sec. 5.2: the Blinn-Phong lobe as wide as Beckmann's of this `alpha` |
//! | highlight `k_s` | `F0 (s + 2) / 8` | normalised Blinn-Phong `F0 (s + 2) / (8 π)` (Akenine-Möller et al. 2018, "Real-Time Rendering", sec. 9.8), in the paper's units of light, π times less |
//! | Fresnel `F` | `F0 + (max(F90 (1 - roughness), F0) - F0) (1 - n.v)^5` | Schlick 1994, "An Inexpensive BRDF Model for Physically-based Rendering"; the lower peak of rough surfaces is Lagarde's (2011) |
//! | reflectivity | `F m`, `m = max(0, 1 - roughness / 0.6)^2` | ours: a sharp mirror stands for the lobe while it is narrow, and is gone where it is wide |
//! | ambient | `k_d + F (1 - m)` | ours: the rest of the lobe sees the constant ambient light |
//!
//! A thin film replaces `F`, and `F0` in the highlight, by its own at this angle ([`iridescence`]).

use super::Reflectance;
use super::iridescence::{self, ThinFilm};
use crate::color::Rgb;

/// The parameters at one point, textures looked up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// `k_d`.
    pub diffuse: Rgb,
    /// The share of diffuse light from behind that comes through. Only the constant ambient light is let through: a
    /// lamp behind the surface does not reach the side that is seen.
    pub through: Rgb,
    /// What is reflected head-on.
    pub f0: Rgb,
    /// What a smooth surface reflects at the edge: 1 but for KHR_materials_specular.
    pub f90: f32,
    /// Perceptual roughness, 0..1.
    pub roughness: f32,
    /// The share of ambient light that arrives, 0..1.
    pub ambient_access: f32,
    /// A film on the surface.
    pub film: Option<ThinFilm>,
}

/// The least roughness a highlight is reckoned with: a light without extent has none on a perfect mirror.
const LEAST_HIGHLIGHT_ROUGHNESS: f32 = 0.1;
/// From this roughness on nothing is mirrored sharply.
const MIRROR_ENDS_AT: f32 = 0.6;

/// What roughness makes of reflected light.
pub(super) struct Lobe {
    /// `s`.
    pub(super) shininess: f32,
    /// `k_s` where all light is reflected.
    pub(super) peak: f32,
    /// `m`.
    pub(super) mirrored: f32,
}

impl Lobe {
    pub(super) fn new(roughness: f32) -> Lobe {
        let alpha =
            roughness.max(LEAST_HIGHLIGHT_ROUGHNESS) * roughness.max(LEAST_HIGHLIGHT_ROUGHNESS);
        let shininess = 2.0 / (alpha * alpha) - 2.0;
        let sharp = (1.0 - roughness / MIRROR_ENDS_AT).max(0.0);
        Lobe {
            shininess,
            peak: (shininess + 2.0) / 8.0,
            mirrored: sharp * sharp,
        }
    }
}

/// The table in this file's head. `cos_view` is `n . v`, 0..1.
pub fn reflectance(p: Parameters, cos_view: f32, emission: Rgb) -> Reflectance {
    let roughness = p.roughness.clamp(0.0, 1.0);
    let lobe = Lobe::new(roughness);
    let (mut f0, mut diffuse) = (p.f0, p.diffuse);
    let mut fresnel = f0.map(|f0| schlick(f0, p.f90, roughness, cos_view));
    if let Some(film) = p.film {
        let tinted = iridescence::fresnel(f0, film, cos_view);
        // Diffuse light is what is not reflected (KHR_materials_iridescence, `rgb_mix`).
        let [left, before] = [tinted, f0].map(|f| 1.0 - f.max_component().min(1.0));
        let dimmed = (left / before.max(1e-3)).min(1.0);
        diffuse *= 1.0 - film.strength + dimmed * film.strength;
        fresnel = fresnel.mix(tinted, film.strength);
        f0 = f0.mix(tinted, film.strength);
    }
    Reflectance {
        diffuse,
        specular: f0 * lobe.peak,
        shininess: lobe.shininess,
        reflectivity: fresnel * lobe.mirrored,
        ambient: (diffuse + p.through + fresnel * (1.0 - lobe.mirrored)) * p.ambient_access,
        emission,
        layers: None,
    }
}

/// `F0 + (F90 - F0) (1 - n.v)^5`, where `F90` is lower on rough surfaces.
pub(super) fn schlick(f0: f32, f90: f32, roughness: f32, cos_view: f32) -> f32 {
    let x = 1.0 - cos_view.clamp(0.0, 1.0);
    let x5 = x * x * x * x * x;
    f0 + ((f90 * (1.0 - roughness)).max(f0) - f0) * x5
}

/// What a surface of this index of refraction reflects head-on (KHR_materials_ior); everything if it is infinite.
pub fn f0_of(ior: f32) -> f32 {
    let r = if ior.is_finite() {
        (ior - 1.0) / (ior + 1.0)
    } else {
        1.0
    };
    r * r
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_indices_of_the_specifications_table_reflect_what_optics_says() {
        // Water 2.0 %, window glass 4.3 %, sapphire 7.6 %, diamond 17.2 %: their usual reflectances head-on.
        for (ior, percent) in [
            (1.0, 0.0),
            (1.33, 2.0),
            (1.5, 4.0),
            (1.52, 4.3),
            (1.76, 7.6),
            (2.42, 17.2),
            (f32::INFINITY, 100.0),
        ] {
            assert!((f0_of(ior) * 100.0 - percent).abs() < 0.06, "{ior}");
        }
    }

    #[test]
    fn light_from_behind_counts_as_ambient_alone() {
        let p = Parameters {
            diffuse: Rgb::grey(0.25),
            through: Rgb::new(0.5, 0.0, 0.0),
            f0: Rgb::BLACK,
            f90: 0.0,
            roughness: 1.0,
            ambient_access: 1.0,
            film: None,
        };
        let leaf = reflectance(p, 1.0, Rgb::BLACK);
        assert_eq!(leaf.ambient, Rgb::new(0.75, 0.25, 0.25));
        assert_eq!(leaf.diffuse, Rgb::grey(0.25));
    }
}
