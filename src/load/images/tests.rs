//! Each kind of image, made by another writer.

#![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

use super::*;
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
        refused(b"RIFF\x1a\0\0\0WEBPVP8L"),
        "is a WebP image, which is not supported; use PNG or JPEG"
    );
    assert!(refused(b"\xabKTX 20\xbb\r\n\x1a\n").starts_with("is a KTX2 image"));
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
