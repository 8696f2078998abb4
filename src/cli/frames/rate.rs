//! How many frames a second, and when each is.

use super::number;
use std::str::FromStr;

/// How many frames a second: exact, since a film of an hour at 24000/1001 is not one at 23.976.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::cli) struct Rate {
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
    pub(super) fn time(self, frame: u32) -> f64 {
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

#[cfg(test)]
mod tests {
    use super::*;

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
}
