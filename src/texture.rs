//! Patterns on surfaces: images, and the paper's checkerboard.

mod checker;
mod footprint;
mod lookup;
mod pyramid;
mod texels;

pub use checker::Checker;
pub use footprint::{Footprint, Taps};
pub use pyramid::{Fourth, Pyramid};

use glam::Mat3;
use std::sync::Arc;

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
    /// Whether its pixels are averaged where a ray sees many of them; a picture of hard pixels may want none of that.
    pub mipmaps: bool,
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

/// Which part of a texture a ray shows.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TextureFilter {
    /// All that it sees: textures and checkerboards are averaged over the ray's footprint.
    #[default]
    Footprint,
    /// The very point that it meets.
    Point,
}
