//! Exposure for a file with lights of its own: they are in candela and lux, and may be a desk lamp or the sun.

use crate::framing::Face;
use crate::light::Light;
use glam::{DVec3, Vec3};

/// What a white matt surface should show where the light falls: that of a sphere in a sun of 1, by the same mean.
const WELL_LIT: f64 = 0.51;
/// Light from this share of `WELL_LIT` to this multiple of it is left as it is.
const GOOD_AS_IT_IS: std::ops::RangeInclusive<f64> = 0.25..=2.0;
/// No exposure goes further, so that what is made of it stays finite.
const MOST_STOPS: f64 = 64.0;
/// Points on the faces at which light is measured.
const POINTS: f64 = 4096.0;

/// The stops by which a display should change what `lights` make of the sides of `faces` that are seen from `eye`;
/// `None` where that is well lit or not lit at all. Shadows are not reckoned with.
///
/// The mean is of logarithms, as in Reinhard et al. 2002, "Photographic Tone Reproduction for Digital Images", eq. 1,
/// each weighted with the light's square root: what is dark hardly counts, and neither does the small place next to a
/// bulb.
pub(super) fn stops(
    faces: impl Iterator<Item = Face> + Clone,
    lights: &[Light],
    eye: DVec3,
) -> Option<f32> {
    let total_area: f64 = faces.clone().map(|face| area_normal(&face).length()).sum();
    let step = total_area / POINTS;
    if !(step > 0.0 && step.is_finite()) {
        return None;
    }
    let (mut weights, mut weighted_logs) = (0.0, 0.0);
    // How far the next point lies behind the beginning of the face at hand, in area.
    let mut ahead = step / 2.0;
    let mut number = 0;
    for face in faces {
        let area_normal = area_normal(&face);
        let area = area_normal.length();
        while ahead < area {
            ahead += step;
            number += 1;
            let point = point_on(&face, number);
            let arrives = arriving(&face, area_normal / area, point, lights, eye);
            if arrives > 0.0 && arrives.is_finite() {
                let weight = arrives.sqrt();
                weights += weight;
                weighted_logs += weight * libm::log2(arrives);
            }
        }
        ahead -= area;
    }
    let mean = weighted_logs / weights - libm::log2(WELL_LIT);
    let stops = (-mean).clamp(-MOST_STOPS, MOST_STOPS) as f32;
    (mean.is_finite() && !GOOD_AS_IT_IS.contains(&libm::exp2(mean))).then_some(stops)
}

/// The light that a white matt surface shows the eye at a point of a face.
fn arriving(face: &Face, normal: DVec3, point: Vec3, lights: &[Light], eye: DVec3) -> f64 {
    let is_front = (eye - point.as_dvec3()).dot(normal) >= 0.0;
    if !is_front && !face.double_sided {
        return 0.0;
    }
    let toward_viewer = if is_front { normal } else { -normal };
    let of_light = |light: &Light| {
        light.illuminate(point).map_or(0.0, |light| {
            let cosine = light.to_light.as_dvec3().dot(toward_viewer).max(0.0);
            f64::from(light.irradiance.luminance()) * cosine
        })
    };
    lights.iter().map(of_light).sum()
}

/// Twice the area, along the normal.
fn area_normal(face: &Face) -> DVec3 {
    let [a, b, c] = face.triangle.0.map(|p| p.as_dvec3());
    (b - a).cross(c - a)
}

/// The point with this number of a sequence that fills a triangle evenly: multiples of the plastic number's powers
/// (Roberts 2018, "The Unreasonable Effectiveness of Quasirandom Sequences").
fn point_on(face: &Face, number: u32) -> Vec3 {
    let [a, b, c] = face.triangle.0.map(|p| p.as_dvec3());
    let part = |multiple: f64| multiple - libm::floor(multiple);
    let v = part(f64::from(number) * 0.754_877_666_246_692_8);
    let w = part(f64::from(number) * 0.569_840_290_998_053_3);
    let (v, w) = if v + w > 1.0 {
        (1.0 - v, 1.0 - w)
    } else {
        (v, w)
    };
    (a + (b - a) * v + (c - a) * w).as_vec3()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Rgb;
    use crate::generate;
    use crate::light::{Falloff, LightKind};

    fn light(kind: LightKind, intensity: f32) -> Light {
        Light {
            name: String::new(),
            kind,
            color: Rgb::WHITE,
            intensity,
            falloff: Falloff::InverseSquare,
            range: None,
        }
    }

    fn sun(intensity: f32) -> Light {
        let direction = Vec3::NEG_Z;
        light(LightKind::Directional { direction }, intensity)
    }

    /// A ball of radius 1 at the origin, seen from +Z.
    fn of_ball(lights: &[Light]) -> Option<f32> {
        let ball = generate::icosphere(3);
        let face = |index| Face {
            triangle: ball.triangle(index),
            double_sided: false,
            is_clear: false,
            object: 0,
        };
        let faces = (0..ball.triangles.len() as u32).map(face);
        stops(faces, lights, DVec3::Z * 100.0)
    }

    #[test]
    fn a_sun_of_one_needs_no_exposure_and_ten_thousand_lux_what_makes_one_of_them() {
        assert_eq!(of_ball(&[sun(1.0)]), None);
        let found = of_ball(&[sun(10_000.0)]).unwrap_or_default();
        assert!((found - -libm::log2f(10_000.0)).abs() < 0.05, "{found}");
    }

    #[test]
    fn a_bulb_close_to_a_surface_does_not_darken_all_the_others() {
        let position = Vec3::new(0.0, 0.0, 1.01);
        let bulb = light(LightKind::Point { position }, 0.01);
        let both = of_ball(&[sun(0.01), bulb]).unwrap_or_default();
        assert!(both > 0.0, "{both}");
    }

    #[test]
    fn lights_that_reach_nothing_change_nothing() {
        assert_eq!(of_ball(&[]), None);
        assert_eq!(of_ball(&[sun(0.0)]), None);
        let behind = LightKind::Directional { direction: Vec3::Z };
        assert_eq!(of_ball(&[light(behind, 1e9)]), None);
        assert_eq!(stops([].into_iter(), &[sun(1e9)], DVec3::ZERO), None);
    }

    #[test]
    fn the_brightest_and_the_faintest_lights_stay_finite() {
        for intensity in [1e38, 1e-38] {
            let found = of_ball(&[sun(intensity)]).unwrap_or_default();
            assert!(found.abs() <= 64.0 && found != 0.0, "{found}");
        }
    }
}
