//! What a texture shows at a point, and over a footprint.

use super::{Encoding, Filter, Footprint, Image, Pixels, Pyramid, Texture, Wrap};
use crate::color::srgb_to_linear;
use glam::{Vec2, Vec4};
use std::sync::LazyLock;

impl Texture {
    /// The linear colour and alpha at `uv`, (0, 0) being the upper left corner of the image.
    pub fn sample(&self, uv: Vec2) -> [f32; 4] {
        self.texel(&self.image, self.filter, uv).to_array()
    }

    /// The mean linear colour and alpha of what `footprint` covers around `uv`; where that is no more than a pixel, the
    /// bits of [`Texture::sample`]. `pyramid` is that of the image.
    pub fn sample_over(&self, pyramid: &Pyramid, uv: Vec2, footprint: &Footprint) -> [f32; 4] {
        let taps = footprint.taps(self.image.width, self.image.height);
        if taps.count == 1 {
            return self.at_level(pyramid, uv, taps.level).to_array();
        }
        let middle = (taps.count - 1) as f32 * 0.5;
        let mut sum = Vec4::ZERO;
        for tap in 0..taps.count {
            let uv = uv + taps.step * (tap as f32 - middle);
            sum += self.at_level(pyramid, uv, taps.level);
        }
        (sum / taps.count as f32).to_array()
    }

    /// The level of the pyramid that [`Texture::sample_over`] looks at, 0 for the image itself.
    pub fn level(&self, footprint: &Footprint) -> f32 {
        footprint.taps(self.image.width, self.image.height).level
    }

    /// Between the two levels of a pyramid that are nearest: 0 is the image itself.
    fn at_level(&self, pyramid: &Pyramid, uv: Vec2, level: f32) -> Vec4 {
        let level = level.min(pyramid.levels().len() as f32);
        if level <= 0.0 {
            return self.texel(&self.image, self.filter, uv);
        }
        let (below, share) = (level as usize, level - level.trunc());
        let at = |level: usize| match level.checked_sub(1) {
            None => self.texel(&self.image, self.filter, uv),
            // Only a pixel that is drawn large has hard edges.
            Some(index) => match pyramid.levels().get(index) {
                Some(image) => self.texel(image, Filter::Linear, uv),
                None => Vec4::ZERO,
            },
        };
        if share == 0.0 {
            return at(below);
        }
        at(below) * (1.0 - share) + at(below + 1) * share
    }

    /// The linear colour and alpha of one of the texture's images.
    fn texel(&self, image: &Image, filter: Filter, uv: Vec2) -> Vec4 {
        let bytes = |[r, g, b, a]: [u8; 4]| Vec4::new(r.into(), g.into(), b.into(), a.into());
        let words = |[r, g, b, a]: [u16; 4]| Vec4::new(r.into(), g.into(), b.into(), a.into());
        match (&image.pixels, self.encoding) {
            (Pixels::Eight(pixels), Encoding::Srgb) => {
                let linear = &*SRGB_TO_LINEAR;
                self.filtered((image, filter), uv, pixels, |[r, g, b, a]| {
                    let [r, g, b] = [linear[r as usize], linear[g as usize], linear[b as usize]];
                    Vec4::new(r, g, b, f32::from(a) / 255.0)
                })
            }
            (Pixels::Eight(pixels), Encoding::Linear) => {
                self.filtered((image, filter), uv, pixels, |texel| bytes(texel) / 255.0)
            }
            (Pixels::Sixteen(pixels), Encoding::Srgb) => {
                self.filtered((image, filter), uv, pixels, |texel| {
                    let [x, y, z, w] = (words(texel) / 65535.0).to_array();
                    Vec4::new(srgb_to_linear(x), srgb_to_linear(y), srgb_to_linear(z), w)
                })
            }
            (Pixels::Sixteen(pixels), Encoding::Linear) => {
                self.filtered((image, filter), uv, pixels, |texel| words(texel) / 65535.0)
            }
        }
    }

    /// The nearest pixel or the blend of the nearest four, each through `decode`.
    #[inline(always)]
    fn filtered<T: Copy + Default>(
        &self,
        (image, filter): (&Image, Filter),
        uv: Vec2,
        pixels: &[T],
        decode: impl Fn(T) -> Vec4,
    ) -> Vec4 {
        // A coordinate that is no number shows the first pixel; one too great to have a fraction shows any.
        let uv = if uv.is_nan() {
            Vec2::ZERO
        } else {
            uv.clamp(Vec2::splat(-1e9), Vec2::splat(1e9))
        };
        let (width, height) = (image.width, image.height);
        let (x, y) = (uv.x * width as f32, uv.y * height as f32);
        let column = |i| wrapped(i, width, self.wrap[0]);
        let row = |j| wrapped(j, height, self.wrap[1]) * width as usize;
        let texel = |at: usize| decode(pixels.get(at).copied().unwrap_or_default());
        match filter {
            Filter::Nearest => texel(row(floor(y)) + column(floor(x))),
            Filter::Linear => {
                // Pixel centres lie at halves.
                let (x, y) = (x - 0.5, y - 0.5);
                let (i, j) = (floor(x), floor(y));
                let (right_share, bottom_share) = (x - i as f32, y - j as f32);
                let within = |i: i64, size: u32| (0..i64::from(size) - 1).contains(&i);
                if within(i, width) && within(j, height) {
                    // No neighbour is across an edge: the same sums, but for what finds the pixels.
                    let (first, next) = (j as usize * width as usize + i as usize, width as usize);
                    let pair = |at: usize| match pixels.get(at..at + 2) {
                        Some(&[left, right]) => {
                            decode(left) * (1.0 - right_share) + decode(right) * right_share
                        }
                        _ => Vec4::ZERO,
                    };
                    let (top, bottom) = (pair(first), pair(first + next));
                    return top * (1.0 - bottom_share) + bottom * bottom_share;
                }
                let [left, right] = [column(i), column(i.saturating_add(1))];
                let across = |row| {
                    let (left, right) = (texel(row + left), texel(row + right));
                    left * (1.0 - right_share) + right * right_share
                };
                let (top, bottom) = (across(row(j)), across(row(j.saturating_add(1))));
                top * (1.0 - bottom_share) + bottom * bottom_share
            }
        }
    }
}

/// The greatest whole number that is not above `x`, a number that 64 bits can hold.
#[inline(always)]
fn floor(x: f32) -> i64 {
    let toward_zero = x as i64;
    toward_zero - i64::from(x < toward_zero as f32)
}

/// The linear light of every byte.
pub(super) static SRGB_TO_LINEAR: LazyLock<[f32; 256]> =
    LazyLock::new(|| std::array::from_fn(|byte| srgb_to_linear(byte as f32 / 255.0)));

/// The pixel that stands at position `i` of a row of `size`.
#[inline(always)]
fn wrapped(i: i64, size: u32, wrap: Wrap) -> usize {
    let size = i64::from(size).max(1);
    if (0..size).contains(&i) {
        return i as usize; // Every way of wrapping leaves it there.
    }
    let within = match wrap {
        Wrap::Repeat => i.rem_euclid(size),
        Wrap::ClampToEdge => i.clamp(0, size - 1),
        Wrap::MirroredRepeat => {
            let there_and_back = i.rem_euclid(2 * size);
            there_and_back.min(2 * size - 1 - there_and_back)
        }
    };
    within as usize
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texture::Fourth;
    use std::sync::Arc;

    fn two_by_one(wrap: Wrap, filter: Filter) -> Texture {
        let pixels = Pixels::Eight(vec![[0, 0, 0, 255], [255, 255, 255, 255]]);
        let image = Arc::new(Image {
            name: String::new(),
            width: 2,
            height: 1,
            pixels,
        });
        Texture {
            image,
            wrap: [wrap; 2],
            filter,
            mipmaps: true,
            encoding: Encoding::Linear,
        }
    }

    fn red(texture: &Texture, u: f32) -> f32 {
        texture.sample(Vec2::new(u, 0.5))[0]
    }

    #[test]
    fn linear_filtering_is_exact_at_centres_and_halfway() {
        let texture = two_by_one(Wrap::ClampToEdge, Filter::Linear);
        assert_eq!([0.25, 0.5, 0.75].map(|u| red(&texture, u)), [0.0, 0.5, 1.0]);
    }

    #[test]
    fn each_wrap_says_what_lies_outside() {
        let at = |wrap, u| red(&two_by_one(wrap, Filter::Nearest), u);
        assert_eq!(
            [at(Wrap::Repeat, 1.25), at(Wrap::Repeat, -0.25)],
            [0.0, 1.0]
        );
        assert_eq!(
            [
                at(Wrap::MirroredRepeat, 1.25),
                at(Wrap::MirroredRepeat, -0.25)
            ],
            [1.0, 0.0]
        );
        assert_eq!(
            [at(Wrap::ClampToEdge, 1.25), at(Wrap::ClampToEdge, -0.25)],
            [1.0, 0.0]
        );
    }

    /// A wave that goes round once, in a number of pixels that halves badly.
    fn wave(width: u32) -> Texture {
        let byte = |x: u32| {
            let turn = (x as f32 + 0.5) / width as f32 * std::f32::consts::TAU;
            (127.5 + 100.0 * libm::sinf(turn)).round() as u8
        };
        let pixels = Pixels::Eight((0..width * 3).map(|at| [byte(at % width); 4]).collect());
        let image = Arc::new(Image {
            name: String::new(),
            width,
            height: 3,
            pixels,
        });
        Texture {
            image,
            ..two_by_one(Wrap::Repeat, Filter::Linear)
        }
    }

    fn wide(pixels: f32, texture: &Texture) -> Footprint {
        let size = Vec2::new(texture.image.width as f32, texture.image.height as f32);
        Footprint {
            axes: [Vec2::X * pixels / size.x, Vec2::Y * pixels / size.y],
        }
    }

    #[test]
    fn a_texture_that_repeats_has_no_seam_at_any_size() {
        for width in [13, 16, 37, 100] {
            let texture = wave(width);
            let pyramid = Pyramid::of(&texture.image, Encoding::Linear, Fourth::Number);
            for pixels in [1.0, 1.5, 2.0, 3.0, 4.7, 6.0] {
                let footprint = wide(pixels, &texture);
                let at = |u: f32| texture.sample_over(&pyramid, Vec2::new(u, 0.5), &footprint)[0];
                // As smooth across the edge as the wave is steep: 0.4 of its turn in radians.
                let steps = (0..400).map(|i| (at(i as f32 / 200.0), at((i + 1) as f32 / 200.0)));
                let step = steps.fold(0.0f32, |most, (a, b)| most.max((b - a).abs()));
                assert!(step < 0.4 * 0.0315 + 0.02, "{width} {pixels}: {step}");
                assert!((at(0.3) - at(1.3)).abs() < 1e-3 && (at(0.3) - at(-0.7)).abs() < 1e-3);
            }
        }
    }

    #[test]
    fn what_is_drawn_as_large_as_it_is_or_larger_has_the_bits_of_the_image() {
        let texture = wave(37);
        let pyramid = Pyramid::of(&texture.image, Encoding::Linear, Fourth::Number);
        for pixels in [0.0, 0.1, 0.999] {
            for i in 0..100 {
                let uv = Vec2::new(i as f32 * 0.0137 - 0.2, 0.4);
                let found = texture.sample_over(&pyramid, uv, &wide(pixels, &texture));
                assert_eq!(found, texture.sample(uv));
            }
        }
    }

    #[test]
    fn drawn_as_small_as_a_pixel_an_image_is_its_mean() {
        for filter in [Filter::Nearest, Filter::Linear] {
            let texture = two_by_one(Wrap::Repeat, filter);
            let pyramid = Pyramid::of(&texture.image, Encoding::Linear, Fourth::Number);
            for pixels in [2.0, 50.0, 3e38, f32::NAN] {
                let footprint = wide(pixels, &texture);
                let red = texture.sample_over(&pyramid, Vec2::new(0.3, 0.5), &footprint)[0];
                assert_eq!(red, 128.0 / 255.0, "{filter:?} {pixels}");
            }
        }
    }

    #[test]
    fn coordinates_out_of_this_world_give_some_pixel() {
        for filter in [Filter::Nearest, Filter::Linear] {
            for u in [f32::NAN, f32::INFINITY, -3e38, 3e38] {
                assert!(red(&two_by_one(Wrap::Repeat, filter), u).is_finite());
            }
        }
    }

    #[test]
    fn sixteen_and_eight_bits_of_white_are_the_same() {
        let mut texture = two_by_one(Wrap::Repeat, Filter::Nearest);
        let eight = red(&texture, 0.75);
        let pixels = Pixels::Sixteen(vec![[0; 4], [65535; 4]]);
        texture.image = Arc::new(Image {
            name: String::new(),
            width: 2,
            height: 1,
            pixels,
        });
        assert_eq!(red(&texture, 0.75), eight);
    }
}
