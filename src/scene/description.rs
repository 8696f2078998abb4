//! What a scene is made of.

use super::Ground;
use crate::camera::Camera;
use crate::color::Rgb;
use crate::environment::Surroundings;
use crate::geometry::{Plane, Sphere};
use crate::light::Light;
use crate::material::Material;
use crate::mesh::Mesh;
use crate::texture::Texture;
use glam::DAffine3;
use std::sync::Arc;

/// What a scene is made of, before anything is checked.
#[derive(Clone, Debug)]
pub struct SceneDescription {
    /// Where the picture is taken from.
    pub camera: Camera,
    /// What a ray that misses everything sees.
    pub background: Background,
    /// Constant light from everywhere.
    pub ambient: Rgb,
    /// Light from everywhere that is not constant, and what mirrors see past everything.
    pub environment: Option<Arc<Surroundings>>,
    /// A floor that shows shadows.
    pub ground: Option<Ground>,
    /// Named by index.
    pub materials: Vec<Material>,
    /// Named by index.
    pub textures: Vec<Texture>,
    /// In the order in which their light is added.
    pub lights: Vec<Light>,
    /// Analytic spheres, world space.
    pub spheres: Vec<Object<Sphere>>,
    /// Analytic planes, world space.
    pub planes: Vec<Object<Plane>>,
    /// Named by index; one that no instance names is not seen.
    pub meshes: Vec<Mesh>,
    /// Where the meshes stand.
    pub instances: Vec<Instance>,
}

impl SceneDescription {
    /// Nothing but a camera, before black.
    pub fn empty(camera: Camera) -> SceneDescription {
        SceneDescription {
            camera,
            background: Background::default(),
            ambient: Rgb::BLACK,
            environment: None,
            ground: None,
            materials: Vec::new(),
            textures: Vec::new(),
            lights: Vec::new(),
            spheres: Vec::new(),
            planes: Vec::new(),
            meshes: Vec::new(),
            instances: Vec::new(),
        }
    }
}

/// An analytic shape of some material.
#[derive(Clone, Debug, PartialEq)]
pub struct Object<S> {
    /// As in the file, for layers and messages; may be empty.
    pub name: String,
    /// The shape.
    pub shape: S,
    /// An index into the scene's materials.
    pub material: u32,
}

/// A mesh somewhere in the world. Many may share one.
#[derive(Clone, Debug, PartialEq)]
pub struct Instance {
    /// As in the file, for layers and messages; may be empty.
    pub name: String,
    /// An index into the scene's meshes.
    pub mesh: u32,
    /// An index into the scene's materials.
    pub material: u32,
    /// From the mesh's space to the world's.
    pub to_world: DAffine3,
}

/// What a ray that misses everything sees.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Background {
    /// Seen by mirror rays always, unless there is an environment; by camera rays as `shown` says.
    pub color: Rgb,
    /// On a display, the colour at the top of the picture, where it is not the same all over: `color` is then the one at
    /// its bottom.
    pub top: Option<Rgb>,
    /// Which pictures have it behind everything.
    pub shown: Shown,
}

impl Background {
    /// The same colour all over.
    pub const fn plain(color: Rgb, shown: Shown) -> Background {
        Background {
            color,
            top: None,
            shown,
        }
    }
}

/// Which pictures have the background behind everything.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Shown {
    /// All: it is part of the picture, alpha is 1.
    Always,
    /// Those made for a display; an EXR, made for compositing, is transparent there. For a background that nobody
    /// asked for.
    #[default]
    OnDisplay,
    /// None: every picture is transparent there.
    Never,
    /// All, and it is the environment itself that one sees: alpha is 1.
    Environment,
}
