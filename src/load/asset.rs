//! What a file holds, before a choice of camera and time makes a scene of it.

use super::viewpoint::{self, Choices, Viewpoint};
use super::{Model, Warnings};
use crate::Error;
use crate::camera::Camera;
use crate::color::Rgb;
use crate::geometry::{Plane, Sphere};
use crate::light::Light;
use crate::material::Material;
use crate::scene::{Instance, Object, Scene, SceneDescription};
use crate::shade::Shading;
use glam::{DAffine3, Vec3};
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
    /// The scene that a viewpoint sees, `time` seconds into the asset's animation, and what was chosen where neither
    /// the file nor the user said. Animation is not read yet, so every time shows the same.
    ///
    /// # Errors
    ///
    /// There is no camera of the wanted name, or what the file says makes no scene.
    pub fn scene(&self, time: f64, viewpoint: &Viewpoint) -> Result<(Scene, Choices), Error> {
        self.clone().take_scene(time, viewpoint)
    }

    /// The same without a copy: meshes and textures go into the scene. What else is known of the file stays here.
    ///
    /// # Errors
    ///
    /// Those of [`Asset::scene`].
    pub fn take_scene(
        &mut self,
        _time: f64,
        viewpoint: &Viewpoint,
    ) -> Result<(Scene, Choices), Error> {
        let mut choices = Choices::default();
        let placeholder = Camera::looking_at(Vec3::Z, Vec3::ZERO, Vec3::Y, 1.0);
        let mut description = SceneDescription {
            materials: self.materials.clone(),
            spheres: self.spheres.clone(),
            planes: self.planes.clone(),
            lights: self.lights.clone(),
            ..SceneDescription::empty(placeholder)
        };
        self.models
            .iter_mut()
            .for_each(|placed| placed.move_into(&mut description));
        description.camera = viewpoint::camera(self, viewpoint, &description, &mut choices)?;
        viewpoint::light(self, viewpoint, &mut description, &mut choices);
        description.background = viewpoint::background(self, viewpoint, &mut choices);
        let in_file = |problem| Error::Scene {
            file: self.file.clone(),
            problem,
        };
        let scene = Scene::new(description).map_err(in_file)?;
        Ok((scene, choices))
    }

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

impl PlacedModel {
    /// Adds what the model's nodes place; its meshes and textures are gone from it then.
    fn move_into(&mut self, scene: &mut SceneDescription) {
        let model = &mut self.model;
        let [first_material, first_texture, first_mesh] = [
            scene.materials.len(),
            scene.textures.len(),
            scene.meshes.len(),
        ]
        .map(|length| length as u32);
        scene.textures.append(&mut model.textures);
        scene.meshes.append(&mut model.meshes);
        let model = &self.model;
        scene
            .materials
            .extend(model.materials.iter().map(|material| {
                let mut material = material.clone();
                material
                    .textures_mut()
                    .for_each(|used| used.texture += first_texture);
                material
            }));
        for (node, to_model) in model.placed_nodes() {
            let to_world = self.to_world * to_model;
            if let Some(light) = node.light.and_then(|light| model.lights.get(light)) {
                let name = if light.name.is_empty() {
                    &node.name
                } else {
                    &light.name
                };
                let carried = viewpoint::carried(light, &to_world);
                scene.lights.push(Light {
                    name: name.clone(),
                    ..carried
                });
            }
            let parts = node
                .shape
                .and_then(|shape| model.shapes.get(shape))
                .map_or(&[][..], |shape| &shape.parts);
            for to_world in node.places(to_world) {
                scene.instances.extend(parts.iter().map(|part| Instance {
                    name: node.name.clone(),
                    mesh: first_mesh + part.mesh,
                    material: self.material.unwrap_or(first_material + part.material),
                    to_world,
                }));
            }
        }
    }
}
