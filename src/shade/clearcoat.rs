//! A clear coat over a surface (KHR_materials_clearcoat): a second mirror and a second highlight, and less of all that
//! is below.

use super::microfacet::{Lobe, schlick};
use super::{Coat, Layers, Reflectance};
use crate::color::Rgb;
use glam::Vec3;

/// A coat at one point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Clearcoat {
    /// How much of it there is, 0..1.
    pub weight: f32,
    /// Perceptual roughness, 0..1.
    pub roughness: f32,
    /// Its unit normal, where that is not the surface's.
    pub normal: Option<Vec3>,
}

/// What a coat reflects head-on: its index of refraction is 1.5 (KHR_materials_clearcoat).
const F0: f32 = 0.04;

/// `base` below a coat: `mix(base, coat, weight F)`, emission included.
///
/// `cos_view` is that of the coat's normal. A coat that faces another way than what is below it is a mirror by itself.
pub fn over(
    base: &Reflectance,
    coat: Clearcoat,
    cos_view: f32,
    ambient_access: f32,
) -> Reflectance {
    let roughness = coat.roughness.clamp(0.0, 1.0);
    let lobe = Lobe::new(roughness);
    let fresnel = coat.weight * schlick(F0, 1.0, roughness, cos_view);
    let below = base.dimmed(1.0 - fresnel);
    let layers = below.layers.unwrap_or(Layers::NONE);
    let mirrored = fresnel * lobe.mirrored;
    let (alike, apart) = match coat.normal {
        Some(normal) => (0.0, Coat { normal, mirrored }),
        None => (mirrored, Coat::ALIKE),
    };
    Reflectance {
        reflectivity: below.reflectivity + Rgb::grey(alike),
        ambient: below.ambient + Rgb::grey(fresnel * (1.0 - lobe.mirrored) * ambient_access),
        emission: base.emission * (1.0 - fresnel),
        layers: Some(Layers {
            coat_specular: coat.weight * F0 * lobe.peak,
            coat_shininess: lobe.shininess,
            coat: apart,
            ..layers
        }),
        ..below
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shade::Shading;
    use crate::shade::test_surface::glossy;

    fn coated(weight: f32, roughness: f32, cos: f32) -> Reflectance {
        let base = Reflectance {
            emission: Rgb::WHITE,
            ..glossy(8.0)
        };
        let coat = Clearcoat {
            weight,
            roughness,
            normal: None,
        };
        over(&base, coat, cos, 1.0)
    }

    #[test]
    fn a_smooth_coat_takes_from_below_what_it_reflects() {
        for (weight, cos, fresnel) in [
            (1.0, 1.0, 0.04),
            (0.5, 1.0, 0.02),
            // 0.04 + 0.96 (1 - 1/2)^5 = 0.07.
            (1.0, 0.5, 0.07),
            (1.0, 0.0, 1.0),
        ] {
            let surface = coated(weight, 0.0, cos);
            assert!((surface.reflectivity.r - fresnel).abs() < 1e-6);
            assert!((surface.emission.g - (1.0 - fresnel)).abs() < 1e-6);
            assert!((surface.diffuse.b - 0.5 * (1.0 - fresnel)).abs() < 1e-6);
            assert!((surface.specular.b - (1.0 - fresnel)).abs() < 1e-6);
        }
    }

    #[test]
    fn a_coat_that_faces_another_way_mirrors_and_shines_along_its_own_normal() {
        // cos 60 degrees = 1/2: F = 0.07; at roughness 1/2 it is 0.04 + 0.46 / 32 = 0.054375, k_s = 0.16, exponent 30,
        // mirrored (1 - 5/6)^2.
        let base = Reflectance {
            specular: Rgb::BLACK,
            ..glossy(8.0)
        };
        let tilted = Vec3::new(0.0, 0.5, 0.75f32.sqrt());
        for (roughness, mirrored) in [(0.0, 0.07), (0.5, 0.054375 / 36.0)] {
            let coat = Clearcoat {
                weight: 1.0,
                roughness,
                normal: Some(tilted),
            };
            let surface = over(&base, coat, 0.5, 1.0);
            assert_eq!(surface.reflectivity, Rgb::BLACK);
            let coat = surface.layers.and_then(|layers| layers.coat());
            let coat = coat.unwrap_or(Coat::ALIKE);
            assert_eq!(coat.normal, tilted);
            assert!((coat.mirrored - mirrored).abs() < 1e-5, "{coat:?}");
            let toward = |l| Shading::BlinnPhong.reflected(&surface, Vec3::Y, l, l, Rgb::WHITE);
            let below = surface.diffuse.r;
            let (along, across) = (toward(tilted).r, toward(Vec3::Y).r);
            assert!(along > 0.5 * below + 0.1, "{along}");
            assert!((across - below).abs() < 1e-3, "{across}");
        }
    }

    #[test]
    fn a_coat_has_a_highlight_of_its_own() {
        // Roughness 1/2: exponent 30, k_s = 0.04 * 32 / 8 = 0.16 (see `metallic_roughness`).
        let surface = coated(1.0, 0.5, 1.0);
        let lit = Shading::BlinnPhong.reflected(&surface, Vec3::Y, Vec3::Y, Vec3::Y, Rgb::WHITE);
        assert!((lit.r - (0.96 * 1.5 + 0.16)).abs() < 1e-5, "{lit:?}");
        let lit = Shading::Phong.reflected(&surface, Vec3::Y, Vec3::Y, Vec3::Y, Rgb::WHITE);
        assert!((lit.r - (0.96 * 1.5 + 0.16)).abs() < 1e-5, "{lit:?}");
    }
}
