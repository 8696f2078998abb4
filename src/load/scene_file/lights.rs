//! `[[light]]`.

use super::kind::{self, COLOR, DIRECTION, INNER_ANGLE, NOT_NEGATIVE, OUTER_ANGLE, POINT, TEXT};
use super::table::{Schema, Table};
use crate::Error;
use crate::color::Rgb;
use crate::light::{Falloff, Light, LightKind};
use std::f32::consts::FRAC_PI_4;

const LIGHT: Schema = Schema {
    key: "light",
    label: "[[light]]",
    keys: &[
        "type",
        "name",
        "position",
        "direction",
        "color",
        "intensity",
        "falloff",
        "inner_angle",
        "outer_angle",
    ],
};

const TYPES: [(&str, Type); 3] = [
    ("point", Type::Point),
    ("directional", Type::Directional),
    ("spot", Type::Spot),
];

const FALLOFFS: [(&str, Falloff); 2] = [
    ("none", Falloff::None),
    ("inverse-square", Falloff::InverseSquare),
];

#[derive(Clone, Copy)]
enum Type {
    Point,
    Directional,
    Spot,
}

/// Every light, in the file's order.
pub(super) fn read(root: &Table<'_>) -> Result<Vec<Light>, Error> {
    root.tables(&LIGHT)?.iter().map(light).collect()
}

fn light(table: &Table<'_>) -> Result<Light, Error> {
    let Some(light_type) = table.choice("type", &TYPES)? else {
        let words = TYPES.iter().map(|&(word, _)| word);
        return Err(table.missing("type", &kind::one_of(words)));
    };
    let kind = match light_type {
        Type::Point => {
            without(table, "point", &["direction", "inner_angle", "outer_angle"])?;
            LightKind::Point {
                position: table.required("position", &POINT)?.as_vec3(),
            }
        }
        Type::Directional => {
            let spatial = ["position", "falloff", "inner_angle", "outer_angle"];
            without(table, "directional", &spatial)?;
            LightKind::Directional {
                direction: table.required("direction", &DIRECTION)?,
            }
        }
        Type::Spot => spot(table)?,
    };
    Ok(Light {
        name: table.or("name", &TEXT, String::new())?,
        kind,
        color: table.or("color", &COLOR, Rgb::WHITE)?,
        intensity: table.or("intensity", &NOT_NEGATIVE, 1.0)?,
        falloff: table.choice("falloff", &FALLOFFS)?.unwrap_or_default(),
        range: None,
    })
}

fn spot(table: &Table<'_>) -> Result<LightKind, Error> {
    let position = table.required("position", &POINT)?.as_vec3();
    let direction = table.required("direction", &DIRECTION)?;
    let outer_angle = table.or("outer_angle", &OUTER_ANGLE, FRAC_PI_4)?;
    let inner_angle = table.or("inner_angle", &INNER_ANGLE, 0.0)?;
    if inner_angle >= outer_angle {
        let expected = match table.has("outer_angle") {
            true => "less than outer_angle",
            false => "less than outer_angle, which is 45 where it is not written",
        };
        return Err(table.wrong("inner_angle", expected));
    }
    Ok(LightKind::Spot {
        position,
        direction,
        inner_angle,
        outer_angle,
    })
}

/// No key that says nothing of a light of this type: it would be ignored.
fn without(table: &Table<'_>, light_type: &str, keys: &[&str]) -> Result<(), Error> {
    match table.keys().into_iter().find(|key| keys.contains(key)) {
        None => Ok(()),
        Some(key) => {
            let problem = format!("a {light_type} light has no {key}; remove it");
            Err(table.error(key, problem))
        }
    }
}
