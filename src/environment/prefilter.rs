//! An environment as rough surfaces mirror it: each pixel the mean of all light in a lobe about its direction.

use super::equirect::{Equirect, colatitude, solid_angle};
use super::lobe::Lobe;
use crate::color::Rgb;
use glam::Vec4;
use rayon::prelude::*;
use std::f64::consts::{FRAC_PI_2, TAU};

/// No row has fewer columns, however near to a pole it is.
const FEWEST: usize = 16;

/// `source` seen through `lobe`, `width` x `width / 2` pixels: `width` is a power of two, at least 16, and the source's
/// is it or a greater one.
///
/// Between two rows the weights depend only on how many columns lie between two pixels. So they are reckoned once for
/// a pair of rows, and what remains is a sum of products along rows. Near the poles, where pixels are narrow, several of
/// them are taken as one.
pub(super) fn prefiltered(source: &Equirect, width: u32, lobe: &Lobe) -> Equirect {
    let height = width / 2;
    let bands: Vec<Band> = source
        .rows()
        .enumerate()
        .map(|row| Band::new(source, row))
        .collect();
    let half_columns = 2 * source.width;
    let angle = |half_columns_off: u32| f64::from(half_columns_off) * TAU / f64::from(half_columns);
    let cosines: Vec<f64> = (0..half_columns).map(|off| libm::cos(angle(off))).collect();
    let row = |y| {
        let row = Row::new(y, (width, height), lobe);
        widened(&row.filtered(&bands, &cosines, lobe), row.together)
    };
    let rows: Vec<Vec<Rgb>> = (0..height).into_par_iter().map(row).collect();
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
    /// Its pixels, the means of two neighbours, of four, and so on. Each twice over, so that what goes over the end of a row
    /// is beside it.
    pixels: Vec<Vec<Vec4>>,
}

impl Band {
    fn new(source: &Equirect, (y, row): (usize, &[Rgb])) -> Band {
        let (sin, cos) = colatitude(y as f64 + 0.5, source.height);
        let vector = |pixel: &Rgb| Vec4::new(pixel.r, pixel.g, pixel.b, 0.0);
        let mut pixels: Vec<Vec<Vec4>> = vec![row.iter().chain(row).map(vector).collect()];
        while let Some(finer) = pixels.last().filter(|finer| finer.len() > 4 * FEWEST) {
            let mean = |two: &[Vec4]| two.iter().sum::<Vec4>() * 0.5;
            let coarser = finer.chunks_exact(2).map(mean).collect();
            pixels.push(coarser);
        }
        Band {
            sin,
            cos,
            solid_angle: solid_angle(y as u32, source.width, source.height),
            pixels,
        }
    }
}

/// A row that is made.
struct Row {
    sin: f64,
    cos: f64,
    columns: usize,
    /// The binary logarithm of how many columns are taken as one.
    together: u32,
}

impl Row {
    fn new(y: u32, (width, height): (u32, u32), lobe: &Lobe) -> Row {
        let (sin, cos) = colatitude(f64::from(y) + 0.5, height);
        // What counts for the row reaches farther from the pole than the row itself: its pixels, too, are to be small.
        let from_pole = libm::acos(cos.abs()) + 0.6 * libm::acos(lobe.cos_end());
        let mut together = 0;
        while (width as usize >> together) > FEWEST
            && f64::from(2 << together) * libm::sin(from_pole.min(FRAC_PI_2)) <= 1.0
        {
            together += 1;
        }
        Row {
            sin,
            cos,
            columns: width as usize >> together,
            together,
        }
    }

    /// The mean of the lobe about each pixel. `cosines` are those of all multiples of half a column of the source.
    fn filtered(&self, bands: &[Band], cosines: &[f64], lobe: &Lobe) -> Vec<Vec4> {
        let mut row = vec![Vec4::ZERO; self.columns];
        let mut weight = 0.0;
        for band in bands {
            let Some(pixels) = band.pixels.get(self.together as usize) else {
                continue;
            };
            let columns = pixels.len() / 2;
            let step = columns / self.columns;
            let Some((first, weights)) = self.weights(band, columns, cosines, lobe) else {
                continue;
            };
            weight += weights.iter().copied().map(f64::from).sum::<f64>();
            // Four pixels at once: their sums do not wait for each other.
            for (at, four) in row.chunks_exact_mut(4).enumerate() {
                let [a, b, c, d] = [0, 1, 2, 3].map(|n| {
                    let from = ((at * 4 + n) * step) as i64 + first;
                    let from = from.rem_euclid(columns as i64) as usize;
                    pixels.get(from..from + weights.len()).unwrap_or_default()
                });
                let mut sums = [Vec4::ZERO; 4];
                for ((((w, a), b), c), d) in weights.iter().zip(a).zip(b).zip(c).zip(d) {
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
        row.iter().map(|sum| *sum * normal).collect()
    }

    /// How much neighbouring pixels of a band of so many columns count for a pixel of this row, and where the first of
    /// them lies: in columns from the first one that the pixel itself covers. `None` where the lobe does not reach the band.
    fn weights(
        &self,
        band: &Band,
        columns: usize,
        cosines: &[f64],
        lobe: &Lobe,
    ) -> Option<(i64, Vec<f32>)> {
        let (level, slant) = (self.cos * band.cos, self.sin * band.sin);
        let cos_reach = (lobe.cos_end() - level) / slant;
        if cos_reach >= 1.0 {
            return None;
        }
        let step = columns / self.columns;
        let column_angle = TAU / columns as f64;
        let reach = (libm::acos(cos_reach.max(-1.0)) / column_angle) as usize + 1;
        let (first, count) = match 2 * reach + step {
            all if all >= columns => (0, columns),
            some => (-(reach as i64), some),
        };
        let weight = |n: usize| {
            // From the pixel's middle, in half columns of the source.
            let off = (2 * (first + n as i64) - (step as i64 - 1)) << self.together;
            let off = off.rem_euclid(cosines.len() as i64) as usize;
            let cos = cosines.get(off).copied().unwrap_or_default();
            (lobe.weight(level + slant * cos) * band.solid_angle) as f32
        };
        Some((first, (0..count).map(weight).collect()))
    }
}

/// A row of `2^together` times as many columns, linear between the ones that are there.
fn widened(row: &[Vec4], together: u32) -> Vec<Rgb> {
    let times = 1 << together;
    let pixel = |column: usize| {
        // Where its middle lies among the middles of the row's pixels; one farther, to stay above zero.
        let place = (column as f32 + 0.5) / times as f32 + 0.5;
        let left = place as usize;
        let at = |index: usize| row.get((index + row.len() - 1) % row.len());
        let [left_pixel, right_pixel] =
            [at(left), at(left + 1)].map(|pixel| pixel.copied().unwrap_or_default());
        let mix = left_pixel + (right_pixel - left_pixel) * (place - left as f32);
        Rgb::new(mix.x, mix.y, mix.z)
    };
    (0..row.len() * times).map(pixel).collect()
}
