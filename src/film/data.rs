//! The layers of what surfaces are: each pixel has those of its nearest sample.

use super::{Combine, Layer, Precision, Quantity};
use std::borrow::Cow;

/// What shading takes for the surface's normal, turned toward the viewer; zero where nothing is seen.
pub const NORMAL: Layer = Layer {
    name: Cow::Borrowed("N"),
    quantity: Quantity::Normal,
    channels: &["X", "Y", "Z"],
    precision: Precision::Half,
    unit: "unit vector, world space, toward the viewer",
    combine: Combine::Nearest,
    values: Vec::new(),
};

/// Where the surface is; zero where nothing is seen.
pub const POSITION: Layer = Layer {
    name: Cow::Borrowed("P"),
    quantity: Quantity::Position,
    channels: &["X", "Y", "Z"],
    precision: Precision::Float,
    unit: "point, world space, scene units",
    combine: Combine::Nearest,
    values: Vec::new(),
};

/// The first set of texture coordinates, (0, 0) at the upper left of a texture as glTF has it, whatever the file's format;
/// zero where there is none.
pub const UV: Layer = Layer {
    name: Cow::Borrowed("UV"),
    quantity: Quantity::Uv,
    channels: &["U", "V"],
    precision: Precision::Float,
    unit: "texture coordinates, (0, 0) at the upper left",
    combine: Combine::Nearest,
    values: Vec::new(),
};

/// The surface's own colour, as [`crate::shade::Shading::Flat`] shows it; zero where nothing is seen.
pub const ALBEDO: Layer = Layer {
    name: Cow::Borrowed("albedo"),
    quantity: Quantity::Albedo,
    channels: &["R", "G", "B"],
    precision: Precision::Half,
    unit: "linear Rec. 709, 0 to 1",
    combine: Combine::Nearest,
    values: Vec::new(),
};
