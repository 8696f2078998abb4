//! What a scene file says itself, beside the models it places.

use super::{Line, listed};
use luch::load::{Asset, CameraSource};
use serde::Serialize;

/// What a scene file says itself. Names are empty strings where it gives none.
#[derive(Serialize)]
pub(super) struct SceneFileInfo {
    materials: Vec<String>,
    spheres: usize,
    planes: usize,
    lights: Vec<String>,
    /// As in `its own`.
    camera: String,
}

impl SceneFileInfo {
    pub(super) fn of(asset: &Asset) -> SceneFileInfo {
        let camera = match &asset.camera {
            Some(CameraSource::Given(_)) => "its own".into(),
            Some(CameraSource::OfModel(name)) => format!("\"{name}\" of a model"),
            None => "of a model, or framed".into(),
        };
        SceneFileInfo {
            materials: asset.materials.iter().map(|m| m.name.clone()).collect(),
            spheres: asset.spheres.len(),
            planes: asset.planes.len(),
            lights: asset.lights.iter().map(|l| l.name.clone()).collect(),
            camera,
        }
    }

    pub(super) fn in_words(&self) -> [Line; 6] {
        [
            ("format", "scene file".into()),
            ("materials", listed(&self.materials)),
            ("spheres", self.spheres.to_string()),
            ("planes", self.planes.to_string()),
            ("lights", listed(&self.lights)),
            ("camera", self.camera.clone()),
        ]
    }
}
