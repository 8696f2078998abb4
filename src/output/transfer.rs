//! Display light to the whole numbers of a file, sRGB-encoded.

use crate::color::linear_to_srgb;
use std::sync::LazyLock;

/// The least light of each code from 1 to 255: a power function for every channel of every pixel would take longer than
/// some renders.
static LEAST_LIGHT: LazyLock<[f32; 255]> =
    LazyLock::new(|| std::array::from_fn(|before| least_light_of(before as f32 + 1.0)));

/// The code of the darkest of all lights that share their upper 16 bits, from black to white. The others have it too, or
/// the next: they are at most 1/128 brighter, and no code spans less than 1/112.
static FIRST_CODE: LazyLock<Vec<u8>> = LazyLock::new(|| {
    let darkest = (0..=1.0f32.to_bits() >> 16).map(|upper| f32::from_bits(upper << 16));
    let code = |light| LEAST_LIGHT.partition_point(|&least| least <= light) as u8;
    darkest.map(code).collect()
});

/// Found by halving: positive numbers stand in the order of their bits.
fn least_light_of(code: f32) -> f32 {
    let (mut below, mut reaches) = (0.0f32.to_bits(), 1.0f32.to_bits());
    while reaches - below > 1 {
        let between = below + (reaches - below) / 2;
        if rounded_code(f32::from_bits(between)) < code {
            below = between;
        } else {
            reaches = between;
        }
    }
    f32::from_bits(reaches)
}

fn rounded_code(light: f32) -> f32 {
    (linear_to_srgb(light) * 255.0).round()
}

/// The nearest 8-bit sRGB code of linear light in 0..1; what is no number is black.
pub(super) fn srgb_code_8(light: f32) -> u8 {
    let Some(&first) = FIRST_CODE.get((light.to_bits() >> 16) as usize) else {
        return 0;
    };
    let next = LEAST_LIGHT.get(usize::from(first));
    first + u8::from(next.is_some_and(|&least| least <= light))
}

/// The nearest 16-bit sRGB code of linear light in 0..1; what is no number is black.
pub(super) fn srgb_code_16(light: f32) -> u16 {
    (linear_to_srgb(light) * 65535.0).round() as u16
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_rounds_as_the_formula_does_at_every_step() {
        for (before, &least) in LEAST_LIGHT.iter().enumerate() {
            let around = -40..=40;
            for bits in around.filter_map(|away| least.to_bits().checked_add_signed(away)) {
                let light = f32::from_bits(bits);
                assert_eq!(
                    f32::from(srgb_code_8(light)),
                    rounded_code(light),
                    "{before} {light}"
                );
            }
        }
    }

    #[test]
    fn the_table_rounds_as_the_formula_does_in_between() {
        for step in 0..=100_000 {
            let light = step as f32 / 100_000.0;
            assert_eq!(f32::from(srgb_code_8(light)), rounded_code(light));
        }
    }

    #[test]
    fn the_ends_are_black_and_white() {
        assert_eq!([0.0, f32::NAN, 1.0].map(srgb_code_8), [0, 0, 255]);
        assert_eq!([0.0, f32::NAN, 1.0].map(srgb_code_16), [0, 0, 65535]);
    }
}
