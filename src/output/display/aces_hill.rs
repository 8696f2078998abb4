//! Stephen Hill's fit of ACES: of its reference rendering transform and its output transform for sRGB.

use super::transformed;
use crate::color::Rgb;

/// Linear Rec. 709 to the space in which the curve is applied, desaturated.
const IN: [[f32; 3]; 3] = [
    [0.59719, 0.35458, 0.04823],
    [0.07600, 0.90834, 0.01566],
    [0.02840, 0.13383, 0.83777],
];

/// And back.
const OUT: [[f32; 3]; 3] = [
    [1.60475, -0.53108, -0.07367],
    [-0.10208, 1.10813, -0.00605],
    [-0.00327, -0.07276, 1.07602],
];

/// Hill's fit as it stands, without the exposure of 1/0.6 that three.js puts before it: 18 % grey becomes 11 %.
///
/// Stephen Hill, `ACES.hlsl` in BakingLab by Matt Pettineo and David Neubelt,
/// <https://github.com/TheRealMJP/BakingLab/blob/master/BakingLab/ACES.hlsl>.
pub(super) fn aces_hill(light: Rgb) -> Rgb {
    transformed(&OUT, transformed(&IN, light).map(curve))
}

fn curve(v: f32) -> f32 {
    let a = v * (v + 0.0245786) - 0.000090537;
    let b = v * (0.983729 * v + 0.432951) + 0.238081;
    a / b
}
