//! The door out: from a film to a file.

mod destination;
mod display;
mod exr;
mod header;
mod png;
mod rows;
mod transfer;

pub use destination::Destination;
pub use display::Display;
pub use header::{Fact, Frame, Header};
pub use png::rgb_png;

use crate::Error;
use crate::film::{BEAUTY, Film};
use std::fs::File;
use std::io::{BufReader, Write};
use std::path::Path;

/// What kind of file a picture becomes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// For displays: 8 or 16 bits, sRGB, the beauty alone.
    Png,
    /// For compositing: linear light, every layer of the film.
    Exr,
}

impl Format {
    /// The format that `path`'s extension names, in upper or lower case.
    ///
    /// # Errors
    ///
    /// It has no extension, or one that names no format luch writes.
    pub fn of(path: &Path) -> Result<Format, Error> {
        let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase());
        match extension.as_deref() {
            Some("png") => Ok(Format::Png),
            Some("exr") => Ok(Format::Exr),
            _ => Err(Error::Unsupported {
                file: path.to_owned(),
                what: "its name does not end in .png or .exr".into(),
                way_out: "give it one of these".into(),
            }),
        }
    }
}

/// Whether a picture is at `path`, from its beginning to its end: one that was cut while it was written or copied is not
/// whole, nor is one that cannot be read.
pub fn is_whole(path: &Path) -> bool {
    let Ok(file) = File::open(path).map(BufReader::new) else {
        return false;
    };
    match Format::of(path) {
        Ok(Format::Png) => png::is_whole(file),
        Ok(Format::Exr) => exr::is_whole(file),
        Err(_) => false,
    }
}

/// How a film becomes a file.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Options {
    /// How light becomes a display's colours. PNG only.
    pub display: Display,
    /// In stops: light is multiplied by two to this power before the display transform. PNG only.
    pub exposure: f32,
    /// PNG only.
    pub bit_depth: BitDepth,
    /// What the attribute `comments` says, as a rule the command line. EXR only.
    pub comments: Option<String>,
    /// What else it says of itself. EXR only.
    pub header: Header,
}

/// Bits a channel.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum BitDepth {
    /// What displays show.
    #[default]
    Eight,
    /// For pictures that are worked on.
    Sixteen,
}

/// Writes `film` to `out`, which messages call `name`: for standard output. [`Destination`] is for files.
///
/// # Errors
///
/// `out` refuses, or the film is no picture: its render was cancelled, it has no pixels, too many for a file, no beauty,
/// or a layer without all its values.
pub fn encode(
    film: &Film,
    format: Format,
    options: &Options,
    name: &Path,
    out: &mut dyn Write,
) -> Result<(), Error> {
    check(film).map_err(|problem| Error::malformed(name, "", problem))?;
    match format {
        Format::Png => png::write(film, options, out),
        Format::Exr => exr::write(film, options, out),
    }
    .map_err(Error::io(name, "write"))
}

/// As many pixels as an EXR's windows span in either direction.
const MAX_SIDE: u32 = i32::MAX as u32 / 2;

/// Finds what keeps a film from being a picture: past this, every row of every layer is there.
fn check(film: &Film) -> Result<(), String> {
    let (width, height) = (film.width, film.height);
    let sides = 1..=MAX_SIDE;
    if !film.complete {
        return Err("is not finished, its render was cancelled".into());
    }
    if !sides.contains(&width) || !sides.contains(&height) {
        return Err(format!(
            "the film is {width} x {height} pixels, expected 1 to {MAX_SIDE} each way"
        ));
    }
    let display = [film.display_width, film.display_height];
    if !display.iter().all(|side| sides.contains(side)) {
        return Err(format!(
            "the film is of a picture of {} x {} pixels, expected 1 to {MAX_SIDE} each way",
            film.display_width, film.display_height
        ));
    }
    let (window, furthest) = (film.window(), i64::from(MAX_SIDE));
    let is_near = |from: i32, to: i64| i64::from(from) >= -furthest && to <= furthest;
    if !is_near(window.left, window.right()) || !is_near(window.top, window.bottom()) {
        return Err(format!(
            "the film begins at {},{}, expected it within {MAX_SIDE} pixels of the picture",
            film.left, film.top
        ));
    }
    if film.layer(BEAUTY.channels).is_none() {
        return Err("the film has no beauty, expected a layer R, G, B, A".into());
    }
    for layer in &film.layers {
        let expected = u64::from(width) * u64::from(height) * layer.channels.len() as u64;
        let found = layer.values.len() as u64;
        if found != expected {
            return Err(format!(
                "the film has {found} values in its layer {:?}, expected {expected}",
                layer.channels
            ));
        }
    }
    Ok(())
}
