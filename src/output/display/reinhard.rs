//! Reinhard's simple operator.

use crate::color::Rgb;

/// `c / (1 + c)` for each channel by itself, as three.js has it: bright colours lose saturation.
///
/// Reinhard, Stark, Shirley, Ferwerda 2002, "Photographic Tone Reproduction for Digital Images", equation (3), which
/// takes the luminance for `c`.
pub(super) fn reinhard(light: Rgb) -> Rgb {
    light.map(|c| c / (1.0 + c))
}
