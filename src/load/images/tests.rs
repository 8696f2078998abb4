//! Each kind of image, made by another writer.

#![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

use super::samples::{self, from_hex};
use super::*;
use crate::load::Options;
use crate::texture::Pixels;
use image::{DynamicImage, ImageBuffer, ImageFormat, Luma, LumaA, Rgb, Rgba};
use std::io::Cursor;

fn encoded(image: impl Into<DynamicImage>, format: ImageFormat) -> Vec<u8> {
    let mut bytes = Cursor::new(Vec::new());
    image.into().write_to(&mut bytes, format).unwrap();
    bytes.into_inner()
}

fn eight(name: &str, bytes: &[u8]) -> Vec<[u8; 4]> {
    match decode(name, bytes).unwrap().image.pixels {
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
    let image = decode("deep", &png).unwrap().image;
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
fn what_luch_does_not_read_is_refused_by_name() {
    let refused = |bytes: &[u8]| decode("", bytes).unwrap_err();
    assert_eq!(
        refused(b"\0\0\0\x1cftypavif"),
        "is an AVIF image, which is not supported; use PNG or JPEG"
    );
    assert!(refused(b"DDS |\0\0\0").starts_with("is a DDS image"));
    assert_eq!(refused(b""), "is empty");
    assert_eq!(
        refused(b"<!DOCTYPE html>"),
        "is no image luch knows, expected PNG, JPEG, WebP, KTX2, BMP, TGA or GIF"
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

/// The greatest difference of any channel of a file from what another program reads in it.
fn difference(file: &str, expected: &str) -> u8 {
    let found = eight("", &from_hex(file));
    let (found, expected) = (found.as_flattened(), from_hex(expected));
    assert_eq!(found.len(), expected.len());
    let pairs = found.iter().zip(expected);
    pairs.map(|(&a, b)| a.abs_diff(b)).max().unwrap()
}

#[test]
fn basis_universal_is_what_its_own_transcoder_says() {
    assert_eq!(difference(samples::ETC1S, samples::ETC1S_PIXELS), 0);
    assert_eq!(difference(samples::UASTC, samples::UASTC_PIXELS), 0);
    assert_eq!(difference(samples::UASTC_ZSTD, samples::UASTC_PIXELS), 0);
}

#[test]
fn webp_is_what_libwebp_says() {
    for (file, expected) in [
        (samples::WEBP_LOSSY, samples::WEBP_LOSSY_PIXELS),
        (samples::WEBP_LOSSLESS, samples::WEBP_LOSSLESS_PIXELS),
        (samples::WEBP_ANIMATION, samples::WEBP_ANIMATION_PIXELS),
    ] {
        assert_eq!(difference(file, expected), 0);
    }
}

#[test]
fn jpeg_is_what_libjpeg_says_but_for_rounding() {
    for (file, expected) in [
        (samples::JPEG_PROGRESSIVE, samples::JPEG_PROGRESSIVE_PIXELS),
        (samples::JPEG_YCCK, samples::JPEG_YCCK_PIXELS),
        (samples::JPEG_RESTARTS, samples::JPEG_RESTARTS_PIXELS),
    ] {
        assert!(difference(file, expected) <= 4);
    }
}

#[test]
fn a_jpeg_that_is_cut_short_shows_what_there_is() {
    let whole = from_hex(samples::JPEG_PROGRESSIVE);
    assert_eq!(decode("", &whole).unwrap().flaw, None);
    let first_scan = whole.windows(2).position(|pair| pair == [0xff, 0xda]);
    let mut shown = 0;
    for length in first_scan.unwrap() + 20..whole.len() - 1 {
        if let Ok(found) = decode("", &whole[..length]) {
            assert_eq!(
                found.flaw,
                Some("is cut short, what there is of it is shown")
            );
            shown += 1;
        }
    }
    let lengths = whole.len() - 1 - first_scan.unwrap() - 20;
    assert!(shown * 10 > lengths * 9, "{shown} of {lengths}");
}

#[test]
fn a_broken_or_changed_file_of_a_rarer_kind_is_no_panic() {
    for file in [
        samples::ETC1S,
        samples::UASTC,
        samples::UASTC_ZSTD,
        samples::WEBP_LOSSY,
        samples::WEBP_LOSSLESS,
        samples::WEBP_ANIMATION,
        samples::JPEG_PROGRESSIVE,
        samples::JPEG_YCCK,
    ] {
        let whole = from_hex(file);
        for at in 0..whole.len() {
            // Any outcome but a panic.
            let _ = decode("", &whole[..at]);
            for with in [0, 1, 0x7f, 0xff] {
                let mut changed = whole.clone();
                changed[at] = with;
                let _ = decode("", &changed);
            }
        }
    }
}

#[test]
fn ktx2_that_luch_does_not_read_is_refused_by_its_numbers() {
    let refused = |at: usize, with: u32| {
        let mut bytes = from_hex(samples::UASTC);
        bytes[at..at + 4].copy_from_slice(&with.to_le_bytes());
        decode("", &bytes).unwrap_err()
    };
    assert_eq!(
        refused(12, 37),
        "is a KTX2 image in Vulkan's format 37, which is not supported; use Basis Universal, PNG or JPEG"
    );
    assert_eq!(
        refused(36, 6),
        "is a KTX2 image of 5 x 6 x 0 pixels in 0 layers and 6 faces, expected one flat picture"
    );
    assert_eq!(
        refused(44, 3),
        "is a KTX2 image of colour model 166 with supercompression 3, which is not supported; use ETC1S with BasisLZ, \
         or UASTC plain or with Zstandard"
    );
    assert_eq!(
        refused(24, 4096),
        "broken KTX2: its first level is not the 32768 bytes of 5 x 4096 pixels"
    );
    assert_eq!(
        refused(80, u32::MAX),
        "broken KTX2: its first level is not in the file"
    );
}

#[test]
fn a_header_tells_how_much_memory_the_pixels_take() {
    let bytes = |file| header("", &from_hex(file)).unwrap().bytes_decoded();
    assert_eq!(bytes(samples::ETC1S), 5 * 6 * 4);
    assert_eq!(bytes(samples::WEBP_LOSSY), 5 * 6 * 4);
    assert_eq!(bytes(samples::JPEG_YCCK), 10 * 9 * 4);
    let grey = ImageBuffer::from_pixel(3, 2, Luma([513_u16]));
    let png = encoded(DynamicImage::ImageLuma16(grey), ImageFormat::Png);
    assert_eq!(header("", &png).map(|h| h.bytes_decoded()), Ok(3 * 2 * 8));
}

#[test]
fn pixels_come_from_the_budget_before_they_are_decoded() {
    let grey = ImageBuffer::from_pixel(1000, 1000, Luma([7_u8]));
    let png = encoded(grey, ImageFormat::Png);
    let within = |bytes| {
        let options = Options {
            max_memory: Some(bytes),
            ..Options::default()
        };
        let encoded = Encoded::new(String::new(), png.as_slice().into());
        let mut decoded = decode_all(vec![(0, encoded)], &Budget::of(&options));
        decoded.remove(0).1
    };
    assert_eq!(
        within(7_000_000).unwrap_err(),
        "1000 x 1000 pixels: takes 8 MB of memory, 7 MB are left; make it smaller, or allow more with --max-memory"
    );
    assert!(within(8_000_000).is_ok());
}

#[test]
fn many_images_come_back_under_their_keys() {
    let png = |side: u32| {
        let grey = ImageBuffer::from_pixel(side, side, Luma([7_u8]));
        Encoded::new(String::new(), encoded(grey, ImageFormat::Png).into())
    };
    let options = Options {
        max_memory: Some(100_000),
        ..Options::default()
    };
    let broken = Encoded::new(String::new(), b"?".as_slice().into());
    let all = vec![(3, png(1)), (1, png(5)), (0, png(1000)), (2, broken)];
    let found = decode_all(all, &Budget::of(&options));
    let widths = found.iter().map(|(key, found)| {
        let width = found.as_ref().ok().map(|decoded| decoded.image.width);
        (*key, width)
    });
    let expected = [(0, None), (1, Some(5)), (2, None), (3, Some(1))];
    assert_eq!(widths.collect::<Vec<_>>(), expected);
}
