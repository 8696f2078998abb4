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
    let before = budget.spent();
    let picture = read(path, budget, warnings);
    let kept = picture
        .as_ref()
        .map_or(0, |picture| size_of_val(picture.pixels.as_slice()));
    budget.settle(before, kept as u64);
    picture
}

fn read(path: &Path, budget: &Budget, warnings: &mut Warnings) -> Result<Equirect, Error> {
    let wrong = |problem: String| Error::malformed(path, "", problem);
    let bytes = files::read(path, budget)?;
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
        let header = hdr::header(&bytes).map_err(wrong)?;
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
        let pixels = hdr::decode(&bytes, &header).map_err(wrong)?;
        Equirect {
            width,
            height,
            pixels,
        }
    } else if bytes.starts_with(exr::MAGIC) {
        let header = exr::header(&bytes).map_err(wrong)?;
        room(header.width, header.height, header.bytes_to_decode())?;
        let (width, height, pixels) = exr::decode(&bytes).map_err(wrong)?;
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
    drop(bytes);
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
