//! From glTF's metallic-roughness parameters to the quantities a Whitted renderer has.
//!
//! | quantity | formula | source |
//! | --- | --- | --- |
//! | `alpha` | `roughness^2` | glTF 2.0, appendix B.2.3 |
//! | `F0` | `mix(0.04, base, metallic)` | glTF 2.0, appendix B.3.5 |
//! | diffuse `k_d` | `base (1 - metallic)` | glTF 2.0, appendix B.3.5 |
//! | exponent `s` | `2 / alpha^2 - 2` | Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces", sec. 5.2: the Blinn-Phong lobe as wide as Beckmann's of this `alpha` |
//! | highlight `k_s` | `F0 (s + 2) / 8` | normalised Blinn-Phong `F0 (s + 2) / (8 π)` (Akenine-Möller et al. 2018, "Real-Time Rendering", sec. 9.8), in the paper's units of light, π times less |
//! | Fresnel `F` | `F0 + (max(1 - roughness, F0) - F0) (1 - n.v)^5` | Schlick 1994, "An Inexpensive BRDF Model for Physically-based Rendering"; the lower peak of rough surfaces is Lagarde's (2011) |
//! | reflectivity | `F m`, `m = max(0, 1 - roughness / 0.6)^2` | ours: a sharp mirror stands for the lobe while it is narrow, and is gone where it is wide |
//! | ambient | `k_d + F (1 - m)` | ours: the rest of the lobe sees the constant ambient light |

use super::Reflectance;
use crate::color::Rgb;

/// The parameters at one point, textures looked up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// Linear base colour.
    pub base_color: Rgb,
    /// 0..1.
    pub metallic: f32,
    /// Perceptual roughness, 0..1.
    pub roughness: f32,
    /// The share of ambient light that arrives, 0..1.
    pub ambient_access: f32,
}

/// What is reflected head-on by what is not metal: an index of refraction of 1.5.
const DIELECTRIC_F0: f32 = 0.04;
/// The least roughness a highlight is reckoned with: a light without extent has none on a perfect mirror.
const LEAST_HIGHLIGHT_ROUGHNESS: f32 = 0.1;
/// From this roughness on nothing is mirrored sharply.
const MIRROR_ENDS_AT: f32 = 0.6;

/// The table in this file's head. `cos_view` is `n . v`, 0..1.
pub fn reflectance(p: Parameters, cos_view: f32, emission: Rgb) -> Reflectance {
    let roughness = p.roughness.clamp(0.0, 1.0);
    let metallic = p.metallic.clamp(0.0, 1.0);
    let f0 = Rgb::grey(DIELECTRIC_F0).mix(p.base_color, metallic);
    let diffuse = p.base_color * (1.0 - metallic);
    let alpha = roughness.max(LEAST_HIGHLIGHT_ROUGHNESS) * roughness.max(LEAST_HIGHLIGHT_ROUGHNESS);
    let shininess = 2.0 / (alpha * alpha) - 2.0;
    let fresnel = schlick(f0, roughness, cos_view);
    let sharp = (1.0 - roughness / MIRROR_ENDS_AT).max(0.0);
    let mirrored = sharp * sharp;
    Reflectance {
        diffuse,
        specular: f0 * ((shininess + 2.0) / 8.0),
        shininess,
        reflectivity: fresnel * mirrored,
        ambient: (diffuse + fresnel * (1.0 - mirrored)) * p.ambient_access,
        emission,
    }
}

/// `F0 + (F90 - F0) (1 - n.v)^5`, where `F90 = max(1 - roughness, F0)`.
fn schlick(f0: Rgb, roughness: f32, cos_view: f32) -> Rgb {
    let x = 1.0 - cos_view.clamp(0.0, 1.0);
    let x5 = x * x * x * x * x;
    f0.map(|f0| f0 + ((1.0 - roughness).max(f0) - f0) * x5)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parameters(metallic: f32, roughness: f32) -> Parameters {
        Parameters {
            base_color: Rgb::new(1.0, 0.5, 0.25),
            metallic,
            roughness,
            ambient_access: 1.0,
        }
    }

    #[test]
    fn a_smooth_metal_is_a_mirror_of_its_colour_with_no_diffuse_light() {
        let gold = reflectance(parameters(1.0, 0.0), 1.0, Rgb::BLACK);
        assert_eq!(
            (gold.diffuse, gold.reflectivity),
            (Rgb::BLACK, Rgb::new(1.0, 0.5, 0.25))
        );
    }

    #[test]
    fn a_smooth_plastic_mirrors_four_per_cent_head_on_and_everything_at_the_edge() {
        let at = |cos| {
            reflectance(parameters(0.0, 0.0), cos, Rgb::BLACK)
                .reflectivity
                .g
        };
        assert!((at(1.0) - 0.04).abs() < 1e-6);
        assert!((at(0.0) - 1.0).abs() < 1e-6);
    }

    #[test]
    fn a_rough_surface_does_not_mirror() {
        assert_eq!(
            reflectance(parameters(1.0, 0.6), 0.5, Rgb::BLACK).reflectivity,
            Rgb::BLACK
        );
    }

    #[test]
    fn roughness_one_half_has_the_exponent_of_its_alpha() {
        // alpha = 1/4: 2 * 16 - 2.
        let surface = reflectance(parameters(0.0, 0.5), 1.0, Rgb::BLACK);
        assert_eq!(surface.shininess, 30.0);
        assert!((surface.specular.r - 0.04 * 32.0 / 8.0).abs() < 1e-6);
    }

    #[test]
    fn occlusion_keeps_ambient_light_away() {
        let p = Parameters {
            ambient_access: 0.0,
            ..parameters(0.0, 0.9)
        };
        assert_eq!(reflectance(p, 1.0, Rgb::BLACK).ambient, Rgb::BLACK);
    }
}
