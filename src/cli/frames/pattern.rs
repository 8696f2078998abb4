//! Names of files that have a place for the number of a frame.

use super::super::{Failure, print};
use std::ops::Range;
use std::path::{Path, PathBuf};

/// The most digits of a frame's number in a name.
const MOST_DIGITS: usize = 10;

/// The path of a frame: its number, in at least as many digits as there are, takes the place of `####` or `%04d`.
pub(in crate::cli) fn path_of(pattern: &Path, frame: u32) -> Result<PathBuf, Failure> {
    let of_frame = pattern.file_name().and_then(|name| {
        let name = name.to_str()?;
        let (place, digits) = place(name)?;
        let (before, after) = (&name[..place.start], &name[place.end..]);
        let is_the_only_one = self::place(after).is_none();
        is_the_only_one.then(|| format!("{before}{frame:0digits$}{after}"))
    });
    let of_frame = of_frame.ok_or_else(|| {
        let example = match (pattern.file_stem(), pattern.extension()) {
            (Some(stem), Some(extension)) if !holds_pattern(pattern) => {
                format!("{}.####.{}", stem.display(), extension.display())
            }
            _ => "shot.####.exr".to_owned(),
        };
        Failure::usage_or_scene(format!(
            "{}: expected one place for the number of a frame, as in {example} or %04d",
            print::path(pattern)
        ))
    })?;
    Ok(pattern.with_file_name(of_frame))
}

/// Whether a path's name is one of frames.
pub(in crate::cli) fn holds_pattern(path: &Path) -> bool {
    let name = path.file_name().and_then(|name| name.to_str());
    name.is_some_and(|name| place(name).is_some())
}

/// Where in a name the number of a frame goes, and how many digits it has at least.
fn place(name: &str) -> Option<(Range<usize>, usize)> {
    for (start, character) in name.char_indices() {
        let rest = &name[start..];
        if character == '#' {
            let length = rest.bytes().take_while(|byte| *byte == b'#').count();
            return Some((start..start + length, length));
        }
        if let Some(rest) = rest.strip_prefix('%') {
            let length = rest.bytes().take_while(u8::is_ascii_digit).count();
            let (digits, after) = rest.split_at(length);
            let digits = match digits {
                "" => Some(1),
                // Without the zero, C would put blanks.
                padded if padded.starts_with('0') => padded.parse().ok(),
                _ => None,
            };
            let digits = digits.filter(|digits| *digits <= MOST_DIGITS);
            if let (Some(digits), true) = (digits, after.starts_with('d')) {
                return Some((start..start + length + 2, digits));
            }
        }
    }
    None
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_frames_number_takes_its_place_in_the_name() {
        let of = |pattern: &str, frame| path_of(Path::new(pattern), frame).ok();
        for (pattern, expected) in [
            ("a/shot.####.exr", "a/shot.0013.exr"),
            ("shot_%04d.png", "shot_0013.png"),
            ("#.png", "13.png"),
            ("%d.png", "13.png"),
            ("a#b/100%_##.png", "a#b/100%_13.png"),
        ] {
            assert_eq!(of(pattern, 13), Some(expected.into()), "{pattern}");
        }
        assert_eq!(of("##.png", 1000), Some("1000.png".into()));
        for wrong in [
            "shot.exr",
            "#.#.exr",
            "a_%04d_#.exr",
            "%4d.png",
            "%099999999999d.png",
            "..",
        ] {
            assert_eq!(of(wrong, 1), None, "{wrong}");
        }
        let problem = path_of(Path::new("b/shot.exr"), 1).err();
        let problem = problem.map(|failure| failure.error.to_string());
        assert_eq!(
            problem.as_deref(),
            Some(
                "b/shot.exr: expected one place for the number of a frame, as in shot.####.exr or %04d"
            )
        );
    }
}
