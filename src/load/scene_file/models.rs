//! `[[model]]`.

use super::kind::{POINT, ROTATION, SCALE, TEXT};
use super::materials::{Materials, Wearer};
use super::source::one_line;
use super::table::{Schema, Table};
use crate::Error;
use crate::load::{Budget, Model, PlacedModel, Warnings, budget, files};
use glam::{DAffine3, DQuat, DVec3};
use std::collections::BTreeMap;
use std::path::{Path, PathBuf};

const MODEL: Schema = Schema {
    key: "model",
    label: "[[model]]",
    keys: &["path", "translation", "rotation", "scale", "material"],
};

/// The models of a scene file, and what came of reading them.
#[derive(Default)]
pub(super) struct Models {
    /// In the file's order.
    pub(super) placed: Vec<PlacedModel>,
    /// Each after the path of its model.
    pub(super) warnings: Warnings,
    /// Every file that was read.
    pub(super) files: Vec<PathBuf>,
}

impl Models {
    /// Reads every model once, however often it is placed. `open` answers `None` to a name that is not a model's.
    pub(super) fn open(
        root: &Table<'_>,
        materials: &Materials,
        scene_file: &Path,
        budget: &Budget,
        mut open: impl FnMut(&Path) -> Option<Result<Model, Error>>,
    ) -> Result<Models, Error> {
        let mut models = Models::default();
        let mut place_of: BTreeMap<PathBuf, usize> = BTreeMap::new();
        for table in root.tables(&MODEL)? {
            let reference = table.required("path", &TEXT)?;
            let to_world = to_world(&table)?;
            let material = materials.optional(&table, Wearer::Other)?;
            let path = files::beside(scene_file, Path::new(&reference));
            let known = place_of
                .get(&path)
                .and_then(|&place| models.placed.get(place));
            let model = match known {
                Some(known) => {
                    let copy = budget::bytes_of_model(&known.model);
                    budget.take(copy).map_err(|problem| {
                        table.error("path", format!("to place it once more {problem}"))
                    })?;
                    known.model.clone()
                }
                None => {
                    let model = open(&path).ok_or_else(|| {
                        table.wrong("path", "a name that ends in .gltf, .glb or .obj")
                    })??;
                    models.note(&reference, &model);
                    place_of.insert(path, models.placed.len());
                    model
                }
            };
            models.placed.push(PlacedModel {
                model,
                to_world,
                material,
            });
        }
        Ok(models)
    }

    /// What every camera of the models is called: its own name and its node's.
    pub(super) fn camera_names(&self) -> Vec<&str> {
        let mut names = Vec::new();
        for PlacedModel { model, .. } in &self.placed {
            for (node, _) in model.placed_nodes() {
                let camera = node.camera.and_then(|camera| model.cameras.get(camera));
                if let Some(camera) = camera {
                    let of_both = [camera.name.as_str(), node.name.as_str()];
                    names.extend(of_both.into_iter().filter(|name| !name.is_empty()));
                }
            }
        }
        names
    }

    fn note(&mut self, reference: &str, model: &Model) {
        for warning in model.warnings.iter() {
            let message = format!("{}: {}", one_line(reference), warning.message);
            self.warnings.add_times(message, warning.count);
        }
        self.files.extend(model.files.iter().cloned());
    }
}

fn to_world(table: &Table<'_>) -> Result<DAffine3, Error> {
    let translation = table.or("translation", &POINT, DVec3::ZERO)?;
    let rotation = table.or("rotation", &ROTATION, DQuat::IDENTITY)?;
    let scale = table.or("scale", &SCALE, DVec3::ONE)?;
    Ok(DAffine3::from_scale_rotation_translation(
        scale,
        rotation,
        translation,
    ))
}
