//! The camera that an asset is seen with.

use super::faces;
use super::{CameraChoice, Choices, Framed, Viewpoint};
use crate::Error;
use crate::camera::{Camera, Clip, Fov, Projection};
use crate::framing::{Direction, LeftOut, Subject, View};
use crate::geometry::Bounds;
use crate::load::pose::Pose;
use crate::load::{Asset, CameraSource, PlacedModel, choice};
use crate::scene::SceneDescription;
use glam::DVec3;

/// So many things that a picture is not fitted to are named.
const MOST_NAMED: usize = 3;

/// Who says where the camera is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::load) enum Chosen {
    /// The user or the file.
    Camera(Camera),
    /// The framing, like this.
    Framing(View),
}

impl Chosen {
    /// The camera, where it is not framed.
    pub(in crate::load) fn camera(&self) -> Option<Camera> {
        match self {
            Chosen::Camera(camera) => Some(*camera),
            Chosen::Framing(_) => None,
        }
    }
}

/// The camera that the user or the file gives, with the field of view that the user asks for; or how to frame.
pub(in crate::load) fn chosen(
    asset: &Asset,
    cameras: &[PlacedCamera],
    viewpoint: &Viewpoint,
) -> Result<Chosen, Error> {
    let asked = viewpoint
        .fov_y
        .map(|fov| Projection::Perspective { fov: Fov::Y(fov) });
    let given = |camera: Camera| {
        Chosen::Camera(Camera {
            projection: asked.unwrap_or(camera.projection),
            ..camera
        })
    };
    let of_file = |name: &str| {
        camera_of_model(cameras, name).map_err(|problem| Error::malformed(&asset.file, "", problem))
    };
    match (&viewpoint.camera, &asset.camera) {
        (CameraChoice::Given(camera), _) => Ok(given(*camera)),
        (CameraChoice::Named(name), _) => of_file(name).map(given),
        (CameraChoice::OfFile, Some(CameraSource::Given(camera))) => Ok(given(*camera)),
        (CameraChoice::OfFile, Some(CameraSource::OfModel(name))) => of_file(name).map(given),
        (CameraChoice::OfFile, None) => Ok(match cameras.first() {
            Some(placed) => given(placed.camera),
            None => Chosen::Framing(View::default()),
        }),
        (CameraChoice::Framed(view), _) => Ok(Chosen::Framing(*view)),
    }
}

/// What is fitted to the scene, unless it is kept from another moment.
pub(in crate::load) fn fitted(
    viewpoint: &Viewpoint,
    chosen: &Chosen,
    scene: &SceneDescription,
    choices: &mut Choices,
) -> Framed {
    match (&viewpoint.stage, chosen) {
        (Some(stage), _) => stage.framed.clone(),
        (None, Chosen::Camera(camera)) => around(*camera, scene),
        (None, Chosen::Framing(view)) => framed(viewpoint, view, scene, choices),
    }
}

/// The camera of a framed view, and what there is to say of it.
fn framed(
    viewpoint: &Viewpoint,
    view: &View,
    scene: &SceneDescription,
    choices: &mut Choices,
) -> Framed {
    let subject = Subject::of(faces(scene));
    let without = left_out(&subject, scene);
    // Who asks for a view knows of it.
    if viewpoint.camera == CameraChoice::OfFile {
        let what = if subject.is_interior() {
            "a room, seen from inside"
        } else {
            "a three-quarter view, fitted to the model"
        };
        choices
            .lines
            .push(format!("camera: none in the file; {what}{without}"));
    } else if !without.is_empty() {
        choices
            .lines
            .push(format!("camera: fitted to the model{without}"));
    }
    let camera = subject.camera(view, viewpoint.aspect, viewpoint.fov_y);
    let is_inside = subject.is_interior() && view.direction == Direction::Broadest;
    Framed {
        camera,
        pivot: if is_inside || subject.bounds.is_empty() {
            camera.position
        } else {
            subject.bounds.center().as_dvec3()
        },
        bounds: subject.bounds,
        is_enclosed: subject.is_enclosed(),
    }
}

/// A camera that luch did not choose, and what is about it.
fn around(camera: Camera, scene: &SceneDescription) -> Framed {
    let bounds = Bounds::around(faces(scene).flat_map(|face| face.triangle.0));
    let (eye, min, max) = (
        camera.position,
        bounds.min.as_dvec3(),
        bounds.max.as_dvec3(),
    );
    let is_within = eye.cmpge(min).all() && eye.cmple(max).all();
    Framed {
        camera,
        pivot: camera.look_at,
        bounds,
        is_enclosed: is_within && Subject::of(faces(scene)).is_enclosed(),
    }
}

/// What the picture is not fitted to, as the end of a line.
fn left_out(subject: &Subject, scene: &SceneDescription) -> String {
    let named = |out: &LeftOut| {
        let index = out.object as usize;
        let (instances, spheres) = (&scene.instances, &scene.spheres);
        let of_sphere = || {
            Some(
                spheres
                    .get(index.checked_sub(instances.len())?)?
                    .name
                    .as_str(),
            )
        };
        let of_instance = || {
            let instance = instances.get(index)?;
            let of_mesh = scene.meshes.get(instance.mesh as usize);
            Some(match instance.name.as_str() {
                "" => of_mesh.map_or("", |mesh| mesh.name.as_str()),
                name => name,
            })
        };
        let name = of_instance().or_else(of_sphere).unwrap_or_default();
        let times = out.times_as_large;
        format!(", without {name:?}, {times:.0} times as large as the rest")
    };
    let mut told: String = subject
        .left_out
        .iter()
        .take(MOST_NAMED)
        .map(named)
        .collect();
    let more = subject.left_out.len().saturating_sub(MOST_NAMED);
    if more > 0 {
        told += &format!(", without {more} more like it");
    }
    match subject.strays {
        0 => {}
        1 => told += ", without a triangle far away",
        count => told += &format!(", without {count} triangles far away"),
    }
    told
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
