//! The door in: from a file to an [`Asset`], and from an asset to a scene.

pub mod gltf;
pub mod obj;
pub mod scene_file;

mod analytic;
mod animated;
mod asset;
mod budget;
mod choice;
mod environment;
mod exposure;
mod files;
mod images;
mod memory;
mod model;
mod names;
mod options;
mod pose;
mod tangents;
mod text_bytes;
mod viewpoint;
mod warnings;

pub use analytic::{Analytic, AnalyticKind};
pub use asset::{Asset, CameraSource, PictureDefaults, PlacedModel};
pub use budget::Budget;
pub use environment::{EnvironmentChoice, EnvironmentLight, sun};
pub use model::{
    AnimationFacts, Ask, Facts, Model, ModelCamera, ModelMesh, Moved, Node, Note, Part,
    TextureFacts, Treatment,
};
pub use options::{AnimationChoice, Options};
pub use viewpoint::{
    CameraChoice, Choices, GroundChoice, LightsChoice, PlacedCamera, Surrounding, Viewpoint,
};
pub use warnings::{Warning, Warnings};

use crate::Error;
use std::path::Path;

/// Opens a model (`.gltf`, `.glb`, `.obj`) or a scene file (`.toml`), by its extension.
///
/// # Errors
///
/// The file cannot be read, is malformed, asks for what luch does not do, or has nothing to draw.
pub fn open(path: &Path, options: &Options) -> Result<Asset, Error> {
    let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase());
    let budget = Budget::of(options);
    let of_model = |model| Asset::of_model(model, budget.clone());
    match extension.as_deref() {
        Some("toml") => scene_file::open(path, options),
        Some("gltf" | "glb") => {
            let model = gltf::open_within(path, options, &budget)?;
            animated::check(of_model(model), options)
        }
        Some("obj") => {
            let model = obj::open_within(path, options, &budget)?;
            animated::check(of_model(model), options)
        }
        _ => {
            files::check(path)?;
            Err(Error::Unsupported {
                file: path.to_owned(),
                what: "its name does not end in .gltf, .glb, .obj or .toml".into(),
                way_out: "convert it to glTF, or rename it if it is one of these".into(),
            })
        }
    }
}
