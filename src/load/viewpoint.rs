//! How an asset is to be looked at, and what was chosen where neither the file nor the user said.

mod cameras;
mod environment;
mod faces;
mod ground;
mod lights;

pub use cameras::PlacedCamera;
pub(super) use cameras::{cameras, chosen, fitted};
pub(super) use environment::environment;
pub(super) use faces::bytes_of_faces;
use faces::faces;
pub(super) use ground::ground;
pub(super) use lights::{carried, light};

use super::Asset;
use super::environment::EnvironmentChoice;
use crate::camera::Camera;
use crate::color::Rgb;
use crate::environment::Surroundings;
use crate::framing::View;
use crate::geometry::Bounds;
use crate::scene::{Background, Shown};
use glam::DVec3;
use std::path::PathBuf;
use std::sync::Arc;

/// How an asset is to be looked at.
#[derive(Clone, Debug)]
pub struct Viewpoint {
    /// The picture's width over its height, for framing.
    pub aspect: f64,
    /// From where.
    pub camera: CameraChoice,
    /// The vertical field of view in radians, instead of the camera's own; a framed view is fitted to it.
    pub fov_y: Option<f64>,
    /// The background; the file's, or a default, where it is `None`.
    pub background: Option<Background>,
    /// Stops by which a display will change the picture; what suits the file's lights where it is `None`.
    pub exposure: Option<f32>,
    /// What lights it beside its own lights.
    pub environment: Surrounding,
    /// Whose lights shine; where it is `None` both, the environment being a fill beside lights of the file's own.
    pub lights: Option<LightsChoice>,
    /// Whether a model stands on a floor that shows its shadow.
    pub ground: GroundChoice,
    /// The share of light that this floor mirrors, 0..1.
    pub ground_reflectivity: f32,
    /// What was found at another moment and is to stay, for pictures that follow each other; cameras of files move on.
    pub stage: Option<Stage>,
}

/// What is fitted to an asset at one moment, and made ready for it: a framed camera, the floor, the lamp of a room, the
/// environment.
#[derive(Clone, Debug)]
pub struct Stage {
    framed: Framed,
    environment: Option<Arc<Surroundings>>,
}

impl Stage {
    pub(in crate::load) fn of(framed: Framed, environment: Option<Arc<Surroundings>>) -> Stage {
        Stage {
            framed,
            environment,
        }
    }

    /// The camera.
    pub fn camera(&self) -> Camera {
        self.framed.camera
    }

    /// A point of the vertical axis that a turntable has: through the middle of what is seen; in a room, the eye.
    pub fn pivot(&self) -> DVec3 {
        self.framed.pivot
    }
}

impl Viewpoint {
    /// As the file says, framed and lit where it does not, for a picture of this width over height.
    pub fn of_file(aspect: f64) -> Viewpoint {
        Viewpoint {
            aspect,
            camera: CameraChoice::OfFile,
            fov_y: None,
            background: None,
            exposure: None,
            environment: Surrounding::Asked(EnvironmentChoice::default()),
            lights: None,
            ground: GroundChoice::Auto,
            ground_reflectivity: 0.0,
            stage: None,
        }
    }
}

/// The light from all around an asset.
#[derive(Clone, Debug)]
pub enum Surrounding {
    /// What is said of it; the file where that is silent; a studio about a model where both are.
    Asked(EnvironmentChoice),
    /// This one, made ready before.
    Ready(Option<Arc<Surroundings>>),
}

/// Whose lights shine on a model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum LightsChoice {
    /// The file's alone, and no environment.
    File,
    /// Those that luch gives to models without lights.
    Default,
    /// Both, in full.
    Both,
}

/// Whether a model stands on a floor that shows its shadow.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum GroundChoice {
    /// Where it is seen from above and from outside.
    #[default]
    Auto,
    /// Yes.
    On,
    /// No.
    Off,
}

/// A camera, and what is known of the place that it looks at.
#[derive(Clone, Debug)]
pub(in crate::load) struct Framed {
    /// The camera itself.
    pub(in crate::load) camera: Camera,
    /// The box around what it was fitted to, or around everything.
    pub(in crate::load) bounds: Bounds,
    /// Whether it stands in a room, or under a sky that is a thing.
    pub(in crate::load) is_enclosed: bool,
    /// What a camera can go around.
    pub(in crate::load) pivot: DVec3,
}

/// From where an asset is to be looked at.
#[derive(Clone, Debug, PartialEq)]
pub enum CameraChoice {
    /// As the file says; framed where it does not.
    OfFile,
    /// The model's camera of this name or, if none has it and it is a number, of this index.
    Named(String),
    /// This one.
    Given(Camera),
    /// Framed like this, whatever cameras the file has.
    Framed(View),
}

/// What was chosen where neither the file nor the user said.
#[derive(Clone, Debug, Default)]
pub struct Choices {
    /// A line each, for the user.
    pub lines: Vec<String>,
    /// Stops by which a display should change the picture: those asked for or, where a model has lights of its own, in
    /// candela or lux, those with which they neither wash the picture out nor leave it dark.
    pub exposure: f32,
    /// What was fitted to the asset, or kept.
    pub stage: Option<Stage>,
    /// The files that were read for it, beside the asset's own.
    pub files: Vec<PathBuf>,
}

/// What lies behind models on a display, in sRGB .87 at the bottom and .70 at the top: dark things stand out from it, and
/// white ones, and shadows.
const MODEL_BACKGROUND: [Rgb; 2] = [Rgb::grey(0.73), Rgb::grey(0.45)];

/// The background that the user, the file or the default gives.
pub(super) fn background(
    asset: &Asset,
    viewpoint: &Viewpoint,
    choices: &mut Choices,
) -> Background {
    match (viewpoint.background, asset.background) {
        // Mirrors go on to see what they would have seen.
        (Some(asked), color) if asked.shown == Shown::Never => Background {
            shown: Shown::Never,
            ..color.map_or(default_background(asset, choices.exposure), |color| {
                Background::plain(color, Shown::Never)
            })
        },
        (Some(asked), _) => asked,
        (None, Some(color)) => Background::plain(color, Shown::Always),
        (None, None) => {
            if !asset.is_scene_file {
                choices
                    .lines
                    .push("background: light grey (an EXR is transparent there)".into());
            }
            default_background(asset, choices.exposure)
        }
    }
}

/// Black behind what a person composed; behind models greys that the exposure does not change.
fn default_background(asset: &Asset, exposure: f32) -> Background {
    if asset.is_scene_file {
        return Background::default();
    }
    let [bottom, top] = MODEL_BACKGROUND.map(|grey| grey * libm::exp2f(-exposure));
    Background {
        color: bottom,
        top: Some(top),
        shown: Shown::OnDisplay,
    }
}
