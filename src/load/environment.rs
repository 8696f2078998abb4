//! Which light comes from all around: what a user or a scene file says of it, and that made ready.

mod file;

use super::{Budget, Warnings};
use crate::Error;
use crate::color::Rgb;
use crate::environment::{self, Environment, Surroundings};
use glam::Vec3;
use std::path::PathBuf;
use std::sync::Arc;

/// How many lights an environment is cut into where nobody says.
const LIGHTS: u32 = 64;

/// What is said of the light from all around. Nobody need say any of it.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct EnvironmentChoice {
    /// What sends it.
    pub light: Option<EnvironmentLight>,
    /// How far it is turned about +Y, radians: a quarter turns what was at +Z to +X. 0 where nobody says.
    pub rotation: Option<f32>,
    /// What multiplies it. 1 where nobody says.
    pub intensity: Option<f32>,
    /// How many lights it is cut into for shadows, 1 to [`environment::MAX_LIGHTS`]. 64 where nobody says.
    pub lights: Option<u32>,
}

/// What sends light from all around.
#[derive(Clone, Debug, PartialEq)]
pub enum EnvironmentLight {
    /// Nothing.
    None,
    /// [`environment::studio`].
    Studio,
    /// [`environment::sky`].
    Sky {
        /// Unit, toward the sun.
        sun: Vec3,
    },
    /// The same from everywhere, in the paper's units.
    Color(Rgb),
    /// The picture in a `.hdr` or `.exr` file.
    File(PathBuf),
}

/// The direction toward a sun at `azimuth`, from +Z toward +X, and `elevation` above the horizon, both in degrees.
pub fn sun(azimuth: f64, elevation: f64) -> Vec3 {
    let (azimuth, elevation) = (azimuth.to_radians(), elevation.to_radians());
    let level = libm::cos(elevation);
    let [x, y, z] = [
        libm::sin(azimuth) * level,
        libm::sin(elevation),
        libm::cos(azimuth) * level,
    ];
    Vec3::new(x as f32, y as f32, z as f32)
}

impl EnvironmentLight {
    /// A sky with its sun where nobody says: at the left of the viewer of a framed model, half up.
    pub fn sky() -> EnvironmentLight {
        EnvironmentLight::Sky {
            sun: sun(-15.0, 45.0),
        }
    }
}

impl EnvironmentChoice {
    /// What lights models where nobody says: a studio.
    pub fn of_models() -> EnvironmentChoice {
        EnvironmentChoice {
            light: Some(EnvironmentLight::Studio),
            ..EnvironmentChoice::default()
        }
    }

    /// Whether the program makes its light by itself: no file has to be read, and nothing can be wrong with it.
    pub fn is_built_in(&self) -> bool {
        use EnvironmentLight::{Color, Sky, Studio};
        matches!(self.light, Some(Studio | Sky { .. } | Color(_)))
    }

    /// What this one says and, where it is silent, what `other` does.
    pub fn or(&self, other: &EnvironmentChoice) -> EnvironmentChoice {
        EnvironmentChoice {
            light: self.light.clone().or_else(|| other.light.clone()),
            rotation: self.rotation.or(other.rotation),
            intensity: self.intensity.or(other.intensity),
            lights: self.lights.or(other.lights),
        }
    }

    /// The light made ready; `None` where there is none. A file's picture takes from the budget.
    ///
    /// # Errors
    ///
    /// A file cannot be read, is no picture of an environment, or there is not the memory for it.
    pub fn surroundings(
        &self,
        budget: &Budget,
        warnings: &mut Warnings,
    ) -> Result<Option<Arc<Surroundings>>, Error> {
        let radiance = match &self.light {
            None | Some(EnvironmentLight::None) => {
                if self.rotation.is_some() || self.intensity.is_some() || self.lights.is_some() {
                    warnings
                        .add("environment: there is none to be turned, dimmed or cut into lights");
                }
                return Ok(None);
            }
            Some(EnvironmentLight::Studio) => environment::studio(),
            Some(EnvironmentLight::Sky { sun }) => environment::sky(*sun),
            Some(EnvironmentLight::Color(color)) => environment::uniform(*color),
            Some(EnvironmentLight::File(path)) => file::open(path, budget, warnings)?,
        };
        Ok(Some(Arc::new(Surroundings::new(&Environment {
            radiance: Arc::new(radiance),
            rotation: self.rotation.unwrap_or(0.0),
            intensity: self.intensity.unwrap_or(1.0),
            lights: self.lights.unwrap_or(LIGHTS),
        }))))
    }
}
