//! The ideal mirror (Whitted 1980, "An Improved Illumination Model for Shaded Display").

use crate::color::Rgb;
use glam::Vec3;

/// The direction in which an ideal mirror sends on what travels along `d`: `r = d - 2 (d . n) n`. Keeps `d`'s length.
pub fn direction(d: Vec3, n: Vec3) -> Vec3 {
    d - n * (2.0 * d.dot(n))
}

/// Below this product of reflectivities a mirror ray could no longer change a picture, and none is sent.
pub const LEAST_ENERGY: f32 = 1.0 / 4096.0;

/// Whether a mirror ray of this energy is sent.
#[inline(always)]
pub fn matters(energy: Rgb) -> bool {
    energy.r >= LEAST_ENERGY || energy.g >= LEAST_ENERGY || energy.b >= LEAST_ENERGY
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_angle_out_is_the_angle_in() {
        assert_eq!(
            direction(Vec3::new(3.0, -4.0, 0.0), Vec3::Y),
            Vec3::new(3.0, 4.0, 0.0)
        );
        assert_eq!(direction(Vec3::NEG_Z, Vec3::Z), Vec3::Z);
    }
}
