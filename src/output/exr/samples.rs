//! The numbers of a line, as the file keeps them.

use super::Channel;
use crate::film::{Film, Layer, Precision};
use crate::output::rows::row;
use exr::prelude::f16;

/// The greatest number that 16 bits hold.
const HALF_MAX: f32 = 65504.0;

/// Row `y`: channel after channel, in the machine's byte order, as crate `exr` takes it.
pub(super) fn line(film: &Film, channels: &[Channel], y: usize) -> Vec<u8> {
    let rows: Vec<Vec<f32>> = film
        .layers
        .iter()
        .map(|layer| storable(row(film, layer, y), layer))
        .collect();
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

/// The values of a row as numbers that the layer's precision can hold: no reader likes an infinity.
fn storable(values: &[f32], layer: &Layer) -> Vec<f32> {
    let mut values: Vec<f32> = values.iter().copied().map(finite).collect();
    if layer.precision == Precision::Half {
        for pixel in values.chunks_mut(layer.channels.len().max(1)) {
            fit(pixel, layer.channels);
        }
    }
    values
}

/// Zero for what is no number, the greatest number for infinity.
fn finite(value: f32) -> f32 {
    if value.is_nan() {
        0.0
    } else {
        value.clamp(f32::MIN, f32::MAX)
    }
}

/// Scales what is too bright for a half down, all channels but alpha together: the colour stays.
fn fit(pixel: &mut [f32], channels: &[&str]) {
    let is_light = |channel: &&str| *channel != "A";
    let lights = pixel.iter().zip(channels).filter(|(_, c)| is_light(c));
    let greatest = lights.fold(0.0, |greatest: f32, (value, _)| greatest.max(value.abs()));
    if greatest > HALF_MAX {
        let factor = HALF_MAX / greatest;
        let lights = pixel.iter_mut().zip(channels);
        for (value, _) in lights.filter(|(_, c)| is_light(c)) {
            *value *= factor;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::BEAUTY;

    #[test]
    fn what_a_half_cannot_hold_is_scaled_down_with_its_colour() {
        let bright = [131008.0, 65504.0, 0.0, 1.0];
        let fitted = storable(&bright, &BEAUTY);
        assert_eq!(fitted, [65504.0, 32752.0, 0.0, 1.0]);
        assert_eq!(storable(&fitted, &BEAUTY), fitted);
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
            let stored = storable(&[value, 1.0, -2.0, 1.0], &BEAUTY);
            assert!(
                stored.iter().all(|v| f16::from_f32(*v).is_finite()),
                "{value}"
            );
        }
    }
}
