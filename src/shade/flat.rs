//! Flat colour: the first of the paper's pictures, rays without light (Appel 1968, Roth 1982).

use super::Reflectance;
use crate::color::Rgb;

/// `k_d`: the surface's colour, whatever the light.
pub fn color(surface: &Reflectance) -> Rgb {
    surface.color
}
