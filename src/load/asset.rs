//! What a file holds, before a choice of camera and time makes a scene of it.

use super::{Model, Warnings};
use crate::camera::Camera;
use crate::color::Rgb;
use crate::geometry::{Plane, Sphere};
use crate::light::Light;
use crate::material::Material;
use crate::scene::Object;
use crate::shade::Shading;
use glam::DAffine3;
use std::path::PathBuf;

/// Everything a file holds.
#[derive(Clone, Debug)]
pub struct Asset {
    /// Where it came from.
    pub file: PathBuf,
    /// Whether a person wrote it as a scene: such a file is taken at its word, a model gets a good first picture.
    pub is_scene_file: bool,
    /// The models, in the file's order.
    pub models: Vec<PlacedModel>,
    /// The scene file's own materials, named by index.
    pub materials: Vec<Material>,
    /// The scene file's spheres; materials index the asset's own.
    pub spheres: Vec<Object<Sphere>>,
    /// The scene file's planes; materials index the asset's own.
    pub planes: Vec<Object<Plane>>,
    /// The scene file's lights.
    pub lights: Vec<Light>,
    /// The scene file's camera.
    pub camera: Option<CameraSource>,
    /// The background, where the file asks for one.
    pub background: Option<Rgb>,
    /// The ambient light, where the file says it.
    pub ambient: Option<Rgb>,
    /// What the file says of the picture.
    pub picture: PictureDefaults,
    /// What was ignored or mended, those of the models included.
    pub warnings: Warnings,
    /// Every file that was read, the asset's own first.
    pub files: Vec<PathBuf>,
}

/// A model somewhere in an asset's world.
#[derive(Clone, Debug)]
pub struct PlacedModel {
    /// The model itself.
    pub model: Model,
    /// Where it stands.
    pub to_world: DAffine3,
    /// An index into the asset's materials, for all of it instead of its own.
    pub material: Option<u32>,
}

/// Which camera a scene file asks for.
#[derive(Clone, Debug, PartialEq)]
pub enum CameraSource {
    /// This one.
    Given(Camera),
    /// One of a model's, by name.
    OfModel(String),
}

/// What a file says of the picture; the command line may say otherwise.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct PictureDefaults {
    /// In pixels.
    pub width: Option<u32>,
    /// In pixels.
    pub height: Option<u32>,
    /// A pixel, a square number.
    pub samples: Option<u32>,
    /// Mirror bounces.
    pub max_depth: Option<u32>,
    /// The shading model.
    pub shading: Option<Shading>,
}

impl Asset {
    /// A model by itself, at its own place.
    pub(super) fn of_model(model: Model) -> Asset {
        Asset {
            file: model.file.clone(),
            is_scene_file: false,
            warnings: model.warnings.clone(),
            files: model.files.clone(),
            models: vec![PlacedModel {
                model,
                to_world: DAffine3::IDENTITY,
                material: None,
            }],
            materials: Vec::new(),
            spheres: Vec::new(),
            planes: Vec::new(),
            lights: Vec::new(),
            camera: None,
            background: None,
            ambient: None,
            picture: PictureDefaults::default(),
        }
    }
}
