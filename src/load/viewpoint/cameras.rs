//! The camera that an asset is seen with.

use super::faces;
use super::{CameraChoice, Choices, Viewpoint};
use crate::Error;
use crate::camera::{Camera, Clip, Fov, Projection};
use crate::framing;
use crate::load::pose::Pose;
use crate::load::{Asset, CameraSource, PlacedModel};
use crate::scene::SceneDescription;
use glam::DVec3;

/// The camera that the user, the file or the framing gives, with the field of view that the user asks for.
pub(in crate::load) fn camera(
    asset: &Asset,
    poses: &[(&PlacedModel, Pose)],
    viewpoint: &Viewpoint,
    scene: &SceneDescription,
    choices: &mut Choices,
) -> Result<Camera, Error> {
    let camera = chosen_camera(asset, poses, viewpoint, scene, choices)?;
    let asked = viewpoint
        .fov_y
        .map(|fov| Projection::Perspective { fov: Fov::Y(fov) });
    Ok(Camera {
        projection: asked.unwrap_or(camera.projection),
        ..camera
    })
}

fn chosen_camera(
    asset: &Asset,
    poses: &[(&PlacedModel, Pose)],
    viewpoint: &Viewpoint,
    scene: &SceneDescription,
    choices: &mut Choices,
) -> Result<Camera, Error> {
    let of_file = |name: &str| {
        camera_of_model(poses, name)
            .ok_or_else(|| Error::malformed(&asset.file, "", no_such_camera(poses, name)))
    };
    match (&viewpoint.camera, &asset.camera) {
        (CameraChoice::Given(camera), _) => Ok(*camera),
        (CameraChoice::Named(name), _) => of_file(name),
        (CameraChoice::OfFile, Some(CameraSource::Given(camera))) => Ok(*camera),
        (CameraChoice::OfFile, Some(CameraSource::OfModel(name))) => of_file(name),
        (CameraChoice::OfFile, None) => {
            let first = cameras(poses).next();
            Ok(first.map(|placed| placed.camera).unwrap_or_else(|| {
                choices.lines.push(
                    "camera: none in the file; a three-quarter view, fitted to the model".into(),
                );
                framing::frame(
                    faces(scene),
                    viewpoint.aspect,
                    viewpoint.fov_y.unwrap_or(framing::FOV_Y),
                )
            }))
        }
    }
}

/// A camera in its place, the name it goes by, and that of its node.
struct PlacedCamera {
    name: String,
    node: String,
    camera: Camera,
}

/// Every camera that a node of a model places.
fn cameras(poses: &[(&PlacedModel, Pose)]) -> impl Iterator<Item = PlacedCamera> {
    poses.iter().flat_map(|(placed, pose)| {
        pose.nodes.iter().filter_map(|posed| {
            let node = posed.node;
            let camera = pose.cameras.get(node.camera?)?;
            let to_world = placed.to_world * posed.to_model;
            let position = to_world.translation;
            // Directions only: a camera does not grow with its node (glTF 2.0, section 3.10).
            let forward = to_world
                .transform_vector3(DVec3::NEG_Z)
                .normalize_or(DVec3::NEG_Z);
            let up = to_world.transform_vector3(DVec3::Y).normalize_or(DVec3::Y);
            let target = position + forward * position.abs().max_element().max(1.0);
            let name = if camera.name.is_empty() {
                node.name.clone()
            } else {
                camera.name.clone()
            };
            let camera = Camera {
                position,
                look_at: target,
                up,
                projection: camera.projection,
                near: camera.near,
                far: camera.far,
                clip: Clip::Axis,
            };
            Some(PlacedCamera {
                name,
                node: node.name.clone(),
                camera,
            })
        })
    })
}

fn camera_of_model(poses: &[(&PlacedModel, Pose)], wanted: &str) -> Option<Camera> {
    let by_name = cameras(poses).find(|placed| placed.name == wanted || placed.node == wanted);
    let by_index = || cameras(poses).nth(wanted.parse().ok()?);
    by_name.or_else(by_index).map(|placed| placed.camera)
}

fn no_such_camera(poses: &[(&PlacedModel, Pose)], wanted: &str) -> String {
    const SHOWN: usize = 8;
    let called = |(index, PlacedCamera { name, .. }): (usize, PlacedCamera)| match name.as_str() {
        "" => index.to_string(),
        name => format!("{index} \"{name}\""),
    };
    let known: Vec<String> = (0..).zip(cameras(poses)).map(called).collect();
    let there = match known.as_slice() {
        [] => "the file has none".into(),
        [only] => format!("there is {only}"),
        [first @ .., last] if first.len() < SHOWN => {
            format!("there are {} and {last}", first.join(", "))
        }
        _ => format!("there are {}, ...", known[..SHOWN].join(", ")),
    };
    format!("there is no camera \"{wanted}\"; {there}")
}
