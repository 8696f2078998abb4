//! Facets: the highlight of a rough surface, with normalised Blinn-Phong facets, V-cavities and Fresnel's share.
//!
//! | quantity | formula | source |
//! | --- | --- | --- |
//! | lobe | `D G F / (4 (n.l) (n.v))` | Torrance and Sparrow 1967, "Theory for Off-Specular Reflection From Roughened Surfaces"; the 4 as in Walter et al. 2007, "Microfacet Models for Refraction through Rough Surfaces" |
//! | facets `D` | `(s + 2) / (2 π) (n.h)^s`, so that `∫ D (n.h) dh = 1` | Blinn 1977, "Models of Light Reflection for Computer Synthesized Pictures", normalised |
//! | exponent `s` | `ln(1/2) / ln(cos θ)`, `cos² θ = 1 - (√2 - 1) α² / (1 - α²)`, `α = roughness²` | ours: `θ` is where GGX's `D` (Walter et al. 2007; glTF 2.0, appendix B.3.2) falls to half of its height |
//! | shadowing `G` | `min(1, 2 (n.h) (n.v) / (v.h), 2 (n.h) (n.l) / (v.h))` | Cook and Torrance 1982, "A Reflectance Model for Computer Graphics": no energy is made with any `D` |
//! | Fresnel `F` | `F0 + (F90 - F0) (1 - v.h)^5` | Schlick 1994, "An Inexpensive BRDF Model for Physically-based Rendering" |
//!
//! Light that facets throw on one another is lost. Of light from everywhere, surfaces of `F0 = F90 = 1` lose, in per cent
//! (a test holds the numbers):
//!
//! | roughness | 0.1 | 0.2 | 0.3 | 0.4 | 0.5 | 0.6 | 0.7 | 0.8 | 0.9 | 1.0 |
//! | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- | --- |
//! | seen head-on | 0.0 | 0.0 | 0.0 | 0.0 | 0.0 | 0.7 | 7.4 | 24.9 | 51.0 | 62.5 |
//! | `n.v = 0.6` | 0.0 | 0.0 | 0.0 | 0.1 | 1.9 | 6.0 | 10.6 | 17.0 | 31.5 | 41.7 |
//! | `n.v = 0.3` | 0.0 | 0.0 | 0.4 | 3.7 | 6.9 | 7.7 | 7.7 | 8.5 | 14.3 | 20.7 |
//! | `n.v = 0.1` | 0.0 | 1.5 | 6.5 | 6.0 | 4.5 | 3.4 | 2.8 | 2.9 | 4.5 | 6.9 |

mod albedo;
#[cfg(test)]
pub(super) mod tests;

pub use albedo::albedo;

use crate::color::Rgb;
use glam::Vec3;
use std::f32::consts::{LN_2, SQRT_2};

/// The lobe of a rough surface under a lamp: `D V F`, `D` normalised Blinn-Phong.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Facets {
    /// The share of light that is reflected head-on.
    pub f0: Rgb,
    /// The same at the edge.
    pub f90: f32,
    /// `s`.
    pub shininess: f32,
}

/// The least roughness that a lamp's highlight is reckoned with: a light without extent has none on a perfect mirror.
const LEAST_ROUGHNESS: f32 = 0.1;
/// The least cosine to the viewer that the lobe is divided by.
const LEAST_COS: f32 = 1e-3;

impl Facets {
    /// No light comes back.
    pub const NONE: Facets = Facets {
        f0: Rgb::BLACK,
        f90: 0.0,
        shininess: 0.0,
    };

    /// A surface of this perceptual roughness, 0..1.
    pub fn new(f0: Rgb, f90: f32, roughness: f32) -> Facets {
        Facets {
            f0,
            f90,
            shininess: exponent(roughness.max(LEAST_ROUGHNESS)),
        }
    }

    /// The same below something that lets this share of the light through.
    pub fn dimmed(&self, share: f32) -> Facets {
        Facets {
            f0: self.f0 * share,
            f90: self.f90 * share,
            ..*self
        }
    }
}

/// `D V F (n . l) E π`: what one light adds, in the paper's units (a white matt surface that faces it shows `E`); zero
/// where the light stands behind the surface.
///
/// `n`, `l`, `v` are unit vectors that point away from the surface; `e` is the light's irradiance.
#[inline(never)]
pub fn reflected(facets: &Facets, n: Vec3, l: Vec3, v: Vec3, e: Rgb) -> Rgb {
    let [cos_light, cos_view] = [n.dot(l), n.dot(v).max(LEAST_COS)];
    // 2 (v.h) h, which needs no root: its length is 2 (v.h).
    let both = l + v;
    let (along, length2) = (n.dot(both), both.length_squared());
    // Written to be false for NaN.
    let lit = cos_light > 0.0 && along > 0.0 && length2 > 0.0;
    if !lit || (facets.f90 <= 0.0 && facets.f0 == Rgb::BLACK) {
        return Rgb::BLACK;
    }
    // Rounding must not make the cosine greater than 1: its power would be great.
    let cos2_half = (along * along / length2).min(1.0);
    let distribution = (facets.shininess + 2.0) * libm::powf(cos2_half, 0.5 * facets.shininess);
    // 2 (n.h) / (v.h).
    let groove = 4.0 * along / length2;
    let unshadowed = (groove * cos_view.min(cos_light)).min(1.0);
    let cos_both = 0.5 * length2.sqrt();
    let fresnel = facets.f0.map(|f0| schlick(f0, facets.f90, cos_both));
    fresnel * (0.125 * distribution * unshadowed / cos_view) * e
}

/// `F0 + (F90 - F0) (1 - cos)^5`.
pub fn schlick(f0: f32, f90: f32, cos: f32) -> f32 {
    f0 + (f90 - f0) * fifth_power(1.0 - cos.clamp(0.0, 1.0))
}

fn fifth_power(x: f32) -> f32 {
    (x * x) * (x * x) * x
}

/// The exponent of Blinn's lobe that is as wide at half its height as GGX's of this perceptual roughness, 0..1: infinite
/// at 0, and 0 from 0.917 on, where GGX's falls to less than half nowhere.
pub fn exponent(roughness: f32) -> f32 {
    let alpha = roughness.clamp(0.0, 1.0) * roughness.clamp(0.0, 1.0);
    let alpha2 = alpha * alpha;
    let sin2 = (SQRT_2 - 1.0) * alpha2 / (1.0 - alpha2);
    // Written to be false at a roughness of 1, which divides by zero.
    if sin2 < 1.0 {
        -2.0 * LN_2 / libm::log1pf(-sin2)
    } else {
        0.0
    }
}

/// The inverse of [`exponent`], 0 to 0.917.
pub fn roughness_of(shininess: f32) -> f32 {
    let sin2 = -libm::expm1f(-2.0 * LN_2 / shininess.max(0.0));
    let odds = sin2 / (SQRT_2 - 1.0);
    (odds / (1.0 + odds)).sqrt().sqrt()
}
