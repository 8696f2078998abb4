//! Values on the command line that are more than a number or a word.

use clap::builder::{PossibleValuesParser, TypedValueParser};
use glam::Vec3;
use luch::color::{Rgb, srgb_to_linear};
use luch::output::Display;
use luch::scene::{Background, Shown};
use std::num::NonZeroU8;
use std::ops::RangeInclusive;
use std::str::FromStr;

/// A picture's size, as in `1280x720`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Size {
    pub(super) width: u32,
    pub(super) height: u32,
}

impl FromStr for Size {
    type Err = String;

    fn from_str(text: &str) -> Result<Size, String> {
        let sides = text
            .split_once(['x', 'X'])
            .and_then(|(w, h)| Some((w.parse().ok()?, h.parse().ok()?)));
        let (width, height) = sides.ok_or("expected width x height in pixels, as in 1280x720")?;
        Ok(Size { width, height })
    }
}

/// What lies behind everything.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct BackgroundValue(pub(super) Background);

impl FromStr for BackgroundValue {
    type Err = String;

    fn from_str(text: &str) -> Result<BackgroundValue, String> {
        if text == "transparent" {
            return Ok(BackgroundValue(Background::plain(Rgb::BLACK, Shown::Never)));
        }
        if text == "environment" {
            let shown = Shown::Environment;
            return Ok(BackgroundValue(Background::plain(Rgb::BLACK, shown)));
        }
        let color = display_color(text.strip_prefix('#').unwrap_or(text));
        let color = color.ok_or(
            "expected a colour of six hex digits, as in '#808080', transparent or environment",
        )?;
        Ok(BackgroundValue(Background::plain(color, Shown::Always)))
    }
}

/// The linear colour of six hex digits.
pub(super) fn display_color(digits: &str) -> Option<Rgb> {
    let is_color = digits.len() == 6 && digits.bytes().all(|b| b.is_ascii_hexdigit());
    let bits = u32::from_str_radix(digits, 16).ok().filter(|_| is_color)?;
    let channel = |shift: u32| srgb_to_linear((bits >> shift & 255) as f32 / 255.0);
    Some(Rgb::new(channel(16), channel(8), channel(0)))
}

/// An angle in degrees, of any size.
pub(super) fn degrees(text: &str) -> Result<f64, String> {
    let angle = text.parse().ok().filter(|angle: &f64| angle.abs() <= 1e6);
    angle.ok_or_else(|| "expected an angle in degrees".into())
}

/// Where something is seen, in degrees, as in `-15,45`.
pub(super) fn azimuth_and_elevation(text: &str) -> Result<[f64; 2], String> {
    let angles = text.split_once(',').and_then(|(azimuth, elevation)| {
        let elevation = degrees(elevation.trim()).ok();
        let elevation = elevation.filter(|elevation| elevation.abs() <= 90.0)?;
        Some([degrees(azimuth.trim()).ok()?, elevation])
    });
    let expected = "expected two angles in degrees with a comma between, as in -15,45, the second from -90 to 90";
    angles.ok_or_else(|| expected.into())
}

/// What multiplies light.
pub(super) fn factor(text: &str) -> Result<f32, String> {
    let factor = text
        .parse()
        .ok()
        .filter(|&factor| (0.0..=f32::MAX).contains(&factor));
    factor.ok_or_else(|| "expected a finite number, 0 or more".into())
}

/// A point, as in `1,-2,0.5`.
pub(super) fn vector(text: &str) -> Result<Vec3, String> {
    let numbers: Result<Vec<f32>, _> = text
        .split(',')
        .map(|number| number.trim().parse())
        .collect();
    match numbers.as_deref() {
        Ok(&[x, y, z]) if Vec3::new(x, y, z).is_finite() => Ok(Vec3::new(x, y, z)),
        _ => Err("expected three finite numbers with commas between, as in 1,2,0.5".into()),
    }
}

/// Two angles in degrees, as in `-30,10`.
pub(super) fn angles(text: &str) -> Result<[f64; 2], String> {
    let numbers = text.split(',').map(|number| number.trim().parse());
    let numbers: Result<Vec<f64>, _> = numbers.collect();
    match numbers.as_deref() {
        Ok(&[yaw, pitch]) if yaw.is_finite() && pitch.is_finite() => Ok([yaw, pitch]),
        _ => Err("expected two angles in degrees with a comma between, as in -30,10".into()),
    }
}

/// How many times as large.
pub(super) fn zoom(text: &str) -> Result<f64, String> {
    let zoom = text.parse().ok();
    zoom.filter(|zoom| (1e-3..=1e3).contains(zoom))
        .ok_or_else(|| "expected a number from 0.001 to 1000; 2 is twice as large".into())
}

/// A number of bytes, as in `1000000`, `500M` or `4G`: the letters are powers of 1024.
pub(super) fn bytes(text: &str) -> Result<u64, String> {
    let units = [('K', 10), ('M', 20), ('G', 30), ('T', 40)];
    let unit = units
        .into_iter()
        .find(|(letter, _)| text.to_uppercase().ends_with(*letter));
    let (digits, shift) = match unit {
        Some((_, shift)) => (text.get(..text.len() - 1), shift),
        None => (Some(text), 0),
    };
    let number: Option<u64> = digits.and_then(|digits| digits.parse().ok());
    number
        .and_then(|number| number.checked_mul(1 << shift))
        .filter(|&bytes| bytes > 0)
        .ok_or_else(|| "expected a whole number of bytes above 0, as in 4G or 500M".into())
}

/// A whole number in a range.
pub(super) fn whole_number(
    range: RangeInclusive<u32>,
) -> impl Fn(&str) -> Result<u32, String> + Clone + Send + Sync {
    move |text| {
        let number = text.parse().ok().filter(|number| range.contains(number));
        let (least, most) = (range.start(), range.end());
        number.ok_or_else(|| match *most {
            u32::MAX => format!("expected a whole number, at least {least}"),
            _ => format!("expected a whole number from {least} to {most}"),
        })
    }
}

/// How many primitives a leaf may have.
pub(super) fn leaf_size(text: &str) -> Result<NonZeroU8, String> {
    let size: Option<NonZeroU8> = text.parse().ok();
    size.filter(|size| size.get() <= 16)
        .ok_or_else(|| "expected a whole number from 1 to 16".to_owned())
}

/// A moment in seconds.
pub(super) fn seconds(text: &str) -> Result<f64, String> {
    let seconds: Option<f64> = text.parse().ok();
    seconds
        .filter(|seconds| *seconds >= 0.0 && seconds.is_finite())
        .ok_or_else(|| "expected seconds, 0 or more".to_owned())
}

/// A field of view in degrees.
pub(super) fn field_of_view(text: &str) -> Result<f64, String> {
    let angle = text
        .parse()
        .ok()
        .filter(|&angle| 0.0 < angle && angle < 180.0);
    angle.ok_or_else(|| "expected an angle above 0 and below 180 degrees".into())
}

/// A share of something.
pub(super) fn share(text: &str) -> Result<f32, String> {
    let share = text.parse().ok();
    share
        .filter(|share| (0.0..=1.0).contains(share))
        .ok_or_else(|| "expected a share from 0 to 1".into())
}

/// An exposure: two to this power is a number.
pub(super) fn stops(text: &str) -> Result<f32, String> {
    let stops = text
        .parse()
        .ok()
        .filter(|stops| (-100.0..=100.0).contains(stops));
    stops.ok_or_else(|| "expected a number of stops from -100 to 100".into())
}

/// A display transform by its name.
pub(super) fn display() -> impl TypedValueParser<Value = Display> {
    named("a display transform", Display::ALL, Display::name)
}

/// One of several by its name.
pub(super) fn named<T, const N: usize>(
    what: &'static str,
    all: [T; N],
    name_of: fn(T) -> &'static str,
) -> impl TypedValueParser<Value = T>
where
    T: Copy + Send + Sync + 'static,
{
    PossibleValuesParser::new(all.map(name_of)).try_map(move |name| {
        let found = all.into_iter().find(|&one| name_of(one) == name);
        found.ok_or_else(|| format!("expected the name of {what}"))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bytes_have_letters_for_powers_of_1024() {
        for (text, expected) in [
            ("7", 7),
            ("3k", 3 << 10),
            ("500M", 500 << 20),
            ("4G", 4 << 30),
        ] {
            assert_eq!(bytes(text), Ok(expected));
        }
        for wrong in ["", "0", "G", "-1G", "1.5G", "99999999T", "4 G", "é"] {
            assert!(bytes(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn sizes_are_two_numbers_with_an_x() {
        assert_eq!(
            "640x480".parse(),
            Ok(Size {
                width: 640,
                height: 480
            })
        );
        for wrong in ["640", "x", "640x", "-1x2", "640x480x3", "1e3x2"] {
            assert!(wrong.parse::<Size>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn a_background_is_a_display_colour() {
        let parsed: Result<BackgroundValue, String> = "#ff8000".parse();
        let expected = Rgb::new(1.0, srgb_to_linear(128.0 / 255.0), 0.0);
        assert_eq!(
            parsed,
            Ok(BackgroundValue(Background::plain(expected, Shown::Always)))
        );
        for wrong in ["#fff", "#gggggg", "red", "#+12345", ""] {
            assert!(wrong.parse::<BackgroundValue>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn a_vector_is_three_numbers() {
        assert_eq!(vector("1,-2, .5"), Ok(Vec3::new(1.0, -2.0, 0.5)));
        for wrong in ["1,2", "1,2,3,4", "a,b,c", "nan,0,0", "0,inf,0", "0,0,1e39"] {
            assert!(vector(wrong).is_err(), "{wrong}");
        }
    }

    #[test]
    fn numbers_outside_their_range_are_told_the_range() {
        let threads = whole_number(1..=1024);
        assert_eq!(threads("1024"), Ok(1024));
        for wrong in ["0", "1025", "-1", "1.5", "", "many"] {
            let expected = "expected a whole number from 1 to 1024";
            assert_eq!(threads(wrong), Err(expected.into()), "{wrong}");
        }
        let samples = whole_number(0..=u32::MAX);
        let expected = "expected a whole number, at least 0";
        assert_eq!(samples("-1"), Err(expected.into()));
        assert!(leaf_size("1").is_ok() && leaf_size("0").is_err() && leaf_size("17").is_err());
    }

    #[test]
    fn angles_and_stops_are_finite_and_in_range() {
        assert_eq!(field_of_view("40"), Ok(40.0));
        for wrong in ["0", "180", "-1", "nan", "inf", "wide"] {
            assert!(field_of_view(wrong).is_err(), "{wrong}");
        }
        assert_eq!(stops("-1.5"), Ok(-1.5));
        for wrong in ["nan", "inf", "-inf", "101", "bright"] {
            assert!(stops(wrong).is_err(), "{wrong}");
        }
    }
}
