//! Where light goes, and how much of it, at a smooth boundary of two media (Whitted 1980, "An Improved Illumination
//! Model for Shaded Display"): Snell's law and Fresnel's equations.
//!
//! Everywhere `m` is the index of refraction behind the boundary over the one before it.

use crate::color::Rgb;
use glam::Vec3;

/// The cosine of the refracted ray with the normal, `cos theta_t = sqrt(1 - (sin theta_i / m)^2)`; `None` where all light
/// is reflected.
fn cos_refracted(cos_i: f32, m: f32) -> Option<f32> {
    // Both brackets of 1 - cos^2 apart: near the edge of a surface its square would lose the digits that count.
    let sin2_t = (1.0 - cos_i) * (1.0 + cos_i) / (m * m);
    // Written to be false for NaN: an `m` of zero at normal incidence.
    (sin2_t < 1.0).then(|| (1.0 - sin2_t).sqrt())
}

/// The share of unpolarised light that is reflected, exactly (Born and Wolf, "Principles of Optics", sec. 1.5.2).
///
/// `cos_i` is the cosine of the ray with the normal, 0..1. Total reflection is 1; so is an `m` of 0 or infinity.
pub fn fresnel(cos_i: f32, m: f32) -> f32 {
    if m == 1.0 || !m.is_finite() {
        return f32::from(u8::from(m != 1.0));
    }
    let cos_i = cos_i.clamp(0.0, 1.0);
    let Some(cos_t) = cos_refracted(cos_i, m) else {
        return 1.0;
    };
    let across = (cos_i - m * cos_t) / (cos_i + m * cos_t);
    let along = (m * cos_i - cos_t) / (m * cos_i + cos_t);
    0.5 * (across * across + along * along)
}

/// Schlick's approximation of [`fresnel`], where no angle is reflected totally.
pub fn schlick(cos_i: f32, m: f32) -> f32 {
    let (f0, x) = ((m - 1.0) / (m + 1.0), 1.0 - cos_i.clamp(0.0, 1.0));
    f0 * f0 + (1.0 - f0 * f0) * (x * x * x * x * x)
}

/// The unit direction in which light that travels along `d` goes on behind the boundary (Snell's law); `None` where all of
/// it is reflected. `d` and `n` are unit vectors, `n` on the side that `d` comes from.
pub fn direction(d: Vec3, n: Vec3, m: f32) -> Option<Vec3> {
    let cos_i = -n.dot(d);
    let cos_t = cos_refracted(cos_i, m)?;
    (d / m + n * (cos_i / m - cos_t)).try_normalize()
}

/// The indices for red, green and blue light: those of the implementation note in KHR_materials_dispersion, where
/// `dispersion` is 20 over Abbe's number and half of the spread lies on either side of `ior`.
pub fn indices(ior: f32, dispersion: f32) -> Rgb {
    // A bubble, whose index is below 1, has none.
    let half_spread = (ior - 1.0).max(0.0) * 0.025 * dispersion;
    // The note wants a clamp where dispersion is so strong that red would bend the other way.
    let red = (ior - half_spread).max(ior.min(1.0));
    Rgb::new(red, ior, ior + half_spread)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn head_on_the_square_of_the_relative_difference_is_reflected() {
        assert!((fresnel(1.0, 1.5) - 0.04).abs() < 1e-7);
        assert!((fresnel(1.0, 1.0 / 1.5) - 0.04).abs() < 1e-7);
        // Diamond: (1.42 / 3.42)^2.
        assert!((fresnel(1.0, 2.42) - 0.172_394_92).abs() < 1e-6);
    }

    #[test]
    fn angles_between_have_what_fresnels_equations_in_sines_and_tangents_say() {
        // R = (sin^2(i - t) / sin^2(i + t) + tan^2(i - t) / tan^2(i + t)) / 2, in decimal arithmetic of 30 digits.
        for (degrees, expected) in [
            (30.0f64, 0.041_522_625_975_8),
            (45.0, 0.050_239_911_012_2),
            (60.0, 0.089_186_712_802_2),
            (75.0, 0.253_060_562_990_3),
            (85.0, 0.612_799_645_264_8),
            (89.0, 0.904_184_949_780_2),
        ] {
            let found = fresnel(degrees.to_radians().cos() as f32, 1.5);
            assert!(
                (f64::from(found) - expected).abs() < 2e-6,
                "{degrees}: {found}"
            );
        }
    }

    #[test]
    fn at_brewsters_angle_half_of_what_is_polarised_across_is_all_that_is_reflected() {
        // tan i = 1.5: what is polarised along is not reflected, and the rays are at right angles, so that what is
        // polarised across is ((1 - n^2) / (1 + n^2))^2 = (1.25 / 3.25)^2.
        let cos_i = 1.0 / 3.25f32.sqrt();
        let expected = 0.5 * (1.25f32 / 3.25) * (1.25 / 3.25);
        assert!((fresnel(cos_i, 1.5) - expected).abs() < 1e-6);
    }

    #[test]
    fn from_the_critical_angle_on_everything_is_reflected() {
        // sin i = 1 / 1.5.
        let critical = (1.0 - 1.0f32 / 2.25).sqrt();
        let m = 1.0 / 1.5;
        assert!(fresnel(critical + 1e-3, m) < 0.9);
        assert_eq!(fresnel(critical - 1e-3, m), 1.0);
        let along = |cos_i: f32| Vec3::new((1.0 - cos_i * cos_i).sqrt(), -cos_i, 0.0);
        assert!(direction(along(critical + 1e-3), Vec3::Y, m).is_some());
        assert_eq!(direction(along(critical - 1e-3), Vec3::Y, m), None);
    }

    #[test]
    fn both_ways_through_a_boundary_reflect_alike() {
        for cos_i in [1.0f32, 0.9, 0.5, 0.2, 0.05] {
            let cos_t = (1.0 - (1.0 - cos_i * cos_i) / 2.25).sqrt();
            let (inward, outward) = (fresnel(cos_i, 1.5), fresnel(cos_t, 1.0 / 1.5));
            assert!((inward - outward).abs() < 1e-5, "{inward} {outward}");
        }
    }

    #[test]
    fn an_index_of_one_neither_bends_nor_reflects_and_none_reflects_all() {
        let d = Vec3::new(0.6, -0.8, 0.0);
        assert!((direction(d, Vec3::Y, 1.0).unwrap_or(Vec3::ZERO) - d).length() < 1e-6);
        for cos_i in [0.0, 0.5, 1.0] {
            assert_eq!((fresnel(cos_i, 1.0), fresnel(cos_i, 0.0)), (0.0, 1.0));
            assert_eq!(fresnel(cos_i, f32::INFINITY), 1.0);
            assert!(fresnel(cos_i, 1e38) <= 1.0 && fresnel(cos_i, 1e-38) <= 1.0);
        }
        assert_eq!(direction(Vec3::NEG_Y, Vec3::Y, 0.0), None);
    }

    #[test]
    fn sines_are_in_the_ratio_of_the_indices() {
        let bent = direction(Vec3::new(0.6, -0.8, 0.0), Vec3::Y, 1.5).unwrap_or(Vec3::ZERO);
        assert!((bent.x - 0.4).abs() < 1e-6 && (bent.y + 0.84f32.sqrt()).abs() < 1e-6);
    }

    #[test]
    fn dispersion_spreads_the_indices_by_abbes_number() {
        // V = 20: nF - nC = (1.5 - 1) / 20.
        let spread = indices(1.5, 1.0);
        assert!((spread.b - spread.r - 0.025).abs() < 1e-6 && spread.g == 1.5);
        assert_eq!(indices(1.5, 0.0), Rgb::grey(1.5));
        assert_eq!(indices(1.1, 1000.0).r, 1.0);
        assert_eq!(indices(0.75, 1.0), Rgb::grey(0.75));
    }
}
