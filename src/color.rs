//! Linear light: Rec. 709 primaries, D65 white, no upper limit.

use std::ops::{Add, AddAssign, Mul, MulAssign, Sub, SubAssign};

/// A colour or an amount of light in linear Rec. 709.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Rgb {
    /// Red.
    pub r: f32,
    /// Green.
    pub g: f32,
    /// Blue.
    pub b: f32,
}

impl Rgb {
    /// No light.
    pub const BLACK: Rgb = Rgb::grey(0.0);
    /// One in every channel.
    pub const WHITE: Rgb = Rgb::grey(1.0);

    /// A colour from its channels.
    pub const fn new(r: f32, g: f32, b: f32) -> Rgb {
        Rgb { r, g, b }
    }

    /// The same amount in every channel.
    pub const fn grey(value: f32) -> Rgb {
        Rgb::new(value, value, value)
    }

    /// Relative luminance `Y` (ITU-R BT.709-6, item 3.2).
    pub fn luminance(self) -> f32 {
        0.2126 * self.r + 0.7152 * self.g + 0.0722 * self.b
    }

    /// The greatest channel.
    pub fn max_component(self) -> f32 {
        self.r.max(self.g).max(self.b)
    }

    /// Each channel by itself through `f`.
    pub fn map(self, f: impl Fn(f32) -> f32) -> Rgb {
        Rgb::new(f(self.r), f(self.g), f(self.b))
    }

    /// Each channel of both by themselves through `f`.
    pub fn by_channel(self, other: Rgb, f: impl Fn(f32, f32) -> f32) -> Rgb {
        Rgb::new(f(self.r, other.r), f(self.g, other.g), f(self.b, other.b))
    }

    /// `self` at `share` 0, `other` at 1.
    pub fn mix(self, other: Rgb, share: f32) -> Rgb {
        self * (1.0 - share) + other * share
    }

    /// Whether every channel is a finite number.
    pub fn is_finite(self) -> bool {
        self.r.is_finite() && self.g.is_finite() && self.b.is_finite()
    }
}

impl From<[f32; 3]> for Rgb {
    fn from([r, g, b]: [f32; 3]) -> Rgb {
        Rgb::new(r, g, b)
    }
}

impl From<Rgb> for [f32; 3] {
    fn from(color: Rgb) -> [f32; 3] {
        [color.r, color.g, color.b]
    }
}

impl Add for Rgb {
    type Output = Rgb;
    fn add(self, other: Rgb) -> Rgb {
        Rgb::new(self.r + other.r, self.g + other.g, self.b + other.b)
    }
}

impl AddAssign for Rgb {
    fn add_assign(&mut self, other: Rgb) {
        *self = *self + other;
    }
}

impl Sub for Rgb {
    type Output = Rgb;
    fn sub(self, other: Rgb) -> Rgb {
        Rgb::new(self.r - other.r, self.g - other.g, self.b - other.b)
    }
}

impl SubAssign for Rgb {
    fn sub_assign(&mut self, other: Rgb) {
        *self = *self - other;
    }
}

impl Mul for Rgb {
    type Output = Rgb;
    fn mul(self, other: Rgb) -> Rgb {
        Rgb::new(self.r * other.r, self.g * other.g, self.b * other.b)
    }
}

impl Mul<f32> for Rgb {
    type Output = Rgb;
    fn mul(self, factor: f32) -> Rgb {
        Rgb::new(self.r * factor, self.g * factor, self.b * factor)
    }
}

impl MulAssign<f32> for Rgb {
    fn mul_assign(&mut self, factor: f32) {
        *self = *self * factor;
    }
}

/// The sRGB transfer function, display value in 0..1 to linear light (IEC 61966-2-1).
pub fn srgb_to_linear(value: f32) -> f32 {
    if value <= 0.04045 {
        value / 12.92
    } else {
        libm::powf((value + 0.055) / 1.055, 2.4)
    }
}

/// Its inverse, linear light in 0..1 to display value (IEC 61966-2-1).
pub fn linear_to_srgb(value: f32) -> f32 {
    if value <= 0.003_130_8 {
        value * 12.92
    } else {
        1.055 * libm::powf(value, 1.0 / 2.4) - 0.055
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn middle_grey_is_118_in_eight_bits() {
        assert_eq!((linear_to_srgb(0.18) * 255.0).round(), 118.0);
    }

    #[test]
    fn the_transfer_functions_undo_each_other() {
        for step in 0..=255 {
            let display = step as f32 / 255.0;
            assert!((linear_to_srgb(srgb_to_linear(display)) - display).abs() < 1e-6);
        }
    }

    #[test]
    fn white_has_luminance_one() {
        assert!((Rgb::WHITE.luminance() - 1.0).abs() < 1e-6);
    }
}
