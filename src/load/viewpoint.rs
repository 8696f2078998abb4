//! How an asset is to be looked at, and what was chosen where neither the file nor the user said.

mod cameras;
mod faces;
mod lights;

pub use cameras::PlacedCamera;
pub(super) use cameras::{camera, cameras};
pub(super) use faces::bytes_of_faces;
use faces::faces;
pub(super) use lights::{carried, light};

use super::Asset;
use super::environment::EnvironmentChoice;
use crate::camera::Camera;
use crate::color::Rgb;
use crate::scene::{Background, Shown};

/// How an asset is to be looked at.
#[derive(Clone, Debug)]
pub struct Viewpoint {
    /// The picture's width over its height, for framing.
    pub aspect: f64,
    /// From where.
    pub camera: CameraChoice,
    /// The vertical field of view in radians, instead of the camera's own.
    pub fov_y: Option<f64>,
    /// The background; the file's, or a default, where it is `None`.
    pub background: Option<Background>,
    /// Stops by which a display will change the picture; what suits the file's lights where it is `None`.
    pub exposure: Option<f32>,
    /// The light from all around; what the file says of it where this is silent.
    pub environment: EnvironmentChoice,
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
            environment: EnvironmentChoice::default(),
        }
    }
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
}

/// What was chosen where neither the file nor the user said.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Choices {
    /// A line each, for the user.
    pub lines: Vec<String>,
    /// Stops by which a display should change the picture: those asked for or, where a model has lights of its own, in
    /// candela or lux, those with which they neither wash the picture out nor leave it dark.
    pub exposure: f32,
}

/// The grey behind models on a display, linear.
const MODEL_BACKGROUND: Rgb = Rgb::grey(0.2);

/// The background that the user, the file or the default gives.
pub(super) fn background(
    asset: &Asset,
    viewpoint: &Viewpoint,
    choices: &mut Choices,
) -> Background {
    match (viewpoint.background, asset.background) {
        // Mirrors go on to see what they would have seen.
        (
            Some(Background {
                shown: Shown::Never,
                ..
            }),
            color,
        ) => Background {
            color: color.unwrap_or(default_background(asset, choices.exposure)),
            shown: Shown::Never,
        },
        (Some(asked), _) => asked,
        (None, Some(color)) => Background {
            color,
            shown: Shown::Always,
        },
        (None, None) => {
            if !asset.is_scene_file {
                choices
                    .lines
                    .push("background: neutral grey (an EXR is transparent there)".into());
            }
            Background {
                color: default_background(asset, choices.exposure),
                shown: Shown::OnDisplay,
            }
        }
    }
}

/// Black behind what a person composed; behind models a grey that the exposure does not change.
fn default_background(asset: &Asset, exposure: f32) -> Rgb {
    if asset.is_scene_file {
        Rgb::BLACK
    } else {
        MODEL_BACKGROUND * libm::exp2f(-exposure)
    }
}
