//! Patterns on surfaces: images, and the paper's checkerboard.

use crate::color::{Rgb, srgb_to_linear};
use crate::geometry::Plane;
use glam::{DVec3, Mat3, Vec2, Vec3, Vec4};
use std::sync::{Arc, LazyLock};

/// Pixels of four channels, top row first, `width * height` of them.
#[derive(Clone, Debug, PartialEq)]
pub struct Image {
    /// As in the file: a name or a path, for messages.
    pub name: String,
    /// Above zero.
    pub width: u32,
    /// Above zero.
    pub height: u32,
    /// Straight (not premultiplied) alpha last.
    pub pixels: Pixels,
}

/// The pixels of an image as the file keeps them.
#[derive(Clone, Debug, PartialEq)]
pub enum Pixels {
    /// 8 bits a channel.
    Eight(Vec<[u8; 4]>),
    /// 16 bits a channel.
    Sixteen(Vec<[u16; 4]>),
}

/// What an image's numbers mean.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Encoding {
    /// Colour, sRGB-encoded; alpha is linear.
    Srgb,
    /// Numbers.
    Linear,
}

/// What lies outside 0..1 in one direction.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Wrap {
    /// The image again.
    #[default]
    Repeat,
    /// The image again, every second time mirrored.
    MirroredRepeat,
    /// Its edge.
    ClampToEdge,
}

/// What lies between pixel centres.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Filter {
    /// The nearest pixel.
    Nearest,
    /// A blend of the nearest four.
    #[default]
    Linear,
}

/// An image and how to look things up in it.
#[derive(Clone, Debug, PartialEq)]
pub struct Texture {
    /// Shared by every texture that shows it.
    pub image: Arc<Image>,
    /// Horizontal and vertical.
    pub wrap: [Wrap; 2],
    /// Between pixels.
    pub filter: Filter,
    /// What the numbers mean.
    pub encoding: Encoding,
}

/// The use of a texture by a material.
#[derive(Clone, Debug, PartialEq)]
pub struct TextureUse {
    /// An index into the scene's textures.
    pub texture: u32,
    /// Which of a mesh's two sets of texture coordinates, 0 or 1.
    pub uv_set: u8,
    /// From the mesh's coordinates to the texture's; `None` where they are the same. The image's upper left corner is
    /// (0, 0), its lower right one (1, 1), as in glTF.
    pub transform: Option<Mat3>,
}

impl Texture {
    /// The linear colour and alpha at `uv`, (0, 0) being the upper left corner of the image.
    pub fn sample(&self, uv: Vec2) -> [f32; 4] {
        let bytes = |[r, g, b, a]: [u8; 4]| Vec4::new(r.into(), g.into(), b.into(), a.into());
        let words = |[r, g, b, a]: [u16; 4]| Vec4::new(r.into(), g.into(), b.into(), a.into());
        let color = match (&self.image.pixels, self.encoding) {
            (Pixels::Eight(pixels), Encoding::Srgb) => {
                let linear = &*SRGB_TO_LINEAR;
                self.filtered(uv, pixels, |[r, g, b, a]| {
                    let [r, g, b] = [linear[r as usize], linear[g as usize], linear[b as usize]];
                    Vec4::new(r, g, b, f32::from(a) / 255.0)
                })
            }
            (Pixels::Eight(pixels), Encoding::Linear) => {
                self.filtered(uv, pixels, |texel| bytes(texel) / 255.0)
            }
            (Pixels::Sixteen(pixels), Encoding::Srgb) => self.filtered(uv, pixels, |texel| {
                let [x, y, z, w] = (words(texel) / 65535.0).to_array();
                Vec4::new(srgb_to_linear(x), srgb_to_linear(y), srgb_to_linear(z), w)
            }),
            (Pixels::Sixteen(pixels), Encoding::Linear) => {
                self.filtered(uv, pixels, |texel| words(texel) / 65535.0)
            }
        };
        color.to_array()
    }

    /// The nearest pixel or the blend of the nearest four, each through `decode`.
    #[inline(always)]
    fn filtered<T: Copy + Default>(
        &self,
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
        let (width, height) = (self.image.width, self.image.height);
        let (x, y) = (uv.x * width as f32, uv.y * height as f32);
        let column = |i| wrapped(i, width, self.wrap[0]);
        let row = |j| wrapped(j, height, self.wrap[1]) * width as usize;
        let texel = |at: usize| decode(pixels.get(at).copied().unwrap_or_default());
        match self.filter {
            Filter::Nearest => texel(row(floor(y)) + column(floor(x))),
            Filter::Linear => {
                // Pixel centres lie at halves.
                let (x, y) = (x - 0.5, y - 0.5);
                let (i, j) = (floor(x), floor(y));
                let (right_share, bottom_share) = (x - i as f32, y - j as f32);
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

static SRGB_TO_LINEAR: LazyLock<[f32; 256]> =
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

/// The paper's pattern on a plane: squares in two colours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Checker {
    /// The diffuse colour of every second square; the material's own is on the others.
    pub color: Rgb,
    /// The side of a square, above zero, in the scene's unit.
    pub size: f32,
}

impl Checker {
    /// Whether `position` lies on a square of the checker's colour: `floor(a/size) + floor(b/size)` is odd, where `a`
    /// and `b` are the position's coordinates from the plane's point along two axes in the plane: the world axes least
    /// aligned with the normal (the earlier of equals), in x, y, z order, projected onto the plane.
    pub fn covers(&self, plane: &Plane, position: DVec3) -> bool {
        let [e1, e2] = in_plane_axes(plane.normal);
        let p = position - plane.point.as_dvec3();
        let cell = |axis: DVec3| libm::floor(p.dot(axis) / f64::from(self.size));
        (cell(e1) + cell(e2)).rem_euclid(2.0) == 1.0
    }
}

fn in_plane_axes(n: Vec3) -> [DVec3; 2] {
    let n = n.as_dvec3();
    let mut axes = [DVec3::X, DVec3::Y, DVec3::Z];
    // Stable: of equals the earlier axis counts as less aligned.
    axes.sort_by(|p, q| n.dot(*p).abs().total_cmp(&n.dot(*q).abs()));
    let [least, second, _] = axes;
    let ordered = if least.dot(DVec3::new(0.0, 1.0, 2.0)) < second.dot(DVec3::new(0.0, 1.0, 2.0)) {
        [least, second]
    } else {
        [second, least]
    };
    ordered.map(|axis| (axis - n * n.dot(axis)).normalize_or_zero())
}

#[cfg(test)]
mod tests {
    use super::*;

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

    #[test]
    fn a_checker_alternates_along_both_axes() {
        let checker = Checker {
            color: Rgb::BLACK,
            size: 2.0,
        };
        let floor = Plane {
            point: Vec3::new(0.0, -1.0, 0.0),
            normal: Vec3::Y,
        };
        let at = |x, z| checker.covers(&floor, DVec3::new(x, -1.0, z));
        assert_eq!(
            [at(0.5, 0.5), at(2.5, 0.5), at(2.5, 2.5), at(-0.5, 0.5)],
            [false, true, false, true]
        );
    }

    #[test]
    fn axes_of_a_plane_keep_the_order_x_y_z() {
        assert_eq!(in_plane_axes(Vec3::Y), [DVec3::X, DVec3::Z]);
        assert_eq!(in_plane_axes(Vec3::Z), [DVec3::X, DVec3::Y]);
        assert_eq!(in_plane_axes(Vec3::X), [DVec3::Y, DVec3::Z]);
        // All equally aligned: x and y are the less aligned ones.
        let [e1, e2] = in_plane_axes(Vec3::ONE.normalize());
        assert!(e1.x > 0.5 && e2.y > 0.5);
    }
}
