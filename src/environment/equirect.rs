//! A picture of all directions: longitude across, latitude down.

use crate::color::Rgb;
use glam::{DVec3, Vec3};
use rayon::prelude::*;
use std::f32::consts::FRAC_1_PI;
use std::f64::consts::PI;

/// No radiance counts as more: a sum over a whole picture stays a finite number, and the sun itself has less.
const BRIGHTEST: f32 = 1e10;

/// Radiance from every direction, in the paper's units of light: a white matt surface in an environment of radiance 1
/// everywhere shows 1.
///
/// Rows go from +Y down to -Y and columns once about +Y, as one sees them from inside: the middle column is +X, and
/// right of it, after a quarter of the width, is +Z (as in three.js and model-viewer). A pixel is what comes from all
/// of its solid angle, on average.
#[derive(Clone, Debug, PartialEq)]
pub struct Equirect {
    /// Columns, above zero.
    pub width: u32,
    /// Rows, above zero.
    pub height: u32,
    /// `width * height` of them, top row first.
    pub pixels: Vec<Rgb>,
}

impl Equirect {
    /// A picture of what `radiance` says of each pixel's middle, a unit vector.
    pub(super) fn of(width: u32, height: u32, radiance: impl Fn(Vec3) -> Rgb + Sync) -> Equirect {
        let longitudes = longitudes(width);
        let row = |y: u32| {
            let (sin, cos) = colatitude(f64::from(y) + 0.5, height);
            let direction = |&(x, z): &(f64, f64)| DVec3::new(x * sin, cos, z * sin).as_vec3();
            longitudes.iter().map(direction).map(&radiance).collect()
        };
        let rows: Vec<Vec<Rgb>> = (0..height).into_par_iter().map(row).collect();
        Equirect {
            width,
            height,
            pixels: rows.concat(),
        }
    }

    /// The same, with numbers that light can have. A picture without pixels is black, and so are pixels that lack.
    pub(super) fn sound(&self) -> Equirect {
        let count = self.width as usize * self.height as usize;
        if count == 0 {
            return Equirect {
                width: 1,
                height: 1,
                pixels: vec![Rgb::BLACK],
            };
        }
        // False where there is no number.
        let is_light = |value: f32| value > 0.0;
        let sound_value = |value: f32| {
            if is_light(value) {
                value.min(BRIGHTEST)
            } else {
                0.0
            }
        };
        let sound = |pixel: &Rgb| pixel.map(sound_value);
        let mut pixels: Vec<Rgb> = self.pixels.iter().take(count).map(sound).collect();
        pixels.resize(count, Rgb::BLACK);
        Equirect { pixels, ..*self }
    }

    /// The rows, from the top.
    pub(super) fn rows(&self) -> impl DoubleEndedIterator<Item = &[Rgb]> {
        self.pixels.chunks_exact(self.width.max(1) as usize)
    }

    /// The same light in a picture of another size: each pixel is the mean over its solid angle, so that no energy is
    /// lost, also where the sizes are no multiples of each other.
    pub fn resized(&self, width: u32, height: u32) -> Equirect {
        if (width, height) == (self.width, self.height) {
            return self.clone();
        }
        let across = shares(self.width, width, |x, of| f64::from(x) / f64::from(of));
        // The solid angle of a band goes with the difference of the cosines at its edges.
        let down = shares(self.height, height, |y, of| -colatitude(y.into(), of).1);
        let narrowed: Vec<Vec<Rgb>> = self
            .pixels
            .par_chunks(self.width.max(1) as usize)
            .map(|row| {
                across
                    .iter()
                    .map(|of| of.mean(|x| row.get(x).copied()))
                    .collect()
            })
            .collect();
        let row = |of: &Shares| -> Vec<Rgb> {
            let pixel = |x: usize| of.mean(|y| narrowed.get(y)?.get(x).copied());
            (0..width as usize).map(pixel).collect()
        };
        let rows: Vec<Vec<Rgb>> = down.par_iter().map(row).collect();
        Equirect {
            width,
            height,
            pixels: rows.concat(),
        }
    }
}

/// Which pixels of a line a wider one covers, and how much of each.
struct Shares {
    first: usize,
    /// Their sum is 1.
    shares: Vec<f32>,
}

impl Shares {
    fn mean(&self, pixel: impl Fn(usize) -> Option<Rgb>) -> Rgb {
        let mut mean = Rgb::BLACK;
        for (at, share) in self.shares.iter().enumerate() {
            mean += pixel(self.first + at).unwrap_or_default() * *share;
        }
        mean
    }
}

/// What each of `to` pixels covers of `from` pixels of the same line, whose edges lie where `edge` says: it rises with
/// its first argument, up to its second.
fn shares(from: u32, to: u32, edge: impl Fn(u32, u32) -> f64) -> Vec<Shares> {
    let mut first = 0;
    let of_pixel = |at: u32| {
        let (low, high) = (edge(at, to), edge(at + 1, to));
        while first + 1 < from && edge(first + 1, from) <= low {
            first += 1;
        }
        let covered = |source: u32| edge(source + 1, from).min(high) - edge(source, from).max(low);
        let lengths: Vec<f64> = (first..from)
            .map(covered)
            .take_while(|&l| l > 0.0)
            .collect();
        let all: f64 = lengths.iter().sum();
        Shares {
            first: first as usize,
            shares: lengths.iter().map(|length| (length / all) as f32).collect(),
        }
    };
    (0..to).map(of_pixel).collect()
}

/// The sine and the cosine of the colatitude (the angle from +Y) `row` rows below the top of `height`; row 0 reaches
/// from 0 to 1.
pub(super) fn colatitude(row: f64, height: u32) -> (f64, f64) {
    let angle = PI * row / f64::from(height);
    (libm::sin(angle), libm::cos(angle))
}

/// The solid angle of each pixel of a row, in steradians.
pub(super) fn solid_angle(row: u32, width: u32, height: u32) -> f64 {
    let cos = |row: u32| colatitude(row.into(), height).1;
    2.0 * PI / f64::from(width) * (cos(row) - cos(row + 1))
}

/// Where the middles of columns lie about +Y: the cosine along +X, and the sine along +Z.
pub(super) fn longitudes(width: u32) -> Vec<(f64, f64)> {
    let longitude = |x: u32| PI * ((2.0 * f64::from(x) + 1.0) / f64::from(width) - 1.0);
    let of_column = |x| (libm::cos(longitude(x)), libm::sin(longitude(x)));
    (0..width).map(of_column).collect()
}

/// Where a direction lies in a picture, (0, 0) being the upper left corner and (1, 1) the lower right one.
pub(super) fn position(direction: Vec3) -> (f32, f32) {
    let Vec3 { x, y, z } = direction;
    let longitude = libm::atan2f(z, x);
    // As exact at the poles as elsewhere, which an arc cosine is not.
    let colatitude = libm::atan2f((x * x + z * z).sqrt(), y);
    (longitude * FRAC_1_PI * 0.5 + 0.5, colatitude * FRAC_1_PI)
}
