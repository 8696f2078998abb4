//! Interference in a thin film (KHR_materials_iridescence, "Iridescence Fresnel"): Belcour and Barla 2017, "A Practical
//! Extension to Microfacet Theory for the Modeling of Varying Iridescence", without polarisation, as the extension has it.

use super::facets::schlick;
use super::microfacet::f0_of;
use crate::color::Rgb;
use std::f32::consts::PI;

/// A film at one point, air above it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ThinFilm {
    /// How much of it there is, 0..1.
    pub strength: f32,
    /// Index of refraction, 1 or more.
    pub ior: f32,
    /// Nanometres.
    pub thickness: f32,
}

/// What a surface of this `F0` reflects through a film that covers it, seen at `cos_view`.
pub fn fresnel(f0: Rgb, film: ThinFilm, cos_view: f32) -> Rgb {
    let cos1 = cos_view.clamp(0.0, 1.0);
    let sin2 = (1.0 - cos1 * cos1) / (film.ior * film.ior);
    if sin2 > 1.0 {
        return Rgb::WHITE; // Total reflection, for a film thinner than air.
    }
    let cos2 = (1.0 - sin2).sqrt();
    // Air to film.
    let r12 = schlick(f0_of(film.ior), 1.0, cos1);
    let t121 = 1.0 - r12;
    // Film to base, whose index is what its F0 says; no base reflects everything, so that none is infinite.
    let base_ior = f0.map(|f0| {
        let root = (f0 + 1e-4).clamp(0.0, 0.9999).sqrt();
        (1.0 + root) / (1.0 - root)
    });
    let r23 = base_ior.map(|ior| {
        let r = (ior - film.ior) / (ior + film.ior);
        schlick(r * r, 1.0, cos2)
    });
    let way = 2.0 * film.ior * film.thickness * cos2;
    // Half a wave is lost where the index rises.
    let half_wave = |rises: bool| if rises { 0.0 } else { PI };
    let phi21 = PI - half_wave(film.ior >= 1.0);
    let phase = base_ior.map(|ior| phi21 + half_wave(ior >= film.ior));
    // The light that goes back and forth in the film m times; two are enough.
    let both = r23.map(|r23| (r12 * r23).clamp(1e-5, 0.9999));
    let inside = r23 * (t121 * t121) * both.map(|both| 1.0 / (1.0 - both));
    let mut light = Rgb::grey(r12) + inside;
    let mut amplitude = inside + Rgb::grey(-t121);
    for m in [1.0, 2.0] {
        amplitude = amplitude * both.map(f32::sqrt);
        light += amplitude * sensitivity(m * way, phase * m) * 2.0;
    }
    light.map(|channel| channel.clamp(0.0, 1.0))
}

/// How the eye's three kinds of receptors answer light that interferes with itself a `way` later (nanometres), in linear
/// Rec. 709: Gaussian fits in Fourier space (Belcour and Barla 2017, section 4).
fn sensitivity(way: f32, shift: Rgb) -> Rgb {
    let phase = 2.0 * PI * way * 1e-9;
    let gaussian = |value: f32, position: f32, variance: f32, shift: f32| {
        value
            * (2.0 * PI * variance).sqrt()
            * libm::cosf(position * phase + shift)
            * libm::expf(-phase * phase * variance)
            / 1.0685e-7
    };
    let x = gaussian(5.4856e-13, 1.6810e6, 4.3278e9, shift.r)
        + gaussian(9.7470e-14, 2.2399e6, 4.5282e9, shift.r);
    let y = gaussian(4.4201e-13, 1.7953e6, 9.3046e9, shift.g);
    let z = gaussian(5.2481e-13, 2.2084e6, 6.6121e9, shift.b);
    Rgb::new(
        3.240_454_2 * x - 1.537_138_5 * y - 0.498_531_4 * z,
        -0.969_266 * x + 1.876_010_8 * y + 0.041_556 * z,
        0.055_643_4 * x - 0.204_025_9 * y + 1.057_225_2 * z,
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn film(ior: f32, thickness: f32) -> ThinFilm {
        ThinFilm {
            strength: 1.0,
            ior,
            thickness,
        }
    }

    #[test]
    fn the_values_are_those_of_the_extensions_own_code() {
        // Its GLSL in double precision, by another program.
        let plastic = Rgb::grey(0.04);
        for (f0, ior, thickness, cos, expected) in [
            (plastic, 1.3, 400.0, 1.0, [0.00744, 0.03845, 0.01605]),
            (plastic, 1.3, 400.0, 0.5, [0.06089, 0.02283, 0.05053]),
            (plastic, 1.8, 515.0, 0.8, [0.02758, 0.09456, 0.07507]),
            (
                Rgb::new(0.9, 0.5, 0.3),
                1.67,
                250.0,
                0.3,
                [1.00000, 0.43868, 0.05376],
            ),
            (plastic, 1.33, 200.0, 1.0, [0.03507, 0.03969, 0.02879]),
            (plastic, 1.3, 1200.0, 0.9, [0.03215, 0.01897, 0.02014]),
        ] {
            let found = fresnel(f0, film(ior, thickness), cos);
            for (found, expected) in <[f32; 3]>::from(found).into_iter().zip(expected) {
                assert!((found - expected).abs() < 2e-4, "{found} {expected}");
            }
        }
    }

    #[test]
    fn a_quarter_wave_of_lower_index_makes_green_darker_and_half_a_wave_brighter() {
        // A coat of index sqrt(1.5) and a quarter of 550 nm thick is the lens maker's antireflection coat.
        let ior = 1.5f32.sqrt();
        let at = |waves: f32| fresnel(Rgb::grey(0.04), film(ior, waves * 550.0 / ior), 1.0).g;
        assert!(at(0.25) < 0.005, "{}", at(0.25));
        assert!(at(0.5) > 0.02, "{}", at(0.5));
    }
}
