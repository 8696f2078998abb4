//! Radiance HDR, whose pixels share an exponent among three bytes (Ward 1991, "Real Pixels", Graphics Gems II). Read here:
//! the format is small, and a hostile file is one error.

use crate::color::Rgb;

/// The first bytes of every such file.
pub(in crate::load) const MAGIC: &[u8] = b"#?";
/// A row of other widths has no run lengths by component.
const WIDTHS_OF_RUNS: std::ops::RangeInclusive<usize> = 8..=0x7fff;

/// What stands before the pixels.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::load) struct Header {
    pub(in crate::load) width: u32,
    pub(in crate::load) height: u32,
    /// By what the pixels were multiplied when they were written.
    pub(in crate::load) exposure: f32,
    /// Whether the first row is the lowest one.
    upside_down: bool,
    /// Whether the first column is the rightmost one.
    mirrored: bool,
    /// Where the pixels begin, in bytes.
    pixels_at: usize,
}

/// Reads what stands before the pixels.
///
/// # Errors
///
/// One line that says what is wrong, without the file's name.
pub(in crate::load) fn header(bytes: &[u8]) -> Result<Header, String> {
    let mut rest = bytes;
    let mut exposure = 1.0;
    loop {
        let line = line(&mut rest)?;
        if line.is_empty() {
            break;
        }
        match line
            .split_once('=')
            .map(|(key, value)| (key.trim(), value.trim()))
        {
            Some(("FORMAT", format)) if format != "32-bit_rle_rgbe" => {
                let shown: String = format.chars().take(40).collect();
                return Err(format!(
                    "has the format {shown:?}, expected 32-bit_rle_rgbe"
                ));
            }
            Some(("EXPOSURE", value)) => exposure *= value.parse().unwrap_or(1.0),
            _ => {}
        }
    }
    let resolution = line(&mut rest)?;
    let words: Vec<&str> = resolution.split_whitespace().collect();
    let size = |word: &str| word.parse().ok().filter(|&size: &u32| size > 0);
    let (upside_down, mirrored, sizes) = match words.as_slice() {
        [y @ ("-Y" | "+Y"), height, x @ ("-X" | "+X"), width] => {
            (*y == "+Y", *x == "-X", size(width).zip(size(height)))
        }
        _ => (false, false, None),
    };
    let (width, height) = sizes.ok_or_else(|| {
        let shown: String = resolution.chars().take(40).collect();
        format!("has the size {shown:?}, expected -Y HEIGHT +X WIDTH")
    })?;
    Ok(Header {
        width,
        height,
        exposure,
        upside_down,
        mirrored,
        pixels_at: bytes.len() - rest.len(),
    })
}

/// Reads the pixels, top row first, as they stand in the file: nothing undoes the exposure, as in other programs.
///
/// # Errors
///
/// One line that says what is wrong, without the file's name.
pub(in crate::load) fn decode(bytes: &[u8], header: &Header) -> Result<Vec<Rgb>, String> {
    let mut rest = bytes.get(header.pixels_at..).unwrap_or_default();
    let (width, height) = (header.width as usize, header.height as usize);
    let mut pixels = Vec::new();
    let mut row = vec![[0; 4]; width];
    for y in 0..height {
        read_row(&mut rest, &mut row)
            .ok_or_else(|| format!("is broken or too short: row {y} of {height} is not whole"))?;
        if header.mirrored {
            row.reverse();
        }
        pixels.extend(row.iter().copied().map(radiance));
    }
    if header.upside_down {
        let rows: Vec<&[Rgb]> = pixels.chunks(width).rev().collect();
        pixels = rows.concat();
    }
    Ok(pixels)
}

/// A line of text without its end.
fn line(rest: &mut &[u8]) -> Result<String, String> {
    let end = rest.iter().position(|&byte| byte == b'\n');
    let end = end.ok_or("is too short: its header has no end")?;
    let (line, after) = rest.split_at(end);
    *rest = after.get(1..).unwrap_or_default();
    Ok(String::from_utf8_lossy(line).trim().to_owned())
}

fn take<'a>(rest: &mut &'a [u8], count: usize) -> Option<&'a [u8]> {
    let (taken, after) = rest.split_at_checked(count)?;
    *rest = after;
    Some(taken)
}

/// A row of three mantissas and an exponent; `None` where the file is too short or a run goes over the row's end.
fn read_row(rest: &mut &[u8], row: &mut [[u8; 4]]) -> Option<()> {
    let by_component = match **rest {
        [2, 2, high, low, ..] => {
            WIDTHS_OF_RUNS.contains(&row.len())
                && usize::from(high) << 8 | usize::from(low) == row.len()
        }
        _ => false,
    };
    if !by_component {
        return read_whole_pixels(rest, row);
    }
    take(rest, 4)?;
    for component in 0..4 {
        let mut at = 0;
        while at < row.len() {
            let (count, run) = match *take(rest, 1)? {
                [code @ 0..=128] => (usize::from(code), false),
                [code] => (usize::from(code) - 128, true),
                _ => return None,
            };
            let values = take(rest, if run { 1 } else { count })?;
            let pixels = row.get_mut(at..at + count)?;
            for (pixel, value) in pixels.iter_mut().zip(values.iter().cycle()) {
                *pixel.get_mut(component)? = *value;
            }
            at += count;
        }
    }
    Some(())
}

/// The oldest way: pixels one by one, and (1, 1, 1, n) for n more of the last one; another such one after it counts
/// 256 times as much.
fn read_whole_pixels(rest: &mut &[u8], row: &mut [[u8; 4]]) -> Option<()> {
    let (mut at, mut shift) = (0, 0);
    while at < row.len() {
        let pixel: [u8; 4] = take(rest, 4)?.try_into().ok()?;
        if let [1, 1, 1, count] = pixel {
            let last = *row.get(at.checked_sub(1)?)?;
            let count = usize::from(count).checked_shl(shift)?;
            row.get_mut(at..at.checked_add(count)?)?.fill(last);
            at += count;
            shift = (shift + 8).min(24);
        } else {
            *row.get_mut(at)? = pixel;
            at += 1;
            shift = 0;
        }
    }
    Some(())
}

/// `(mantissa + 1/2) 2^(exponent - 136)`, the middle of what was rounded; no light where the exponent is 0.
fn radiance([r, g, b, exponent]: [u8; 4]) -> Rgb {
    if exponent == 0 {
        return Rgb::BLACK;
    }
    let scale = libm::ldexpf(1.0, i32::from(exponent) - 136);
    Rgb::from([r, g, b].map(|mantissa| (f32::from(mantissa) + 0.5) * scale))
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

    use super::*;

    /// A file of these rows, after this line of sizes.
    fn file(size: &str, rows: &[&[u8]]) -> Vec<u8> {
        let header =
            format!("#?RADIANCE\n# by hand\nFORMAT=32-bit_rle_rgbe\nEXPOSURE=2\n\n{size}\n");
        [header.as_bytes(), &rows.concat()].concat()
    }

    fn read(file: &[u8]) -> Result<Vec<Rgb>, String> {
        decode(file, &header(file)?)
    }

    /// Pixels of one half, by the exponent of 1.
    fn greys(mantissas: &[u8]) -> Vec<Rgb> {
        mantissas
            .iter()
            .map(|&mantissa| Rgb::grey((f32::from(mantissa) + 0.5) / 128.0))
            .collect()
    }

    #[test]
    fn pixels_one_by_one_with_and_without_runs() {
        let plain = file("-Y 1 +X 3", &[&[7, 7, 7, 129, 9, 9, 9, 129, 3, 3, 3, 0]]);
        let black = vec![Rgb::BLACK];
        assert_eq!(read(&plain), Ok([greys(&[7, 9]), black].concat()));
        let run = file("-Y 1 +X 4", &[&[7, 7, 7, 129, 1, 1, 1, 2, 9, 9, 9, 129]]);
        assert_eq!(read(&run), Ok(greys(&[7, 7, 7, 9])));
        let long = [&[7, 7, 7, 129, 1, 1, 1, 4, 1, 1, 1, 1][..]];
        assert_eq!(read(&file("-Y 1 +X 261", &long)), Ok(greys(&[7; 261])));
    }

    #[test]
    fn runs_by_component() {
        let component: &[u8] = &[128 + 5, 6, 3, 7, 8, 9];
        let row = [
            &[2, 2, 0, 8],
            component,
            component,
            component,
            &[128 + 8, 129],
        ]
        .concat();
        let expected = greys(&[6, 6, 6, 6, 6, 7, 8, 9]);
        assert_eq!(read(&file("-Y 1 +X 8", &[&row])), Ok(expected.clone()));
        let mut mirrored = expected;
        mirrored.reverse();
        assert_eq!(read(&file("-Y 1 -X 8", &[&row])), Ok(mirrored));
    }

    #[test]
    fn rows_from_the_bottom_are_turned_over() {
        let rows: [&[u8]; 2] = [&[1, 1, 2, 129], &[5, 5, 5, 129]];
        let top = read(&file("+Y 2 +X 1", &rows)).map(|pixels| pixels.first().copied());
        assert_eq!(top, Ok(greys(&[5]).first().copied()));
        assert_eq!(
            header(&file("+Y 2 +X 1", &rows)).map(|header| header.exposure),
            Ok(2.0)
        );
    }

    #[test]
    fn what_is_wrong_is_one_error() {
        let row: &[u8] = &[7, 7, 7, 129, 9, 9, 9, 129];
        for size in ["+X 2 -Y 1", "-Y 0 +X 2", "-Y 1 +X 99999999999", "-Y 1", ""] {
            let problem = read(&file(size, &[row])).unwrap_err();
            assert!(problem.starts_with("has the size"), "{problem}");
        }
        let whole = file("-Y 1 +X 2", &[row]);
        for length in 0..whole.len() {
            assert!(read(whole.get(..length).unwrap()).is_err(), "{length}");
        }
        for run in [&[1, 1, 1, 2][..], &[7, 7, 7, 129, 1, 1, 1, 2]] {
            assert!(read(&file("-Y 1 +X 2", &[run])).is_err(), "{run:?}");
        }
        let endless: Vec<u8> = [&[7, 7, 7, 129][..], &[1, 1, 1, 0].repeat(40)].concat();
        assert!(read(&file("-Y 1 +X 2", &[&endless])).is_err());
        let xyz = b"#?RADIANCE\nFORMAT=32-bit_rle_xyze\n\n-Y 1 +X 1\n\0\0\0\0";
        let problem = header(xyz).unwrap_err();
        assert_eq!(
            problem,
            "has the format \"32-bit_rle_xyze\", expected 32-bit_rle_rgbe"
        );
    }
}
