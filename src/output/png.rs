//! PNG: the beauty as a display shows it.

use super::rows::{map_rows, row};
use super::transfer::{srgb_code_8, srgb_code_16};
use super::{BitDepth, Options};
use crate::color::Rgb;
use crate::film::{BEAUTY, Film};
use crate::scene::Shown;
use std::io::{self, BufRead, Seek, Write};

/// Writes the beauty: with straight alpha where the background is never shown, else without alpha and with the
/// background behind everything.
pub(super) fn write(film: &Film, options: &Options, out: &mut dyn Write) -> io::Result<()> {
    // In memory first: crate `png` makes a sentence of what `out` says, and a closed pipe should be seen as one.
    out.write_all(&encoded(film, options)?)?;
    out.flush()
}

fn encoded(film: &Film, options: &Options) -> Result<Vec<u8>, png::EncodingError> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, film.width, film.height);
    encoder.set_color(match film.background.shown {
        Shown::Never => png::ColorType::Rgba,
        Shown::Always | Shown::OnDisplay | Shown::Environment => png::ColorType::Rgb,
    });
    encoder.set_depth(match options.bit_depth {
        BitDepth::Eight => png::BitDepth::Eight,
        BitDepth::Sixteen => png::BitDepth::Sixteen,
    });
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    encoder.set_compression(png::Compression::Fast);
    let mut writer = encoder.write_header()?;
    let mut lines = writer.stream_writer()?;
    for line in map_rows(film, |y| line(film, options, y)) {
        lines.write_all(&line)?;
    }
    lines.finish()?;
    writer.finish()?;
    Ok(bytes)
}

/// A PNG of `rgb`: 8-bit sRGB, three bytes a pixel, top row first. For pictures that are no film.
///
/// # Errors
///
/// A side is zero, or `rgb` is not as long as the sides say.
pub fn rgb_png(width: u32, height: u32, rgb: &[u8]) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    encoder.set_source_srgb(png::SrgbRenderingIntent::Perceptual);
    let mut writer = encoder.write_header()?;
    writer.write_image_data(rgb)?;
    writer.finish()?;
    Ok(bytes)
}

/// Whether `file` is a PNG from its signature to its end.
pub(super) fn is_whole(file: impl BufRead + Seek) -> bool {
    let read = || -> Result<(), png::DecodingError> {
        let mut reader = png::Decoder::new(file).read_info()?;
        while reader.next_row()?.is_some() {}
        reader.finish()
    };
    read().is_ok()
}

/// The bytes of row `y`.
fn line(film: &Film, options: &Options, y: usize) -> Vec<u8> {
    let exposure = libm::exp2f(options.exposure);
    let beauty = film.layer(BEAUTY.channels);
    let pixels = beauty.map_or(&[][..], |beauty| row(film, beauty, y));
    let mut bytes = Vec::with_capacity(pixels.len() * 2);
    // Of the whole picture's height: a crop's background is that of the whole.
    let share = (film.top as f32 + y as f32 + 0.5) / film.display_height as f32;
    let share = share.clamp(0.0, 1.0);
    let background = film.background;
    let behind = background
        .top
        .map_or(background.color, |top| top.mix(background.color, share));
    for &pixel in pixels.as_chunks::<4>().0 {
        let (light, alpha) = on_display(pixel, background.shown, behind);
        let Rgb { r, g, b } = options.display.apply(light * exposure);
        let alpha = (film.background.shown == Shown::Never).then_some(alpha);
        match options.bit_depth {
            BitDepth::Eight => {
                bytes.extend([r, g, b].map(srgb_code_8));
                bytes.extend(alpha.map(|alpha| (alpha * 255.0).round() as u8));
            }
            BitDepth::Sixteen => {
                let alpha = alpha.map(|alpha| (alpha * 65535.0).round() as u16);
                let codes = [r, g, b].map(srgb_code_16).into_iter().chain(alpha);
                bytes.extend(codes.flat_map(u16::to_be_bytes));
            }
        }
    }
    bytes
}

/// The light of a pixel before what lies behind it, and how much of the pixel is covered, 0..1.
fn on_display([r, g, b, alpha]: [f32; 4], shown: Shown, behind: Rgb) -> (Rgb, f32) {
    let light = Rgb::new(r, g, b);
    match shown {
        Shown::Always | Shown::Environment => (light, 1.0),
        Shown::OnDisplay => (light + behind * (1.0 - alpha), 1.0),
        // PNG's alpha is straight, and a display transform must see the light of the surface, not its share.
        Shown::Never if alpha > 0.0 => (light.map(|channel| channel / alpha), alpha.min(1.0)),
        Shown::Never => (Rgb::BLACK, 0.0),
    }
}
