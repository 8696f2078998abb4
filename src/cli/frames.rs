//! What can be said of pictures that follow each other, and the times at which they are taken.

mod pattern;
mod rate;

pub(super) use pattern::{holds_pattern, path_of};

use super::Failure;
use super::values::whole_number;
use clap::Args;
use rate::Rate;
use std::collections::HashSet;
use std::f64::consts::TAU;
use std::str::FromStr;

/// The greatest number of a frame, and the most frames: 11 hours at 24 a second.
const MOST_FRAMES: u32 = 1_000_000;

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
}
