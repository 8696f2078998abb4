//! A clear coat over a surface (KHR_materials_clearcoat): a second mirror and a second highlight, and less of all that
//! is below.

use super::facets::{Facets, albedo};
use super::microfacet::mirrored_share;
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

/// `base` below a coat: `mix(base, coat, weight E)`, emission included, where `E` is all that a coat of weight 1 reflects
/// toward the viewer ([`albedo`]).
///
/// `cos_view` is that of the coat's normal. A coat that faces another way than what is below it is a mirror by itself.
/// What a rough coat reflects beside its mirror is the surface's gloss where that has none of its own; elsewhere it is
/// part of what ambient light does.
pub fn over(
    base: &Reflectance,
    coat: Clearcoat,
    cos_view: f32,
    ambient_access: f32,
) -> Reflectance {
    let roughness = coat.roughness.clamp(0.0, 1.0);
    let [head_on, edge] = albedo(cos_view, roughness);
    let reflected = coat.weight * (F0 * head_on + edge);
    let below = base.dimmed(1.0 - reflected);
    let layers = below.layers.unwrap_or(Layers::NONE);
    let mirrored = reflected * mirrored_share(roughness, reflected);
    let rest = Rgb::grey((reflected - mirrored) * ambient_access);
    let (alike, apart) = match coat.normal {
        Some(normal) => (0.0, Coat { normal, mirrored }),
        None => (mirrored, Coat::ALIKE),
    };
    let (gloss, gloss_roughness) = if below.gloss == Rgb::BLACK {
        (rest, roughness)
    } else {
        (below.gloss, below.roughness)
    };
    // Of two mirrors behind one ray the stronger says how rough they are.
    let mirror_roughness = if alike > below.reflectivity.max_component() {
        roughness
    } else {
        below.mirror_roughness
    };
    Reflectance {
        reflectivity: below.reflectivity + Rgb::grey(alike),
        mirror_roughness,
        gloss,
        roughness: gloss_roughness,
        ambient: below.ambient + rest,
        emission: base.emission * (1.0 - reflected),
        layers: Some(Layers {
            coat_facets: Facets::new(Rgb::grey(coat.weight * F0), coat.weight, roughness),
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
    use crate::shade::facets::exponent;
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
        let base = Reflectance {
            specular: Rgb::BLACK,
            ..glossy(8.0)
        };
        let tilted = Vec3::new(0.0, 0.5, 0.75f32.sqrt());
        for roughness in [0.0, 0.4] {
            // cos 60 degrees = 1/2: 0.07 where it is smooth.
            let [a, b] = albedo(0.5, roughness);
            let mirrored = (0.04 * a + b) * mirrored_share(roughness, 0.04 * a + b);
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
            assert!((coat.mirrored - mirrored).abs() < 1e-6, "{coat:?}");
            let toward = |l| Shading::BlinnPhong.reflected(&surface, Vec3::Y, l, l, Rgb::WHITE);
            let below = surface.diffuse.r;
            let (along, across) = (toward(tilted).r, toward(Vec3::Y).r);
            assert!(along > 0.5 * below + 0.1, "{along}");
            assert!((across - below).abs() < 1e-3, "{across}");
        }
    }

    #[test]
    fn a_coat_has_a_highlight_of_its_own() {
        // 0.04 (s + 2) / 8 over 0.96 of the base's 0.5 and 1.
        let expected = 0.96 * 1.5 + 0.04 * (exponent(0.5) + 2.0) / 8.0;
        let surface = coated(1.0, 0.5, 1.0);
        for shading in [Shading::BlinnPhong, Shading::Phong] {
            let lit = shading.reflected(&surface, Vec3::Y, Vec3::Y, Vec3::Y, Rgb::WHITE);
            assert!((lit.r - expected).abs() < 1e-3, "{lit:?} {expected}");
        }
    }

    #[test]
    fn a_rough_coat_is_gloss_over_what_has_none_and_ambient_over_what_has_some() {
        let matt = coated(1.0, 0.8, 0.5);
        let [a, b] = albedo(0.5, 0.8);
        let reflected = 0.04 * a + b;
        assert_eq!((matt.gloss, matt.roughness), (Rgb::grey(reflected), 0.8));
        assert!((matt.ambient.r - (0.5 * (1.0 - reflected) + reflected)).abs() < 1e-6);
        let rough = Reflectance {
            gloss: Rgb::grey(0.25),
            roughness: 0.5,
            ..glossy(8.0)
        };
        let coat = Clearcoat {
            weight: 1.0,
            roughness: 0.8,
            normal: None,
        };
        let both = over(&rough, coat, 0.5, 1.0);
        assert_eq!(both.gloss, Rgb::grey(0.25 * (1.0 - reflected)));
        assert_eq!((both.roughness, both.ambient), (0.5, matt.ambient));
    }

    #[test]
    fn lacquer_over_a_rough_paint_mirrors_sharply() {
        let paint = Reflectance {
            reflectivity: Rgb::grey(0.01),
            mirror_roughness: 0.5,
            gloss: Rgb::grey(0.2),
            roughness: 0.5,
            ..glossy(8.0)
        };
        let lacquer = Clearcoat {
            weight: 1.0,
            roughness: 0.0,
            normal: None,
        };
        let car = over(&paint, lacquer, 1.0, 1.0);
        assert_eq!((car.mirror_roughness, car.roughness), (0.0, 0.5));
    }
}
