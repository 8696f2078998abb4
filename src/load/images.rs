//! Image files: PNG, BMP, TGA and GIF by crate `image`, JPEG in a file of its own.

mod jpeg;

use crate::load::Budget;
use crate::texture::{Image, Pixels};
use image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader, Limits};
use std::io::Cursor;

/// No image has more, 16384 x 16384.
const MOST_PIXELS: u64 = 1 << 28;

/// No PNG, BMP, TGA or GIF has more for each byte of its file: deflate reaches 1032 bytes of 8 one-bit pixels each.
const MOST_PIXELS_A_BYTE: u64 = 1 << 14;

/// Bytes of a pixel at most: four channels of 16 bits.
const MOST_BYTES_A_PIXEL: u64 = 8;

/// The kinds of image file that first bytes tell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    Jpeg,
    Other(ImageFormat),
    /// A kind that luch knows and does not read.
    Refused(&'static str),
}

/// Decodes an image file, whose kind its first bytes tell (TGA: `name`'s ending).
///
/// 16-bit PNG stays [`Pixels::Sixteen`], everything else becomes [`Pixels::Eight`]. Of an animation it is the first
/// picture.
///
/// # Errors
///
/// One line that says what is wrong, without the image's name.
pub(super) fn decode(name: &str, bytes: &[u8], budget: &Budget) -> Result<Image, String> {
    let (width, height, pixels) = match kind(name, bytes)? {
        Kind::Jpeg => jpeg::decode(bytes, budget)?,
        Kind::Other(format) => decode_other(format, bytes, budget)?,
        Kind::Refused(kind) => {
            return Err(format!(
                "is {kind}, which is not supported; use PNG or JPEG"
            ));
        }
    };
    Ok(Image {
        name: name.to_owned(),
        width,
        height,
        pixels,
    })
}

fn kind(name: &str, bytes: &[u8]) -> Result<Kind, String> {
    let is_riff_webp = bytes.starts_with(b"RIFF") && bytes.get(8..12) == Some(b"WEBP");
    Ok(match bytes {
        [] => return Err("is empty".into()),
        [0xff, 0xd8, 0xff, ..] => Kind::Jpeg,
        [0x89, b'P', b'N', b'G', ..] => Kind::Other(ImageFormat::Png),
        [b'G', b'I', b'F', b'8', ..] => Kind::Other(ImageFormat::Gif),
        [b'B', b'M', ..] => Kind::Other(ImageFormat::Bmp),
        _ if is_riff_webp => Kind::Refused("a WebP image"),
        [0xab, b'K', b'T', b'X', b' ', b'2', b'0', ..] => Kind::Refused("a KTX2 image"),
        [0xab, b'K', b'T', b'X', ..] => Kind::Refused("a KTX image"),
        [b'D', b'D', b'S', b' ', ..] => Kind::Refused("a DDS image"),
        [b'I', b'I', 42, 0, ..] | [b'M', b'M', 0, 42, ..] => Kind::Refused("a TIFF image"),
        [0x76, 0x2f, 0x31, 0x01, ..] => Kind::Refused("an OpenEXR image"),
        [b'#', b'?', ..] => Kind::Refused("a Radiance HDR image"),
        [b'8', b'B', b'P', b'S', ..] => Kind::Refused("a Photoshop image"),
        _ if name.to_lowercase().ends_with(".tga") => Kind::Other(ImageFormat::Tga),
        _ => return Err("is no image luch knows, expected PNG, JPEG, BMP, TGA or GIF".into()),
    })
}

fn decode_other(
    format: ImageFormat,
    bytes: &[u8],
    budget: &Budget,
) -> Result<(u32, u32, Pixels), String> {
    let said = |error| match format {
        ImageFormat::Png => said("PNG", error),
        ImageFormat::Bmp => said("BMP", error),
        ImageFormat::Gif => said("GIF", error),
        _ => said("TGA", error),
    };
    let most = most_pixels(bytes, MOST_PIXELS_A_BYTE);
    let mut limits = Limits::default();
    limits.max_image_width = Some(u32::try_from(most).unwrap_or(u32::MAX));
    limits.max_image_height = limits.max_image_width;
    limits.max_alloc = Some(most * MOST_BYTES_A_PIXEL);
    let mut reader = ImageReader::with_format(Cursor::new(bytes), format);
    reader.limits(limits);
    let decoder = reader.into_decoder().map_err(said)?;
    let (width, height) = decoder.dimensions();
    check_size(width.into(), height.into(), most)?;
    // As it is decoded, then as RGBA, then a copy of that.
    let kind = decoder.color_type();
    let a_channel = kind.bytes_per_pixel() / kind.channel_count();
    let bytes_a_pixel = kind.bytes_per_pixel() + 2 * 4 * a_channel;
    take(width, height, bytes_a_pixel, budget)?;
    let image = DynamicImage::from_decoder(decoder).map_err(said)?;
    let is_deep = image.color().bytes_per_pixel() / image.color().channel_count() > 1;
    let pixels = if is_deep {
        Pixels::Sixteen(image.into_rgba16().into_raw().as_chunks().0.to_vec())
    } else {
        Pixels::Eight(image.into_rgba8().into_raw().as_chunks().0.to_vec())
    };
    Ok((width, height, pixels))
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

/// Takes the memory that decoding takes at its peak.
fn take(width: u32, height: u32, bytes_a_pixel: u8, budget: &Budget) -> Result<(), String> {
    let bytes = u64::from(width) * u64::from(height) * u64::from(bytes_a_pixel);
    let taken = budget.take(bytes);
    taken.map_err(|problem| format!("{width} x {height} pixels: {problem}"))
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
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

    use super::*;
    use crate::load::Options;
    use image::{ImageBuffer, Luma, LumaA, Rgb, Rgba};

    fn encoded(image: impl Into<DynamicImage>, format: ImageFormat) -> Vec<u8> {
        let mut bytes = Cursor::new(Vec::new());
        image.into().write_to(&mut bytes, format).unwrap();
        bytes.into_inner()
    }

    fn eight(name: &str, bytes: &[u8]) -> Vec<[u8; 4]> {
        match decode(name, bytes, &Budget::default()).unwrap().pixels {
            Pixels::Eight(pixels) => pixels,
            Pixels::Sixteen(_) => panic!("8 bits expected"),
        }
    }

    #[test]
    fn png_of_every_channel_count_becomes_rgba() {
        let grey = ImageBuffer::from_raw(2, 1, vec![7, 200]).unwrap();
        let png = encoded(DynamicImage::ImageLuma8(grey), ImageFormat::Png);
        assert_eq!(eight("", &png), [[7, 7, 7, 255], [200, 200, 200, 255]]);
        let grey_alpha = ImageBuffer::from_pixel(1, 1, LumaA([7, 8]));
        let png = encoded(DynamicImage::ImageLumaA8(grey_alpha), ImageFormat::Png);
        assert_eq!(eight("", &png), [[7, 7, 7, 8]]);
        let rgba = ImageBuffer::from_pixel(1, 1, Rgba([1, 2, 3, 4]));
        let png = encoded(DynamicImage::ImageRgba8(rgba), ImageFormat::Png);
        assert_eq!(eight("", &png), [[1, 2, 3, 4]]);
    }

    #[test]
    fn a_palette_and_its_transparency_are_looked_up() {
        let mut bytes = Vec::new();
        let mut encoder = png::Encoder::new(&mut bytes, 2, 1);
        encoder.set_color(png::ColorType::Indexed);
        encoder.set_depth(png::BitDepth::One);
        encoder.set_palette(vec![9, 8, 7, 1, 2, 3]);
        encoder.set_trns(vec![255, 100]);
        let mut writer = encoder.write_header().unwrap();
        writer.write_image_data(&[0b0100_0000]).unwrap();
        writer.finish().unwrap();
        assert_eq!(eight("", &bytes), [[9, 8, 7, 255], [1, 2, 3, 100]]);
    }

    #[test]
    fn sixteen_bits_stay_sixteen() {
        let grey = ImageBuffer::from_pixel(1, 1, Luma([513_u16]));
        let png = encoded(DynamicImage::ImageLuma16(grey), ImageFormat::Png);
        let image = decode("deep", &png, &Budget::default()).unwrap();
        assert_eq!(image.pixels, Pixels::Sixteen(vec![[513, 513, 513, 65535]]));
        assert_eq!(
            (image.name.as_str(), image.width, image.height),
            ("deep", 1, 1)
        );
    }

    #[test]
    fn the_top_row_of_bmp_and_tga_comes_first() {
        let rgb = ImageBuffer::from_fn(2, 2, |x, y| Rgb([x as u8, y as u8, 5]));
        let expected = [
            [0, 0, 5, 255],
            [1, 0, 5, 255],
            [0, 1, 5, 255],
            [1, 1, 5, 255],
        ];
        let image = DynamicImage::ImageRgb8(rgb);
        let bmp = encoded(image.clone(), ImageFormat::Bmp);
        assert_eq!(eight("", &bmp), expected);
        let tga = encoded(image, ImageFormat::Tga);
        assert_eq!(eight("a.TGA", &tga), expected);
        assert!(decode("a.png", &tga, &Budget::default()).is_err());
    }

    #[test]
    fn gif_is_read() {
        let rgba = ImageBuffer::from_pixel(3, 1, Rgba([255, 0, 0, 255]));
        let gif = encoded(DynamicImage::ImageRgba8(rgba), ImageFormat::Gif);
        assert_eq!(eight("", &gif), [[255, 0, 0, 255]; 3]);
    }

    #[test]
    fn what_luch_does_not_read_is_refused_by_name() {
        let refused = |bytes: &[u8]| decode("", bytes, &Budget::default()).unwrap_err();
        assert_eq!(
            refused(b"RIFF\x1a\0\0\0WEBPVP8L"),
            "is a WebP image, which is not supported; use PNG or JPEG"
        );
        assert!(refused(b"\xabKTX 20\xbb\r\n\x1a\n").starts_with("is a KTX2 image"));
        assert!(refused(b"DDS |\0\0\0").starts_with("is a DDS image"));
        assert_eq!(refused(b""), "is empty");
        assert_eq!(
            refused(b"<!DOCTYPE html>"),
            "is no image luch knows, expected PNG, JPEG, BMP, TGA or GIF"
        );
    }

    #[test]
    fn a_header_that_promises_too_much_takes_no_memory() {
        let rgb = ImageBuffer::from_pixel(1, 1, Rgb([1, 2, 3]));
        let mut bmp = encoded(DynamicImage::ImageRgb8(rgb), ImageFormat::Bmp);
        bmp[18..22].copy_from_slice(&30_000_u32.to_le_bytes());
        bmp[22..26].copy_from_slice(&30_000_u32.to_le_bytes());
        assert_eq!(
            decode("", &bmp, &Budget::default()).unwrap_err(),
            "is 30000 x 30000 pixels, expected at most 268435456 in all"
        );
        bmp[18..22].copy_from_slice(&10_000_u32.to_le_bytes());
        bmp[22..26].copy_from_slice(&10_000_u32.to_le_bytes());
        assert_eq!(
            decode("", &bmp, &Budget::default()).unwrap_err(),
            "says 10000 x 10000 pixels, for which the file is too short"
        );
    }

    #[test]
    fn a_broken_file_is_one_line() {
        let rgb = ImageBuffer::from_pixel(9, 9, Rgb([1, 2, 3]));
        let png = encoded(DynamicImage::ImageRgb8(rgb), ImageFormat::Png);
        for length in 1..png.len() - 12 {
            let problem = decode("", &png[..length], &Budget::default()).unwrap_err();
            assert!(!problem.contains('\n'), "{problem}");
        }
        assert!(decode("", b"\xff\xd8\xff\xe0", &Budget::default()).is_err());
    }

    #[test]
    fn pixels_come_from_the_budget_before_they_are_decoded() {
        let grey = ImageBuffer::from_pixel(1000, 1000, Luma([7_u8]));
        let png = encoded(grey, ImageFormat::Png);
        let budget = |bytes| {
            Budget::of(&Options {
                max_memory: Some(bytes),
                ..Options::default()
            })
        };
        let refused = decode("", &png, &budget(8_000_000)).unwrap_err();
        assert_eq!(
            refused,
            "1000 x 1000 pixels: takes 9 MB of memory, 8 MB are left; make it smaller, or allow more with --max-memory"
        );
        assert!(decode("", &png, &budget(9_000_000)).is_ok());
    }
}
