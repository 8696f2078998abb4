//! PNG, BMP, TGA and GIF by crate `image`. Of an animation it is the first picture.
//!
//! What a PNG says of its colours' meaning (gAMA, iCCP, cHRM) is ignored, as glTF wants it (section 3.8.3).

use super::{Header, MOST_PIXELS, most_pixels, rgba, said};
use crate::texture::Pixels;
use image::{ColorType, ImageDecoder, ImageFormat, ImageReader, Limits};
use std::io::Cursor;

/// None has more for each byte of its file: deflate reaches 1032 bytes of 8 one-bit pixels each.
const MOST_PIXELS_A_BYTE: u64 = 1 << 14;

/// Bytes of a pixel at most: four channels of 16 bits.
const MOST_BYTES_A_PIXEL: u64 = 8;

/// Which of the crate's formats.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Format {
    Png,
    Bmp,
    Tga,
    Gif,
}

impl Format {
    fn name(self) -> &'static str {
        match self {
            Format::Png => "PNG",
            Format::Bmp => "BMP",
            Format::Tga => "TGA",
            Format::Gif => "GIF",
        }
    }
}

/// What the header says.
///
/// # Errors
///
/// One line.
pub(super) fn header(format: Format, bytes: &[u8]) -> Result<Header, String> {
    let decoder = decoder(format, bytes)?;
    let (width, height) = decoder.dimensions();
    let color = decoder.color_type();
    let is_deep = color.bytes_per_pixel() > color.channel_count();
    Header::checked(
        width.into(),
        height.into(),
        if is_deep { 2 } else { 1 },
        most_pixels(bytes, MOST_PIXELS_A_BYTE),
    )
}

/// The pixels of a file whose header is right. 16 bits stay 16.
///
/// # Errors
///
/// One line.
pub(super) fn decode(format: Format, bytes: &[u8], header: &Header) -> Result<Pixels, String> {
    let decoder = decoder(format, bytes)?;
    let color = decoder.color_type();
    let expected = header.count() as u64 * u64::from(color.bytes_per_pixel());
    if decoder.total_bytes() != expected {
        return Err(format!("broken {}: its size is in doubt", format.name()));
    }
    let read = |buffer: &mut [u8]| {
        decoder
            .read_image(buffer)
            .map_err(|error| said(format.name(), error))
    };
    match color {
        ColorType::L8 => rgba::eight::<1>(header, read),
        ColorType::La8 => rgba::eight::<2>(header, read),
        ColorType::Rgb8 => rgba::eight::<3>(header, read),
        ColorType::Rgba8 => rgba::eight::<4>(header, read),
        ColorType::L16 => rgba::sixteen::<1>(header, read),
        ColorType::La16 => rgba::sixteen::<2>(header, read),
        ColorType::Rgb16 => rgba::sixteen::<3>(header, read),
        ColorType::Rgba16 => rgba::sixteen::<4>(header, read),
        _ => Err(format!(
            "broken {}: its pixels are no colours",
            format.name()
        )),
    }
}

fn decoder(format: Format, bytes: &[u8]) -> Result<impl ImageDecoder, String> {
    let mut limits = Limits::default();
    let most = most_pixels(bytes, MOST_PIXELS_A_BYTE);
    // An image that is too great for its file is told of in our own words.
    limits.max_image_width = Some(u32::try_from(MOST_PIXELS).unwrap_or(u32::MAX));
    limits.max_image_height = limits.max_image_width;
    limits.max_alloc = Some(most * MOST_BYTES_A_PIXEL);
    let kind = match format {
        Format::Png => ImageFormat::Png,
        Format::Bmp => ImageFormat::Bmp,
        Format::Tga => ImageFormat::Tga,
        Format::Gif => ImageFormat::Gif,
    };
    let mut reader = ImageReader::with_format(Cursor::new(bytes), kind);
    reader.limits(limits);
    reader
        .into_decoder()
        .map_err(|error| said(format.name(), error))
}
