//! JPEG by crate `zune-jpeg`, with the same bits on every machine.
//!
//! JPEG decoders differ in their last bit, and one decoder's SIMD from its scalar code. What holds here is that the
//! crate's features `x86`, `neon` and `portable_simd` are off, behind which every use of intrinsics stands (0.5.15). Its
//! options could not do it: `set_use_unsafe(false)` leaves AVX2 on (`use_avx2` in zune-core 0.5.3 takes either of two
//! flags). So no other dependency may switch these features on: `cargo tree -e features -i zune-jpeg` shows who does.
//!
//! Against libjpeg-turbo (Pillow 13.0) on 133 x 77 pixels: baseline and progressive, grey, RGB, CMYK, YCCK, 4:4:4, 4:1:1
//! differ by 3 of 255 at most, colours of half size (4:2:2, 4:4:0, 4:2:0), which each decoder smooths its own way, by 4.

use super::{Header, most_pixels, rgba, said};
use crate::texture::Pixels;
use zune_jpeg::JpegDecoder;
use zune_jpeg::zune_core::bytestream::ZCursor;
use zune_jpeg::zune_core::colorspace::ColorSpace;
use zune_jpeg::zune_core::options::DecoderOptions;

/// No JPEG has more for each byte of its file: the least is one bit for 64 pixels.
const MOST_PIXELS_A_BYTE: u64 = 1 << 10;

/// Coefficients of 16 bits (all of them, where it is progressive) of up to four components, then RGB, then RGBA.
const BYTES_A_PIXEL: u64 = 15;

/// The end-of-image marker.
const END: [u8; 2] = [0xff, 0xd9];

/// Follows the name of an image without its end, which every viewer shows as far as it goes.
const CUT_SHORT: &str = "is cut short, what there is of it is shown";

/// What the header says.
///
/// # Errors
///
/// One line.
pub(super) fn header(bytes: &[u8]) -> Result<Header, String> {
    let mut decoder = decoder(bytes);
    decoder.decode_headers().map_err(|e| said("JPEG", e))?;
    let (width, height) = decoder.dimensions().unwrap_or_default();
    let most = most_pixels(bytes, MOST_PIXELS_A_BYTE);
    let header = Header::checked(width as u64, height as u64, 1, most)?;
    Ok(Header {
        bytes_a_pixel: BYTES_A_PIXEL,
        ..header
    })
}

/// The pixels of a file whose header is right, and what is wrong with them.
///
/// How a camera was held (EXIF) is ignored, as glTF wants it (section 3.8.3).
///
/// # Errors
///
/// One line.
pub(super) fn decode(
    bytes: &[u8],
    header: &Header,
) -> Result<(Pixels, Option<&'static str>), String> {
    let whole = rgba::eight::<3>(header, |buffer| read(bytes, buffer));
    if has_end(bytes) {
        return whole.map(|pixels| (pixels, None));
    }
    // Where the file ends within a header between two scans, the decoder gives nothing: it is shown the scans before.
    let pixels = whole.or_else(|problem| {
        let mut ended = up_to_last_marker(bytes).ok_or(problem)?.to_vec();
        ended.extend(END);
        rgba::eight::<3>(header, |buffer| read(&ended, buffer))
    })?;
    Ok((pixels, Some(CUT_SHORT)))
}

fn read(bytes: &[u8], buffer: &mut [u8]) -> Result<(), String> {
    let mut decoder = decoder(bytes);
    decoder.decode_headers().map_err(|e| said("JPEG", e))?;
    if decoder.output_buffer_size() != Some(buffer.len()) {
        return Err("broken JPEG: its size is in doubt".into());
    }
    decoder.decode_into(buffer).map_err(|e| said("JPEG", e))
}

fn decoder(bytes: &[u8]) -> JpegDecoder<ZCursor<&[u8]>> {
    // RGB rather than RGBA: for RGBA the decoder (0.5.15) steps through CMYK images in rows of a wrong length.
    let options = DecoderOptions::new_safe()
        .set_max_width(u16::MAX.into())
        .set_max_height(u16::MAX.into())
        .jpeg_set_out_colorspace(ColorSpace::RGB);
    JpegDecoder::new_with_options(ZCursor::new(bytes), options)
}

/// Whether there is an end-of-image marker after the last start of a scan. No pixel's bits look like either.
fn has_end(bytes: &[u8]) -> bool {
    let mut pairs = bytes.windows(2).rev();
    let marker = pairs.find(|pair| matches!(pair, [0xff, 0xd9 | 0xda]));
    marker == Some(&END)
}

/// What stands before the last marker that ends a scan: no byte stuffed into the pixels, no restart.
fn up_to_last_marker(bytes: &[u8]) -> Option<&[u8]> {
    let ends = |pair: &[u8]| matches!(pair, [0xff, 0x01..=0xcf | 0xd8..=0xfe]);
    let last = bytes.windows(2).rposition(ends)?;
    bytes.get(..last)
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

    use super::super::samples::from_hex;
    use super::*;

    /// The four corners against what Pillow 13.0 (libjpeg-turbo) decodes: the standard leaves decoders the last bit.
    fn assert_corners(jpeg: &str, width: usize, height: usize, expected: [[i32; 3]; 4]) {
        let bytes = from_hex(jpeg);
        let header = header(&bytes).unwrap();
        assert_eq!(
            (header.width as usize, header.height as usize),
            (width, height)
        );
        let (pixels, flaw) = decode(&bytes, &header).unwrap();
        assert_eq!(flaw, None);
        let Pixels::Eight(pixels) = pixels else {
            panic!("8 bits expected")
        };
        let corners = [0, width - 1, width * (height - 1), width * height - 1];
        for (at, expected) in corners.into_iter().zip(expected) {
            let [r, g, b, a] = pixels[at].map(i32::from);
            let near = |(found, expected): (i32, i32)| (found - expected).abs() <= 2;
            let all = [r, g, b].into_iter().zip(expected).all(near);
            assert!(all && a == 255, "{:?} is not {expected:?}", pixels[at]);
        }
    }

    #[test]
    fn colour_is_what_another_decoder_says() {
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
    fn grey_is_what_another_decoder_says() {
        let jpeg = "ffd8ffe000104a46494600010100000100010000ffdb00430006040506050406060506070706080a100a\
         0a09090a140e0f0c1017141818171416161a1d251f1a1b231c1616202c20232627292a29191f2d302d28\
         3025282928ffc0000b080003000301011100ffc40014000100000000000000000000000000000006ffc4\
         001d1000010207000000000000000000000000010003040507162233b1ffda0008010100003f00574ea1\
         dab224f80d03a57fffd9";
        assert_corners(jpeg, 3, 3, [[32; 3], [173; 3], [49; 3], [190; 3]]);
    }

    #[test]
    fn adobe_cmyk_is_what_another_decoder_says() {
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
}
