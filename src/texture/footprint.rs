//! What of a texture a ray sees.

use glam::Vec2;

/// The ellipse that a ray sees of a texture, around the point that it meets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Footprint {
    /// Two diameters, in texture coordinates: of the circle that was stretched to the ellipse they were square to each other.
    pub axes: [Vec2; 2],
}

/// Where a texture is looked up for a footprint.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Taps {
    /// How many lookups, side by side.
    pub(super) count: u32,
    /// From one to the next, in texture coordinates.
    pub(super) step: Vec2,
    /// The binary logarithm of how many pixels across each of them averages: the level of the pyramid, 0 being the image
    /// itself.
    pub(super) level: f32,
}

impl Taps {
    /// The very point, in the image itself.
    pub(super) const POINT: Taps = Taps {
        count: 1,
        step: Vec2::ZERO,
        level: 0.0,
    };

    /// How much of what one sees is a mean of many pixels, 0..1: the share of the pyramid's levels in it.
    pub fn blurred(&self) -> f32 {
        self.level.clamp(0.0, 1.0)
    }
}

/// The most lookups for one footprint: a longer one is blurred. As graphics cards have it.
const MOST_TAPS: f32 = 16.0;

impl Footprint {
    /// The very point that the ray meets.
    pub const POINT: Footprint = Footprint {
        axes: [Vec2::ZERO; 2],
    };

    /// The lookups in an image of `width x height` pixels: side by side along the longer axis, each as wide as the shorter
    /// one (Heckbert 1989, "Fundamentals of Texture Mapping and Image Warping", has the ellipse; McCormack et al. 1999,
    /// "Feline: Fast Elliptical Lines for Anisotropic Texture Mapping", the lookups along a line).
    pub fn taps(&self, width: u32, height: u32) -> Taps {
        let size = Vec2::new(width as f32, height as f32);
        let [a, b] = self.axes.map(|axis| axis * size);
        let (p, q, r) = (a.length_squared(), b.length_squared(), a.dot(b));
        // The point a cos x + b sin x is farthest where tan 2x = 2r / (p - q).
        let (across, along) = (p - q, 2.0 * r);
        let length = (across * across + along * along).sqrt();
        let [longest2, shortest2] = [0.5 * (p + q + length), 0.5 * (p + q - length)];
        if longest2 <= 1.0 {
            return Taps::POINT;
        }
        if !longest2.is_finite() {
            // All of the image.
            return Taps {
                level: f32::INFINITY,
                ..Taps::POINT
            };
        }
        let (longest, shortest) = (longest2.sqrt(), shortest2.max(1.0).sqrt());
        let ratio = longest / shortest;
        // One, as long as it is less than half as long again as wide.
        let count = (ratio - 0.5).ceil().clamp(1.0, MOST_TAPS);
        let level = libm::log2f((longest / count).max(shortest));
        let (cos_2x, sin_2x) = (across / length, along / length);
        let cos_x = (0.5 * (1.0 + cos_2x)).max(0.0).sqrt();
        let sin_x = (0.5 * (1.0 - cos_2x)).max(0.0).sqrt().copysign(sin_2x);
        let [a, b] = self.axes;
        Taps {
            count: count as u32,
            step: (a * cos_x + b * sin_x) / count,
            level,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn taps(a: [f32; 2], b: [f32; 2]) -> Taps {
        let axes = [Vec2::from(a), Vec2::from(b)];
        Footprint { axes }.taps(1, 1)
    }

    #[test]
    fn up_to_a_pixel_the_image_itself_is_looked_up_once() {
        assert_eq!(taps([0.6, 0.8], [-0.8, 0.6]).level, 0.0);
        assert_eq!(taps([1.0, 0.0], [0.0, 0.1]).count, 1);
    }

    #[test]
    fn a_round_footprint_of_four_pixels_is_one_lookup_two_levels_up() {
        for axes in [[[4.0, 0.0], [0.0, 4.0]], [[2.4, 3.2], [-3.2, 2.4]]] {
            let taps = taps(axes[0], axes[1]);
            assert!(
                taps.count == 1 && (taps.level - 2.0).abs() < 1e-4,
                "{taps:?}"
            );
        }
    }

    #[test]
    fn a_long_footprint_is_looked_up_along_its_length() {
        // The same ellipse, 8 by 2, given by its axes and by two others.
        let half = 0.5f32.sqrt();
        let by_others = [[8.0 * half, 2.0 * half], [8.0 * half, -2.0 * half]];
        for [a, b] in [
            [[8.0, 0.0], [0.0, 2.0]],
            [[0.0, 2.0], [8.0, 0.0]],
            by_others,
        ] {
            let taps = taps(a, b);
            assert!(
                taps.count == 4 && (taps.level - 1.0).abs() < 1e-4,
                "{taps:?}"
            );
            assert!((taps.step.x.abs() - 2.0).abs() < 1e-4 && taps.step.y.abs() < 1e-3);
        }
    }

    #[test]
    fn the_longest_footprints_are_blurred_rather_than_sparse() {
        let taps = taps([64.0, 0.0], [0.0, 1.0]);
        assert!(
            taps.count == 16 && (taps.level - 2.0).abs() < 1e-4,
            "{taps:?}"
        );
    }

    #[test]
    fn a_footprint_out_of_this_world_is_all_of_the_image() {
        for x in [f32::NAN, f32::INFINITY, 3e38] {
            assert_eq!(taps([x, 0.0], [0.0, 1.0]).level, f32::INFINITY);
        }
    }
}
