//! `[[material]]`, and the names by which others speak of one.

use super::kind::{ABOVE_ZERO, COLOR, NOT_NEGATIVE, SHARE, TEXT};
use super::nearest::suggestion;
use super::source::quoted;
use super::table::{Schema, Table};
use super::transmission;
use crate::Error;
use crate::color::Rgb;
use crate::material::{Alpha, Material, Model, Phong, Textured};
use crate::texture::Checker;
use std::collections::BTreeMap;

const MATERIAL: Schema = Schema {
    key: "material",
    label: "[[material]]",
    keys: &[
        "name",
        "diffuse",
        "specular",
        "shininess",
        "reflectivity",
        "emission",
        "checker",
        "transmission",
        "ior",
        "thin",
        "attenuation_color",
        "attenuation_distance",
        "dispersion",
    ],
};

const CHECKER: Schema = Schema {
    key: "checker",
    label: "checker { color, size }",
    keys: &["color", "size"],
};

/// Who may have a checkerboard.
#[derive(Clone, Copy, PartialEq, Eq)]
pub(super) enum Wearer {
    /// A plane: the pattern lies in it.
    Plane,
    /// Anything else, on which the pattern has no place.
    Other,
}

/// The materials of a scene file.
pub(super) struct Materials {
    /// In the file's order.
    pub(super) list: Vec<Material>,
    /// Index into the list, and where the definition stands, in bytes.
    by_name: BTreeMap<String, (u32, usize)>,
}

impl Materials {
    /// All that the file defines.
    pub(super) fn read(root: &Table<'_>) -> Result<Materials, Error> {
        let tables = root.tables(&MATERIAL)?;
        let mut materials = Materials {
            list: Vec::with_capacity(tables.len()),
            by_name: BTreeMap::new(),
        };
        for (index, table) in (0..).zip(&tables) {
            let material = material(table)?;
            let name = material.name.clone();
            if let Some(&(_, first)) = materials.by_name.get(&name) {
                let problem = format!(
                    "a material named {} is defined already, on line {}; rename one",
                    quoted(&name),
                    table.line(first)
                );
                return Err(table.error("name", problem));
            }
            materials.by_name.insert(name, (index, table.at()));
            materials.list.push(material);
        }
        Ok(materials)
    }

    /// The index of the material that `table` names, if it names one.
    pub(super) fn optional(&self, table: &Table<'_>, wearer: Wearer) -> Result<Option<u32>, Error> {
        let Some(name) = table.optional("material", &TEXT)? else {
            return Ok(None);
        };
        let Some(&(index, _)) = self.by_name.get(&name) else {
            return Err(table.error("material", self.unknown(&name)));
        };
        let checkered = self.list.get(index as usize).is_some_and(has_checker);
        if checkered && wearer == Wearer::Other {
            let problem = format!(
                "material {} has a checker, which only planes can have; name another",
                quoted(&name)
            );
            return Err(table.error("material", problem));
        }
        Ok(Some(index))
    }

    /// The index of the material that `table` must name.
    pub(super) fn required(&self, table: &Table<'_>, wearer: Wearer) -> Result<u32, Error> {
        self.optional(table, wearer)?
            .ok_or_else(|| table.missing("material", "the name of a [[material]]"))
    }

    fn unknown(&self, name: &str) -> String {
        if self.list.is_empty() {
            return format!(
                "no material is named {}; write a [[material]] with that name",
                quoted(name)
            );
        }
        format!(
            "no material is named {}{}",
            quoted(name),
            suggestion(name, self.by_name.keys().map(String::as_str))
        )
    }
}

fn has_checker(material: &Material) -> bool {
    matches!(&material.model, Model::Phong(phong) if phong.checker.is_some())
}

fn material(table: &Table<'_>) -> Result<Material, Error> {
    let name = table.required("name", &TEXT)?;
    let color = |key, default| table.or(key, &COLOR, default).map(Textured::uniform);
    let checker = match table.table(&CHECKER)? {
        None => None,
        Some(checker) => Some(Checker {
            color: checker.required("color", &COLOR)?,
            size: checker.required("size", &ABOVE_ZERO)?,
        }),
    };
    let transmission = transmission::read(table)?;
    // What light goes through is clear where no colour is written, what it does not is grey.
    let default_color = match &transmission {
        Some(_) => Rgb::WHITE,
        None => Rgb::grey(0.8),
    };
    let phong = Phong {
        diffuse: color("diffuse", default_color)?,
        specular: color("specular", Rgb::BLACK)?,
        shininess: table.or("shininess", &NOT_NEGATIVE, 32.0)?,
        reflectivity: Rgb::grey(table.or("reflectivity", &SHARE, 0.0)?),
        checker,
    };
    Ok(Material {
        name,
        model: Model::Phong(phong),
        emission: color("emission", Rgb::BLACK)?,
        alpha: Alpha::OPAQUE,
        transmission,
        normal_map: None,
        double_sided: true,
    })
}
