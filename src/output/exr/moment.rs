//! When a picture was made, and where in a sequence it stands.

use super::attributes::text;
use crate::output::{Frame, Header};
use exr::meta::attribute::{AttributeValue, TimeCode};
use exr::meta::header::LayerAttributes;

/// Adds what is known of it. The date is in UTC, wherever the machine stands.
pub(super) fn describe(header: &Header, attributes: &mut LayerAttributes) {
    if let Some(date) = header.captured.and_then(date) {
        attributes.capture_date = Some(text(&date));
        attributes.utc_offset = Some(0.0);
    }
    if let Some(frame) = header.frame {
        let number = AttributeValue::I32(frame.number);
        attributes.other.insert(text("imageCounter"), number);
        attributes.frames_per_second = frame.per_second.and_then(rational);
    }
}

/// The time code of a frame: hours, minutes, seconds, and frames since the last second, none of them dropped. None where
/// there are more than 30 frames a second, which is as far as SMPTE ST 12-1 counts.
pub(super) fn time_code(frame: Frame) -> Option<TimeCode> {
    let [numerator, denominator] = frame.per_second?;
    // 24000/1001 counts to 24.
    let nominal = numerator
        .checked_add(denominator / 2)?
        .checked_div(denominator)?;
    let nominal = i64::from(nominal);
    if !(1..=30).contains(&nominal) {
        return None;
    }
    let number = i64::from(frame.number).rem_euclid(24 * 60 * 60 * nominal);
    let seconds = number / nominal;
    Some(TimeCode {
        hours: (seconds / 3600) as u8,
        minutes: (seconds / 60 % 60) as u8,
        seconds: (seconds % 60) as u8,
        frame: (number % nominal) as u8,
        drop_frame: false,
        color_frame: false,
        field_phase: false,
        binary_group_flags: [false; 3],
        binary_groups: [0; 8],
    })
}

fn rational([numerator, denominator]: [u32; 2]) -> Option<(i32, u32)> {
    let numerator = i32::try_from(numerator).ok()?;
    (denominator > 0).then_some((numerator, denominator))
}

/// `YYYY:MM:DD hh:mm:ss`; none after the year 9999.
///
/// The year begins in March, so that the day that some years lack is its last (Hinnant 2013, "chrono-Compatible Low-Level
/// Date Algorithms", civil_from_days).
fn date(seconds: u64) -> Option<String> {
    let (days, second) = (seconds / 86_400, seconds % 86_400);
    // Days since 1 March of the year 0, in eras of 400 years.
    let days = days.checked_add(719_468)?;
    let (era, day_of_era) = (days / 146_097, days % 146_097);
    let year_of_era =
        (day_of_era - day_of_era / 1460 + day_of_era / 36_524 - day_of_era / 146_096) / 365;
    let day_of_year = day_of_era - (365 * year_of_era + year_of_era / 4 - year_of_era / 100);
    let month_from_march = (5 * day_of_year + 2) / 153;
    let day = day_of_year - (153 * month_from_march + 2) / 5 + 1;
    let month = if month_from_march < 10 {
        month_from_march + 3
    } else {
        month_from_march - 9
    };
    let year = year_of_era + era * 400 + u64::from(month <= 2);
    let (hour, minute, second) = (second / 3600, second / 60 % 60, second % 60);
    (year <= 9999)
        .then(|| format!("{year:04}:{month:02}:{day:02} {hour:02}:{minute:02}:{second:02}"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn dates_are_those_of_the_calendar() {
        // What `date -u -d @N` says.
        for (seconds, expected) in [
            (0, Some("1970:01:01 00:00:00")),
            (951_782_399, Some("2000:02:28 23:59:59")),
            (951_782_400, Some("2000:02:29 00:00:00")),
            (1_709_251_199, Some("2024:02:29 23:59:59")),
            (4_107_542_400, Some("2100:03:01 00:00:00")),
            (253_402_300_799, Some("9999:12:31 23:59:59")),
            (253_402_300_800, None),
            (u64::MAX, None),
        ] {
            assert_eq!(date(seconds).as_deref(), expected, "{seconds}");
        }
    }

    #[test]
    fn a_time_code_counts_frames_within_seconds() {
        let of = |number, per_second| {
            let code = time_code(Frame { number, per_second })?;
            Some([code.hours, code.minutes, code.seconds, code.frame])
        };
        assert_eq!(of(25, Some([24, 1])), Some([0, 0, 1, 1]));
        assert_eq!(
            of(86_399 * 30 + 29, Some([30_000, 1001])),
            Some([23, 59, 59, 29])
        );
        assert_eq!(of(-1, Some([25, 1])), Some([23, 59, 59, 24]));
        let none = [
            None,
            Some([60, 1]),
            Some([0, 1]),
            Some([24, 0]),
            Some([u32::MAX, 2]),
        ];
        assert_eq!(none.map(|per_second| of(1, per_second)), [None; 5]);
    }
}
