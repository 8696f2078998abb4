//! The kinds of value that keys of a scene file have, each with the words for what is expected.
//!
//! A number is one that 32 bits hold: neither `nan` nor `inf`, nor beyond 3.4e38.

use crate::color::Rgb;
use glam::{DQuat, DVec3, Vec3};
use std::f32::consts::{FRAC_PI_2, PI};
use toml::de::DeValue;

/// A kind of value.
pub(super) struct Kind<T> {
    /// As in "a number above 0".
    pub(super) expected: &'static str,
    /// The value, where it is of this kind.
    pub(super) read: fn(&DeValue<'_>) -> Option<T>,
}

/// A length that something real has.
pub(super) const ABOVE_ZERO: Kind<f32> = Kind {
    expected: "a finite number above 0",
    read: |value| number(value).filter(|&number| number > 0.0),
};

/// A factor, an exponent, a distance.
pub(super) const NOT_NEGATIVE: Kind<f32> = Kind {
    expected: "a finite number, 0 or more",
    read: |value| number(value).filter(|&number| number >= 0.0),
};

/// A distance that need not end.
pub(super) const FAR: Kind<f32> = Kind {
    expected: "a number above 0, or inf",
    read: |value| match value {
        DeValue::Float(float) if ["inf", "+inf"].contains(&float.as_str()) => Some(f32::INFINITY),
        _ => (ABOVE_ZERO.read)(value),
    },
};

/// A part of a whole.
pub(super) const SHARE: Kind<f32> = Kind {
    expected: "a number from 0 to 1",
    read: |value| number(value).filter(|number| (0.0..=1.0).contains(number)),
};

/// A field of view, in radians.
pub(super) const FIELD_OF_VIEW: Kind<f64> = Kind {
    expected: "an angle above 0 and below 180 degrees",
    read: |value| {
        let angle = finite(value).map(f64::to_radians);
        // Half a picture's width is the tangent of half of it: not one of 1e9.
        angle.filter(|&angle| angle > 0.0 && (angle as f32) < PI)
    },
};

/// Half of a spot's opening, in radians.
pub(super) const OUTER_ANGLE: Kind<f32> = Kind {
    expected: "a half-angle above 0, at most 90 degrees",
    read: |value| angle(value).filter(|&angle| angle > 0.0 && angle <= FRAC_PI_2),
};

/// Half of the opening in which a spot is at its full strength, in radians.
pub(super) const INNER_ANGLE: Kind<f32> = Kind {
    expected: "a half-angle of 0 degrees or more, less than outer_angle",
    read: |value| angle(value).filter(|&angle| (0.0..FRAC_PI_2).contains(&angle)),
};

/// How many, none included.
pub(super) const COUNT: Kind<u32> = Kind {
    expected: "a whole number, 0 or more",
    read: |value| whole_number(value).and_then(|number| u32::try_from(number).ok()),
};

/// How many, at least one.
pub(super) const COUNT_ABOVE_ZERO: Kind<u32> = Kind {
    expected: "a whole number above 0",
    read: |value| (COUNT.read)(value).filter(|&count| count > 0),
};

/// How far something is turned, in radians.
pub(super) const TURN: Kind<f32> = Kind {
    expected: "an angle in degrees",
    read: angle,
};

/// Where something is seen, in degrees: azimuth and elevation.
pub(super) const ANGLES: Kind<[f64; 2]> = Kind {
    expected: "two angles in degrees, [azimuth, elevation], the latter from -90 to 90",
    read: |value| numbers(value).filter(|[_, elevation]| (-90.0..=90.0).contains(elevation)),
};

/// Words.
pub(super) const TEXT: Kind<String> = Kind {
    expected: "a text in quotes",
    read: |value| value.as_str().map(str::to_owned),
};

/// A place, or a way from one to another.
pub(super) const POINT: Kind<DVec3> = Kind {
    expected: "three finite numbers, [x, y, z]",
    read: |value| numbers(value).map(DVec3::from),
};

/// A vector of any length but none.
pub(super) const DIRECTION: Kind<Vec3> = Kind {
    expected: "three finite numbers, [x, y, z], that are not all 0",
    read: |value| {
        let direction = numbers(value).map(|xyz| DVec3::from(xyz).as_vec3())?;
        (direction != Vec3::ZERO).then_some(direction)
    },
};

/// A linear colour or an amount of light.
pub(super) const COLOR: Kind<Rgb> = Kind {
    expected: "three finite numbers, [red, green, blue], each 0 or more",
    read: |value| {
        let color = numbers(value).map(|rgb| rgb.map(|channel| channel as f32))?;
        color
            .iter()
            .all(|&channel| channel >= 0.0)
            .then_some(color.into())
    },
};

/// What is left of light: a colour of shares.
pub(super) const FILTER: Kind<Rgb> = Kind {
    expected: "three numbers from 0 to 1, [red, green, blue]",
    read: |value| {
        let color = (COLOR.read)(value);
        color.filter(|color| color.max_component() <= 1.0)
    },
};

/// Whether something is so.
pub(super) const TRUE_OR_FALSE: Kind<bool> = Kind {
    expected: "true or false",
    read: |value| value.as_bool(),
};

/// A quaternion of any length but none, which becomes unit length.
pub(super) const ROTATION: Kind<DQuat> = Kind {
    expected: "a quaternion of four finite numbers, [x, y, z, w], that are not all 0",
    read: |value| {
        let q = numbers(value)?;
        // What has a length in 32 bits has squares in 64.
        let has_length = q.iter().any(|&part| part as f32 != 0.0);
        has_length.then(|| DQuat::from_array(q).normalize())
    },
};

/// The same factor along all axes, or one for each.
pub(super) const SCALE: Kind<DVec3> = Kind {
    expected: "a finite number or three, [x, y, z], none of them 0, which would make a singular matrix",
    read: |value| {
        let scale = finite(value)
            .map(DVec3::splat)
            .or_else(|| numbers(value).map(DVec3::from))?;
        scale
            .to_array()
            .iter()
            .all(|&factor| factor as f32 != 0.0)
            .then_some(scale)
    },
};

/// `"point", "directional" or "spot"`.
pub(super) fn one_of<'w>(words: impl Iterator<Item = &'w str>) -> String {
    let quoted: Vec<String> = words.map(|word| format!("\"{word}\"")).collect();
    match quoted.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
        _ => quoted.concat(),
    }
}

fn number(value: &DeValue<'_>) -> Option<f32> {
    finite(value).map(|number| number as f32)
}

/// Degrees as radians.
fn angle(value: &DeValue<'_>) -> Option<f32> {
    finite(value).map(|degrees| degrees.to_radians() as f32)
}

fn numbers<const N: usize>(value: &DeValue<'_>) -> Option<[f64; N]> {
    let items = value.as_array().filter(|items| items.len() == N)?;
    let mut numbers = [0.0; N];
    for (number, item) in numbers.iter_mut().zip(items.iter()) {
        *number = finite(item.get_ref())?;
    }
    Some(numbers)
}

/// A number that 32 bits hold.
fn finite(value: &DeValue<'_>) -> Option<f64> {
    let number = match value {
        DeValue::Integer(_) => whole_number(value)? as f64,
        DeValue::Float(float) => float.as_str().parse().ok()?,
        _ => return None,
    };
    (number as f32).is_finite().then_some(number)
}

fn whole_number(value: &DeValue<'_>) -> Option<i64> {
    let integer = value.as_integer()?;
    i64::from_str_radix(integer.as_str(), integer.radix()).ok()
}
