//! The MTL files that an OBJ names.

use super::find::{Finder, Found};
use super::geometry::Geometry;
use super::mtl::{self, MtlMaterial};
use super::text::{plain, shown};
use crate::load::{Budget, Model, files, text_bytes};
use std::collections::hash_map::Entry;
use std::collections::{HashMap, HashSet};
use std::path::{Path, PathBuf};

/// A material and the folder that its textures' names start from.
pub(super) struct Known {
    pub(super) mtl: MtlMaterial,
    pub(super) folder: PathBuf,
}

pub(super) fn folder_of(path: &Path) -> PathBuf {
    path.parent().map(Path::to_owned).unwrap_or_default()
}

/// The materials of every MTL that the geometry names, by name.
pub(super) fn read_libraries(
    model: &mut Model,
    geometry: &Geometry,
    folder: &Path,
    finder: &mut Finder,
    budget: &Budget,
) -> HashMap<String, Known> {
    let mut known: HashMap<String, Known> = HashMap::new();
    let folders = [folder.to_owned()];
    let mut read = HashSet::new();
    for names in &geometry.libraries {
        // `mtllib` may list several files, and the name of one may have blanks.
        let all = match finder.find(names, &folders) {
            Found::Missing | Found::Refused(_) => separate_libraries(names),
            Found::AsNamed(_) | Found::Elsewhere(_) => vec![names.as_str()],
        };
        for name in all {
            let Some(path) = library_path(model, &finder.find(name, &folders), name) else {
                continue;
            };
            // However many names it goes by.
            if read.insert(path.canonicalize().unwrap_or_else(|_| path.clone())) {
                read_library(model, &path, budget, &mut known);
            }
        }
    }
    read_namesake(model, geometry, finder, budget, &read, &mut known);
    known
}

/// The MTL that has the OBJ's own name, for materials that are in none the OBJ names: files are renamed together, and
/// what `mtllib` says is forgotten.
fn read_namesake(
    model: &mut Model,
    geometry: &Geometry,
    finder: &mut Finder,
    budget: &Budget,
    read: &HashSet<PathBuf>,
    known: &mut HashMap<String, Known>,
) {
    if geometry
        .materials
        .iter()
        .all(|name| known.contains_key(name))
    {
        return;
    }
    let namesake = model.file.with_extension("mtl");
    let name = namesake.file_name().unwrap_or_default().to_string_lossy();
    let (Found::AsNamed(path) | Found::Elsewhere(path)) =
        finder.find(&name, &[folder_of(&namesake)])
    else {
        return;
    };
    if read.contains(&path.canonicalize().unwrap_or_else(|_| path.clone())) {
        return;
    }
    let mut more = HashMap::new();
    read_library(model, &path, budget, &mut more);
    more.retain(|name, _| !known.contains_key(name));
    known.extend(more);
    let shown = shown(name.as_bytes());
    model.warnings.add(format!(
        "materials that no mtllib leads to are looked for in \"{shown}\", which has the model's name"
    ));
}

/// The names in a list: each ends in `.mtl`, so that blanks within names are kept.
fn separate_libraries(names: &str) -> Vec<&str> {
    const ENDING: &str = ".mtl";
    let mut separate = Vec::new();
    let mut start = 0;
    let lower = names.to_ascii_lowercase();
    for (at, _) in lower.match_indices(ENDING) {
        let end = at + ENDING.len();
        let ends_word = names[end..].chars().next().is_none_or(char::is_whitespace);
        if ends_word {
            separate.push(names[start..end].trim());
            start = end;
        }
    }
    let last = names[start..].trim();
    if !last.is_empty() {
        separate.push(last);
    }
    separate
}

fn library_path(model: &mut Model, found: &Found, name: &str) -> Option<PathBuf> {
    let name = shown(name.as_bytes());
    match found {
        Found::AsNamed(path) => Some(path.clone()),
        Found::Elsewhere(path) => {
            let there = path.display();
            model
                .warnings
                .add(format!("MTL \"{name}\" is not there; {there} is taken"));
            Some(path.clone())
        }
        Found::Missing => {
            model
                .warnings
                .add(format!("MTL \"{name}\" is missing; its materials are grey"));
            None
        }
        Found::Refused(why) => {
            model
                .warnings
                .add(format!("MTL \"{name}\" {why}; its materials are grey"));
            None
        }
    }
}

fn read_library(
    model: &mut Model,
    path: &Path,
    budget: &Budget,
    known: &mut HashMap<String, Known>,
) {
    let bytes = match files::read(path, budget) {
        Ok(bytes) => bytes,
        Err(error) => {
            model
                .warnings
                .add(format!("{error}; its materials are grey"));
            return;
        }
    };
    if let Err(problem) = budget.take(text_bytes::of_mtl(&bytes)) {
        let path = path.display();
        model
            .warnings
            .add(format!("{path}: {problem}; its materials are grey"));
        return;
    }
    model.files.push(path.to_owned());
    let file = path.file_name().unwrap_or_default().to_string_lossy();
    let folder = folder_of(path);
    for mtl in mtl::read(&plain(&bytes), &file, &mut model.warnings) {
        let (name, shown) = (mtl.name.clone(), shown(mtl.name.as_bytes()));
        let folder = folder.clone();
        match known.entry(name) {
            // As in Blender.
            Entry::Occupied(_) => model.warnings.add(format!(
                "{file}: material \"{shown}\" was there before; the earlier one counts"
            )),
            Entry::Vacant(place) => drop(place.insert(Known { mtl, folder })),
        }
    }
}
