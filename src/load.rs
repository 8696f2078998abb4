//! The door in: from a file to an [`Asset`], and from an asset to a scene.

pub mod gltf;
pub mod obj;
pub mod scene_file;

mod asset;
mod budget;
mod exposure;
mod files;
mod images;
mod memory;
mod model;
mod options;
mod tangents;
mod text_bytes;
mod viewpoint;
mod warnings;

pub use asset::{Asset, CameraSource, PictureDefaults, PlacedModel};
pub use budget::{Budget, OutOfMemory};
pub use model::{
    ExtensionFacts, Facts, Model, ModelCamera, ModelMesh, Node, Part, TextureFacts, Treatment,
};
pub use options::{AnimationChoice, Options};
pub use viewpoint::{CameraChoice, Choices, Viewpoint};
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
        Some("gltf" | "glb") => gltf::open_within(path, options, &budget).map(of_model),
        Some("obj") => obj::open_within(path, options, &budget).map(of_model),
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
