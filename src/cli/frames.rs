//! What can be said of pictures that follow each other, and the times at which they are taken.

use super::values::whole_number;
use super::{Failure, print};
use clap::Args;
use std::collections::HashSet;
use std::f64::consts::TAU;
use std::ops::Range;
use std::path::{Path, PathBuf};
use std::str::FromStr;

/// The greatest number of a frame, and the most frames: 11 hours at 24 a second.
const MOST_FRAMES: u32 = 1_000_000;
/// The most digits of a frame's number in a name.
const MOST_DIGITS: usize = 10;

/// The options about sequences.
#[derive(Args, Debug)]
pub(super) struct SequenceArguments {
    /// Render a sequence: these frames, in this order, as in 1-48, 1-100x2 (or 1-100:2, every other one) or 1,5,9-12. Frame 1 is
    /// the animation's beginning; camera, floor and exposure that luch chooses are those of frame 1 in all of them
    #[arg(long, value_name = "LIST")]
    pub(super) frames: Option<Frames>,

    /// Frames a second, as in 25, 23.976, 29.97 or 30000/1001: frame f shows the moment (f - 1) / rate [default: 24]
    #[arg(
        long,
        value_name = "RATE",
        requires = "frames",
        conflicts_with = "turntable"
    )]
    pub(super) fps: Option<Rate>,

    /// Go around the model once, in so many frames, of which --frames may choose some: frame 1 is the usual picture (with
    /// --zoom 0.8 there is more room for what is long), in a room the camera turns
    #[arg(long, value_name = "N", allow_negative_numbers = true, conflicts_with_all = ["camera", "eye", "target"], value_parser = whole_number(1..=MOST_FRAMES))]
    pub(super) turntable: Option<u32>,

    /// Render only what is not there yet: a file that is whole from beginning to end stays, one that was cut is made again
    #[arg(long)]
    pub(super) skip_existing: bool,
}

impl SequenceArguments {
    /// The frames that are asked for; `None` where one picture is.
    pub(super) fn list(&self) -> Result<Option<Vec<u32>>, Failure> {
        let frames = self.frames.as_ref().map(|Frames(frames)| frames.clone());
        let Some(views) = self.turntable else {
            return Ok(frames);
        };
        let frames = frames.unwrap_or_else(|| (1..=views).collect());
        match frames.iter().find(|frame| **frame > views) {
            Some(frame) => Err(Failure::usage_or_scene(format!(
                "frame {frame} is past the last one of --turntable {views}"
            ))),
            None => Ok(Some(frames)),
        }
    }

    /// Whether time goes on from frame to frame.
    pub(super) fn is_of_an_animation(&self) -> bool {
        self.frames.is_some() && self.turntable.is_none()
    }

    /// The moment of a frame, in seconds.
    pub(super) fn time(&self, frame: u32) -> f64 {
        self.fps.unwrap_or_default().time(frame)
    }

    /// So many frames in so many seconds, where time goes on.
    pub(super) fn per_second(&self) -> Option<[u32; 2]> {
        let Rate { frames, seconds } = self.fps.unwrap_or_default();
        self.is_of_an_animation().then_some([frames, seconds])
    }

    /// How far around a frame's view is, in radians.
    pub(super) fn angle(&self, frame: u32) -> f64 {
        let share = |views: u32| f64::from(frame.saturating_sub(1)) / f64::from(views);
        TAU * self.turntable.map_or(0.0, share)
    }
}

/// Numbers of frames, each once, in the order in which they were given.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Frames(Vec<u32>);

impl FromStr for Frames {
    type Err = String;

    fn from_str(text: &str) -> Result<Frames, String> {
        let (mut known, mut frames) = (HashSet::new(), Vec::new());
        let mut count = 0;
        for part in text.split(',') {
            let range = range(part.trim()).ok_or_else(|| {
                format!(
                    "expected frames from 1 to {MOST_FRAMES}, as in 1-48, 1-100x2, 1-5:2 or 1,5,9-12"
                )
            })?;
            count += range.size_hint().0;
            if count > MOST_FRAMES as usize {
                return Err(format!("expected at most {MOST_FRAMES} frames"));
            }
            // "1-100x10,1-100" is every tenth frame first, then the others.
            frames.extend(range.filter(|frame| known.insert(*frame)));
        }
        Ok(Frames(frames))
    }
}

/// One frame, or from one to another, every so many.
fn range(text: &str) -> Option<std::iter::StepBy<std::ops::RangeInclusive<u32>>> {
    let (ends, step) = match text.split_once(['x', ':']) {
        Some((ends, step)) => (ends, number(step)?),
        None => (text, 1),
    };
    let (first, last) = match ends.split_once('-') {
        Some((first, last)) => (number(first)?, number(last)?),
        None if ends.len() == text.len() => (number(ends)?, number(ends)?),
        None => return None,
    };
    (first <= last).then(|| (first..=last).step_by(step as usize))
}

fn number(text: &str) -> Option<u32> {
    let is_number = !text.is_empty() && text.bytes().all(|byte| byte.is_ascii_digit());
    let number = is_number.then(|| text.parse().ok()).flatten()?;
    (1..=MOST_FRAMES).contains(&number).then_some(number)
}

/// How many frames a second: exact, since a film of an hour at 24000/1001 is not one at 23.976.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Rate {
    /// So many frames...
    pub(super) frames: u32,
    /// ...in so many seconds.
    pub(super) seconds: u32,
}

impl Default for Rate {
    fn default() -> Rate {
        Rate {
            frames: 24,
            seconds: 1,
        }
    }
}

impl Rate {
    /// The moment of a frame, in seconds: that of frame 1 is 0.
    fn time(self, frame: u32) -> f64 {
        let steps = u64::from(frame.saturating_sub(1)) * u64::from(self.seconds);
        // Both are whole numbers below 2^53: the quotient is the nearest number to the true one.
        steps as f64 / f64::from(self.frames)
    }
}

impl FromStr for Rate {
    type Err = String;

    fn from_str(text: &str) -> Result<Rate, String> {
        let thousandths = |text: &str| match text.split_once('.') {
            Some((whole, rest)) if (1..=3).contains(&rest.len()) => {
                number(&format!("{whole}{rest:0<3}"))
            }
            Some(_) => None,
            None => number(text)?.checked_mul(1000),
        };
        let rate = match text.split_once('/') {
            Some((frames, seconds)) => number(frames).zip(number(seconds)),
            None => thousandths(text).map(|rate| {
                // The rates of NTSC have 1001 under the line and are written rounded.
                let ntsc = [24, 30, 48, 60, 120].map(|whole| whole * 1000);
                let is_near =
                    |whole: &u32| rate != *whole && (whole * 1000 / 1001).abs_diff(rate) < 8;
                match ntsc.into_iter().find(is_near) {
                    Some(frames) => (frames, 1001),
                    None => (rate, 1000),
                }
            }),
        };
        let (frames, seconds) =
            rate.ok_or("expected frames a second, as in 25, 23.976, 29.97 or 30000/1001")?;
        let divisor = greatest_common_divisor(frames, seconds);
        Ok(Rate {
            frames: frames / divisor,
            seconds: seconds / divisor,
        })
    }
}

fn greatest_common_divisor(a: u32, b: u32) -> u32 {
    if b == 0 {
        a
    } else {
        greatest_common_divisor(b, a % b)
    }
}

/// The path of a frame: its number, in at least as many digits as there are, takes the place of `####` or `%04d`.
pub(super) fn path_of(pattern: &Path, frame: u32) -> Result<PathBuf, Failure> {
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
pub(super) fn holds_pattern(path: &Path) -> bool {
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

    fn frames(text: &str) -> Option<Vec<u32>> {
        text.parse().ok().map(|Frames(frames)| frames)
    }

    #[test]
    fn frames_are_numbers_and_ranges_with_steps_each_once_in_the_order_given() {
        for (text, expected) in [
            ("7", vec![7]),
            ("1-5", vec![1, 2, 3, 4, 5]),
            ("1-10x3", vec![1, 4, 7, 10]),
            ("1-5:2", vec![1, 3, 5]),
            ("1,5, 9-12", vec![1, 5, 9, 10, 11, 12]),
            ("1-7x3,1-4", vec![1, 4, 7, 2, 3]),
            ("1000000", vec![1_000_000]),
        ] {
            assert_eq!(frames(text), Some(expected), "{text}");
        }
        for wrong in [
            "",
            "0",
            "-1",
            "5-1",
            "1-",
            "1-5x0",
            "1-5x",
            "5x2",
            "1,,2",
            "1-99999999999",
            "1.5",
            "+1",
            "1000001",
            "1-1000000,1-1000000",
            "a",
        ] {
            assert_eq!(frames(wrong), None, "{wrong}");
        }
    }

    #[test]
    fn rates_are_exact() {
        for (text, frames, seconds) in [
            ("24", 24, 1),
            ("25", 25, 1),
            ("23.976", 24_000, 1001),
            ("23.98", 24_000, 1001),
            ("29.97", 30_000, 1001),
            ("59.94", 60_000, 1001),
            ("12.5", 25, 2),
            ("30000/1001", 30_000, 1001),
        ] {
            assert_eq!(text.parse(), Ok(Rate { frames, seconds }), "{text}");
        }
        for wrong in ["", "0", "-24", "1/0", "24.", ".5.", "nan", "1e3", "23.9760"] {
            assert!(wrong.parse::<Rate>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn frame_1_is_the_beginning_and_frame_13_at_24_a_second_half_a_second_later() {
        let time = |rate: &str, frame| rate.parse().map(|rate: Rate| rate.time(frame));
        assert_eq!(time("24", 1), Ok(0.0));
        assert_eq!(time("24", 13), Ok(0.5));
        assert_eq!(time("23.976", 24_001), Ok(1001.0));
        assert_eq!(time("25", 26), Ok(1.0));
    }

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
