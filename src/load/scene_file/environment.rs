//! `[environment]`.

use super::kind::{self, ANGLES, COLOR, COUNT_ABOVE_ZERO, NOT_NEGATIVE, TEXT, TURN};
use super::table::{Schema, Table};
use crate::Error;
use crate::environment::MAX_LIGHTS;
use crate::load::environment::{EnvironmentChoice, EnvironmentLight, sun};
use crate::load::files;
use std::path::Path;

const ENVIRONMENT: Schema = Schema {
    key: "environment",
    label: "[environment]",
    keys: &[
        "kind",
        "color",
        "path",
        "sun",
        "rotation",
        "intensity",
        "lights",
    ],
};

const KINDS: [(&str, Kind); 4] = [
    ("studio", Kind::Studio),
    ("sky", Kind::Sky),
    ("color", Kind::Color),
    ("file", Kind::File),
];

#[derive(Clone, Copy)]
enum Kind {
    Studio,
    Sky,
    Color,
    File,
}

/// What `file` says of the light from all around.
pub(super) fn read(root: &Table<'_>, file: &Path) -> Result<EnvironmentChoice, Error> {
    let Some(table) = root.table(&ENVIRONMENT)? else {
        return Ok(EnvironmentChoice::default());
    };
    let Some(kind) = table.choice("kind", &KINDS)? else {
        let words = KINDS.iter().map(|&(word, _)| word);
        return Err(table.missing("kind", &kind::one_of(words)));
    };
    let light = match kind {
        Kind::Studio => {
            without(&table, "studio", &["color", "path", "sun"])?;
            EnvironmentLight::Studio
        }
        Kind::Sky => {
            without(&table, "sky", &["color", "path"])?;
            match table.optional("sun", &ANGLES)? {
                Some([azimuth, elevation]) => EnvironmentLight::Sky {
                    sun: sun(azimuth, elevation),
                },
                None => EnvironmentLight::sky(),
            }
        }
        Kind::Color => {
            without(&table, "color", &["path", "sun"])?;
            EnvironmentLight::Color(table.required("color", &COLOR)?)
        }
        Kind::File => {
            without(&table, "file", &["color", "sun"])?;
            let path = table.required("path", &TEXT)?;
            EnvironmentLight::File(files::beside(file, Path::new(&path)))
        }
    };
    let lights = table.optional("lights", &COUNT_ABOVE_ZERO)?;
    if lights.is_some_and(|lights| lights > MAX_LIGHTS) {
        let expected = format!("a whole number from 1 to {MAX_LIGHTS}");
        return Err(table.wrong("lights", &expected));
    }
    Ok(EnvironmentChoice {
        light: Some(light),
        rotation: table.optional("rotation", &TURN)?,
        intensity: table.optional("intensity", &NOT_NEGATIVE)?,
        lights,
    })
}

/// No key that says nothing of an environment of this kind: it would be ignored.
fn without(table: &Table<'_>, kind: &str, keys: &[&str]) -> Result<(), Error> {
    match table.keys().into_iter().find(|key| keys.contains(key)) {
        None => Ok(()),
        Some(key) => {
            let problem = format!("an environment of kind \"{kind}\" has no {key}; remove it");
            Err(table.error(key, problem))
        }
    }
}
