//! What facets send back of light from everywhere: a table, summed once.

use super::{LEAST_COS, exponent, fifth_power};
use std::f64::consts::PI;
use std::sync::LazyLock;

/// Steps of the table along either side.
const STEPS: usize = 16;
/// Facets that one value is summed over: by slope, and by direction on one side of the viewer's plane.
const SLOPES: u32 = 24;
const DIRECTIONS: u32 = 16;

/// Rows by width, from the first step on, since without width it is Schlick's formula; columns by the root of `n . v`.
type Table = [[[f32; 2]; STEPS + 1]; STEPS];

static TABLE: LazyLock<Table> = LazyLock::new(|| {
    // By index: the values follow from where they are.
    std::array::from_fn(|row| {
        let width = (row + 1) as f64 / STEPS as f64;
        let shininess = 2.0 / (width * width * width * width) - 2.0;
        std::array::from_fn(|column| {
            let root = column as f64 / STEPS as f64;
            summed(root * root, shininess)
        })
    })
});

/// The share of light from everywhere that a surface sends back to a viewer at `cos_view`, as `[a, b]`: `F0 a + F90 b`.
///
/// `a + b` is at most 1. Without roughness it is Schlick's formula; elsewhere it is within 0.01 of the lobe's integral.
/// Where the surface is smooth and seen from its edge (roughness under 0.15, `cos_view` under 0.1) it is within 0.02, and
/// below a `cos_view` of 0.02 it is about right.
pub fn albedo(cos_view: f32, roughness: f32) -> [f32; 2] {
    let cos_view = cos_view.clamp(0.0, 1.0);
    // About the roughness, but even where the exponent changes fastest.
    let width = (2.0 / (exponent(roughness) + 2.0)).sqrt().sqrt();
    let (row, down) = place(width);
    // Denser at the edge, where it changes most.
    let (column, right) = place(cos_view.sqrt());
    let at = |row: usize, column: usize| {
        let row = TABLE.get(row).map_or(&[][..], |row| &row[..]);
        row.get(column).copied().unwrap_or_default()
    };
    let along = |row| mix(at(row, column), at(row, column + 1), right);
    let above = match row.checked_sub(1) {
        Some(row) => along(row),
        None => smooth(cos_view),
    };
    if down == 0.0 {
        return above;
    }
    mix(above, along(row), down)
}

/// Without roughness.
fn smooth(cos_view: f32) -> [f32; 2] {
    let edge = fifth_power(1.0 - cos_view);
    [1.0 - edge, edge]
}

/// Which of the steps from 0 to 1, and how far in it.
fn place(share: f32) -> (usize, f32) {
    let scaled = share * STEPS as f32;
    let step = (scaled as usize).min(STEPS - 1);
    (step, scaled - step as f32)
}

fn mix([a, b]: [f32; 2], [c, d]: [f32; 2], share: f32) -> [f32; 2] {
    [a + (c - a) * share, b + (d - b) * share]
}

/// `∫ G (v.h) / ((n.v) (n.h)) [1 - (1 - v.h)^5, (1 - v.h)^5] D (n.h) dh`: the lobe's integral over lights, in which
/// `dl = 4 (v.h) dh`, by the midpoints of equal shares of `D (n.h) dh`.
fn summed(cos_view: f64, shininess: f64) -> [f32; 2] {
    let cos_view = cos_view.max(f64::from(LEAST_COS));
    let sin_view = (1.0 - cos_view * cos_view).sqrt();
    let mut sum = [0.0; 2];
    for slope in 0..SLOPES {
        let share = (f64::from(slope) + 0.5) / f64::from(SLOPES);
        let cos_half = libm::pow(share, 1.0 / (shininess + 2.0));
        let sin_half = (1.0 - cos_half * cos_half).sqrt();
        for direction in 0..DIRECTIONS {
            let phi = PI * (f64::from(direction) + 0.5) / f64::from(DIRECTIONS);
            let cos_both = sin_half * libm::cos(phi) * sin_view + cos_half * cos_view;
            let cos_light = 2.0 * cos_both * cos_half - cos_view;
            if cos_both <= 0.0 || cos_light <= 0.0 {
                continue;
            }
            let unshadowed = (2.0 * cos_half * cos_view.min(cos_light) / cos_both).min(1.0);
            let weight = unshadowed * cos_both / (cos_view * cos_half);
            let x = 1.0 - cos_both;
            let edge = x * x * x * x * x;
            sum = [sum[0] + (1.0 - edge) * weight, sum[1] + edge * weight];
        }
    }
    // Rounding and the few facets must not make more light than there is.
    let count = f64::from(SLOPES * DIRECTIONS).max(sum[0] + sum[1]);
    sum.map(|sum| (sum / count) as f32)
}
