//! What can be said of the light from all around.

use super::Failure;
use super::values::{self, whole_number};
use clap::Args;
use luch::load::{Budget, EnvironmentChoice, EnvironmentLight, Surrounding, Warnings, sun};
use std::path::Path;
use std::str::FromStr;
use std::time::{Duration, Instant};

/// The options about light from all around.
#[derive(Args, Debug)]
pub(super) struct EnvironmentArguments {
    /// What lights the scene from all around: studio, sky, none, a display colour, or an equirectangular .hdr
    /// or .exr picture
    #[arg(long, value_name = "studio|sky|none|#RRGGBB|FILE")]
    pub(super) environment: Option<EnvironmentValue>,

    /// Turns the environment about +Y: 90 turns what was at +Z to +X
    #[arg(long, value_name = "DEGREES", allow_hyphen_values = true, value_parser = values::degrees)]
    pub(super) environment_rotation: Option<f64>,

    /// Multiplies the environment's light
    #[arg(long, value_name = "FACTOR", allow_hyphen_values = true, value_parser = values::factor)]
    pub(super) environment_intensity: Option<f32>,

    /// How many lights the environment is cut into for shadows, 1 to 1024 [default: 64]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = whole_number(1..=1024))]
    pub(super) environment_lights: Option<u32>,

    /// Where the sun of --environment sky stands, in degrees: from +Z toward +X, and above the horizon [default: -15,45]
    #[arg(long, value_name = "AZIMUTH,ELEVATION", allow_hyphen_values = true, value_parser = values::azimuth_and_elevation)]
    pub(super) sun: Option<[f64; 2]>,
}

/// What `--environment` says.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct EnvironmentValue(EnvironmentLight);

impl FromStr for EnvironmentValue {
    type Err = String;

    fn from_str(text: &str) -> Result<EnvironmentValue, String> {
        let is_picture = |path: &Path| {
            let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase());
            matches!(extension.as_deref(), Some("hdr" | "exr"))
        };
        let light = match text {
            "studio" => EnvironmentLight::Studio,
            "sky" => EnvironmentLight::sky(),
            "none" => EnvironmentLight::None,
            _ => match text.strip_prefix('#').map(values::display_color) {
                Some(Some(color)) => EnvironmentLight::Color(color),
                None if is_picture(Path::new(text)) => EnvironmentLight::File(text.into()),
                _ => {
                    return Err("expected studio, sky, none, a colour of six hex digits, as in '#808080', or a .hdr or \
                        .exr file"
                        .into());
                }
            },
        };
        Ok(EnvironmentValue(light))
    }
}

impl EnvironmentArguments {
    /// What they say, made ready while the input is read, and how long that took: where neither the input can say
    /// otherwise nor another file has to be read.
    pub(super) fn beside(&self, input: &Path) -> Result<(Surrounding, Duration), Failure> {
        let start = Instant::now();
        let asked = self.choice()?;
        let of_model = asked.or(&EnvironmentChoice::of_models());
        let is_scene_file = input
            .extension()
            .is_some_and(|e| e.eq_ignore_ascii_case("toml"));
        if is_scene_file || !of_model.is_built_in() {
            return Ok((Surrounding::Asked(asked), start.elapsed()));
        }
        let ready = of_model.surroundings(&Budget::default(), &mut Warnings::default());
        let surrounding = Surrounding::Ready(ready.map_err(Failure::usage_or_scene)?);
        Ok((surrounding, start.elapsed()))
    }

    /// The picture that they name, if they name one.
    pub(super) fn file(&self) -> Option<&Path> {
        match &self.environment {
            Some(EnvironmentValue(EnvironmentLight::File(path))) => Some(path),
            _ => None,
        }
    }

    /// What they say.
    pub(super) fn choice(&self) -> Result<EnvironmentChoice, Failure> {
        let asked = self
            .environment
            .as_ref()
            .map(|EnvironmentValue(light)| light);
        let light = match (asked, self.sun) {
            (Some(EnvironmentLight::Sky { .. }), Some([azimuth, elevation])) => {
                Some(EnvironmentLight::Sky {
                    sun: sun(azimuth, elevation),
                })
            }
            (_, Some(_)) => {
                return Err(Failure::usage_or_scene(
                    "--sun is where the sun of a sky stands; use it with --environment sky",
                ));
            }
            (asked, None) => asked.cloned(),
        };
        Ok(EnvironmentChoice {
            light,
            rotation: self
                .environment_rotation
                .map(|degrees| degrees.to_radians() as f32),
            intensity: self.environment_intensity,
            lights: self.environment_lights,
        })
    }
}
