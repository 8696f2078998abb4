//! The camera that an asset is seen with.

use super::faces;
use super::{CameraChoice, Choices, Framed, Viewpoint};
use crate::Error;
use crate::camera::{Camera, Clip, Fov, Projection};
use crate::framing;
use crate::geometry::Bounds;
use crate::load::pose::Pose;
use crate::load::{Asset, CameraSource, PlacedModel, choice};
use crate::scene::SceneDescription;
use glam::DVec3;

/// The camera that the user, the file or the framing gives, with the field of view that the user asks for.
pub(in crate::load) fn camera(
    asset: &Asset,
    cameras: &[PlacedCamera],
    viewpoint: &Viewpoint,
    scene: &SceneDescription,
    choices: &mut Choices,
) -> Result<Framed, Error> {
    let (camera, is_chosen) = chosen_camera(asset, cameras, viewpoint, scene, choices)?;
    let asked = viewpoint
        .fov_y
        .map(|fov| Projection::Perspective { fov: Fov::Y(fov) });
    let camera = Camera {
        projection: asked.unwrap_or(camera.projection),
        ..camera
    };
    let points = faces(scene).flat_map(|face| face.triangle.0);
    Ok(Framed {
        camera,
        is_chosen,
        bounds: Bounds::around(points),
        is_interior: false,
        head_room: 1.0,
    })
}

fn chosen_camera(
    asset: &Asset,
    cameras: &[PlacedCamera],
    viewpoint: &Viewpoint,
    scene: &SceneDescription,
    choices: &mut Choices,
) -> Result<(Camera, bool), Error> {
    let of_file = |name: &str| {
        camera_of_model(cameras, name).map_err(|problem| Error::malformed(&asset.file, "", problem))
    };
    match (&viewpoint.camera, &asset.camera) {
        (CameraChoice::Given(camera), _) => Ok((*camera, false)),
        (CameraChoice::Named(name), _) => Ok((of_file(name)?, false)),
        (CameraChoice::OfFile, Some(CameraSource::Given(camera))) => Ok((*camera, false)),
        (CameraChoice::OfFile, Some(CameraSource::OfModel(name))) => Ok((of_file(name)?, false)),
        (CameraChoice::OfFile, None) => {
            let first = cameras.first();
            Ok(first
                .map(|placed| (placed.camera, false))
                .unwrap_or_else(|| {
                    choices.lines.push(
                        "camera: none in the file; a three-quarter view, fitted to the model"
                            .into(),
                    );
                    let fov_y = viewpoint.fov_y.unwrap_or(framing::FOV_Y);
                    (framing::frame(faces(scene), viewpoint.aspect, fov_y), true)
                }))
        }
    }
}

/// A camera of a model in its place.
#[derive(Clone, Debug)]
pub struct PlacedCamera {
    /// Its own name or, if it has none, its node's; may be empty.
    pub name: String,
    /// Its node's name; may be empty.
    pub node: String,
    /// The camera itself.
    pub camera: Camera,
}

/// Every camera that a node of a model places.
pub(in crate::load) fn cameras(
    poses: &[(&PlacedModel, Pose)],
) -> impl Iterator<Item = PlacedCamera> {
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

/// The camera that goes by a name, its own or else its node's, or that has this index.
fn camera_of_model(cameras: &[PlacedCamera], wanted: &str) -> Result<Camera, String> {
    let names: Vec<&str> = cameras.iter().map(|placed| placed.name.as_str()).collect();
    let by_node = || cameras.iter().position(|placed| placed.node == wanted);
    let index = match choice::find("camera", wanted, &names) {
        Ok(index) => index,
        Err(problem) => by_node().ok_or(problem)?,
    };
    cameras
        .get(index)
        .map(|placed| placed.camera)
        .ok_or_else(|| format!("there is no camera {index}"))
}
