//! Smaller and smaller versions of an image, for what is drawn small (Williams 1983, "Pyramidal Parametrics").
//!
//! Each level has half the pixels of the one below it in either direction, rounded down, and each of its pixels the mean of
//! those under it, by area: three by three, with weights, where the number below is odd. So every level covers all of the
//! image, and none has a seam where it repeats. The means are of linear light; the levels are kept as the image is.

use super::lookup::SRGB_TO_LINEAR;
use super::{Encoding, Image, Pixels};
use crate::color::{linear_to_srgb, srgb_to_linear};
use glam::Vec4;
use rayon::iter::{IndexedParallelIterator, ParallelIterator};
use rayon::slice::ParallelSliceMut;
use std::sync::LazyLock;

/// The levels above an image, half its size first, to one pixel.
#[derive(Clone, Debug, PartialEq)]
pub struct Pyramid {
    levels: Vec<Image>,
}

/// What the fourth channel of an image is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fourth {
    /// A number by itself.
    Number,
    /// The coverage: what is not there has no colour to give to a mean.
    Coverage,
    /// Coverage that is there from the cutoff on: the levels hold how much of the area is.
    Mask {
        /// The least that is there.
        cutoff: f32,
    },
}

impl Pyramid {
    /// The pyramid over an image whose numbers mean `encoding`.
    pub fn of(image: &Image, encoding: Encoding, fourth: Fourth) -> Pyramid {
        let by_coverage = fourth != Fourth::Number;
        let levels = match (&image.pixels, encoding) {
            (Pixels::Eight(pixels), Encoding::Srgb) => {
                let (linear, encoded) = (&*SRGB_TO_LINEAR, &*LINEAR_TO_SRGB);
                let steps: &[u32; 256] = &SRGB_TO_STEPS;
                let light = |byte: u8| linear[usize::from(byte)];
                let byte = |light: f32| {
                    let at = (light * (ENCODED - 1) as f32 + 0.5) as usize;
                    encoded[at.min(ENCODED - 1)]
                };
                let codec = Codec {
                    four: |four: [[u8; 4]; 4]| {
                        let [a, b, c, d] = four;
                        let of = |texel: [u8; 4]| texel.map(|byte| steps[usize::from(byte)]);
                        let [a, b, c, d] = [of(a), of(b), of(c), of(d)];
                        let color = |at: usize| {
                            let sum = a[at] + b[at] + c[at] + d[at];
                            encoded[((sum + 2) / 4) as usize % ENCODED]
                        };
                        let [.., alpha] = mean_of_bytes(four);
                        let mean = [color(0), color(1), color(2), alpha];
                        (!by_coverage || alike(four)).then_some(mean)
                    },
                    decode: |[r, g, b, a]: [u8; 4]| {
                        Vec4::new(light(r), light(g), light(b), f32::from(a) / 255.0)
                    },
                    encode: |v: Vec4| [byte(v.x), byte(v.y), byte(v.z), (v.w * 255.0 + 0.5) as u8],
                };
                codec.levels(image, pixels, fourth, Pixels::Eight)
            }
            (Pixels::Eight(pixels), Encoding::Linear) => {
                let codec = Codec {
                    four: |four: [[u8; 4]; 4]| {
                        (!by_coverage || alike(four)).then(|| mean_of_bytes(four))
                    },
                    decode: |texel: [u8; 4]| Vec4::from(texel.map(f32::from)) / 255.0,
                    encode: |v: Vec4| v.to_array().map(|x| (x * 255.0 + 0.5) as u8),
                };
                codec.levels(image, pixels, fourth, Pixels::Eight)
            }
            (Pixels::Sixteen(pixels), Encoding::Srgb) => {
                let word = |light| (linear_to_srgb(light) * 65535.0 + 0.5) as u16;
                let codec = Codec {
                    four: |_| None,
                    decode: |texel: [u16; 4]| {
                        let [r, g, b, a] = texel.map(|x| f32::from(x) / 65535.0);
                        Vec4::new(srgb_to_linear(r), srgb_to_linear(g), srgb_to_linear(b), a)
                    },
                    encode: |v: Vec4| {
                        [
                            word(v.x),
                            word(v.y),
                            word(v.z),
                            (v.w * 65535.0 + 0.5) as u16,
                        ]
                    },
                };
                codec.levels(image, pixels, fourth, Pixels::Sixteen)
            }
            (Pixels::Sixteen(pixels), Encoding::Linear) => {
                let codec = Codec {
                    four: |_| None,
                    decode: |texel: [u16; 4]| Vec4::from(texel.map(f32::from)) / 65535.0,
                    encode: |v: Vec4| v.to_array().map(|x| (x * 65535.0 + 0.5) as u16),
                };
                codec.levels(image, pixels, fourth, Pixels::Sixteen)
            }
        };
        Pyramid { levels }
    }

    /// The levels, half the image's size first.
    pub fn levels(&self) -> &[Image] {
        &self.levels
    }

    /// About what the pyramid over an image takes, in bytes.
    pub fn bytes_over(image: &Image) -> u64 {
        let bytes = match &image.pixels {
            Pixels::Eight(pixels) => size_of_val(pixels.as_slice()),
            Pixels::Sixteen(pixels) => size_of_val(pixels.as_slice()),
        };
        // A quarter and a quarter of that; a row of pixels is halved only, again and again.
        match (image.width, image.height) {
            (1, _) | (_, 1) => bytes as u64,
            _ => bytes as u64 / 3 + 64 * u64::from(image.width.max(image.height)),
        }
    }
}

/// How finely linear light is told apart before it is encoded: the darkest byte but black is 5 of these, and a table of
/// them stays in the nearest cache.
const ENCODED: usize = 1 << 14;

static LINEAR_TO_SRGB: LazyLock<Vec<u8>> = LazyLock::new(|| {
    let encoded = |at: usize| linear_to_srgb(at as f32 / (ENCODED - 1) as f32);
    (0..ENCODED)
        .map(|at| (encoded(at) * 255.0 + 0.5) as u8)
        .collect()
});

/// The linear light of every byte, so finely.
static SRGB_TO_STEPS: LazyLock<[u32; 256]> =
    LazyLock::new(|| SRGB_TO_LINEAR.map(|light| (light * (ENCODED - 1) as f32 + 0.5) as u32));

fn mean_of_bytes([a, b, c, d]: [[u8; 4]; 4]) -> [u8; 4] {
    std::array::from_fn(|at| {
        let sum = u16::from(a[at]) + u16::from(b[at]) + u16::from(c[at]) + u16::from(d[at]);
        ((sum + 2) / 4) as u8
    })
}

/// Whether all are as much there.
fn alike([a, b, c, d]: [[u8; 4]; 4]) -> bool {
    a[3] == b[3] && a[3] == c[3] && a[3] == d[3]
}

/// From stored pixels to linear light and coverage, and back.
struct Codec<F, D, E> {
    /// The mean of four, where whole numbers do: that is most of the work.
    four: F,
    decode: D,
    encode: E,
}

impl<F, D, E> Codec<F, D, E> {
    fn levels<T: Copy + Default + Send + Sync>(
        &self,
        image: &Image,
        pixels: &[T],
        fourth: Fourth,
        stored: impl Fn(Vec<T>) -> Pixels,
    ) -> Vec<Image>
    where
        F: Fn([T; 4]) -> Option<T> + Sync,
        D: Fn(T) -> Vec4 + Sync,
        E: Fn(Vec4) -> T + Sync,
    {
        let by_coverage = fourth != Fourth::Number;
        let size = [image.width as usize, image.height as usize];
        let mut levels: Vec<(Vec<T>, [usize; 2])> = Vec::new();
        loop {
            let next = match (levels.last(), fourth) {
                (None, _) if size == [1, 1] => break,
                (None, Fourth::Mask { cutoff }) => {
                    let decode = |texel: T| {
                        let v = (self.decode)(texel);
                        v.with_w(f32::from(u8::from(v.w >= cutoff)))
                    };
                    let by_number = Codec {
                        four: |_| None,
                        decode,
                        encode: &self.encode,
                    };
                    by_number.halved(pixels, size, by_coverage)
                }
                (None, _) => self.halved(pixels, size, by_coverage),
                (Some((_, [1, 1])), _) => break,
                (Some((pixels, size)), _) => self.halved(pixels, *size, by_coverage),
            };
            levels.push(next);
        }
        let level = |(pixels, [width, height]): (Vec<T>, [usize; 2])| Image {
            name: String::new(),
            width: width as u32,
            height: height as u32,
            pixels: stored(pixels),
        };
        levels.into_iter().map(level).collect()
    }

    /// An image of half the size, at least one pixel in each direction.
    fn halved<T: Copy + Default + Send + Sync>(
        &self,
        pixels: &[T],
        [width, height]: [usize; 2],
        by_coverage: bool,
    ) -> (Vec<T>, [usize; 2])
    where
        F: Fn([T; 4]) -> Option<T> + Sync,
        D: Fn(T) -> Vec4 + Sync,
        E: Fn(Vec4) -> T + Sync,
    {
        let (decode, encode) = (&self.decode, &self.encode);
        /// Fewer pixels are not worth a thread.
        const PIECE: usize = 1 << 14;
        let [new_width, new_height] = [width, height].map(|side| (side / 2).max(1));
        let mut new = vec![T::default(); new_width * new_height];
        let halves = width.is_multiple_of(2) && height.is_multiple_of(2);
        let row_of = |j: usize| pixels.get(j * width..(j + 1) * width).unwrap_or_default();
        let rows = new.par_chunks_mut(new_width).enumerate();
        rows.with_min_len(PIECE.div_ceil(new_width))
            .for_each(|(j, row)| {
                if halves {
                    let (above, below) = (row_of(2 * j), row_of(2 * j + 1));
                    let pairs = above.chunks_exact(2).zip(below.chunks_exact(2));
                    for (pixel, (above, below)) in row.iter_mut().zip(pairs) {
                        if let (&[a, b], &[c, d]) = (above, below) {
                            let four = [a, b, c, d];
                            *pixel = (self.four)(four).unwrap_or_else(|| {
                                encode(mean(four.map(|texel| (decode(texel), 0.25)), by_coverage))
                            });
                        }
                    }
                    return;
                }
                let rows = Under::new(j, height);
                for (i, pixel) in row.iter_mut().enumerate() {
                    let columns = Under::new(i, width);
                    let under = rows.each().flat_map(|(y, share_y)| {
                        let row = row_of(y);
                        columns.each().map(move |(x, share_x)| {
                            let texel = row.get(x).copied().unwrap_or_default();
                            (decode(texel), share_x * share_y)
                        })
                    });
                    *pixel = encode(mean(under, by_coverage));
                }
            });
        (new, [new_width, new_height])
    }
}

/// Which pixels of a row lie under one of the row of half as many, and their shares of it.
#[derive(Clone, Copy)]
struct Under {
    first: usize,
    shares: [f32; 3],
}

impl Under {
    fn new(i: usize, size: usize) -> Under {
        let shares = if size == 1 {
            [1.0, 0.0, 0.0]
        } else if size.is_multiple_of(2) {
            [0.5, 0.5, 0.0]
        } else {
            // n pixels over m = (n - 1) / 2: each is n / m = 2 + 1/m of them wide.
            let (m, n) = ((size / 2) as f32, size as f32);
            [(m - i as f32) / n, m / n, (i as f32 + 1.0) / n]
        };
        Under {
            first: 2 * i,
            shares,
        }
    }

    fn each(self) -> impl Iterator<Item = (usize, f32)> {
        let shares = self.shares.into_iter().enumerate();
        shares
            .filter(|(_, share)| *share > 0.0)
            .map(move |(at, share)| (self.first + at, share))
    }
}

/// The mean of texels with shares that add to 1; their colours count by their coverage, if so.
#[inline(always)]
fn mean(texels: impl IntoIterator<Item = (Vec4, f32)>, by_coverage: bool) -> Vec4 {
    let (mut sum, mut covered) = (Vec4::ZERO, Vec4::ZERO);
    for (texel, share) in texels {
        sum += texel * share;
        if by_coverage {
            covered += texel * (texel.w * share);
        }
    }
    if by_coverage && sum.w > 0.0 {
        (covered / sum.w).with_w(sum.w)
    } else {
        sum
    }
}

#[cfg(test)]
mod tests;
