//! What single fields must be.

use crate::color::Rgb;
use crate::scene::SceneError;
use glam::Vec3;

/// `sphere 3`, or `sphere 3 "moon"`; counted from 1.
pub(super) fn named(kind: &str, position: usize, name: &str) -> String {
    let number = position + 1;
    if name.is_empty() {
        format!("{kind} {number}")
    } else {
        format!("{kind} {number} \"{name}\"")
    }
}

pub(super) fn finite<const N: usize>(
    what: impl Fn() -> String,
    field: &'static str,
    numbers: [f32; N],
) -> Result<(), SceneError> {
    if numbers.iter().all(|n| n.is_finite()) {
        Ok(())
    } else {
        Err(SceneError::NotFinite {
            what: what(),
            field,
        })
    }
}

pub(super) fn check_color(
    what: impl Fn() -> String,
    field: &'static str,
    color: Rgb,
) -> Result<(), SceneError> {
    let negative = <[f32; 3]>::from(color)
        .into_iter()
        .find(|&channel| channel < 0.0);
    in_range(
        &what,
        field,
        negative.unwrap_or(0.0),
        negative.is_none(),
        "0 or more in every channel",
    )?;
    finite(what, field, color.into())
}

pub(super) fn direction(
    what: impl Fn() -> String,
    field: &'static str,
    v: Vec3,
) -> Result<(), SceneError> {
    finite(&what, field, v.to_array())?;
    if v == Vec3::ZERO {
        Err(SceneError::NoLength {
            what: what(),
            field,
        })
    } else {
        Ok(())
    }
}

pub(super) fn above_zero(
    what: impl Fn() -> String,
    field: &'static str,
    found: f32,
) -> Result<(), SceneError> {
    in_range(
        what,
        field,
        found,
        found > 0.0 && found.is_finite(),
        "a finite number above 0",
    )
}

pub(super) fn in_range(
    what: impl Fn() -> String,
    field: &'static str,
    found: f32,
    fits: bool,
    expected: &'static str,
) -> Result<(), SceneError> {
    if fits {
        Ok(())
    } else {
        Err(SceneError::OutOfRange {
            what: what(),
            field,
            found,
            expected,
        })
    }
}

pub(super) fn index(
    what: impl Fn() -> String,
    field: &'static str,
    index: u32,
    count: usize,
) -> Result<(), SceneError> {
    let index = index as usize;
    if index < count {
        Ok(())
    } else {
        Err(SceneError::NoSuch {
            what: what(),
            field,
            index,
            count,
        })
    }
}
