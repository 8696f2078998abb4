//! The light from all around an asset.

use super::{Choices, Surrounding, Viewpoint};
use crate::Error;
use crate::environment::Surroundings;
use crate::load::environment::{EnvironmentChoice, EnvironmentLight};
use crate::load::{Asset, Warnings};
use std::sync::Arc;

/// The environment that the viewpoint, the file or the default gives.
pub(in crate::load) fn environment(
    asset: &Asset,
    viewpoint: &Viewpoint,
    choices: &mut Choices,
) -> Result<Option<Arc<Surroundings>>, Error> {
    if let Some(stage) = &viewpoint.stage {
        return Ok(stage.environment.clone());
    }
    let asked = match &viewpoint.environment {
        Surrounding::Ready(environment) => return Ok(environment.clone()),
        Surrounding::Asked(choice) => choice.or(&asset.environment),
    };
    let choice = if asset.is_scene_file {
        asked
    } else {
        asked.or(&EnvironmentChoice::of_models())
    };
    if let Some(EnvironmentLight::File(path)) = &choice.light {
        choices.files.push(path.clone());
    }
    let mut warnings = Warnings::default();
    let environment = choice.surroundings(&asset.budget, &mut warnings)?;
    let lines = warnings.iter().map(ToString::to_string);
    choices.lines.extend(lines);
    Ok(environment)
}
