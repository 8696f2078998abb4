//! Where a picture was seen from: what compositors place cards and cameras by.
//!
//! The conventions are OpenEXR's ("Standard Attributes"): a point is a row vector, to be multiplied by the matrix; camera
//! space is left-handed with +x to the right, +y up and +z forward; (0, 0) and (1, 1) of NDC are the upper left and the
//! lower right corner of the display window.

use super::attributes::text;
use crate::camera::{Camera, Projection};
use crate::film::FAR_AWAY;
use exr::math::Vec2;
use exr::meta::attribute::{AttributeValue, Matrix4x4};
use exr::meta::header::LayerAttributes;
use glam::DMat4;

/// How wide the sensor is said to be, in millimetres: a full frame's width. A picture does not tell, only the ratio to the
/// focal length counts.
const SENSOR_WIDTH: f64 = 36.0;

/// Adds what is known of a camera in front of a display window of `size` pixels.
pub(super) fn describe(camera: &Camera, size: Vec2<usize>, attributes: &mut LayerAttributes) {
    let [x, y] = camera.half_extents(size.0 as f64 / size.1.max(1) as f64);
    let to_camera = world_to_camera(camera);
    let to_ndc = camera_to_ndc(camera.projection, x, y) * to_camera;
    attributes.world_to_camera = Some(for_row_vectors(to_camera));
    attributes.world_to_normalized_device = Some(for_row_vectors(to_ndc));
    attributes.near_clip_plane = Some(camera.near);
    // An infinity is no number that every reader likes.
    attributes.far_clip_plane = Some(camera.far.min(FAR_AWAY));
    if let Projection::Perspective { .. } = camera.projection {
        let sensor = Vec2(SENSOR_WIDTH as f32, (SENSOR_WIDTH * y / x) as f32);
        let focal_length = (SENSOR_WIDTH / (2.0 * x)) as f32;
        let others = [
            ("sensorOverallDimensions", AttributeValue::FloatVec2(sensor)),
            ("pinholeFocalLength", AttributeValue::F32(focal_length)),
        ];
        let others = others.into_iter().map(|(name, value)| (text(name), value));
        attributes.other.extend(others);
    }
}

/// For column vectors, as glam has them.
fn world_to_camera(camera: &Camera) -> DMat4 {
    let [u, v, w] = camera.basis();
    let c = camera.position;
    let row = |axis: glam::DVec3| axis.extend(-axis.dot(c));
    DMat4::from_cols(row(u), row(v), row(w), glam::DVec4::W).transpose()
}

/// The same for camera space, of which `x` by `y` at distance 1 are half of what is seen. NDC's z, which nobody uses, is the
/// inverse of the distance where rays meet in a point, so that the matrix has an inverse whatever near and far are.
fn camera_to_ndc(projection: Projection, x: f64, y: f64) -> DMat4 {
    let (right, down) = (0.5 / x, -0.5 / y);
    match projection {
        Projection::Perspective { .. } => DMat4::from_cols_array_2d(&[
            [right, 0.0, 0.0, 0.0],
            [0.0, down, 0.0, 0.0],
            [0.5, 0.5, 0.0, 1.0],
            [0.0, 0.0, 1.0, 0.0],
        ]),
        Projection::Orthographic { .. } => DMat4::from_cols_array_2d(&[
            [right, 0.0, 0.0, 0.0],
            [0.0, down, 0.0, 0.0],
            [0.0, 0.0, 1.0, 0.0],
            [0.5, 0.5, 0.0, 1.0],
        ]),
    }
}

/// The transpose, row by row, which is the same numbers column by column.
fn for_row_vectors(matrix: DMat4) -> Matrix4x4 {
    matrix.to_cols_array().map(|value| {
        let value = value.clamp(f64::from(f32::MIN), f64::from(f32::MAX)) as f32;
        // No -0.0, which reads like a mistake.
        value + 0.0
    })
}
