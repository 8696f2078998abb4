//! KTX2 with Basis Universal by crate `basisu`: ETC1S with BasisLZ, and UASTC plain or with Zstandard. Level 0 only.
//!
//! The crate (0.1.0, pure Rust, integers only on the way to RGBA) is a port of the reference transcoder: of 21 files no
//! byte differs from what that one makes of them (three.js 0.187's WebAssembly). It trusts a file's offsets, so that
//! every one that it follows is checked here first.

use super::{Header, most_pixels};
use crate::texture::Pixels;
use basisu::{DecodeFlags, TargetFormat, Transcoder};

/// The first bytes of the file.
pub(super) const MAGIC: [u8; 12] = *b"\xabKTX 20\xbb\r\n\x1a\n";

/// Repeats take few bits: beyond [`super::FREE_PIXELS`], that much is believed.
const MOST_PIXELS_A_BYTE: u64 = 1 << 10;

/// Bytes of a block of 4 x 4 pixels in UASTC.
const BYTES_A_BLOCK: u64 = 16;

const ETC1S: u8 = 163;
const UASTC: u8 = 166;
const NOT_COMPRESSED: u32 = 0;
const BASIS_LZ: u32 = 1;
const ZSTANDARD: u32 = 2;

/// What the header says.
///
/// # Errors
///
/// One line: it is no picture of Basis Universal, or a part of it lies outside the file.
pub(super) fn header(bytes: &[u8]) -> Result<Header, String> {
    let file = File(bytes);
    let [
        format,
        _,
        width,
        height,
        depth,
        layers,
        faces,
        levels,
        scheme,
    ] = file.words(12)?;
    if format != 0 {
        return Err(format!(
            "is a KTX2 image in Vulkan's format {format}, which is not supported; use Basis Universal, PNG or JPEG"
        ));
    }
    if depth > 0 || layers > 1 || faces != 1 || height == 0 {
        return Err(format!(
            "is a KTX2 image of {width} x {height} x {depth} pixels in {layers} layers and {faces} faces, expected one \
             flat picture"
        ));
    }
    let most = most_pixels(bytes, MOST_PIXELS_A_BYTE).max(super::FREE_PIXELS);
    let header = Header::checked(width.into(), height.into(), 1, most)?;
    let [description, _, keys, keys_length] = file.words(48)?;
    let [model] = file.part(u64::from(description) + 12, 1, "data format")? else {
        return Err(cut_short("data format"));
    };
    // The crate looks for the next key at a multiple of 4, wherever the keys end.
    if keys_length > 0 && (keys % 4 != 0 || keys_length % 4 != 0) {
        return Err(
            "broken KTX2: its key and value data do not begin and end at multiples of 4".into(),
        );
    }
    file.part(keys.into(), keys_length.into(), "key and value data")?;
    let [global, global_length, level, length, unpacked] = file.longs(64)?;
    file.part(level, length, "first level")?;
    file.part(global, global_length, "global data")?;
    file.part(
        80,
        u64::from(levels.max(1)).saturating_mul(24),
        "list of levels",
    )?;
    let blocks = u64::from(width.div_ceil(4)) * u64::from(height.div_ceil(4));
    match (*model, scheme) {
        (ETC1S, BASIS_LZ) => Ok(header),
        (UASTC, NOT_COMPRESSED) if length == blocks * BYTES_A_BLOCK => Ok(header),
        (UASTC, ZSTANDARD) if unpacked == blocks * BYTES_A_BLOCK => Ok(header),
        (UASTC, NOT_COMPRESSED | ZSTANDARD) => Err(format!(
            "broken KTX2: its first level is not the {} bytes of {width} x {height} pixels",
            blocks * BYTES_A_BLOCK
        )),
        (model, scheme) => Err(format!(
            "is a KTX2 image of colour model {model} with supercompression {scheme}, which is not supported; use ETC1S \
             with BasisLZ, or UASTC plain or with Zstandard"
        )),
    }
}

/// The pixels of a file whose header is right.
///
/// # Errors
///
/// One line.
pub(super) fn decode(bytes: &[u8], header: &Header) -> Result<Pixels, String> {
    let broken = |error: basisu::Error| match error {
        basisu::Error::VideoRequiresState => "is a video in a KTX2 file, expected a picture".into(),
        _ => String::from("broken KTX2: its pixels cannot be decoded"),
    };
    let transcoder = Transcoder::new(bytes).map_err(broken)?;
    let mut pixels = vec![[0_u8; 4]; header.count()];
    transcoder
        .transcode_into(
            0,
            TargetFormat::Rgba32,
            DecodeFlags::NONE,
            pixels.as_flattened_mut(),
        )
        .map_err(broken)?;
    Ok(Pixels::Eight(pixels))
}

struct File<'a>(&'a [u8]);

impl<'a> File<'a> {
    /// `N` numbers of 32 bits from byte `start`.
    fn words<const N: usize>(&self, start: u64) -> Result<[u32; N], String> {
        let bytes = self.part(start, 4 * N as u64, "header")?;
        let mut words = [0; N];
        for (word, bytes) in words.iter_mut().zip(bytes.as_chunks::<4>().0) {
            *word = u32::from_le_bytes(*bytes);
        }
        Ok(words)
    }

    /// `N` numbers of 64 bits from byte `start`.
    fn longs<const N: usize>(&self, start: u64) -> Result<[u64; N], String> {
        let bytes = self.part(start, 8 * N as u64, "header")?;
        let mut longs = [0; N];
        for (long, bytes) in longs.iter_mut().zip(bytes.as_chunks::<8>().0) {
            *long = u64::from_le_bytes(*bytes);
        }
        Ok(longs)
    }

    fn part(&self, start: u64, length: u64, name: &str) -> Result<&'a [u8], String> {
        let end = start.checked_add(length);
        let range = usize::try_from(start)
            .ok()
            .zip(end.and_then(|end| usize::try_from(end).ok()));
        range
            .and_then(|(start, end)| self.0.get(start..end))
            .ok_or_else(|| cut_short(name))
    }
}

fn cut_short(part: &str) -> String {
    format!("broken KTX2: its {part} is not in the file")
}
