//! PNG, read back.

use super::{encoded, film};
use image::{DynamicImage, ImageFormat};
use luch::film::Film;
use luch::output::{BitDepth, Display, Format, Options};
use luch::scene::Shown;

/// A PNG of `film`, decoded by crate `image`.
pub(crate) fn png(film: &Film, options: &Options) -> DynamicImage {
    let bytes = encoded(film, Format::Png, options);
    image::load_from_memory_with_format(&bytes, ImageFormat::Png).unwrap()
}

fn png_pixel(shown: Shown, pixel: [f32; 4], options: &Options) -> Vec<u8> {
    png(&film(1, shown, &[pixel]), options).as_bytes().to_vec()
}

#[test]
fn a_png_has_its_rows_from_the_top_and_an_srgb_chunk() {
    let [black, white, red] = [[0.0, 0.0, 0.0, 1.0], [1.0; 4], [1.0, 0.0, 0.0, 1.0]];
    let film = film(2, Shown::Always, &[black, white, red, red, black, black]);
    let bytes = encoded(&film, Format::Png, &Options::default());
    assert!(bytes.windows(4).any(|chunk| chunk == b"sRGB"));
    let picture = png(&film, &Options::default()).into_rgb8();
    assert_eq!(picture.dimensions(), (2, 3));
    assert_eq!(picture.get_pixel(1, 0).0, [255, 255, 255]);
    assert_eq!(picture.get_pixel(0, 1).0, [255, 0, 0]);
    assert_eq!(picture.get_pixel(1, 2).0, [0, 0, 0]);
}

#[test]
fn a_background_for_displays_lies_behind_the_picture() {
    // Half covered by light of 0.5: 0.25 of it is in the pixel, and half of the background (0.5, 0.25, 1).
    let pixel = [0.25, 0.25, 0.25, 0.5];
    let options = Options {
        bit_depth: BitDepth::Sixteen,
        ..Options::default()
    };
    let half = png_pixel(Shown::OnDisplay, pixel, &options);
    let whole = png_pixel(Shown::Always, [0.5, 0.375, 0.75, 1.0], &options);
    assert_eq!(half.len(), 6);
    assert_eq!(half, whole);
}

#[test]
fn a_picture_without_background_has_straight_alpha() {
    // Premultiplied light of 0.18 under an alpha of 1/4 is light of 0.72; display transforms see that.
    let pixel = [0.18, 0.045, 0.0, 0.25];
    for display in Display::ALL {
        let options = Options {
            display,
            ..Options::default()
        };
        let found = png_pixel(Shown::Never, pixel, &options);
        let opaque = png_pixel(Shown::Always, [0.72, 0.18, 0.0, 1.0], &options);
        assert_eq!(found[..3], opaque, "{display:?}");
        assert_eq!(found[3], 64);
    }
}

#[test]
fn nothing_is_transparent_black() {
    let nothing = png_pixel(Shown::Never, [0.0; 4], &Options::default());
    assert_eq!(nothing, [0; 4]);
}

#[test]
fn a_stop_of_exposure_doubles_the_light() {
    let one_stop = Options {
        exposure: 1.0,
        display: Display::Reinhard,
        ..Options::default()
    };
    let none = Options {
        exposure: 0.0,
        ..one_stop.clone()
    };
    for shown in [Shown::Always, Shown::OnDisplay, Shown::Never] {
        let [once, twice] = [[0.1, 0.2, 0.3, 1.0], [0.2, 0.4, 0.6, 1.0]];
        assert_eq!(
            png_pixel(shown, once, &one_stop),
            png_pixel(shown, twice, &none)
        );
    }
}

#[test]
fn sixteen_bits_refine_eight() {
    let pixels: Vec<[f32; 4]> = (0..=100)
        .map(|step| [step as f32 / 100.0, 0.0, 1.0, 1.0])
        .collect();
    let film = film(101, Shown::Never, &pixels);
    let sixteen = Options {
        bit_depth: BitDepth::Sixteen,
        ..Options::default()
    };
    let fine = png(&film, &sixteen);
    assert!(matches!(fine, DynamicImage::ImageRgba16(_)));
    let coarse = png(&film, &Options::default()).into_rgba8();
    for (fine, coarse) in fine.into_rgba16().iter().zip(coarse.iter()) {
        assert!((f32::from(*fine) / 257.0 - f32::from(*coarse)).abs() <= 0.51);
    }
}

#[test]
fn what_is_no_number_or_negative_is_black_in_a_png() {
    let pixel = [f32::NAN, -1.0, f32::INFINITY, 1.0];
    for shown in [Shown::Always, Shown::OnDisplay, Shown::Never] {
        let found = png_pixel(shown, pixel, &Options::default());
        assert_eq!(found[..3], [0, 0, 255], "{shown:?}");
    }
    let found = png_pixel(Shown::Never, [1.0, 1.0, 1.0, f32::NAN], &Options::default());
    assert_eq!(found, [0; 4]);
}
