//! How widely a rough surface spreads the light that it mirrors.

/// A lobe about the mirror direction: what comes from an angle `theta` off it counts `cos^exponent(theta)`.
#[derive(Clone, Debug)]
pub(super) struct Lobe {
    /// Where the lobe ends.
    cos_end: f64,
    /// Weights at equal steps of the cosine, from 1 down to `cos_end`.
    table: Vec<f64>,
}

/// Below this share of its peak a narrow lobe is cut off. What remains is lowered by as much, so that a bright spot has
/// no rim.
const CUT: f64 = 3e-3;
/// Lobes of lesser exponents are wide: they reach the horizon.
const WIDE: f64 = 8.0;
const STEPS: u32 = 1024;

impl Lobe {
    /// That of a surface of `alpha`, its roughness squared, 0..1.
    ///
    /// Half-vectors lie as in a Blinn-Phong lobe `cos^s` that falls to one half where GGX does: `D` of Walter et al. 2007,
    /// "Microfacet Models for Refraction through Rough Surfaces", does so at `cos^2 = 1 - (√2 - 1) α² / (1 - α²)`. About
    /// the mirror direction that lobe is nearly `cos^(s/4)`, as a half-vector turns half as far as what it mirrors (Fisher
    /// and Woo 1994, "R.E versus N.H Specular Highlights", Graphics Gems IV). Light that comes at a slant counts its cosine, `n . l`,
    /// as well, which is one more in the exponent where the surface is seen head-on. The roughest lobe, `s` = 0, is so
    /// the cosine: Lambert's.
    pub(super) fn of_alpha(alpha: f64) -> Lobe {
        let squared = alpha * alpha;
        let cos_squared = 1.0 - (2f64.sqrt() - 1.0) * squared / (1.0 - squared);
        // Infinite where alpha is 1: that, too, is below zero.
        let s = if cos_squared > 0.0 {
            2.0 * libm::log(0.5) / libm::log(cos_squared)
        } else {
            0.0
        };
        Lobe::of_exponent(0.25 * s + 1.0)
    }

    pub(super) fn of_exponent(exponent: f64) -> Lobe {
        let cut = if exponent < WIDE { 0.0 } else { CUT };
        let cos_end = libm::pow(cut, 1.0 / exponent);
        let weight = |step: u32| {
            let cos = 1.0 - f64::from(step) / f64::from(STEPS) * (1.0 - cos_end);
            (libm::pow(cos, exponent) - cut).max(0.0)
        };
        Lobe {
            cos_end,
            table: (0..=STEPS).map(weight).collect(),
        }
    }

    /// The cosine from which on nothing counts.
    pub(super) fn cos_end(&self) -> f64 {
        self.cos_end
    }

    /// What light from a direction counts, by the cosine of its angle off the mirror direction.
    pub(super) fn weight(&self, cos: f64) -> f64 {
        let place = (1.0 - cos) / (1.0 - self.cos_end) * f64::from(STEPS);
        let step = place.max(0.0);
        let at = |step: usize| self.table.get(step).copied().unwrap_or_default();
        let [here, next] = [at(step as usize), at(step as usize + 1)];
        here + (next - here) * (step - step.floor())
    }
}
