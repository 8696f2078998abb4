//! What a `[[material]]` says of light that goes through it.

use super::kind::{ABOVE_ZERO, FAR, FILTER, NOT_NEGATIVE, SHARE, TRUE_OR_FALSE};
use super::table::Table;
use crate::Error;
use crate::color::Rgb;
use crate::material::{Textured, Transmission, Volume};

/// The index of refraction of glass, and of glTF's materials that do not say.
const GLASS: f32 = 1.5;

/// The keys that mean nothing without `transmission`.
const MORE: [&str; 5] = [
    "ior",
    "thin",
    "attenuation_color",
    "attenuation_distance",
    "dispersion",
];
/// Those of them that mean nothing of a thin sheet.
const OF_BODIES: [&str; 3] = ["attenuation_color", "attenuation_distance", "dispersion"];

/// What goes through a material, where its table says so.
pub(super) fn read(table: &Table<'_>) -> Result<Option<Transmission>, Error> {
    let Some(share) = table.optional("transmission", &SHARE)? else {
        let problem =
            |key: &str| format!("{key} says nothing without transmission; write that, too");
        return without(table, &MORE, problem).map(|()| None);
    };
    let thin = table.or("thin", &TRUE_OR_FALSE, false)?;
    if thin {
        let problem = |key: &str| format!("a thin material has no {key}; remove it");
        without(table, &OF_BODIES, problem)?;
    }
    let volume = Volume {
        attenuation_color: table.or("attenuation_color", &FILTER, Rgb::WHITE)?,
        attenuation_distance: table.or("attenuation_distance", &FAR, f32::INFINITY)?,
    };
    if volume.attenuation_color != Rgb::WHITE && volume.attenuation_distance == f32::INFINITY {
        let problem = "attenuation_color is what is left after attenuation_distance, which is not written; write a \
                       number above 0";
        return Err(table.error("attenuation_color", problem));
    }
    Ok(Some(Transmission {
        share: Textured::uniform(share),
        ior: table.or("ior", &ABOVE_ZERO, GLASS)?,
        dispersion: table.or("dispersion", &NOT_NEGATIVE, 0.0)?,
        volume: (!thin).then_some(volume),
    }))
}

/// None of these keys: they would be ignored.
fn without(
    table: &Table<'_>,
    keys: &[&str],
    problem: impl Fn(&str) -> String,
) -> Result<(), Error> {
    match table.keys().into_iter().find(|key| keys.contains(key)) {
        None => Ok(()),
        Some(key) => Err(table.error(key, problem(key))),
    }
}
