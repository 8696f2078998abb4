//! glTF's metallic-roughness parameters.
//!
//! | quantity | formula | source |
//! | --- | --- | --- |
//! | `F0` | `mix(dielectric F0, base, metallic)` | glTF 2.0, appendix B.3.5 |
//! | `F90` | `mix(dielectric F90, 1, metallic)` | KHR_materials_specular |
//! | `k_d` | `base (1 - metallic)` | glTF 2.0, appendix B.3.5 |
//!
//! The dielectric's `F0` is 0.04 and its `F90` 1, or what KHR_materials_ior and _specular say. What is reflected is taken
//! from diffuse light by [`microfacet`](super::microfacet).

use super::microfacet::{Parameters, f0_of};
use crate::color::Rgb;

/// What is not metal: how much of the light it reflects.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Dielectric {
    /// Head-on.
    pub f0: Rgb,
    /// At the edge.
    pub f90: f32,
}

/// What is reflected head-on by what is not metal: an index of refraction of 1.5.
const F0: f32 = 0.04;

impl Dielectric {
    /// glTF's own.
    pub const PLAIN: Dielectric = Dielectric {
        f0: Rgb::grey(F0),
        f90: 1.0,
    };

    /// `min(F0(ior) colour, 1) specular` at `F0`, `specular` at `F90` (KHR_materials_specular, "Interaction with other
    /// extensions").
    pub fn new(ior: f32, specular: f32, color: Rgb) -> Dielectric {
        Dielectric {
            f0: color.map(|channel| (f0_of(ior) * channel).min(1.0) * specular),
            f90: specular,
        }
    }
}

/// The table in this file's head.
pub fn parameters(
    base_color: Rgb,
    metallic: f32,
    roughness: f32,
    dielectric: Dielectric,
) -> Parameters {
    let metallic = metallic.clamp(0.0, 1.0);
    Parameters {
        diffuse: base_color * (1.0 - metallic),
        through: Rgb::BLACK,
        f0: dielectric.f0.mix(base_color, metallic),
        f90: dielectric.f90 + (1.0 - dielectric.f90) * metallic,
        roughness,
        ambient_access: 1.0,
        film: None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shade::{Reflectance, microfacet};

    const ORANGE: Rgb = Rgb::new(1.0, 0.5, 0.25);

    fn reflectance(metallic: f32, roughness: f32, cos_view: f32) -> Reflectance {
        let p = parameters(ORANGE, metallic, roughness, Dielectric::PLAIN);
        microfacet::reflectance(p, cos_view, Rgb::BLACK)
    }

    #[test]
    fn a_smooth_metal_is_a_mirror_of_its_colour_with_no_diffuse_light() {
        let gold = reflectance(1.0, 0.0, 1.0);
        assert_eq!((gold.diffuse, gold.reflectivity), (Rgb::BLACK, ORANGE));
    }

    #[test]
    fn a_smooth_plastic_mirrors_four_per_cent_head_on_and_everything_at_the_edge() {
        let at = |cos| reflectance(0.0, 0.0, cos).reflectivity.g;
        assert!((at(1.0) - 0.04).abs() < 1e-6);
        assert!((at(0.0) - 1.0).abs() < 1e-6);
    }

    #[test]
    fn a_rough_surface_does_not_mirror() {
        assert_eq!(reflectance(1.0, 0.6, 0.5).reflectivity, Rgb::BLACK);
    }

    #[test]
    fn occlusion_keeps_ambient_light_away() {
        let p = Parameters {
            ambient_access: 0.0,
            ..parameters(ORANGE, 0.0, 0.9, Dielectric::PLAIN)
        };
        let dark = microfacet::reflectance(p, 1.0, Rgb::BLACK);
        assert_eq!(dark.ambient, Rgb::BLACK);
    }

    #[test]
    fn the_specular_colour_is_cut_off_before_the_specular_factor_scales_it() {
        // min(0.04 * 50, 1) * 0.5, min(0.04 * 10, 1) * 0.5, 0.
        let d = Dielectric::new(1.5, 0.5, Rgb::new(50.0, 10.0, 0.0));
        assert!((d.f0.r - 0.5).abs() < 1e-6 && (d.f0.g - 0.2).abs() < 1e-6 && d.f0.b == 0.0);
        assert_eq!(d.f90, 0.5);
    }

    #[test]
    fn without_specular_a_dielectric_is_matt_and_a_metal_as_before() {
        let matt = Dielectric::new(1.5, 0.0, Rgb::WHITE);
        let at = |metallic, cos| {
            microfacet::reflectance(parameters(ORANGE, metallic, 0.0, matt), cos, Rgb::BLACK)
        };
        assert_eq!(at(0.0, 0.1).reflectivity, Rgb::BLACK);
        assert_eq!(
            at(1.0, 0.1).reflectivity,
            reflectance(1.0, 0.0, 0.1).reflectivity
        );
    }
}
