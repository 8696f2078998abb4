//! The cameras of a file.

use super::Warnings;
use super::document::{Document, named};
use crate::camera::{Fov, Projection};
use crate::load::ModelCamera;
use gltf::json::Camera;
use gltf::json::camera::Type;
use gltf::json::validation::Checked;
use std::f32::consts::PI;

/// The cameras of a file, by their index in it; `None` for one through which nothing can be seen.
pub(super) fn all(document: &Document, warnings: &mut Warnings) -> Vec<Option<ModelCamera>> {
    let cameras = document.root.cameras.iter().enumerate();
    cameras
        .map(|(index, camera)| {
            let place = named("camera", index, camera.name.as_ref());
            let read = one(camera, &place, warnings);
            if let Err(problem) = &read {
                warnings.add(format!("{place}: {problem}: it is ignored"));
            }
            read.ok()
        })
        .collect()
}

/// The picture's shape decides what is seen to the left and right: a perspective camera's `aspectRatio` and a parallel
/// one's `xmag` are not used.
fn one(camera: &Camera, place: &str, warnings: &mut Warnings) -> Result<ModelCamera, String> {
    let (projection, near, far) = match (&camera.type_, &camera.perspective, &camera.orthographic) {
        (Checked::Valid(Type::Perspective), Some(lens), _) => {
            let fov = lens.yfov;
            if !(fov > 0.0 && fov < PI) {
                return Err(format!(
                    "its yfov is {fov}, expected an angle above 0 and below π"
                ));
            }
            let fov = Fov::Y(fov);
            (Projection::Perspective { fov }, lens.znear, lens.zfar)
        }
        (Checked::Valid(Type::Orthographic), _, Some(lens)) => {
            // A negative magnification turns the picture over; files that have one do not mean it.
            let half_height = lens.ymag.abs();
            if !(half_height > 0.0 && half_height.is_finite()) {
                return Err(format!(
                    "its ymag is {}, expected a number but 0",
                    lens.ymag
                ));
            }
            let parallel = Projection::Orthographic {
                half_width: None,
                half_height,
            };
            (parallel, lens.znear, Some(lens.zfar))
        }
        (Checked::Invalid, ..) => return Err("its type is unknown".into()),
        _ => return Err("its type says one projection, its fields another".into()),
    };
    let far = far.unwrap_or(f32::INFINITY);
    let fits = near >= 0.0 && near.is_finite() && far > near;
    if !fits {
        warnings.add(format!(
            "{place}: its near plane is at {near}, its far plane at {far}: neither clips"
        ));
    }
    let (near, far) = if fits {
        (near, far)
    } else {
        (0.0, f32::INFINITY)
    };
    Ok(ModelCamera {
        name: camera.name.clone().unwrap_or_default(),
        projection,
        near,
        far,
    })
}
