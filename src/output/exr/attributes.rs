//! What an EXR says of itself beside its pixels.

use super::{camera, facts, moment};
use crate::film::Film;
use crate::output::Options;
use exr::math::Vec2;
use exr::meta::attribute::{AttributeValue, Chromaticities, IntegerBounds, Text};
use exr::meta::header::{ImageAttributes, LayerAttributes};

/// Rec. ITU-R BT.709-6, items 1.3 and 1.4: the primaries and D65.
const REC_709: Chromaticities = Chromaticities {
    red: Vec2(0.64, 0.33),
    green: Vec2(0.30, 0.60),
    blue: Vec2(0.15, 0.06),
    white: Vec2(0.3127, 0.3290),
};

/// What would be the same for every part of a file.
pub(super) fn shared(display: Vec2<usize>, options: &Options) -> ImageAttributes {
    ImageAttributes {
        chromaticities: Some(REC_709),
        time_code: options.header.frame.and_then(moment::time_code),
        ..ImageAttributes::new(IntegerBounds::from_dimensions(display))
    }
}

/// The others; the display window is of `size`.
pub(super) fn own(film: &Film, size: Vec2<usize>, options: &Options) -> LayerAttributes {
    let mut attributes = LayerAttributes {
        software_name: Some(text(concat!("luch ", env!("CARGO_PKG_VERSION")))),
        owner: Some(text(&options.header.owner)),
        comments: options.comments.as_deref().map(text),
        ..LayerAttributes::default()
    };
    // The Color Interop Forum's name for linear Rec. 709 light that refers to a scene.
    let color = AttributeValue::Text(text("lin_rec709_scene"));
    attributes.other.insert(text("colorInteropID"), color);
    if let Some(of) = &options.header.camera {
        camera::describe(of, size, &mut attributes);
    }
    moment::describe(&options.header, &mut attributes);
    facts::describe(film, &options.header, &mut attributes);
    attributes
}

/// In UTF-8; the crate's own conversion writes Latin-1, and panics beyond it.
pub(super) fn text(text: &str) -> Text {
    Text::from_slice_unchecked(text.as_bytes())
}
