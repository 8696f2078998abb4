//! KHR_lights_punctual: point, directional and spot lights.

use super::Warnings;
use super::document::{Document, named};
use super::extensions;
use crate::color::Rgb;
use crate::light::{Falloff, Light, LightKind};
use glam::Vec3;
use serde_json::Value;
use std::f32::consts::{FRAC_PI_2, FRAC_PI_4, PI};

/// As files call it.
pub(super) const NAME: &str = "KHR_lights_punctual";

#[derive(serde::Deserialize)]
struct Lights {
    lights: Vec<Value>,
}

#[derive(serde::Deserialize)]
struct LightJson {
    name: Option<String>,
    #[serde(rename = "type")]
    kind: String,
    #[serde(default = "white")]
    color: [f32; 3],
    #[serde(default = "one")]
    intensity: f32,
    range: Option<f32>,
    #[serde(default)]
    spot: Spot,
}

#[derive(serde::Deserialize)]
#[serde(rename_all = "camelCase", default)]
struct Spot {
    inner_cone_angle: f32,
    outer_cone_angle: f32,
}

impl Default for Spot {
    fn default() -> Spot {
        Spot {
            inner_cone_angle: 0.0,
            outer_cone_angle: FRAC_PI_4,
        }
    }
}

/// What a node says: which light it holds.
#[derive(serde::Deserialize)]
pub(super) struct OfNode {
    /// An index into the file's lights.
    pub(super) light: u64,
}

fn white() -> [f32; 3] {
    [1.0; 3]
}

fn one() -> f32 {
    1.0
}

/// The lights of a file, by their index in it; `None` for one that is not read as a light.
pub(super) fn all(document: &Document, warnings: &mut Warnings) -> Vec<Option<Light>> {
    let of_root = document.root.extensions.as_ref().map(|e| &e.others);
    let lights = extensions::read::<Lights>(of_root, NAME).unwrap_or_else(|problem| {
        warnings.add(format!("{NAME}: {problem}: its lights are ignored"));
        None
    });
    let lights = lights.map_or(Vec::new(), |lights| lights.lights);
    lights
        .iter()
        .enumerate()
        .map(|(index, value)| one_light(index, value, warnings))
        .collect()
}

fn one_light(index: usize, value: &Value, warnings: &mut Warnings) -> Option<Light> {
    use serde::Deserialize;
    let json = match LightJson::deserialize(value) {
        Ok(json) => json,
        Err(error) => {
            let problem = super::document::one_line(&error.to_string());
            warnings.add(format!("light {index}: {problem}: it is ignored"));
            return None;
        }
    };
    let place = named("light", index, json.name.as_ref());
    // Lights of a file lie along -Z at the origin of their node (KHR_lights_punctual).
    let (position, direction) = (Vec3::ZERO, Vec3::NEG_Z);
    let kind = match json.kind.as_str() {
        "point" => LightKind::Point { position },
        "directional" => LightKind::Directional { direction },
        "spot" => {
            let [inner_angle, outer_angle] = cone(&json.spot, &place, warnings);
            LightKind::Spot {
                position,
                direction,
                inner_angle,
                outer_angle,
            }
        }
        other => {
            let other = super::document::one_line(other);
            warnings.add(format!("{place}: its type is \"{other}\": it is ignored"));
            return None;
        }
    };
    let mut mended = |field: &str, value: f32| {
        let fits = value.clamp(0.0, super::BRIGHTEST);
        if fits != value {
            warnings.add(format!("{place}: its {field} is {value}, taken as {fits}"));
        }
        fits
    };
    let [r, g, b] = json.color.map(|channel| mended("color", channel));
    // Candela and lux are radiometric in their shape: a white matt surface shows 1/π of the illuminance. luch's
    // intensity is what that surface shows.
    let intensity = mended("intensity", json.intensity) / PI;
    let range = json.range.filter(|&range| {
        let fits = range > 0.0;
        if !fits {
            warnings.add(format!("{place}: its range is {range}, taken as none"));
        }
        fits && range.is_finite()
    });
    Some(Light {
        name: json.name.unwrap_or_default(),
        kind,
        color: Rgb::new(r, g, b),
        intensity,
        falloff: Falloff::InverseSquare,
        range,
    })
}

/// The inner and the outer half-angle, `0 <= inner < outer <= π/2`.
fn cone(spot: &Spot, place: &str, warnings: &mut Warnings) -> [f32; 2] {
    let (inner, outer) = (spot.inner_cone_angle, spot.outer_cone_angle);
    let fitting_outer = if outer > 0.0 {
        outer.min(FRAC_PI_2)
    } else {
        FRAC_PI_4
    };
    // Not quite the outer angle: between the two, the light ramps.
    let fitting_inner = inner.clamp(0.0, fitting_outer * 0.999);
    if (fitting_inner, fitting_outer) != (inner, outer) {
        warnings.add(format!(
            "{place}: its cone angles are {inner} and {outer}, taken as {fitting_inner} and {fitting_outer}"
        ));
    }
    [fitting_inner, fitting_outer]
}
