//! A floor for a model to stand on.

use super::{Framed, GroundChoice, Viewpoint};
use crate::load::Asset;
use crate::scene::Ground;
use glam::Vec3;

/// How many times as wide as the model the floor is, before it fades: a low light's shadow has room.
const WIDER: f32 = 2.5;
/// How far below the model the floor is, in parts of its size: what lies flat at its bottom is not in the floor.
const BELOW: f32 = 1e-4;

/// The floor that a model stands on, if it is to have one: where it is seen from outside and from above.
pub(in crate::load) fn ground(
    asset: &Asset,
    viewpoint: &Viewpoint,
    framed: &Framed,
) -> Option<Ground> {
    let (bounds, eye) = (framed.bounds, framed.camera.position);
    let is_outside =
        eye.cmplt(bounds.min.as_dvec3()).any() || eye.cmpgt(bounds.max.as_dvec3()).any();
    let is_above = eye.y > f64::from(bounds.min.y);
    let wanted = match viewpoint.ground {
        GroundChoice::On => true,
        GroundChoice::Auto => !asset.is_scene_file && is_outside && is_above,
        GroundChoice::Off => false,
    };
    let size = bounds.max - bounds.min;
    let across = Vec3::new(size.x, 0.0, size.z).length() / 2.0;
    // A standing line has no width.
    let radius = across.max(size.y / 2.0).max(f32::MIN_POSITIVE) * WIDER;
    let center = bounds.center();
    let below = BELOW * size.length();
    (wanted && !bounds.is_empty()).then_some(Ground {
        center: center.with_y(bounds.min.y - below),
        radius,
        reflectivity: viewpoint.ground_reflectivity,
    })
}
