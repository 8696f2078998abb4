//! What can be wrong with settings.

use super::{MAX_DEPTH, MAX_FILM_BYTES, MAX_PLACE};
use crate::film::Window;
use crate::sampling::MAX_SAMPLES;

/// What is wrong with settings.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum SettingsError {
    /// No pixels.
    #[error("a picture of {width} x {height} pixels has no pixels; both must be above 0")]
    NoPixels {
        /// As asked.
        width: u32,
        /// As asked.
        height: u32,
    },
    /// More than a film may take.
    #[error(
        "a picture of {width} x {height} pixels needs {} MB of memory, more than the {} MB allowed; make it smaller",
        bytes / 1_000_000,
        MAX_FILM_BYTES / 1_000_000
    )]
    TooLarge {
        /// As asked.
        width: u32,
        /// As asked.
        height: u32,
        /// What its film would take.
        bytes: u64,
    },
    /// Further from the picture than a film may lie.
    #[error(
        "a window of {} x {} pixels from {},{} reaches too far from the picture; keep it within {MAX_PLACE} pixels",
        window.width,
        window.height,
        window.left,
        window.top
    )]
    TooFar {
        /// As asked.
        window: Window,
    },
    /// No grid has that many samples.
    #[error("{samples} samples a pixel do not make a square grid; use {below} or {above}")]
    NotSquare {
        /// As asked.
        samples: u32,
        /// The nearest square number below.
        below: u32,
        /// The nearest square number above.
        above: u32,
    },
    /// No samples, or too many.
    #[error("{samples} samples a pixel cannot be; use 1 to {MAX_SAMPLES}")]
    NoSamples {
        /// As asked.
        samples: u32,
    },
    /// More mirror bounces than could ever matter.
    #[error("a depth of {max_depth} mirror bounces is above the limit of {MAX_DEPTH}")]
    TooDeep {
        /// As asked.
        max_depth: u32,
    },
}
