//! An environment as rough surfaces mirror it: each pixel the mean of all light in a lobe about its direction.

use super::equirect::{Equirect, colatitude, solid_angle};
use super::lobe::Lobe;
use crate::color::Rgb;
use glam::Vec4;
use rayon::prelude::*;
use std::f64::consts::PI;

/// `source` seen through `lobe`, `width` x `width / 2` pixels: `width` is a multiple of four and goes evenly into the
/// source's.
///
/// Between two rows the weights depend only on how many columns lie between two pixels. So they are reckoned once for
/// a pair of rows, and what remains is a sum of products along rows.
pub(super) fn prefiltered(source: &Equirect, width: u32, lobe: &Lobe) -> Equirect {
    let height = width / 2;
    let bands: Vec<Band> = source
        .rows()
        .enumerate()
        .map(|row| Band::new(source, row))
        .collect();
    let rows: Vec<Vec<Rgb>> = (0..height)
        .into_par_iter()
        .map(|y| filtered_row(&bands, (y, width, height), lobe))
        .collect();
    Equirect {
        width,
        height,
        pixels: rows.concat(),
    }
}

/// A row of the source.
struct Band {
    sin: f64,
    cos: f64,
    /// Of one pixel, steradians.
    solid_angle: f64,
    /// The row twice, so that what goes over its end is beside it.
    pixels: Vec<Vec4>,
}

impl Band {
    fn new(source: &Equirect, (y, row): (usize, &[Rgb])) -> Band {
        let (sin, cos) = colatitude(y as f64 + 0.5, source.height);
        Band {
            sin,
            cos,
            solid_angle: solid_angle(y as u32, source.width, source.height),
            pixels: [row, row]
                .concat()
                .iter()
                .map(|pixel| Vec4::new(pixel.r, pixel.g, pixel.b, 0.0))
                .collect(),
        }
    }
}

/// How much each of neighbouring pixels of a band counts for a pixel of the row that is made.
struct Weights {
    /// Where the first one lies, in columns from the first one that the pixel itself covers; not above zero.
    first: i64,
    weights: Vec<f32>,
}

fn filtered_row(bands: &[Band], (y, width, height): (u32, u32, u32), lobe: &Lobe) -> Vec<Rgb> {
    let (sin, cos) = colatitude(f64::from(y) + 0.5, height);
    let mut row = vec![Vec4::ZERO; width as usize];
    let mut weight = 0.0;
    for band in bands {
        let columns = band.pixels.len() / 2;
        let step = columns / width as usize;
        let Some(weights) = weights(band, (sin, cos), step, lobe) else {
            continue;
        };
        weight += weights.weights.iter().copied().map(f64::from).sum::<f64>();
        // Four pixels at once: their sums do not wait for each other.
        for (at, four) in row.chunks_exact_mut(4).enumerate() {
            let neighbours = |n: usize| {
                let column = ((at * 4 + n) * step) as i64 + weights.first;
                let first = column.rem_euclid(columns as i64) as usize;
                band.pixels
                    .get(first..first + weights.weights.len())
                    .unwrap_or_default()
            };
            let mut sums = [Vec4::ZERO; 4];
            let [a, b, c, d] = [0, 1, 2, 3].map(neighbours);
            for ((((w, a), b), c), d) in weights.weights.iter().zip(a).zip(b).zip(c).zip(d) {
                sums[0] += *a * *w;
                sums[1] += *b * *w;
                sums[2] += *c * *w;
                sums[3] += *d * *w;
            }
            four.iter_mut()
                .zip(sums)
                .for_each(|(sum, more)| *sum += more);
        }
    }
    let normal = (1.0 / weight) as f32;
    row.iter()
        .map(|sum| Rgb::new(sum.x, sum.y, sum.z) * normal)
        .collect()
}

/// The weights between a band and the pixels of the row at a colatitude, each of which covers `step` columns; `None`
/// where the lobe does not reach the band.
fn weights(band: &Band, (sin, cos): (f64, f64), step: usize, lobe: &Lobe) -> Option<Weights> {
    let (level, slant) = (cos * band.cos, sin * band.sin);
    let cos_reach = (lobe.cos_end() - level) / slant;
    if cos_reach >= 1.0 {
        return None;
    }
    let columns = band.pixels.len() / 2;
    let column_angle = 2.0 * PI / columns as f64;
    let reach = (libm::acos(cos_reach.max(-1.0)) / column_angle) as usize + 1;
    let (first, count) = match 2 * reach + step {
        all if all >= columns => (0, columns),
        some => (-(reach as i64), some),
    };
    let middle = (step as f64 - 1.0) * 0.5;
    let weight = |n: usize| {
        let angle = ((first + n as i64) as f64 - middle) * column_angle;
        (lobe.weight(level + slant * libm::cos(angle)) * band.solid_angle) as f32
    };
    let weights: Vec<f32> = (0..count).map(weight).collect();
    Some(Weights { first, weights })
}
