//! Image files, each kind in a file of its own: what one of these is called, how great it is, its pixels.

mod common;
pub(super) mod exr;
pub(super) mod hdr;
mod jpeg;
mod ktx2;
mod rgba;
mod several;
mod webp;

pub(super) use several::{Encoded, decode_all};

use crate::load::Budget;
use crate::texture::Image;
use common::Format;

/// No image has more, 16384 x 16384.
const MOST_PIXELS: u64 = 1 << 28;

/// So many any file may say that it has, where a picture of one colour takes no bytes: 2048 x 2048.
const FREE_PIXELS: u64 = 1 << 22;

/// The kinds of image file that first bytes tell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Jpeg,
    WebP,
    Ktx2,
    Common(Format),
    /// A kind that luch knows and does not read.
    Refused(&'static str),
}

/// How great an image is, known before memory is taken for it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Header {
    width: u32,
    height: u32,
    bytes_a_channel: u64,
    /// At the peak of decoding.
    bytes_a_pixel: u64,
}

/// A decoded image.
#[derive(Debug)]
pub(super) struct Decoded {
    /// Its pixels.
    pub(super) image: Image,
    /// What is wrong with it, though it can be shown: a few words that follow its name.
    pub(super) flaw: Option<&'static str>,
}

impl Header {
    /// Checked against what a file can hold.
    fn checked(width: u64, height: u64, bytes_a_channel: u64, most: u64) -> Result<Header, String> {
        check_size(width, height, most)?;
        let fits = |size| u32::try_from(size).map_err(|_| format!("is {width} x {height} pixels"));
        Ok(Header::new(fits(width)?, fits(height)?, bytes_a_channel))
    }

    fn new(width: u32, height: u32, bytes_a_channel: u64) -> Header {
        Header {
            width,
            height,
            bytes_a_channel,
            // As it is decoded, and as RGBA.
            bytes_a_pixel: 8 * bytes_a_channel,
        }
    }

    /// How many pixels.
    fn count(&self) -> usize {
        self.width as usize * self.height as usize
    }

    /// Bytes that decoding takes at its peak.
    pub(super) fn bytes_to_decode(&self) -> u64 {
        u64::from(self.width) * u64::from(self.height) * self.bytes_a_pixel
    }

    /// Takes the memory of the decoded image, where there is enough for decoding it.
    ///
    /// # Errors
    ///
    /// There is not: one line without the image's name.
    pub(super) fn take(&self, budget: &Budget) -> Result<(), String> {
        let checked = budget.check(self.bytes_to_decode());
        let taken = checked.and_then(|()| budget.take(self.bytes_decoded()));
        taken.map_err(|problem| format!("{} x {} pixels: {problem}", self.width, self.height))
    }

    /// Bytes that the decoded image takes.
    pub(super) fn bytes_decoded(&self) -> u64 {
        u64::from(self.width) * u64::from(self.height) * 4 * self.bytes_a_channel
    }
}

/// Reads how great an image is, and nothing else of it.
///
/// # Errors
///
/// One line that says what is wrong, without the image's name.
pub(super) fn header(name: &str, bytes: &[u8]) -> Result<Header, String> {
    match kind(name, bytes)? {
        Kind::Jpeg => jpeg::header(bytes),
        Kind::WebP => webp::header(bytes),
        Kind::Ktx2 => ktx2::header(bytes),
        Kind::Common(format) => common::header(format, bytes),
        Kind::Refused(kind) => Err(format!(
            "is {kind}, which is not supported; use PNG or JPEG"
        )),
    }
}

/// Decodes an image file, whose kind its first bytes tell (TGA: `name`'s ending).
///
/// 16-bit PNG stays [`Pixels::Sixteen`](crate::texture::Pixels::Sixteen), everything else becomes [`Pixels::Eight`](crate::texture::Pixels::Eight). Of an animation it is the first
/// picture, of several levels the greatest.
///
/// # Errors
///
/// One line that says what is wrong, without the image's name.
pub(super) fn decode(name: &str, bytes: &[u8]) -> Result<Decoded, String> {
    let header = header(name, bytes)?;
    let (pixels, flaw) = match kind(name, bytes)? {
        Kind::Jpeg => jpeg::decode(bytes, &header)?,
        Kind::WebP => (webp::decode(bytes, &header)?, None),
        Kind::Ktx2 => (ktx2::decode(bytes, &header)?, None),
        Kind::Common(format) => (common::decode(format, bytes, &header)?, None),
        Kind::Refused(kind) => return Err(format!("is {kind}")),
    };
    let image = Image {
        name: name.to_owned(),
        width: header.width,
        height: header.height,
        pixels,
    };
    Ok(Decoded { image, flaw })
}

fn kind(name: &str, bytes: &[u8]) -> Result<Kind, String> {
    Ok(match bytes {
        [] => return Err("is empty".into()),
        [0xff, 0xd8, 0xff, ..] => Kind::Jpeg,
        [0x89, b'P', b'N', b'G', ..] => Kind::Common(Format::Png),
        [b'G', b'I', b'F', b'8', ..] => Kind::Common(Format::Gif),
        [b'B', b'M', ..] => Kind::Common(Format::Bmp),
        _ if webp::is_webp(bytes) => Kind::WebP,
        _ if bytes.starts_with(&ktx2::MAGIC) => Kind::Ktx2,
        [0xab, b'K', b'T', b'X', ..] => Kind::Refused("a KTX image"),
        [
            _,
            _,
            _,
            _,
            b'f',
            b't',
            b'y',
            b'p',
            b'a',
            b'v',
            b'i',
            b'f' | b's',
            ..,
        ] => Kind::Refused("an AVIF image"),
        [b'D', b'D', b'S', b' ', ..] => Kind::Refused("a DDS image"),
        [b'I', b'I', 42, 0, ..] | [b'M', b'M', 0, 42, ..] => Kind::Refused("a TIFF image"),
        [0x76, 0x2f, 0x31, 0x01, ..] => Kind::Refused("an OpenEXR image"),
        [b'#', b'?', ..] => Kind::Refused("a Radiance HDR image"),
        [b'8', b'B', b'P', b'S', ..] => Kind::Refused("a Photoshop image"),
        _ if name.to_lowercase().ends_with(".tga") => Kind::Common(Format::Tga),
        _ => {
            return Err(
                "is no image luch knows, expected PNG, JPEG, WebP, KTX2, BMP, TGA or GIF".into(),
            );
        }
    })
}

/// How many pixels a file of these bytes can have.
fn most_pixels(bytes: &[u8], a_byte: u64) -> u64 {
    (bytes.len() as u64).saturating_mul(a_byte).min(MOST_PIXELS)
}

/// Before memory is taken for it.
fn check_size(width: u64, height: u64, most: u64) -> Result<(), String> {
    let count = width.saturating_mul(height);
    if count == 0 {
        Err(format!(
            "is {width} x {height} pixels, expected at least 1 x 1"
        ))
    } else if count > MOST_PIXELS {
        Err(format!(
            "is {width} x {height} pixels, expected at most {MOST_PIXELS} in all"
        ))
    } else if count > most {
        Err(format!(
            "says {width} x {height} pixels, for which the file is too short"
        ))
    } else {
        Ok(())
    }
}

/// A decoder's own words on one line.
fn said(kind: &str, error: impl std::fmt::Display) -> String {
    let words: String = error
        .to_string()
        .chars()
        .map(|c| if c.is_control() { ' ' } else { c })
        .collect();
    format!("broken {kind}: {}", words.trim())
}

#[cfg(test)]
mod samples;
#[cfg(test)]
mod tests;
