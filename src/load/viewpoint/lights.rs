//! Lights for a model that has none, and exposure for one that has its own.

use super::{Choices, Viewpoint, faces};
use crate::camera::Camera;
use crate::color::Rgb;
use crate::light::{Falloff, Light, LightKind};
use crate::load::{Asset, exposure};
use crate::scene::SceneDescription;
use glam::{DAffine3, DVec3, Vec3};

/// Constant light for models without lights.
const MODEL_AMBIENT: Rgb = Rgb::grey(0.35);
/// Adds lights to a model without any; finds the exposure for one with its own.
pub(in crate::load) fn light(
    asset: &Asset,
    viewpoint: &Viewpoint,
    scene: &mut SceneDescription,
    choices: &mut Choices,
) {
    scene.ambient = asset.ambient.unwrap_or(Rgb::BLACK);
    choices.exposure = viewpoint.exposure.unwrap_or(0.0);
    if asset.is_scene_file {
        return;
    }
    if scene.lights.is_empty() {
        choices.lines.push(
            "light: none in the file; a key and a fill from the viewer's upper left, soft ambient"
                .into(),
        );
        scene.lights = viewer_lights(&scene.camera);
        scene.ambient = MODEL_AMBIENT;
    } else if viewpoint.exposure.is_none()
        && let Some(stops) = exposure::stops(faces(scene), &scene.lights, scene.camera.position)
    {
        choices.exposure = stops;
        choices.lines.push(format!(
            "exposure: {stops:+.1} stops, from the file's lights"
        ));
    }
}

/// A key light from the viewer's upper left and a fill from nearer the viewer, whose shadows hide behind things.
fn viewer_lights(camera: &Camera) -> Vec<Light> {
    let [u, v, w] = camera.basis();
    let light = |name: &str, toward: DVec3, intensity: f32| {
        let direction: Vec3 = (-toward.normalize()).as_vec3();
        let kind = LightKind::Directional { direction };
        Light {
            name: name.into(),
            kind,
            color: Rgb::WHITE,
            intensity,
            falloff: Falloff::None,
            range: None,
        }
    };
    vec![
        light("key", v * 1.1 - u * 0.8 - w * 0.9, 0.6),
        light("fill", v * 0.25 - u * 0.15 - w, 0.2),
    ]
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
