//! Heat maps: one number a pixel, as a picture with its scale.

use crate::study::plot::{Ink, Raster, Side, engineering, raster};
use std::io;

/// Nathaniel Smith and Stéfan van der Walt's map "inferno", even to the eye and to those who see fewer colours, as Matt
/// Zucker's polynomial of degree six in 0..1 for red, green and blue, lowest power first (2019, "fitting polynomials to
/// matplotlib colormaps", both CC0).
const INFERNO: [[f64; 3]; 7] = [
    [
        0.0002189403691192265,
        0.001651004631001012,
        -0.01948089843709184,
    ],
    [0.1065134194856116, 0.5639564367884091, 3.932712388889277],
    [11.60249308247187, -3.972853965665698, -15.9423941062914],
    [-41.70399613139459, 17.43639888205313, 44.35414519872813],
    [77.162935699427, -33.40235894210092, -81.80730925738993],
    [-71.31942824499214, 32.62606426397723, 73.20951985803202],
    [25.13112622477341, -12.24266895238567, -23.07032500287172],
];

/// No colour of the map: values that are no number, and such as are missing.
const UNKNOWN: [u8; 3] = [0x6f, 0x86, 0x8c];

/// Around the picture: dark, as the map's low end is.
const FRAME: [u8; 3] = [0x14, 0x14, 0x1a];
const BRIGHT: Ink = Ink::Rgb([0xee, 0xee, 0xf0]);
const DIM: Ink = Ink::Rgb([0xb4, 0xb6, 0xbe]);

/// Pictures less wide than this have no room for a scale, and are enlarged by whole factors.
const MIN_WIDTH: u32 = 480;

/// A larger side is beyond what a page shows: of such a picture every second, third or so pixel is kept.
const MAX_SIDE: u32 = 4096;

/// A PNG of `values`, row by row from the top, over a scale from zero to `greatest`. Maps to be compared share one
/// `greatest`; `title` says what was counted, and its unit.
///
/// Values past the scale take the colour of its end. Grey is what is no number or missing.
///
/// # Errors
///
/// The encoder refuses, which it has no reason to do.
pub fn heat_map(
    values: &[f32],
    width: u32,
    height: u32,
    title: &str,
    greatest: f32,
) -> io::Result<Vec<u8>> {
    let greatest = if greatest.is_finite() && greatest > 0.0 {
        greatest
    } else {
        1.0
    };
    let every = width.max(height).div_ceil(MAX_SIDE).max(1);
    let times = MIN_WIDTH.div_ceil(width.max(1)).min(MIN_WIDTH);
    let (across, down) = (
        width.div_ceil(every) * times,
        height.div_ceil(every) * times,
    );
    let down = down.min(MAX_SIDE);
    let value = |x: u32, y: u32| -> Option<f32> {
        let (x, y) = (x / times * every, y / times * every);
        let index = u64::from(y) * u64::from(width) + u64::from(x);
        values.get(usize::try_from(index).ok()?).copied()
    };
    let mut rgb = Vec::new();
    for y in 0..down {
        for x in 0..across {
            rgb.extend(color(value(x, y), greatest));
        }
    }
    let strip = strip(across.max(MIN_WIDTH), title, greatest);
    strip.below(across, down, &rgb, UNKNOWN).png()
}

/// What a value looks like.
fn color(value: Option<f32>, greatest: f32) -> [u8; 3] {
    match value {
        Some(value) if !value.is_nan() => inferno(f64::from(value / greatest).clamp(0.0, 1.0)),
        _ => UNKNOWN,
    }
}

/// The map's colour at `t`, 0..1, as sRGB.
fn inferno(t: f64) -> [u8; 3] {
    [0, 1, 2].map(|channel| {
        let value = INFERNO
            .iter()
            .rev()
            .fold(0.0, |sum, powers| sum * t + powers[channel]);
        (value.clamp(0.0, 1.0) * 255.0).round() as u8
    })
}

/// Title, bar and numbers, `width` pixels wide, with letters that grow with it.
fn strip(width: u32, title: &str, greatest: f32) -> Raster {
    // The canvas counts two pixels to a unit.
    let (width, height) = (f64::from(width) / 2.0, f64::from(strip_height(width)) / 2.0);
    let em = height / 5.0;
    let (left, right) = (0.9 * em, width - 0.9 * em);
    raster(width, height, |canvas| {
        canvas.rectangle((0.0, 0.0), (width, height), Ink::Rgb(FRAME));
        canvas.text(title, (left, 1.5 * em), em, BRIGHT, Side::Start);
        let steps = 256;
        let at = |step: i32| left + (right - left) * f64::from(step) / f64::from(steps);
        for step in 0..steps {
            let ink = Ink::Rgb(inferno((f64::from(step) + 0.5) / f64::from(steps)));
            canvas.rectangle((at(step), 2.1 * em), (at(step + 1), 3.0 * em), ink);
        }
        let sides = [
            Side::Start,
            Side::Middle,
            Side::Middle,
            Side::Middle,
            Side::End,
        ];
        for (quarter, side) in sides.into_iter().enumerate() {
            let part = quarter as f64 / 4.0;
            let label = engineering(part * f64::from(greatest), "", 3);
            let place = (left + part * (right - left), 4.25 * em);
            canvas.text(&label, place, 0.92 * em, DIM, side);
        }
    })
}

/// Of the strip with the scale below a picture of this width, in pixels.
fn strip_height(width: u32) -> u32 {
    width / 6
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Relative luminance of sRGB's codes.
    fn luminance([r, g, b]: [u8; 3]) -> f64 {
        let linear = |code: u8| libm::pow(f64::from(code) / 255.0, 2.2);
        0.2126 * linear(r) + 0.7152 * linear(g) + 0.0722 * linear(b)
    }

    #[test]
    fn more_is_brighter_along_the_whole_map() {
        let along: Vec<f64> = (0..=64)
            .map(|i| luminance(inferno(f64::from(i) / 64.0)))
            .collect();
        assert!(along.windows(2).all(|pair| pair[0] < pair[1]), "{along:?}");
    }

    #[test]
    fn the_ends_are_matplotlibs() {
        // Its table begins with (0, 0, 4) and ends with (252, 255, 164).
        for (found, expected) in inferno(0.0)
            .into_iter()
            .chain(inferno(1.0))
            .zip([0, 0, 4, 252, 255, 164])
        {
            assert!(
                i32::from(found).abs_diff(expected) <= 6,
                "{found} {expected}"
            );
        }
    }

    #[test]
    fn maps_with_one_greatest_give_one_value_one_colour() {
        assert_eq!(color(Some(5.0), 10.0), inferno(0.5));
        assert_eq!(color(Some(50.0), 10.0), inferno(1.0));
        assert_eq!(color(Some(f32::INFINITY), 10.0), inferno(1.0));
        assert_eq!(color(Some(f32::NAN), 10.0), UNKNOWN);
        assert_eq!(color(None, 10.0), UNKNOWN);
    }

    /// Width and height, as the file's header says.
    fn sides(png: &[u8]) -> (u32, u32) {
        let number = |at: usize| {
            png[at..at + 4]
                .iter()
                .fold(0, |sum, byte| sum * 256 + u32::from(*byte))
        };
        (number(16), number(20))
    }

    #[test]
    fn small_pictures_are_enlarged_and_odd_ones_still_become_a_file() -> io::Result<()> {
        let map = |values: &[f32], width, height, greatest| {
            heat_map(values, width, height, "nodes", greatest)
        };
        assert_eq!(sides(&map(&[1.0; 64 * 48], 64, 48, 1.0)?), (512, 384 + 85));
        assert_eq!(sides(&map(&[1.0; 640 * 2], 640, 2, 1.0)?), (640, 2 + 106));
        assert_eq!(sides(&map(&[], 0, 0, f32::NAN)?), (480, 80));
        assert_eq!(sides(&map(&[1.0], 1, u32::MAX, 0.0)?).0, 480);
        Ok(())
    }
}
