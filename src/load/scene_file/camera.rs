//! `[camera]`.

use super::kind::{DIRECTION, FAR, FIELD_OF_VIEW, NOT_NEGATIVE, POINT, TEXT};
use super::models::Models;
use super::nearest::suggestion;
use super::source::quoted;
use super::table::{Schema, Table};
use crate::Error;
use crate::camera::{Camera, Clip, Fov, Projection};
use crate::load::CameraSource;
use glam::Vec3;

const CAMERA: Schema = Schema {
    key: "camera",
    label: "[camera]",
    keys: &[
        "position",
        "look_at",
        "up",
        "fov_x",
        "fov_y",
        "near",
        "far",
        "model_camera",
    ],
};

/// The camera that the file asks for, if it asks for one.
pub(super) fn read(root: &Table<'_>) -> Result<Option<CameraSource>, Error> {
    let Some(table) = root.table(&CAMERA)? else {
        return Ok(None);
    };
    let source = match table.optional("model_camera", &TEXT)? {
        Some(name) => {
            only_model_camera(&table)?;
            CameraSource::OfModel(name)
        }
        None => CameraSource::Given(given(&table)?),
    };
    Ok(Some(source))
}

/// One of the models must have a camera of this name.
pub(super) fn check_name(name: &str, root: &Table<'_>, models: &Models) -> Result<(), Error> {
    let known = models.camera_names();
    let table = root.table(&CAMERA)?;
    match table {
        Some(table) if !known.contains(&name) => {
            let problem = format!(
                "no model has a camera named {}{}",
                quoted(name),
                suggestion(name, known)
            );
            Err(table.error("model_camera", problem))
        }
        _ => Ok(()),
    }
}

fn only_model_camera(table: &Table<'_>) -> Result<(), Error> {
    match table.keys().into_iter().find(|&key| key != "model_camera") {
        None => Ok(()),
        Some(key) => {
            let problem =
                format!("[camera] has both model_camera and {key}; remove one of the two");
            Err(table.error(key, problem))
        }
    }
}

fn given(table: &Table<'_>) -> Result<Camera, Error> {
    let position = table.required("position", &POINT)?.as_vec3();
    let look_at = table.required("look_at", &POINT)?.as_vec3();
    if look_at == position {
        let problem = "look_at in [camera] equals position, so that it looks nowhere; move one";
        return Err(table.error("look_at", problem));
    }
    let up = table.or("up", &DIRECTION, Vec3::Y)?;
    let fov_x = table.optional("fov_x", &FIELD_OF_VIEW)?;
    let fov_y = table.optional("fov_y", &FIELD_OF_VIEW)?;
    let fov = match (fov_x, fov_y) {
        (Some(x), Some(y)) => Fov::Both(x, y),
        (Some(x), None) => Fov::X(x),
        (None, Some(y)) => Fov::Y(y),
        (None, None) => Fov::Y(40f64.to_radians() as f32),
    };
    let near = table.or("near", &NOT_NEGATIVE, 0.0)?;
    let far = table.or("far", &FAR, f32::INFINITY)?;
    if far <= near {
        return Err(table.wrong("far", &format!("a number above near ({near}), or inf")));
    }
    Ok(Camera {
        position,
        look_at,
        up,
        projection: Projection::Perspective { fov },
        near,
        far,
        clip: Clip::Ray,
    })
}
