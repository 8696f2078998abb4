//! From what physically based materials are at a point to the quantities a Whitted renderer has.
//!
//! | quantity | formula | source |
//! | --- | --- | --- |
//! | highlight | `D G F / (4 (n.l) (n.v))` for each lamp | [`facets`](super::facets) |
//! | reflected `R` | `F0 a + F90 b`: all that the lobe sends back of light from everywhere | the lobe's integral ([`albedo`]) |
//! | diffuse | `k_d (1 - max R)` | ours: what is reflected is not diffuse, so that no energy is made |
//! | mirror `m` | 1 up to a roughness of 0.15, smoothly down to 0 at 0.6 | ours: a sharp mirror stands for the lobe while it is narrow, and is gone where it is wide |
//! | | and 0 where `max R < 0.03` from a roughness of 0.3 on | ours: a mirror that nobody would see costs no ray |
//! | reflectivity | `R m` | |
//! | gloss | `R (1 - m)`, as much of it as arrives | ours: the rest of the lobe sees the environment as wide as it is |
//! | ambient | diffuse + gloss + what comes through | where occlusion lets light arrive |
//!
//! Light that one facet sends to another comes out of a rough surface in the end: what is reflected, and `F0` and `F90` of
//! the highlight, are multiplied by `1 + F0 (1 / (a + b) - 1)` (Turquin 2019, "Practical Multiple Scattering Compensation
//! for Microfacet Models", eq. 16), so that white metal loses nothing.
//!
//! A thin film replaces `F`, and `F0` in the highlight, by its own at this angle ([`iridescence`]).

use super::Reflectance;
use super::facets::{Facets, albedo};
use super::iridescence::{self, ThinFilm};
use crate::color::Rgb;

/// The parameters at one point, textures looked up.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Parameters {
    /// `k_d`: what would be diffuse if nothing were reflected.
    pub diffuse: Rgb,
    /// The share of the constant ambient light behind the surface that comes through, if nothing were reflected; lamps
    /// there are the tracer's affair.
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

/// Up to this roughness all of the lobe is mirrored sharply, and from `MIRROR_ENDS_AT` on none.
const MIRROR_FADES_FROM: f32 = 0.15;
const MIRROR_ENDS_AT: f32 = 0.6;
/// From this roughness on a mirror that is fainter than `FAINT[0]` is worth no ray, and one of `FAINT[1]` is.
const FAINT_FADES_AT: f32 = 0.3;
const FAINT: [f32; 2] = [0.03, 0.06];

/// The table in this file's head. `cos_view` is `n . v`, 0..1.
pub fn reflectance(p: Parameters, cos_view: f32, emission: Rgb) -> Reflectance {
    let roughness = p.roughness.clamp(0.0, 1.0);
    let [head_on, edge] = albedo(cos_view, roughness);
    let mut f0 = p.f0;
    let mut reflected = f0 * head_on + Rgb::grey(p.f90 * edge);
    if let Some(film) = p.film {
        let tinted = iridescence::fresnel(f0, film, cos_view);
        reflected = reflected.mix(tinted * (head_on + edge), film.strength);
        f0 = f0.mix(tinted, film.strength);
    }
    let again = f0.map(|f0| 1.0 + f0.min(1.0) * (1.0 / (head_on + edge) - 1.0));
    reflected = reflected * again;
    let greatest = reflected.max_component();
    let mirrored = mirrored_share(roughness, greatest);
    let left = (1.0 - greatest).max(0.0);
    let diffuse = p.diffuse * left;
    let gloss = reflected * ((1.0 - mirrored) * p.ambient_access);
    Reflectance {
        diffuse,
        color: p.diffuse,
        facets: Some(Facets::new(
            f0 * again,
            p.f90 * again.max_component(),
            roughness,
        )),
        reflectivity: reflected * mirrored,
        mirror_roughness: roughness,
        gloss,
        roughness,
        ambient: (diffuse + p.through * left) * p.ambient_access + gloss,
        emission,
        ..Reflectance::BLACK
    }
}

/// `m`: the share that a mirror ray stands for of all that a surface reflects, which is `reflected`.
pub(super) fn mirrored_share(roughness: f32, reflected: f32) -> f32 {
    let sharp = 1.0 - smoothstep(MIRROR_FADES_FROM, MIRROR_ENDS_AT, roughness);
    let rough = smoothstep(MIRROR_FADES_FROM, FAINT_FADES_AT, roughness);
    let faint = 1.0 - smoothstep(FAINT[0], FAINT[1], reflected);
    sharp * (1.0 - rough * faint)
}

/// 0 up to `from`, 1 from `to` on, and without a bend between.
fn smoothstep(from: f32, to: f32, x: f32) -> f32 {
    let t = ((x - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
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
    use crate::shade::facets;

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

    fn surface(diffuse: f32, f0: f32, roughness: f32, cos_view: f32) -> Reflectance {
        let p = Parameters {
            diffuse: Rgb::grey(diffuse),
            through: Rgb::BLACK,
            f0: Rgb::grey(f0),
            f90: 1.0,
            roughness,
            ambient_access: 1.0,
            film: None,
        };
        reflectance(p, cos_view, Rgb::BLACK)
    }

    fn steps() -> impl Iterator<Item = f32> {
        (0..=20u8).map(|step| f32::from(step) / 20.0)
    }

    #[test]
    fn mirror_and_gloss_are_all_that_is_reflected_and_the_rest_is_diffuse() {
        for roughness in steps() {
            for cos in steps() {
                for f0 in [0.04, 0.5, 1.0] {
                    let [a, b] = albedo(cos, roughness);
                    let found = surface(1.0, f0, roughness, cos);
                    let reflected = found.reflectivity.g + found.gloss.g;
                    let again = 1.0 + f0 * (1.0 / (a + b) - 1.0);
                    assert!((reflected - (f0 * a + b) * again).abs() < 1e-6);
                    assert!((found.diffuse.g + reflected - 1.0).abs() < 1e-6);
                    assert!((found.ambient.g - found.diffuse.g - found.gloss.g).abs() < 1e-6);
                }
            }
        }
    }

    #[test]
    fn lamps_everywhere_get_no_more_out_of_a_white_surface_than_they_send() {
        // The lobe's own integral is tested beside it: here what is diffuse has to leave it its place.
        for roughness in [0.1, 0.3, 0.5, 0.8, 1.0] {
            for (cos, f0) in [(1.0, 0.04), (0.5, 0.04), (0.1, 0.04), (0.5, 0.9)] {
                let white = surface(1.0, f0, roughness, cos);
                let facets = white.facets.unwrap_or(Facets::NONE);
                let back = white.diffuse.g + facets::tests::furnace(&facets, f64::from(cos)) as f32;
                assert!(back > 0.98 && back < 1.02, "{roughness} {cos} {f0}: {back}");
            }
        }
    }

    #[test]
    fn the_mirror_fades_without_a_step() {
        for f0 in [0.02, 0.04, 0.2, 1.0] {
            let share = |roughness| mirrored_share(roughness, f0);
            assert_eq!((share(0.0), share(0.15)), (1.0, 1.0));
            assert_eq!((share(0.6), share(1.0)), (0.0, 0.0));
            let mut last = 1.0;
            for step in 0..=1000u16 {
                let now = share(f32::from(step) / 1000.0);
                assert!(now <= last && last - now < 0.02, "{f0}: {last} {now}");
                last = now;
            }
        }
        assert_eq!(mirrored_share(0.3, 0.03), 0.0);
        assert!(mirrored_share(0.3, 0.06) > 0.7);
    }

    #[test]
    fn a_thin_film_tints_mirror_and_highlight() {
        let film = ThinFilm {
            strength: 1.0,
            ior: 1.3,
            thickness: 400.0,
        };
        let p = Parameters {
            diffuse: Rgb::WHITE,
            through: Rgb::BLACK,
            f0: Rgb::grey(0.04),
            f90: 1.0,
            roughness: 0.0,
            ambient_access: 1.0,
            film: Some(film),
        };
        let tinted = iridescence::fresnel(p.f0, film, 0.5);
        let found = reflectance(p, 0.5, Rgb::BLACK);
        assert_eq!(found.facets.map(|facets| facets.f0), Some(tinted));
        assert!((found.reflectivity.r - tinted.r).abs() < 1e-6);
        assert!((found.diffuse.b - (1.0 - tinted.max_component())).abs() < 1e-6);
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
