//! Values on the command line that are more than a number or a word.

use glam::Vec3;
use luch::color::{Rgb, srgb_to_linear};
use luch::output::Display;
use luch::scene::{Background, Shown};
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
            return Ok(BackgroundValue(Background {
                color: Rgb::BLACK,
                shown: Shown::Never,
            }));
        }
        let digits = text.strip_prefix('#').unwrap_or(text);
        let is_color = digits.len() == 6 && digits.bytes().all(|b| b.is_ascii_hexdigit());
        let bits = u32::from_str_radix(digits, 16).ok().filter(|_| is_color);
        let bits =
            bits.ok_or("expected a colour of six hex digits, as in '#808080', or transparent")?;
        let channel = |shift: u32| srgb_to_linear((bits >> shift & 255) as f32 / 255.0);
        let color = Rgb::new(channel(16), channel(8), channel(0));
        Ok(BackgroundValue(Background {
            color,
            shown: Shown::Always,
        }))
    }
}

/// A point, as in `1,-2,0.5`.
pub(super) fn vector(text: &str) -> Result<Vec3, String> {
    let numbers: Result<Vec<f32>, _> = text
        .split(',')
        .map(|number| number.trim().parse())
        .collect();
    match numbers.as_deref() {
        Ok(&[x, y, z]) => Ok(Vec3::new(x, y, z)),
        _ => Err("expected three numbers with commas between, as in 1,2,0.5".into()),
    }
}

/// A display transform by its name.
pub(super) fn display(text: &str) -> Result<Display, String> {
    Display::ALL
        .into_iter()
        .find(|display| display.name() == text)
        .ok_or_else(|| {
            let names = Display::ALL.map(Display::name).join(", ");
            format!("expected one of {names}")
        })
}

#[cfg(test)]
mod tests {
    use super::*;

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
            Ok(BackgroundValue(Background {
                color: expected,
                shown: Shown::Always
            }))
        );
        for wrong in ["#fff", "#gggggg", "red", "#+12345", ""] {
            assert!(wrong.parse::<BackgroundValue>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn a_vector_is_three_numbers() {
        assert_eq!(vector("1,-2, .5"), Ok(Vec3::new(1.0, -2.0, 0.5)));
        assert!(vector("1,2").is_err() && vector("1,2,3,4").is_err() && vector("a,b,c").is_err());
    }
}
