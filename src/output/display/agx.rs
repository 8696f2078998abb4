//! AgX in closed form.

use super::transformed;
use crate::color::Rgb;

/// Linear Rec. 709 to Rec. 2020, and AgX's inset.
const IN: [[f32; 3]; 3] = [
    [0.54490816, 0.37377945, 0.08138498],
    [0.14044005, 0.7541096, 0.10543358],
    [0.08882741, 0.17887713, 0.73225],
];

/// AgX's outset, and Rec. 2020 to linear Rec. 709.
const OUT: [[f32; 3]; 3] = [
    [1.964551, -0.8558585, -0.10886711],
    [-0.29932243, 1.326451, -0.02708402],
    [-0.16436833, -0.23822464, 1.4026654],
];

/// In stops: 10 below middle grey.
const DARKEST: f32 = -12.473931;
/// In stops: 6.5 above middle grey.
const BRIGHTEST: f32 = 4.026_069;

/// Where the curve's two halves meet: middle grey on the axis of stops,
const PIVOT: f32 = 10.0 / 16.5;
/// and 0.18 to the power of 1 / [`GAMMA`].
const PIVOT_VALUE: f32 = 0.489_437_1;
/// Of the curve at the pivot.
const SLOPE: f32 = 2.4;
/// Of the display that the curve is made for.
const GAMMA: f32 = 2.4;

/// Eary Chow's AgX, which Blender ships as a table, in closed form: no guard against colours outside Rec. 709 and no
/// mixing of hues. On greys within 1/255 of Blender's.
///
/// <https://github.com/allenwp/AgX-GLSL-Shaders>, `EaryChow-AgX/earychow-agx-simplified.glsl`; its numbers rounded to
/// single precision.
pub(super) fn agx(light: Rgb) -> Rgb {
    // The least that leaves something for the logarithm.
    let light = light.map(|channel| channel.max(2e-10));
    transformed(&OUT, transformed(&IN, light).map(curve))
}

/// Toe and shoulder, each a line bent down by a power law.
fn curve(light: f32) -> f32 {
    let x = ((libm::log2f(light) - DARKEST) / (BRIGHTEST - DARKEST)).max(0.0);
    let (a, b) = if x < PIVOT {
        (-58.337_32, 35.355_953)
    } else {
        (46.141_05, -27.964_273)
    };
    let bend = f32::abs(b + a * x);
    // 1 + k bend^1.5, to the power of 1 / 1.5.
    let root = libm::cbrtf(1.0 + 0.019_613_087 * bend * bend.sqrt());
    let value = PIVOT_VALUE + SLOPE * (x - PIVOT) / (root * root);
    // A third of `powf`'s time (26 and 78 ns), and as good: the value is hardly ever above one.
    libm::exp2f(GAMMA * libm::log2f(value.max(0.0)))
}
