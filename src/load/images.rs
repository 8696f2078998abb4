//! Image files: PNG, BMP, TGA and GIF by crate `image`, JPEG by crate `zune-jpeg`.
//!
//! JPEG decoders differ in their last bit, and one decoder's SIMD from its scalar code. `zune-jpeg` without its features
//! `x86`, `neon` and `portable_simd` compiles no intrinsics (each use stands behind one of them, 0.5.15); its options
//! say so once more, in case another crate of the build switches a feature on.

use crate::texture::{Image, Pixels};
use image::{DynamicImage, ImageDecoder, ImageFormat, ImageReader, Limits};
use std::io::Cursor;
use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

/// No image has more, 16384 x 16384.
const MOST_PIXELS: u64 = 1 << 28;

/// No PNG, BMP, TGA or GIF has more for each byte of its file: deflate reaches 1032 bytes of 8 one-bit pixels each.
const MOST_PIXELS_A_BYTE: u64 = 1 << 14;

/// No JPEG has more for each byte of its file: the least is one bit for 64 pixels.
const MOST_JPEG_PIXELS_A_BYTE: u64 = 1 << 10;

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
pub(super) fn decode(name: &str, bytes: &[u8]) -> Result<Image, String> {
    let (width, height, pixels) = match kind(name, bytes)? {
        Kind::Jpeg => decode_jpeg(bytes)?,
        Kind::Other(format) => decode_other(format, bytes)?,
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

fn decode_jpeg(bytes: &[u8]) -> Result<(u32, u32, Pixels), String> {
    let said = |error| said("JPEG", error);
    // RGB rather than RGBA: for RGBA the decoder (0.5.15) steps through CMYK images in rows of a wrong length.
    let options = DecoderOptions::new_safe()
        .set_use_unsafe(false)
        .set_max_width(u16::MAX.into())
        .set_max_height(u16::MAX.into())
        .jpeg_set_out_colorspace(ColorSpace::RGB);
    let mut decoder = JpegDecoder::new_with_options(ZCursor::new(bytes), options);
    decoder.decode_headers().map_err(said)?;
    let (width, height) = decoder.dimensions().unwrap_or_default();
    check_size(
        width as u64,
        height as u64,
        most_pixels(bytes, MOST_JPEG_PIXELS_A_BYTE),
    )?;
    let rgb = decoder.decode().map_err(said)?;
    let pixels: Vec<[u8; 4]> = rgb
        .as_chunks::<3>()
        .0
        .iter()
        .map(|&[r, g, b]| [r, g, b, 255])
        .collect();
    if pixels.len() != width * height {
        return Err(format!(
            "broken JPEG: {} pixels for {width} x {height}",
            pixels.len()
        ));
    }
    Ok((width as u32, height as u32, Pixels::Eight(pixels)))
}

fn decode_other(format: ImageFormat, bytes: &[u8]) -> Result<(u32, u32, Pixels), String> {
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
    use super::*;
    use image::{ImageBuffer, Luma, LumaA, Rgb, Rgba};

    fn encoded(image: impl Into<DynamicImage>, format: ImageFormat) -> Vec<u8> {
        let mut bytes = Cursor::new(Vec::new());
        image.into().write_to(&mut bytes, format).unwrap();
        bytes.into_inner()
    }

    fn from_hex(hex: &str) -> Vec<u8> {
        (0..hex.len() / 2)
            .map(|i| u8::from_str_radix(&hex[2 * i..2 * i + 2], 16).unwrap())
            .collect()
    }

    fn eight(name: &str, bytes: &[u8]) -> Vec<[u8; 4]> {
        match decode(name, bytes).unwrap().pixels {
            Pixels::Eight(pixels) => pixels,
            Pixels::Sixteen(_) => panic!("8 bits expected"),
        }
    }

    /// The four corners against what Pillow 13.0 (libjpeg-turbo) decodes: the standard leaves decoders the last bit.
    fn assert_corners(jpeg: &str, width: usize, height: usize, expected: [[i32; 3]; 4]) {
        let pixels = eight("a.jpg", &from_hex(jpeg));
        assert_eq!(pixels.len(), width * height);
        let corners = [0, width - 1, width * (height - 1), width * height - 1];
        for (at, expected) in corners.into_iter().zip(expected) {
            let [r, g, b, a] = pixels[at].map(i32::from);
            let near = |(found, expected): (i32, i32)| (found - expected).abs() <= 2;
            let all = [r, g, b].into_iter().zip(expected).all(near);
            assert!(all && a == 255, "{:?} is not {expected:?}", pixels[at]);
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
        let image = decode("deep", &png).unwrap();
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
        assert!(decode("a.png", &tga).is_err());
    }

    #[test]
    fn gif_is_read() {
        let rgba = ImageBuffer::from_pixel(3, 1, Rgba([255, 0, 0, 255]));
        let gif = encoded(DynamicImage::ImageRgba8(rgba), ImageFormat::Gif);
        assert_eq!(eight("", &gif), [[255, 0, 0, 255]; 3]);
    }

    #[test]
    fn a_colour_jpeg_is_what_another_decoder_says() {
        let jpeg = "ffd8ffe000104a46494600010100000100010000ffdb00430006040506050406060506070706080a100a\
         0a09090a140e0f0c1017141818171416161a1d251f1a1b231c1616202c20232627292a29191f2d302d28\
         3025282928ffdb0043010707070a080a130a0a13281a161a282828282828282828282828282828282828\
         2828282828282828282828282828282828282828282828282828282828282828ffc00011080002000403\
         011100021101031101ffc40014000100000000000000000000000000000005ffc4001b10000201050000\
         000000000000000000000304000105152392ffc4001501010100000000000000000000000000000406ff\
         c4001d110001030501000000000000000000000002000103040513142122ffda000c0301000211031100\
         3f004ec8d318e1ef2f7593b5318647e2459620d41f2cbfffd9";
        assert_corners(
            jpeg,
            4,
            2,
            [
                [42, 198, 101],
                [184, 199, 96],
                [36, 145, 78],
                [179, 146, 75],
            ],
        );
    }

    #[test]
    fn a_grey_jpeg_is_what_another_decoder_says() {
        let jpeg = "ffd8ffe000104a46494600010100000100010000ffdb00430006040506050406060506070706080a100a\
         0a09090a140e0f0c1017141818171416161a1d251f1a1b231c1616202c20232627292a29191f2d302d28\
         3025282928ffc0000b080003000301011100ffc40014000100000000000000000000000000000006ffc4\
         001d1000010207000000000000000000000000010003040507162233b1ffda0008010100003f00574ea1\
         dab224f80d03a57fffd9";
        assert_corners(jpeg, 3, 3, [[32; 3], [173; 3], [49; 3], [190; 3]]);
    }

    #[test]
    fn an_adobe_cmyk_jpeg_is_what_another_decoder_says() {
        let jpeg = "ffd8ffee000e41646f626500640000000000ffdb00430002010101010102010101020202020204030202\
         02020504040304060506060605060606070908060709070606080b08090a0a0a0a0a06080b0c0b0a0c09\
         0a0a0affc000140800020002044311004d11005911004b1100ffc4001500010100000000000000000000\
         000000000907ffc4001f1000010500030101010000000000000000020103040506070809001121ffda00\
         0e0443004d0059004b00003f0063359e64f9b7bdd559eeb75e7cf07dd5ddd583d3ee6e6db89e9e4ca9f2\
         9e3571d90f3ae465375d332232325522225555555f98cf32759aadef9b7d7cdd6eb4d61757775c1f939f\
         73736d34e4ca9f29ea78ae3b21e75c55375d332232325522225555555f8eef4dbd36f49305e92760f0b8\
         5f41b9c29692979c359029a9aa7962e234581159b894db51d969b9280d34002202028822228888889f57\
         b97fb49d9bace59d456d6f62f771e3c7d14d6a3c7635d3401a017cd044451dfc1444444444fe2227dfff\
         d9";
        assert_corners(
            jpeg,
            2,
            2,
            [[252, 253, 253], [0, 254, 255], [204, 1, 203], [129, 129, 0]],
        );
    }

    #[test]
    fn what_luch_does_not_read_is_refused_by_name() {
        let refused = |bytes: &[u8]| decode("", bytes).unwrap_err();
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
            decode("", &bmp).unwrap_err(),
            "is 30000 x 30000 pixels, expected at most 268435456 in all"
        );
        bmp[18..22].copy_from_slice(&10_000_u32.to_le_bytes());
        bmp[22..26].copy_from_slice(&10_000_u32.to_le_bytes());
        assert_eq!(
            decode("", &bmp).unwrap_err(),
            "says 10000 x 10000 pixels, for which the file is too short"
        );
    }

    #[test]
    fn a_broken_file_is_one_line() {
        let rgb = ImageBuffer::from_pixel(9, 9, Rgb([1, 2, 3]));
        let png = encoded(DynamicImage::ImageRgb8(rgb), ImageFormat::Png);
        for length in 1..png.len() - 12 {
            let problem = decode("", &png[..length]).unwrap_err();
            assert!(!problem.contains('\n'), "{problem}");
        }
        assert!(decode("", b"\xff\xd8\xff\xe0").is_err());
    }
}
