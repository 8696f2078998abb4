//! What a file holds, before a choice of camera and time makes a scene of it.

mod placing;

use super::environment::EnvironmentChoice;
use super::names;
use super::pose::Pose;
use super::viewpoint::{self, Choices, PlacedCamera, Stage, Viewpoint};
use super::{Budget, Model, Warnings};
use crate::Error;
use crate::camera::Camera;
use crate::color::Rgb;
use crate::error::OutOfMemory;
use crate::geometry::{Plane, Sphere};
use crate::light::Light;
use crate::material::Material;
use crate::mesh::Mesh;
use crate::sampling::{Filter, Pattern};
use crate::scene::{Object, Scene, SceneDescription};
use crate::shade::Shading;
use crate::texture::TextureFilter;
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
    /// What the file says of the light from all around.
    pub environment: EnvironmentChoice,
    /// What the file says of the picture.
    pub picture: PictureDefaults,
    /// What was ignored or mended, those of the models included.
    pub warnings: Warnings,
    /// Every file that was read, the asset's own first.
    pub files: Vec<PathBuf>,
    /// What reading may take, and what it took.
    pub budget: Budget,
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
    /// A pixel.
    pub samples: Option<u32>,
    /// How they lie.
    pub pattern: Option<Pattern>,
    /// How they become a colour.
    pub filter: Option<Filter>,
    /// Whether pixels get so many only where they differ.
    pub adaptive: Option<bool>,
    /// Mirror bounces.
    pub max_depth: Option<u32>,
    /// The shading model.
    pub shading: Option<Shading>,
    /// Which part of a texture a ray shows.
    pub texture_filter: Option<TextureFilter>,
}

impl Asset {
    /// The scene that a viewpoint sees, `time` seconds into the animations that it was opened with, and what was chosen
    /// where neither the file nor the user said. Before an animation's first key and after its last, it stands still.
    ///
    /// # Errors
    ///
    /// There is no camera of the wanted name, or what the file says makes no scene.
    pub fn scene(&self, time: f64, viewpoint: &Viewpoint) -> Result<(Scene, Choices), Error> {
        let copy = |placed: &PlacedModel| placed.model.meshes.iter().map(Mesh::bytes).sum::<u64>();
        let copies = self.models.iter().map(copy).sum();
        let short = |problem: OutOfMemory| problem.of(&self.file, "the scene");
        self.budget.check(copies).map_err(short)?;
        let mut described = self.described(time);
        for (placed, places) in self.models.iter().zip(&described.places) {
            let meshes = placed.model.meshes.iter().cloned();
            fill(&mut described.scene.meshes, places, meshes);
        }
        self.seen(described, viewpoint)
    }

    /// The same without a copy: the meshes that are shown as they are go into the scene, and the asset makes no other. What
    /// else is known of the file stays here.
    ///
    /// # Errors
    ///
    /// Those of [`Asset::scene`].
    pub fn take_scene(
        &mut self,
        time: f64,
        viewpoint: &Viewpoint,
    ) -> Result<(Scene, Choices), Error> {
        let mut described = self.described(time);
        for (placed, places) in self.models.iter_mut().zip(&described.places) {
            let meshes = placed.model.meshes.iter_mut().map(std::mem::take);
            fill(&mut described.scene.meshes, places, meshes);
        }
        self.seen(described, viewpoint)
    }

    /// What stands where at a time; the meshes that models show as they are lack.
    fn described(&self, time: f64) -> Described {
        let placeholder = Camera::looking_at(Vec3::Z, Vec3::ZERO, Vec3::Y, 1.0);
        let mut scene = SceneDescription {
            materials: self.materials.clone(),
            spheres: self.spheres.clone(),
            planes: self.planes.clone(),
            lights: self.lights.clone(),
            ..SceneDescription::empty(placeholder)
        };
        let mut choices = Choices::default();
        let poses = self.poses(time);
        let places = poses
            .iter()
            .zip(names::of_models(self))
            .map(|((placed, pose), names)| placed.add_to(pose, names, &mut scene, &mut choices))
            .collect();
        Described {
            scene,
            places,
            cameras: viewpoint::cameras(&poses).collect(),
            choices,
        }
    }

    /// The scene of what stands there, with a camera, lights and a background.
    fn seen(&self, described: Described, viewpoint: &Viewpoint) -> Result<(Scene, Choices), Error> {
        let Described {
            mut scene,
            cameras,
            mut choices,
            ..
        } = described;
        let looked_at = self.budget.check(viewpoint::bytes_of_faces(&scene));
        looked_at.map_err(|problem| problem.of(&self.file, "the scene"))?;
        let chosen = viewpoint::chosen(self, &cameras, viewpoint)?;
        let framed = viewpoint::fitted(viewpoint, &chosen, &scene, &mut choices);
        scene.camera = chosen.camera().unwrap_or(framed.camera);
        let environment = viewpoint::environment(self, viewpoint, &mut choices)?;
        viewpoint::light(
            self,
            viewpoint,
            environment.clone(),
            &framed,
            &mut scene,
            &mut choices,
        );
        scene.ground = viewpoint::ground(self, viewpoint, &framed);
        scene.background = viewpoint::background(self, viewpoint, &mut choices);
        choices.stage = Some(Stage::of(framed, environment));
        let in_file = |problem| Error::Scene {
            file: self.file.clone(),
            problem,
        };
        let scene = Scene::new_within(scene, self.budget.left()).map_err(in_file)?;
        Ok((scene, choices))
    }

    /// The cameras of its models as they stand at the beginning, in the order in which a user may ask for them by index.
    pub fn cameras(&self) -> Vec<PlacedCamera> {
        viewpoint::cameras(&self.poses(0.0)).collect()
    }

    /// Whether the animations that it was opened with move anything.
    pub fn moves(&self) -> bool {
        let moves = |placed: &PlacedModel| !placed.model.motion.tracks.is_empty();
        self.models.iter().any(moves)
    }

    /// The camera at a `time` at which all else is as it was at the time `before`; `None` where something is not.
    ///
    /// # Errors
    ///
    /// There is no camera of the wanted name.
    pub fn camera_of_the_same_scene(
        &self,
        before: f64,
        time: f64,
        viewpoint: &Viewpoint,
    ) -> Result<Option<Camera>, Error> {
        let (then, now) = (self.poses(before), self.poses(time));
        let mut pairs = then.iter().zip(&now);
        if !pairs.all(|((_, then), (_, now))| then.shows_the_same(now)) {
            return Ok(None);
        }
        let cameras: Vec<PlacedCamera> = viewpoint::cameras(&now).collect();
        let chosen = viewpoint::chosen(self, &cameras, viewpoint)?;
        let staged = || viewpoint.stage.as_ref().map(Stage::camera);
        Ok(chosen.camera().or_else(staged))
    }

    /// Each model, and its pose at a time.
    pub(super) fn poses(&self, time: f64) -> Vec<(&PlacedModel, Pose<'_>)> {
        let models = self.models.iter();
        models
            .map(|placed| (placed, Pose::at(&placed.model, time)))
            .collect()
    }

    /// Finds whether a film of `bytes` fits into what the asset and its scene leave.
    ///
    /// # Errors
    ///
    /// It does not.
    pub fn check_film(&self, scene: &Scene, bytes: u64) -> Result<(), Error> {
        let fits = self.budget.check(scene.bytes().saturating_add(bytes));
        fits.map_err(|problem| problem.of(&self.file, "the scene with its picture"))
    }

    /// A model by itself, at its own place.
    pub(super) fn of_model(model: Model, budget: Budget) -> Asset {
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
            environment: EnvironmentChoice::default(),
            picture: PictureDefaults::default(),
            budget,
        }
    }
}

impl From<Model> for Asset {
    /// A model by itself, at its own place, with as much memory as luch takes where nobody says how much.
    fn from(model: Model) -> Asset {
        Asset::of_model(model, Budget::default())
    }
}

/// What stands where at a moment.
struct Described {
    scene: SceneDescription,
    /// Of each mesh of each model, which of the scene's it is to be, if it is shown as it is.
    places: Vec<Vec<Option<u32>>>,
    cameras: Vec<PlacedCamera>,
    choices: Choices,
}

/// Puts meshes where they lack.
fn fill(scene: &mut [Mesh], places: &[Option<u32>], meshes: impl Iterator<Item = Mesh>) {
    for (mesh, place) in meshes.zip(places) {
        if let Some(place) = place.and_then(|place| scene.get_mut(place as usize)) {
            *place = mesh;
        }
    }
}
