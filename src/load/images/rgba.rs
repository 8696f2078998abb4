//! From the channels that decoders give to red, green, blue and alpha, in one piece of memory.

use super::Header;
use crate::texture::Pixels;

/// Pixels of 8 bits in `CHANNELS` (grey, grey and alpha, red green blue, all four), which `read` writes.
///
/// It writes into the end of the buffer; then each pixel goes to its place, the first first, so that none is written
/// over before it has been read.
///
/// # Errors
///
/// As `read`.
pub(super) fn eight<const CHANNELS: usize>(
    header: &Header,
    read: impl FnOnce(&mut [u8]) -> Result<(), String>,
) -> Result<Pixels, String> {
    let count = header.count();
    let mut pixels = vec![[0_u8; 4]; count];
    let bytes = pixels.as_flattened_mut();
    let start = 4_usize.saturating_sub(CHANNELS) * count;
    read(bytes.get_mut(start..).unwrap_or_default())?;
    if CHANNELS < 4 {
        for i in 0..count {
            let from = start + CHANNELS * i;
            let pixel = match bytes.get(from..from + CHANNELS) {
                Some(&[grey]) => [grey, grey, grey, u8::MAX],
                Some(&[grey, alpha]) => [grey, grey, grey, alpha],
                Some(&[r, g, b]) => [r, g, b, u8::MAX],
                _ => [0; 4],
            };
            if let Some(place) = bytes.get_mut(4 * i..4 * i + 4) {
                place.copy_from_slice(&pixel);
            }
        }
    }
    Ok(Pixels::Eight(pixels))
}

/// The same of 16 bits, in the machine's order of bytes.
///
/// # Errors
///
/// As `read`.
pub(super) fn sixteen<const CHANNELS: usize>(
    header: &Header,
    read: impl FnOnce(&mut [u8]) -> Result<(), String>,
) -> Result<Pixels, String> {
    let mut bytes = vec![0; header.count() * CHANNELS * 2];
    read(&mut bytes)?;
    let (words, _) = bytes.as_chunks::<2>();
    let (words, _) = words.as_chunks::<CHANNELS>();
    let pixel = |words: &[[u8; 2]; CHANNELS]| match words.map(u16::from_ne_bytes)[..] {
        [grey] => [grey, grey, grey, u16::MAX],
        [grey, alpha] => [grey, grey, grey, alpha],
        [r, g, b] => [r, g, b, u16::MAX],
        [r, g, b, a] => [r, g, b, a],
        _ => [0; 4],
    };
    Ok(Pixels::Sixteen(words.iter().map(pixel).collect()))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

    use super::*;

    fn spread<const CHANNELS: usize>(bytes: &[u8]) -> Pixels {
        let header = Header::new(3, 1, 1);
        eight::<CHANNELS>(&header, |buffer| {
            buffer.copy_from_slice(bytes);
            Ok(())
        })
        .unwrap()
    }

    #[test]
    fn every_pixel_finds_its_place() {
        let eight = |pixels: [[u8; 4]; 3]| Pixels::Eight(pixels.to_vec());
        assert_eq!(
            spread::<1>(&[1, 2, 3]),
            eight([[1, 1, 1, 255], [2, 2, 2, 255], [3, 3, 3, 255]])
        );
        assert_eq!(
            spread::<2>(&[1, 9, 2, 8, 3, 7]),
            eight([[1, 1, 1, 9], [2, 2, 2, 8], [3, 3, 3, 7]])
        );
        assert_eq!(
            spread::<3>(&[1, 2, 3, 4, 5, 6, 7, 8, 9]),
            eight([[1, 2, 3, 255], [4, 5, 6, 255], [7, 8, 9, 255]])
        );
        assert_eq!(
            spread::<4>(&[1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12]),
            eight([[1, 2, 3, 4], [5, 6, 7, 8], [9, 10, 11, 12]])
        );
    }

    #[test]
    fn sixteen_bits_are_the_machines_own() {
        let header = Header::new(1, 1, 2);
        let read = |buffer: &mut [u8]| {
            buffer.copy_from_slice(&[513_u16, 7].map(u16::to_ne_bytes).concat());
            Ok(())
        };
        let pixels = sixteen::<2>(&header, read);
        assert_eq!(pixels, Ok(Pixels::Sixteen(vec![[513, 513, 513, 7]])));
    }
}
