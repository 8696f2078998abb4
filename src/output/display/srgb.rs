//! No transform at all: what a display cannot show is cut off.

use crate::color::Rgb;

/// At most one in every channel.
pub(super) fn clip(light: Rgb) -> Rgb {
    light.map(|channel| channel.min(1.0))
}
