//! Sheen (KHR_materials_sheen): light that fibres standing out of a cloth send back at grazing angles. The lobe is
//! "Charlie" (Conty Estevez and Kulla 2017, "Production Friendly Microfacet Sheen BRDF"), formulas as in the extension.

use super::{Layers, Reflectance};
use crate::color::Rgb;
use glam::Vec3;
use std::f32::consts::PI;

/// Sheen at one point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sheen {
    /// Black where there is none.
    pub color: Rgb,
    /// How much the fibres' directions differ, 0..1.
    pub roughness: f32,
}

/// Below this roughness fibres would be seen from the edge alone.
const LEAST_ROUGHNESS: f32 = 0.07;
/// The least cosine to the viewer that the lobe is divided by.
const LEAST_COS: f32 = 1e-3;

/// `base` below fibres: what they send back of all light together, `max(colour) E(n . v)`, is taken from it (the
/// extension's "albedo-scaling technique" with the viewer's angle alone).
pub fn over(base: &Reflectance, sheen: Sheen, cos_view: f32, ambient_access: f32) -> Reflectance {
    let albedo = albedo(cos_view, sheen.roughness);
    let below = base.dimmed(1.0 - sheen.color.max_component().min(1.0) * albedo);
    let layers = below.layers.unwrap_or(Layers::NONE);
    Reflectance {
        ambient: below.ambient + sheen.color * (albedo * ambient_access),
        layers: Some(Layers { sheen, ..layers }),
        ..below
    }
}

/// `colour D V (n . l) E π`: what the fibres send back of one light, in the paper's units.
pub fn reflected(sheen: &Sheen, n: Vec3, l: Vec3, v: Vec3, e: Rgb) -> Rgb {
    let [cos_light, cos_view] = [n.dot(l), n.dot(v).max(LEAST_COS)];
    if cos_light <= 0.0 || sheen.color == Rgb::BLACK {
        return Rgb::BLACK;
    }
    let h = (l + v).normalize_or_zero();
    sheen.color * lobe(sheen.roughness, n.dot(h), cos_light, cos_view) * e
}

/// `D V (n . l) π`.
fn lobe(roughness: f32, cos_half: f32, cos_light: f32, cos_view: f32) -> f32 {
    let roughness = roughness.max(LEAST_ROUGHNESS);
    let alpha = roughness * roughness;
    let sin2 = (1.0 - cos_half * cos_half).max(0.0);
    let distribution = (2.0 + 1.0 / alpha) * libm::powf(sin2, 0.5 / alpha) / (2.0 * PI);
    // The extension's visibility, n . l multiplied in.
    let shadowing = 1.0 + lambda(cos_view, alpha) + lambda(cos_light, alpha);
    distribution * PI / (shadowing * 4.0 * cos_view)
}

fn lambda(cos: f32, alpha: f32) -> f32 {
    let exponent = if cos < 0.5 {
        shadow(cos, alpha)
    } else {
        2.0 * shadow(0.5, alpha) - shadow(1.0 - cos, alpha)
    };
    libm::expf(exponent)
}

/// The fit `l(x)` of Conty Estevez and Kulla, its parameters mixed by roughness.
fn shadow(x: f32, alpha: f32) -> f32 {
    let share = (1.0 - alpha) * (1.0 - alpha);
    let mix = |rough: f32, smooth: f32| rough + (smooth - rough) * share;
    let a = mix(21.5473, 25.3245);
    let b = mix(3.82987, 3.32435);
    let c = mix(0.19823, 0.16801);
    let d = mix(-1.97760, -1.27393);
    let e = mix(-4.32054, -4.85967);
    a / (1.0 + b * libm::powf(x.max(0.0), c)) + d * x + e
}

/// The share of light from everywhere that white fibres send back to a viewer, `E` of the extension: between the values
/// of a table.
pub fn albedo(cos_view: f32, roughness: f32) -> f32 {
    // Denser at the edge, where it changes most.
    let (x, right) = place(cos_view.clamp(0.0, 1.0).sqrt());
    let (y, down) = place(roughness.clamp(0.0, 1.0));
    let along = |row: usize| {
        let row = ALBEDO.get(row).unwrap_or(&[0.0; 9]);
        let at = |column: usize| row.get(column).copied().unwrap_or_default();
        at(x) * (1.0 - right) + at(x + 1) * right
    };
    along(y) * (1.0 - down) + along(y + 1) * down
}

/// Which of eight steps from 0 to 1, and how far in it.
fn place(share: f32) -> (usize, f32) {
    let step = (share * 8.0) as usize;
    let step = step.min(7);
    (step, share * 8.0 - step as f32)
}

/// The lobe's integral over the hemisphere of lights, summed over 200 x 200 directions in double precision, at most 1:
/// rows by roughness in eighths, columns by the root of `n . v` in eighths.
#[rustfmt::skip]
const ALBEDO: [[f32; 9]; 9] = [
    [0.000, 0.000, 0.000, 0.000, 0.000, 0.000, 0.000, 0.000, 0.000],
    [1.000, 1.000, 0.838, 0.360, 0.110, 0.020, 0.001, 0.000, 0.000],
    [0.976, 0.959, 0.689, 0.437, 0.244, 0.114, 0.040, 0.008, 0.000],
    [0.785, 0.810, 0.637, 0.460, 0.310, 0.189, 0.099, 0.040, 0.006],
    [0.744, 0.787, 0.647, 0.498, 0.367, 0.253, 0.158, 0.084, 0.027],
    [0.768, 0.823, 0.693, 0.552, 0.426, 0.313, 0.214, 0.133, 0.062],
    [0.821, 0.883, 0.751, 0.609, 0.482, 0.367, 0.265, 0.179, 0.101],
    [0.867, 0.931, 0.795, 0.651, 0.523, 0.408, 0.303, 0.216, 0.137],
    [0.864, 0.928, 0.796, 0.657, 0.534, 0.424, 0.324, 0.240, 0.164],
];

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shade::test_surface::glossy;

    /// What white fibres send back of light of radiance 1 from everywhere: the lobe summed over the hemisphere.
    fn furnace(cos_view: f32, roughness: f32) -> f64 {
        const STEPS: usize = 100;
        let white = Sheen {
            color: Rgb::WHITE,
            roughness,
        };
        let v = Vec3::new((1.0 - cos_view * cos_view).sqrt(), 0.0, cos_view);
        let mut sum = 0.0;
        for i in 0..STEPS {
            let t = (i as f32 + 0.5) / STEPS as f32;
            let (cos, solid) = (t * t, 2.0 * t / STEPS as f32);
            for j in 0..STEPS {
                let phi = PI * (j as f32 + 0.5) / STEPS as f32;
                let sin = (1.0 - cos * cos).sqrt();
                let l = Vec3::new(sin * phi.cos(), sin * phi.sin(), cos);
                // Irradiance in the paper's units is π times less: `reflected` gives radiance times π.
                let light = reflected(&white, Vec3::Z, l, v, Rgb::WHITE).g / PI;
                sum += f64::from(light * solid * 2.0 * PI / STEPS as f32);
            }
        }
        sum
    }

    #[test]
    fn the_table_is_the_sum_of_the_lobe() {
        for roughness in [0.3, 0.5, 0.7, 0.875, 1.0] {
            for cos in [0.1, 0.25, 0.4, 0.6, 0.8, 1.0] {
                let [summed, table] = [furnace(cos, roughness) as f32, albedo(cos, roughness)];
                assert!(
                    (summed - table).abs() < 0.02,
                    "{roughness} {cos}: {summed} {table}"
                );
            }
        }
    }

    #[test]
    fn what_the_fibres_send_back_is_taken_from_below() {
        let sheen = Sheen {
            color: Rgb::new(0.5, 0.25, 0.0),
            roughness: 0.5,
        };
        // 0.367 in the table: at n . v = 1/4.
        let surface = over(&glossy(8.0), sheen, 0.25, 1.0);
        assert!((surface.diffuse.r - 0.5 * (1.0 - 0.5 * 0.367)).abs() < 1e-4);
        let below = 0.5 * (1.0 - 0.5 * 0.367);
        assert!((surface.ambient.g - (below + 0.25 * 0.367)).abs() < 1e-4);
    }

    #[test]
    fn velvet_is_brighter_seen_from_the_side_than_from_above() {
        let velvet = Sheen {
            color: Rgb::WHITE,
            roughness: 0.5,
        };
        let seen = |v| reflected(&velvet, Vec3::Y, Vec3::new(0.6, 0.8, 0.0), v, Rgb::WHITE).r;
        assert!(seen(Vec3::new(-0.96, 0.28, 0.0)) < seen(Vec3::new(0.96, 0.28, 0.0)));
        assert!(seen(Vec3::Y) < 0.3 * seen(Vec3::new(0.96, 0.28, 0.0)));
    }
}
