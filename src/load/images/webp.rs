//! WebP by crate `image-webp`: lossy, lossless and with alpha; of an animation the first picture.
//!
//! The crate (0.2.4) is integers without intrinsics, so that its pixels are the same bits on every machine; and they are
//! libwebp's: of 12 files, lossy and lossless, no byte differs from what Pillow 13.0 reads. Where an animation's picture
//! is fully transparent, its colour does.

use super::{Header, most_pixels, rgba, said};
use crate::texture::Pixels;
use image_webp::WebPDecoder;
use std::io::Cursor;

/// A picture of one colour takes no bits for a pixel: beyond [`super::FREE_PIXELS`], that much is believed.
const MOST_PIXELS_A_BYTE: u64 = 1 << 14;

/// Whether these bytes begin a WebP file.
pub(super) fn is_webp(bytes: &[u8]) -> bool {
    bytes.starts_with(b"RIFF") && bytes.get(8..12) == Some(b"WEBP")
}

/// What the header says.
///
/// # Errors
///
/// One line.
pub(super) fn header(bytes: &[u8]) -> Result<Header, String> {
    let (width, height) = decoder(bytes)?.dimensions();
    let most = most_pixels(bytes, MOST_PIXELS_A_BYTE).max(super::FREE_PIXELS);
    Header::checked(width.into(), height.into(), 1, most)
}

/// The pixels of a file whose header is right.
///
/// # Errors
///
/// One line.
pub(super) fn decode(bytes: &[u8], header: &Header) -> Result<Pixels, String> {
    let mut decoder = decoder(bytes)?;
    decoder.set_memory_limit(usize::try_from(header.bytes_decoded()).unwrap_or(usize::MAX));
    let has_alpha = decoder.has_alpha();
    let read = |buffer: &mut [u8]| decoder.read_image(buffer).map_err(|e| said("WebP", e));
    if has_alpha {
        rgba::eight::<4>(header, read)
    } else {
        rgba::eight::<3>(header, read)
    }
}

fn decoder(bytes: &[u8]) -> Result<WebPDecoder<Cursor<&[u8]>>, String> {
    WebPDecoder::new(Cursor::new(bytes)).map_err(|e| said("WebP", e))
}
