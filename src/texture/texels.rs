//! The pixels of one image, and what lies between them.

use super::{Filter, Image, Pixels, Wrap};
use glam::{Vec2, Vec4};

/// A pixel as an image keeps it.
pub(super) trait Texel: Copy + Default {
    /// All of an image's, none where it keeps them otherwise.
    fn all(pixels: &Pixels) -> &[Self];

    /// Its four numbers as they are.
    fn numbers(self) -> Vec4;
}

impl Texel for [u8; 4] {
    fn all(pixels: &Pixels) -> &[Self] {
        match pixels {
            Pixels::Eight(pixels) => pixels,
            Pixels::Sixteen(_) => &[],
        }
    }

    #[inline(always)]
    fn numbers(self) -> Vec4 {
        let [r, g, b, a] = self;
        Vec4::new(r.into(), g.into(), b.into(), a.into())
    }
}

impl Texel for [u16; 4] {
    fn all(pixels: &Pixels) -> &[Self] {
        match pixels {
            Pixels::Sixteen(pixels) => pixels,
            Pixels::Eight(_) => &[],
        }
    }

    #[inline(always)]
    fn numbers(self) -> Vec4 {
        let [r, g, b, a] = self;
        Vec4::new(r.into(), g.into(), b.into(), a.into())
    }
}

/// An image as lookups see it.
pub(super) struct Texels<'a, T> {
    pixels: &'a [T],
    width: u32,
    height: u32,
    filter: Filter,
    wrap: [Wrap; 2],
}

impl<'a, T: Texel> Texels<'a, T> {
    #[inline(always)]
    pub(super) fn new(image: &'a Image, filter: Filter, wrap: [Wrap; 2]) -> Texels<'a, T> {
        Texels {
            pixels: T::all(&image.pixels),
            width: image.width,
            height: image.height,
            filter,
            wrap,
        }
    }

    /// The nearest pixel or the blend of the nearest four, each through `decode`.
    #[inline(always)]
    pub(super) fn at(&self, uv: Vec2, decode: &impl Fn(T) -> Vec4) -> Vec4 {
        if self.filter == Filter::Nearest {
            return self.nearest(uv, decode);
        }
        let uv = self.in_first(uv);
        // Pixel centres lie at halves.
        let (x, y) = (
            uv.x * self.width as f32 - 0.5,
            uv.y * self.height as f32 - 0.5,
        );
        let (last_x, last_y) = ((self.width - 1) as f32, (self.height - 1) as f32);
        // Most lookups have no neighbour across an edge. False for NaN.
        if x >= 0.0 && x < last_x && y >= 0.0 && y < last_y {
            let (i, j) = (x as u32 as usize, y as u32 as usize);
            let shares = [x - i as f32, y - j as f32];
            let width = self.width as usize;
            let first = j * width + i;
            let pair = |at: usize| self.pixels.get(at..at + 2);
            if let (Some(&[a, b]), Some(&[c, d])) = (pair(first), pair(first + width)) {
                return blended([decode(a), decode(b), decode(c), decode(d)], shares);
            }
        }
        self.across_edges(uv, decode)
    }

    /// The same place in the first of the images that repeat.
    #[inline(always)]
    fn in_first(&self, uv: Vec2) -> Vec2 {
        let in_first = |x: f32, wrap: Wrap| {
            let repeats = wrap == Wrap::Repeat && !(0.0..1.0).contains(&x);
            if repeats { x - x.floor() } else { x }
        };
        let [across, down] = self.wrap;
        Vec2::new(in_first(uv.x, across), in_first(uv.y, down))
    }

    #[cold]
    fn nearest(&self, uv: Vec2, decode: &impl Fn(T) -> Vec4) -> Vec4 {
        let uv = sound(uv);
        let (x, y) = (uv.x * self.width as f32, uv.y * self.height as f32);
        decode(self.wrapped(floor(x), floor(y)))
    }

    /// The blend of four pixels wherever they are.
    #[inline(never)]
    fn across_edges(&self, uv: Vec2, decode: &impl Fn(T) -> Vec4) -> Vec4 {
        let uv = sound(uv);
        let (x, y) = (
            uv.x * self.width as f32 - 0.5,
            uv.y * self.height as f32 - 0.5,
        );
        let (i, j) = (floor(x), floor(y));
        let (right, below) = (i.saturating_add(1), j.saturating_add(1));
        let shares = [x - i as f32, y - j as f32];
        let at = |i, j| decode(self.wrapped(i, j));
        blended(
            [at(i, j), at(right, j), at(i, below), at(right, below)],
            shares,
        )
    }

    /// The pixel that stands at a position, inside or outside.
    #[inline(always)]
    fn wrapped(&self, i: i64, j: i64) -> T {
        let [across, down] = self.wrap;
        let (column, row) = (
            wrapped(i, self.width, across),
            wrapped(j, self.height, down),
        );
        let pixel = self.pixels.get(row * self.width as usize + column);
        pixel.copied().unwrap_or_default()
    }
}

/// Between two above and two below. What is the same in all four comes out of it as it is.
#[inline(always)]
fn blended([a, b, c, d]: [Vec4; 4], [across, down]: [f32; 2]) -> Vec4 {
    let (top, bottom) = (a + (b - a) * across, c + (d - c) * across);
    top + (bottom - top) * down
}

/// A coordinate that is no number shows the first pixel; one too great to have a fraction shows any.
fn sound(uv: Vec2) -> Vec2 {
    if uv.is_nan() {
        return Vec2::ZERO;
    }
    uv.clamp(Vec2::splat(-1e9), Vec2::splat(1e9))
}

/// The greatest whole number that is not above `x`, a number that 64 bits can hold.
fn floor(x: f32) -> i64 {
    let toward_zero = x as i64;
    toward_zero - i64::from(x < toward_zero as f32)
}

/// The pixel that stands at position `i` of a row of `size`.
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
