//! The numbers of a line, as the file keeps them.

use super::Channel;
use crate::film::{Film, Layer, Precision, Quantity};
use crate::output::rows::row;
use exr::prelude::f16;

/// The greatest number that 16 bits hold.
const HALF_MAX: f32 = 65504.0;

/// Row `y`: channel after channel, in the machine's byte order, as crate `exr` takes it.
pub(super) fn line(film: &Film, channels: &[Channel], y: usize) -> Vec<u8> {
    let rows = film.layers.iter().map(|layer| row(film, layer, y));
    let rows = storable(&film.layers, rows.collect());
    let mut bytes = Vec::new();
    for channel in channels {
        let (Some(layer), Some(values)) = (film.layers.get(channel.layer), rows.get(channel.layer))
        else {
            continue;
        };
        let values = values
            .iter()
            .skip(channel.component)
            .step_by(layer.channels.len());
        match channel.precision {
            Precision::Half => {
                bytes.extend(values.flat_map(|&value| f16::from_f32(value).to_ne_bytes()));
            }
            Precision::Float => bytes.extend(values.flat_map(|value| value.to_ne_bytes())),
        }
    }
    bytes
}

/// The values of a row, layer by layer, as numbers that the layers' precision can hold: no reader likes an infinity.
fn storable(layers: &[Layer], rows: Vec<&[f32]>) -> Vec<Vec<f32>> {
    let finite_row = |row: &[f32]| row.iter().copied().map(finite).collect();
    let mut rows: Vec<Vec<f32>> = rows.into_iter().map(finite_row).collect();
    let (mut light, mut others) = (Vec::new(), Vec::new());
    let halves = layers.iter().zip(&mut rows);
    for (layer, row) in halves.filter(|(layer, _)| layer.precision == Precision::Half) {
        match layer.quantity {
            Quantity::Light | Quantity::Part(_) => light.push((layer, row)),
            _ => others.push((layer, row)),
        }
    }
    // The beauty and its parts by one factor a pixel: they still add up.
    fit(&mut light);
    for other in others {
        fit(&mut [other]);
    }
    rows
}

/// Zero for what is no number, the greatest number for infinity.
fn finite(value: f32) -> f32 {
    if value.is_nan() {
        0.0
    } else {
        value.clamp(f32::MIN, f32::MAX)
    }
}

/// Scales what is too great for a half down, pixel by pixel, all layers and all channels but alpha together: the colour
/// stays.
fn fit(layers: &mut [(&Layer, &mut Vec<f32>)]) {
    let too_great = |row: &Vec<f32>| row.iter().any(|value| value.abs() > HALF_MAX);
    if !layers.iter().any(|(_, row)| too_great(row)) {
        return;
    }
    let mut greatest: Vec<f32> = Vec::new();
    each_light(layers, |pixel, value| {
        if greatest.len() <= pixel {
            greatest.resize(pixel + 1, 0.0);
        }
        if let Some(greatest) = greatest.get_mut(pixel) {
            *greatest = greatest.max(value.abs());
        }
    });
    each_light(layers, |pixel, value| {
        let greatest = greatest.get(pixel).copied().unwrap_or(0.0);
        if greatest > HALF_MAX {
            *value *= HALF_MAX / greatest;
        }
    });
}

/// Does `f` to every value but alpha, with the number of its pixel.
fn each_light(layers: &mut [(&Layer, &mut Vec<f32>)], mut f: impl FnMut(usize, &mut f32)) {
    for (layer, row) in layers {
        let pixels = row.chunks_mut(layer.channels.len().max(1));
        for (number, pixel) in pixels.enumerate() {
            let lights = pixel.iter_mut().zip(layer.channels);
            for (value, _) in lights.filter(|(_, channel)| **channel != "A") {
                f(number, value);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::BEAUTY;
    use std::borrow::Cow;

    fn stored(values: &[f32]) -> Vec<f32> {
        storable(&[BEAUTY], vec![values]).concat()
    }

    #[test]
    fn what_a_half_cannot_hold_is_scaled_down_with_its_colour() {
        let bright = [131008.0, 65504.0, 0.0, 1.0];
        let fitted = stored(&bright);
        assert_eq!(fitted, [65504.0, 32752.0, 0.0, 1.0]);
        assert_eq!(stored(&fitted), fitted);
    }

    #[test]
    fn parts_are_scaled_down_with_the_whole_and_pixels_by_themselves() {
        let part = |number| Layer {
            name: Cow::Borrowed("part"),
            quantity: Quantity::Part(number),
            channels: &["R", "G", "B"],
            ..BEAUTY
        };
        let layers = [BEAUTY, part(0), part(1)];
        // Of the second pixel only a part is too bright: the other takes light away, as filters may.
        let rows: [&[f32]; 3] = [
            &[131008.0, 4.0, 0.0, 1.0, 8.0, 6.0, 2.0, 0.5],
            &[100000.0, 3.0, 0.0, 131008.0, 5.0, 1.0],
            &[31008.0, 1.0, 0.0, -131000.0, 1.0, 1.0],
        ];
        let expected: [&[f32]; 3] = [
            &[65504.0, 2.0, 0.0, 1.0, 4.0, 3.0, 1.0, 0.5],
            &[50000.0, 1.5, 0.0, 65504.0, 2.5, 0.5],
            &[15504.0, 0.5, 0.0, -65500.0, 0.5, 0.5],
        ];
        assert_eq!(storable(&layers, rows.to_vec()), expected);
        // Another kind of layer changes none of them, nor they it.
        let albedo = Layer {
            quantity: Quantity::Samples,
            ..BEAUTY
        };
        let alone = storable(
            &[albedo, part(0)],
            vec![&[131008.0, 0.0, 0.0, 1.0], &[2.0; 3]],
        );
        assert_eq!(alone, [vec![65504.0, 0.0, 0.0, 1.0], vec![2.0; 3]]);
    }

    #[test]
    fn every_number_becomes_a_finite_half() {
        for value in [
            f32::NAN,
            f32::INFINITY,
            f32::NEG_INFINITY,
            f32::MAX,
            65519.0,
            65520.0,
        ] {
            let stored = stored(&[value, 1.0, -2.0, 1.0]);
            assert!(
                stored.iter().all(|v| f16::from_f32(*v).is_finite()),
                "{value}"
            );
        }
    }
}
