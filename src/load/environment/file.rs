//! An environment from a file: Radiance HDR or OpenEXR, whose picture shows all directions.

use crate::Error;
use crate::environment::Equirect;
use crate::load::images::{exr, hdr};
use crate::load::{Budget, Warnings, files};
use std::path::Path;

/// No picture is wider.
const WIDEST: u32 = 16384;
/// A wider picture is made so narrow: a pixel is a fifth of a degree, less than a mirror in a picture shows of it.
const WIDTH: u32 = 2048;

/// Opens the picture of an environment, `.hdr` or `.exr` by its first bytes.
///
/// One of more than 2048 x 1024 pixels is reduced, without loss of energy. Pixels that no light has (negative, infinite,
/// no numbers) are black, and a picture that is not twice as wide as high is stretched: there is a warning of either.
///
/// # Errors
///
/// The file cannot be read, is of neither kind, is broken or too short, is wider than 16384 pixels, or there is not the
/// memory for it.
pub(super) fn open(
    path: &Path,
    budget: &Budget,
    warnings: &mut Warnings,
) -> Result<Equirect, Error> {
    let bytes = files::read(path, budget)?;
    let picture = read(path, &bytes, budget, warnings);
    // The file's own bytes are freed; others may take from the budget meanwhile.
    budget.give_back(bytes.len() as u64);
    let picture = picture?;
    let taken = budget.take(size_of_val(picture.pixels.as_slice()) as u64);
    taken.map_err(|problem| problem.of(path, ""))?;
    Ok(picture)
}

/// The picture in a file of these bytes.
fn read(
    path: &Path,
    bytes: &[u8],
    budget: &Budget,
    warnings: &mut Warnings,
) -> Result<Equirect, Error> {
    let wrong = |problem: String| Error::malformed(path, "", problem);
    let room = |width: u32, height: u32, takes: u64| {
        if width > WIDEST || height > WIDEST {
            let size = format!("is {width} x {height} pixels");
            return Err(wrong(format!(
                "{size}, expected at most {WIDEST} either way; make it smaller"
            )));
        }
        budget
            .check(takes)
            .map_err(|problem| problem.of(path, format!("{width} x {height} pixels:")))
    };
    let mut picture = if bytes.starts_with(hdr::MAGIC) {
        let header = hdr::header(bytes).map_err(wrong)?;
        let (width, height) = (header.width, header.height);
        // Rows may lie upside down: twice the pixels, and a reduced picture.
        room(width, height, u64::from(width) * u64::from(height) * 36)?;
        if header.exposure != 1.0 {
            let exposure = header.exposure;
            warnings.add(format!(
                "{}: says EXPOSURE={exposure}, which is not undone; --environment-intensity can do so",
                path.display()
            ));
        }
        let pixels = hdr::decode(bytes, &header).map_err(wrong)?;
        Equirect {
            width,
            height,
            pixels,
        }
    } else if bytes.starts_with(exr::MAGIC) {
        let header = exr::header(bytes).map_err(wrong)?;
        room(header.width, header.height, header.bytes_to_decode())?;
        let (width, height, pixels) = exr::decode(bytes).map_err(wrong)?;
        Equirect {
            width,
            height,
            pixels,
        }
    } else {
        return Err(Error::Unsupported {
            file: path.to_owned(),
            what: "is no environment that luch knows".into(),
            way_out: "use a Radiance HDR or an OpenEXR image".into(),
        });
    };
    check(&mut picture, path, warnings);
    let (width, height) = (picture.width.min(WIDTH), picture.height.min(WIDTH / 2));
    Ok(picture.resized(width, height))
}

/// Mends what no light is, and says so.
fn check(picture: &mut Equirect, path: &Path, warnings: &mut Warnings) {
    let is_light = |value: f32| value.is_finite() && value >= 0.0;
    let mut dark = 0u64;
    for pixel in &mut picture.pixels {
        if ![pixel.r, pixel.g, pixel.b].into_iter().all(is_light) {
            *pixel = pixel.map(|value| if is_light(value) { value } else { 0.0 });
            dark += 1;
        }
    }
    let name = path.display();
    if dark > 0 {
        warnings.add(format!(
            "{name}: {dark} pixels are negative, infinite or no numbers; they count as 0"
        ));
    }
    let (width, height) = (picture.width, picture.height);
    if u64::from(width) != 2 * u64::from(height) {
        warnings.add(format!(
            "{name}: is {width} x {height} pixels, expected twice as wide as high; it is stretched"
        ));
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

    use super::*;
    use crate::color::Rgb;
    use crate::load::Options;
    use std::fs;

    /// The warnings and what came of a file of these bytes, with so much memory.
    fn opened(bytes: &[u8], max_memory: u64) -> (Vec<String>, Result<Equirect, String>) {
        let folder = tempfile::tempdir().unwrap();
        let path = folder.path().join("light.hdr");
        fs::write(&path, bytes).unwrap();
        let max_memory = Some(max_memory);
        let budget = Budget::of(&Options {
            max_memory,
            ..Options::default()
        });
        let mut warnings = Warnings::default();
        let found = open(&path, &budget, &mut warnings);
        let kept = found
            .as_ref()
            .map_or(0, |picture| picture.pixels.len() * size_of::<Rgb>());
        assert_eq!(budget.spent(), kept as u64);
        let name = format!("{}: ", path.display());
        let said = |text: String| text.replace(&name, "");
        let warnings = warnings
            .iter()
            .map(|warning| said(warning.to_string()))
            .collect();
        (warnings, found.map_err(|error| said(error.to_string())))
    }

    fn hdr(width: usize, height: usize, pixel: [u8; 4]) -> Vec<u8> {
        let header = format!("#?RADIANCE\n\n-Y {height} +X {width}\n");
        [header.as_bytes(), &pixel.repeat(width * height)].concat()
    }

    #[test]
    fn a_great_picture_is_reduced_and_loses_no_light() {
        let (warnings, found) = opened(&hdr(2100, 1050, [64, 64, 64, 129]), 1 << 30);
        let found = found.unwrap();
        assert_eq!((found.width, found.height, warnings.len()), (2048, 1024, 0));
        assert!(
            found
                .pixels
                .iter()
                .all(|pixel| (pixel.g - 64.5 / 128.0).abs() < 1e-5)
        );
    }

    #[test]
    fn a_picture_of_another_shape_is_stretched_with_a_warning() {
        let (warnings, found) = opened(&hdr(3, 3, [64, 64, 64, 129]), 1 << 20);
        assert_eq!(found.map(|found| found.pixels.len()), Ok(9));
        let expected = "is 3 x 3 pixels, expected twice as wide as high; it is stretched";
        assert_eq!(warnings, [expected]);
    }

    #[test]
    fn what_no_light_is_counts_as_none_with_one_warning() {
        let mut picture = Equirect {
            width: 2,
            height: 1,
            pixels: vec![
                Rgb::new(f32::NAN, 1.0, -1.0),
                Rgb::new(2.0, f32::INFINITY, 3.0),
            ],
        };
        let mut warnings = Warnings::default();
        check(&mut picture, Path::new("a.exr"), &mut warnings);
        assert_eq!(
            picture.pixels,
            [Rgb::new(0.0, 1.0, 0.0), Rgb::new(2.0, 0.0, 3.0)]
        );
        let said: Vec<String> = warnings.iter().map(ToString::to_string).collect();
        assert_eq!(
            said,
            ["a.exr: 2 pixels are negative, infinite or no numbers; they count as 0"]
        );
    }

    #[test]
    fn what_cannot_be_light_is_one_error() {
        let claim = |size: &str| format!("#?RADIANCE\n\n{size}\n").into_bytes();
        for (bytes, problem) in [
            (
                b"P6 1 1 255\n".to_vec(),
                "is no environment that luch knows; use a Radiance HDR or an OpenEXR image",
            ),
            (
                vec![],
                "is no environment that luch knows; use a Radiance HDR or an OpenEXR image",
            ),
            (
                claim("-Y 9 +X 16385"),
                "is 16385 x 9 pixels, expected at most 16384 either way; make it smaller",
            ),
            (
                claim("-Y 8192 +X 16384"),
                "16384 x 8192 pixels: takes 4832 MB of memory, 1 MB are left; make it smaller, or allow more with \
                 --max-memory",
            ),
            (
                claim("-Y 1 +X 2"),
                "is broken or too short: row 0 of 1 is not whole",
            ),
            (
                vec![0x76, 0x2f, 0x31, 0x01, 2, 0, 0, 0, b'x'],
                "is too short: its header has no end",
            ),
        ] {
            assert_eq!(opened(&bytes, 1 << 20).1, Err(problem.into()));
        }
    }
}
