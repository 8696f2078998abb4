//! The Khronos PBR Neutral tone mapper.

use crate::color::Rgb;

/// Reflectance at normal incidence of a dielectric whose index is 1.5: what a base colour gains under white light.
const F90: f32 = 0.04;
/// The peak at which highlights begin to be squeezed.
const K_S: f32 = 0.8 - F90;
/// How fast they lose saturation.
const K_D: f32 = 0.15;

/// Base colours between 0.08 and 0.8 come out as they went in, less the reflection [`F90`]; only highlights are
/// squeezed. No hue shifts.
///
/// Khronos Group 2024, "PBR Neutral Specification", in the letters of
/// <https://github.com/KhronosGroup/ToneMapping/blob/main/PBR_Neutral/README.md>. `light` must not be negative.
pub(super) fn pbr_neutral(light: Rgb) -> Rgb {
    let x = light.r.min(light.g).min(light.b);
    let f = if x <= 2.0 * F90 {
        x - x * x / (4.0 * F90)
    } else {
        F90
    };
    let color = light.map(|channel| channel - f);
    let p = color.max_component();
    if p <= K_S {
        return color;
    }
    let p_n = 1.0 - (1.0 - K_S) * (1.0 - K_S) / (p + 1.0 - 2.0 * K_S);
    let g = 1.0 / (K_D * (p - p_n) + 1.0);
    Rgb::grey(p_n).mix(color * (p_n / p), g)
}
