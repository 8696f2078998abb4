//! What a texture shows at a point, and over a footprint.

use super::footprint::Taps;
use super::texels::{Texel, Texels};
use super::{Encoding, Filter, Image, Pixels, Pyramid, Texture};
use crate::color::srgb_to_linear;
use glam::{Vec2, Vec3, Vec4};
use std::sync::LazyLock;

/// Where between two levels of a texture something is looked up.
struct Between<'a> {
    below: (&'a Image, Filter),
    /// The next level, if any, and how much of it is in what one sees.
    above: Option<(&'a Image, f32)>,
}

impl Texture {
    /// The linear colour and alpha at `uv`, (0, 0) being the upper left corner of the image.
    pub fn sample(&self, uv: Vec2) -> [f32; 4] {
        let between = Between {
            below: (&self.image, self.filter),
            above: None,
        };
        self.mean(&between, uv, &Taps::POINT)
    }

    /// The mean linear colour and alpha of what `taps` cover around `uv`; where that is no more than a pixel, the bits of
    /// [`Texture::sample`]. `pyramid` is that of the image.
    pub fn sample_over(&self, pyramid: &Pyramid, uv: Vec2, taps: &Taps) -> [f32; 4] {
        let levels = pyramid.levels();
        let level = taps.level.min(levels.len() as f32).max(0.0);
        // Level 0 is the image itself.
        let number = level as usize;
        let share = level - number as f32;
        let above = levels.get(number).filter(|_| share > 0.0);
        let below = number.checked_sub(1).and_then(|index| levels.get(index));
        let between = Between {
            // Only a pixel that is drawn large has hard edges.
            below: below.map_or((&self.image, self.filter), |image| (image, Filter::Linear)),
            above: above.map(|image| (image, share)),
        };
        self.mean(&between, uv, taps)
    }

    fn mean(&self, between: &Between, uv: Vec2, taps: &Taps) -> [f32; 4] {
        // Whole numbers are blended as they are and made shares at the end: what is 1 all around stays it.
        let mean = match (&between.below.0.pixels, self.encoding) {
            (Pixels::Eight(_), Encoding::Srgb) => {
                let linear = &*SRGB_TO_LINEAR;
                let decode = |[r, g, b, a]: [u8; 4]| {
                    let light = |byte: u8| linear[usize::from(byte)];
                    Vec4::new(light(r), light(g), light(b), a.into())
                };
                self.blend(between, uv, taps, decode) / Vec3::ONE.extend(255.0)
            }
            (Pixels::Eight(_), Encoding::Linear) => {
                self.blend(between, uv, taps, <[u8; 4]>::numbers) / 255.0
            }
            (Pixels::Sixteen(_), Encoding::Srgb) => {
                self.blend(between, uv, taps, |texel: [u16; 4]| {
                    let [r, g, b, a] = (texel.numbers() / 65535.0).to_array();
                    Vec4::new(srgb_to_linear(r), srgb_to_linear(g), srgb_to_linear(b), a)
                })
            }
            (Pixels::Sixteen(_), Encoding::Linear) => {
                self.blend(between, uv, taps, <[u16; 4]>::numbers) / 65535.0
            }
        };
        mean.to_array()
    }

    #[inline(always)]
    fn blend<T: Texel>(
        &self,
        Between { below, above }: &Between,
        uv: Vec2,
        taps: &Taps,
        decode: impl Fn(T) -> Vec4,
    ) -> Vec4 {
        let (image, filter) = below;
        let below = Texels::new(image, *filter, self.wrap);
        let above = above.map(|(image, share)| {
            let texels = Texels::new(image, Filter::Linear, self.wrap);
            (texels, share)
        });
        let at = |uv: Vec2| {
            let mean = below.at(uv, &decode);
            match &above {
                None => mean,
                Some((above, share)) => mean + (above.at(uv, &decode) - mean) * *share,
            }
        };
        if taps.count == 1 {
            return at(uv);
        }
        let count = taps.count as f32;
        let first = uv - taps.step * (0.5 * (count - 1.0));
        let mut sum = Vec4::ZERO;
        for tap in 0..taps.count {
            sum += at(first + taps.step * tap as f32);
        }
        sum / count
    }
}

/// The linear light of every byte.
pub(super) static SRGB_TO_LINEAR: LazyLock<[f32; 256]> =
    LazyLock::new(|| std::array::from_fn(|byte| srgb_to_linear(byte as f32 / 255.0)));

#[cfg(test)]
mod tests {
    use super::*;
    use crate::texture::{Footprint, Fourth, Wrap};
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
                let taps = wide(pixels, &texture).taps(width, 3);
                let at = |u: f32| texture.sample_over(&pyramid, Vec2::new(u, 0.5), &taps)[0];
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
                let taps = wide(pixels, &texture).taps(37, 3);
                let found = texture.sample_over(&pyramid, uv, &taps);
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
                let taps = wide(pixels, &texture).taps(2, 1);
                let red = texture.sample_over(&pyramid, Vec2::new(0.3, 0.5), &taps)[0];
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
