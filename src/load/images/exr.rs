//! OpenEXR, where its pixels are light from all around.

use super::said;
use crate::color::Rgb;
use image::ImageDecoder;
use image::codecs::openexr::OpenExrDecoder;
use std::io::Cursor;

/// The first bytes of every such file.
pub(in crate::load) const MAGIC: &[u8] = &[0x76, 0x2f, 0x31, 0x01];
/// No corner of a picture lies farther from the origin.
const FARTHEST: i64 = 1 << 20;
/// No picture has more of them.
const MOST_CHANNELS: usize = 64;

/// What is known of a file before memory is taken for it.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(in crate::load) struct Header {
    /// The greatest of the file's pictures, and of the frames that they are shown in.
    pub(in crate::load) width: u32,
    pub(in crate::load) height: u32,
    channels: usize,
}

impl Header {
    /// Bytes that decoding takes at its peak: all channels as they are stored, and thrice as light.
    pub(in crate::load) fn bytes_to_decode(&self) -> u64 {
        u64::from(self.width) * u64::from(self.height) * 4 * (self.channels as u64 + 9)
    }
}

/// Reads how great the pictures are. The decoder trusts the file in this.
///
/// # Errors
///
/// One line that says what is wrong, without the file's name.
pub(in crate::load) fn header(bytes: &[u8]) -> Result<Header, String> {
    const MANY_PARTS: u8 = 0x10;
    let flags = bytes.get(5).copied().unwrap_or_default();
    let mut rest = bytes.get(8..).unwrap_or_default();
    let mut header = Header::default();
    loop {
        let name = text(&mut rest)?;
        if name.is_empty() {
            // The end of a part's attributes, and of all parts' where another zero follows.
            if flags & MANY_PARTS == 0 || rest.first().is_none_or(|&byte| byte == 0) {
                break;
            }
            continue;
        }
        let _type = text(&mut rest)?;
        let (length, after) = rest.split_first_chunk::<4>().ok_or(TOO_SHORT)?;
        let length = usize::try_from(i32::from_le_bytes(*length)).map_err(|_| TOO_SHORT)?;
        let (value, after) = after.split_at_checked(length).ok_or(TOO_SHORT)?;
        rest = after;
        match name {
            b"dataWindow" | b"displayWindow" => header.include(window(value)?),
            b"channels" => header.channels += channels(value),
            _ => {}
        }
    }
    if header.channels > MOST_CHANNELS {
        let found = header.channels;
        return Err(format!(
            "has {found} channels, expected at most {MOST_CHANNELS}"
        ));
    }
    Ok(header)
}

/// Reads the pixels of the first picture with red, green and blue, top row first: its width, its height, and they.
///
/// # Errors
///
/// One line that says what is wrong, without the file's name.
pub(in crate::load) fn decode(bytes: &[u8]) -> Result<(u32, u32, Vec<Rgb>), String> {
    let wrong = |error| said("OpenEXR image", error);
    let decoder = OpenExrDecoder::with_alpha_preference(Cursor::new(bytes), Some(false));
    let decoder = decoder.map_err(wrong)?;
    let (width, height) = decoder.dimensions();
    let mut raw = vec![0; usize::try_from(decoder.total_bytes()).map_err(|_| TOO_SHORT)?];
    decoder.read_image(&mut raw).map_err(wrong)?;
    let (pixels, _) = raw.as_chunks::<12>();
    let pixel = |bytes: &[u8; 12]| {
        let (channels, _) = bytes.as_chunks::<4>();
        let mut values = channels.iter().map(|bytes| f32::from_ne_bytes(*bytes));
        let mut next = || values.next().unwrap_or_default();
        Rgb::new(next(), next(), next())
    };
    Ok((width, height, pixels.iter().map(pixel).collect()))
}

const TOO_SHORT: &str = "is too short: its header has no end";

impl Header {
    fn include(&mut self, [width, height]: [u32; 2]) {
        self.width = self.width.max(width);
        self.height = self.height.max(height);
    }
}

/// What stands before the next zero byte.
fn text<'a>(rest: &mut &'a [u8]) -> Result<&'a [u8], String> {
    let end = rest.iter().position(|&byte| byte == 0).ok_or(TOO_SHORT)?;
    let (text, after) = rest.split_at(end);
    *rest = after.get(1..).unwrap_or_default();
    Ok(text)
}

/// The width and height of a window: the corners belong to it.
fn window(value: &[u8]) -> Result<[u32; 2], String> {
    let (numbers, _) = value.as_chunks::<4>();
    let numbers: Vec<i64> = numbers
        .iter()
        .map(|bytes| i32::from_le_bytes(*bytes).into())
        .collect();
    match *numbers {
        [left, top, right, bottom]
            if numbers.iter().all(|number| number.abs() <= FARTHEST)
                && left <= right
                && top <= bottom =>
        {
            Ok([right - left + 1, bottom - top + 1].map(|size| size as u32))
        }
        _ => Err(format!(
            "has a window from and to {numbers:?}, expected one of pixels near the origin"
        )),
    }
}

/// How many channels a list has: a name, a zero and sixteen bytes each.
fn channels(mut list: &[u8]) -> usize {
    let mut count = 0;
    while let Ok([_, ..]) = text(&mut list) {
        list = list.get(16..).unwrap_or_default();
        count += 1;
    }
    count
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

    use super::*;
    use image::codecs::openexr::OpenExrEncoder;
    use image::{ExtendedColorType, ImageEncoder};

    const PIXELS: [[f32; 3]; 2] = [[0.25, 1e6, -1.0], [0.0, f32::INFINITY, 3.0]];

    fn file() -> Vec<u8> {
        let raw: Vec<u8> = PIXELS
            .iter()
            .flatten()
            .flat_map(|value| value.to_ne_bytes())
            .collect();
        let mut file = Cursor::new(Vec::new());
        let encoder = OpenExrEncoder::new(&mut file);
        encoder
            .write_image(&raw, 2, 1, ExtendedColorType::Rgb32F)
            .unwrap();
        file.into_inner()
    }

    #[test]
    fn a_picture_is_known_before_it_is_read_and_read_as_it_was() {
        let found = header(&file()).unwrap();
        assert_eq!((found.width, found.height, found.channels), (2, 1, 3));
        let expected = PIXELS.map(Rgb::from).to_vec();
        assert_eq!(decode(&file()), Ok((2, 1, expected)));
    }

    #[test]
    fn a_picture_cut_short_is_an_error_wherever_that_is() {
        let file = file();
        for length in MAGIC.len()..file.len() {
            let cut = file.get(..length).unwrap();
            assert!(header(cut).is_err() || decode(cut).is_err(), "{length}");
        }
    }

    #[test]
    fn a_picture_with_any_byte_wrong_is_read_or_refused() {
        let file = file();
        for at in MAGIC.len()..file.len() {
            for wrong in [0, 1, 0x7f, 0xff] {
                let mut file = file.clone();
                *file.get_mut(at).unwrap() = wrong;
                // As whoever opens a file does: what is too great is not decoded.
                if header(&file).is_ok_and(|header| header.bytes_to_decode() < 1 << 20) {
                    let _ = decode(&file);
                }
            }
        }
    }

    #[test]
    fn a_window_without_end_is_an_error() {
        let mut file = file();
        let at = file
            .windows(11)
            .position(|name| name == b"dataWindow\0")
            .unwrap();
        // The name, the type, the length; then the corner at the right.
        let right = at + 11 + 6 + 4 + 8;
        file.get_mut(right..right + 4)
            .unwrap()
            .copy_from_slice(&i32::MAX.to_le_bytes());
        let problem = header(&file).unwrap_err();
        assert!(
            problem.starts_with("has a window from and to [0, 0, 2147483647, 0]"),
            "{problem}"
        );
    }
}
