//! Light for a model: its own lights, an environment, or both; and the exposure that suits them.

use super::{Choices, Framed, LightsChoice, Viewpoint, faces};
use crate::color::Rgb;
use crate::environment::Surroundings;
use crate::light::{Falloff, Light, LightKind};
use crate::load::{Asset, exposure};
use crate::scene::SceneDescription;
use glam::{DAffine3, DVec3};
use std::sync::Arc;

/// What is left of the environment beside lights of the file's own: enough that metal mirrors something and no shadow is
/// black, too little to wash them out.
const FILL: f32 = 0.25;
/// Constant light in a room, into which hardly any comes from outside.
const INDOORS_AMBIENT: Rgb = Rgb::grey(0.35);
/// How bright the lamp of a room without lights is, where it falls straight.
const LAMP: f32 = 0.7;

/// Lights a scene: with the file's lights, with `environment`, or with both, and finds the exposure.
pub(in crate::load) fn light(
    asset: &Asset,
    viewpoint: &Viewpoint,
    environment: Option<Arc<Surroundings>>,
    framed: &Framed,
    scene: &mut SceneDescription,
    choices: &mut Choices,
) {
    scene.ambient = asset.ambient.unwrap_or(Rgb::BLACK);
    choices.exposure = viewpoint.exposure.unwrap_or(0.0);
    let of_file = scene.lights.len();
    let lights = viewpoint.lights.unwrap_or(LightsChoice::Both);
    if lights == LightsChoice::Default {
        scene.lights.clear();
    }
    if lights != LightsChoice::File {
        scene.environment = environment;
    }
    if asset.is_scene_file {
        return;
    }
    if scene.lights.is_empty() {
        let wants_lamp = framed.is_enclosed && lights != LightsChoice::File;
        let name = match (&scene.environment, wants_lamp) {
            (_, true) => {
                scene.lights.push(lamp(framed));
                scene.ambient = INDOORS_AMBIENT;
                "a lamp, since the camera is in a room or under a sky"
            }
            (Some(_), false) => "the environment",
            (None, false) => "nothing",
        };
        let reason = match of_file {
            0 => "none in the file",
            _ => "those of the file are out",
        };
        choices.lines.push(format!("light: {reason}; {name}"));
        return;
    }
    if viewpoint.exposure.is_none()
        && let Some(stops) = exposure::stops(faces(scene), &scene.lights, scene.camera.position)
    {
        choices.exposure = stops;
        choices.lines.push(format!(
            "exposure: {stops:+.1} stops, from the file's lights"
        ));
    }
    let count = match of_file {
        1 => "the one light".to_owned(),
        more => format!("the {more} lights"),
    };
    let beside = match &mut scene.environment {
        Some(environment) if viewpoint.lights.is_none() => {
            let as_seen = FILL * libm::exp2f(-choices.exposure);
            *environment = Arc::new(environment.dimmed(as_seen));
            ", and a quarter of the environment beside (--lights file|default|both)"
        }
        Some(environment) => {
            *environment = Arc::new(environment.dimmed(libm::exp2f(-choices.exposure)));
            ", and the environment"
        }
        None => "",
    };
    choices
        .lines
        .push(format!("light: {count} of the file{beside}"));
}

/// A lamp over the shoulder of who stands in a room.
fn lamp(framed: &Framed) -> Light {
    let [u, v, _] = framed.camera.basis();
    let size = framed.bounds.max - framed.bounds.min;
    let aside = (v * 0.12 - u * 0.08) * f64::from(size.min_element());
    Light {
        name: "lamp".into(),
        kind: LightKind::Point {
            position: (framed.camera.position + aside).as_vec3(),
        },
        color: Rgb::WHITE,
        intensity: LAMP,
        falloff: Falloff::None,
        range: None,
    }
}

/// A light in another space: its directions keep their meaning, its intensity does not grow with the scale.
pub(in crate::load) fn carried(light: &Light, to_world: &DAffine3) -> Light {
    let position = to_world.translation.as_vec3();
    let direction = to_world
        .transform_vector3(DVec3::NEG_Z)
        .normalize_or(DVec3::NEG_Z)
        .as_vec3();
    let kind = match light.kind {
        LightKind::Point { .. } => LightKind::Point { position },
        LightKind::Directional { .. } => LightKind::Directional { direction },
        LightKind::Spot {
            inner_angle,
            outer_angle,
            ..
        } => LightKind::Spot {
            position,
            direction,
            inner_angle,
            outer_angle,
        },
    };
    Light {
        kind,
        ..light.clone()
    }
}
