//! How an asset is to be looked at, and what was chosen where neither the file nor the user said.

use super::{Asset, CameraSource};
use crate::Error;
use crate::camera::{Camera, Clip, Fov, Projection};
use crate::color::Rgb;
use crate::framing::{self, Face};
use crate::geometry::Bounds;
use crate::light::{Falloff, Light, LightKind};
use crate::scene::{Background, SceneDescription, Shown};
use glam::{DAffine3, DVec3, Vec3};

/// How an asset is to be looked at.
#[derive(Clone, Debug)]
pub struct Viewpoint {
    /// The picture's width over its height, for framing.
    pub aspect: f64,
    /// From where.
    pub camera: CameraChoice,
    /// The vertical field of view in radians, instead of the camera's own.
    pub fov_y: Option<f64>,
    /// The background; the file's, or a default, where it is `None`.
    pub background: Option<Background>,
}

/// From where an asset is to be looked at.
#[derive(Clone, Debug, PartialEq)]
pub enum CameraChoice {
    /// As the file says; framed where it does not.
    OfFile,
    /// The model's camera of this name or, if none has it and it is a number, of this index.
    Named(String),
    /// This one.
    Given(Camera),
}

/// What was chosen where neither the file nor the user said.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Choices {
    /// A line each, for the user.
    pub lines: Vec<String>,
    /// Stops by which a display should change the picture, so that the file's lights, in candela or lux, neither wash
    /// it out nor leave it dark.
    pub exposure: Option<f32>,
}

/// The grey behind models, linear.
const MODEL_BACKGROUND: Rgb = Rgb::grey(0.2);
/// Constant light for models without lights.
const MODEL_AMBIENT: Rgb = Rgb::grey(0.3);

/// The camera that the user, the file or the framing gives, with the field of view that the user asks for.
pub(super) fn camera(
    asset: &Asset,
    viewpoint: &Viewpoint,
    scene: &SceneDescription,
    choices: &mut Choices,
) -> Result<Camera, Error> {
    let camera = chosen_camera(asset, viewpoint, scene, choices)?;
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
    viewpoint: &Viewpoint,
    scene: &SceneDescription,
    choices: &mut Choices,
) -> Result<Camera, Error> {
    let of_file = |name: &str| {
        camera_of_model(asset, name)
            .ok_or_else(|| Error::malformed(&asset.file, "", no_such_camera(asset, name)))
    };
    match (&viewpoint.camera, &asset.camera) {
        (CameraChoice::Given(camera), _) => Ok(*camera),
        (CameraChoice::Named(name), _) => of_file(name),
        (CameraChoice::OfFile, Some(CameraSource::Given(camera))) => Ok(*camera),
        (CameraChoice::OfFile, Some(CameraSource::OfModel(name))) => of_file(name),
        (CameraChoice::OfFile, None) => {
            let first = cameras(asset).next();
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
fn cameras(asset: &Asset) -> impl Iterator<Item = PlacedCamera> {
    asset.models.iter().flat_map(|placed| {
        let nodes = placed.model.placed_nodes();
        nodes.into_iter().filter_map(move |(node, to_model)| {
            let camera = placed.model.cameras.get(node.camera?)?;
            let to_world = placed.to_world * to_model;
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

fn camera_of_model(asset: &Asset, wanted: &str) -> Option<Camera> {
    let by_name = cameras(asset).find(|placed| placed.name == wanted || placed.node == wanted);
    let by_index = || cameras(asset).nth(wanted.parse().ok()?);
    by_name.or_else(by_index).map(|placed| placed.camera)
}

fn no_such_camera(asset: &Asset, wanted: &str) -> String {
    const SHOWN: usize = 8;
    let called = |(index, PlacedCamera { name, .. }): (usize, PlacedCamera)| match name.as_str() {
        "" => index.to_string(),
        name => format!("{index} \"{name}\""),
    };
    let known: Vec<String> = (0..).zip(cameras(asset)).map(called).collect();
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

/// The triangles of a scene, in world space.
fn faces(scene: &SceneDescription) -> impl Iterator<Item = Face> + Clone {
    scene.instances.iter().flat_map(|instance| {
        let mesh = &scene.meshes[instance.mesh as usize];
        let double_sided = scene.materials[instance.material as usize].double_sided;
        let to_world = instance.to_world.as_affine3();
        (0..mesh.triangles.len() as u32).map(move |index| {
            let mut triangle = mesh.triangle(index);
            triangle.0 = triangle.0.map(|p| to_world.transform_point3(p));
            Face {
                triangle,
                double_sided,
            }
        })
    })
}

/// The background that the user, the file or the default gives.
pub(super) fn background(
    asset: &Asset,
    viewpoint: &Viewpoint,
    choices: &mut Choices,
) -> Background {
    match (viewpoint.background, asset.background) {
        // Mirrors go on to see what they would have seen.
        (
            Some(Background {
                shown: Shown::Never,
                ..
            }),
            color,
        ) => Background {
            color: color.unwrap_or(default_background(asset)),
            shown: Shown::Never,
        },
        (Some(asked), _) => asked,
        (None, Some(color)) => Background {
            color,
            shown: Shown::Always,
        },
        (None, None) => {
            if !asset.is_scene_file {
                choices
                    .lines
                    .push("background: neutral grey (an EXR is transparent there)".into());
            }
            Background {
                color: default_background(asset),
                shown: Shown::OnDisplay,
            }
        }
    }
}

fn default_background(asset: &Asset) -> Rgb {
    if asset.is_scene_file {
        Rgb::BLACK
    } else {
        MODEL_BACKGROUND
    }
}

/// Lights for a model without any; exposure for one with its own.
pub(super) fn light(asset: &Asset, scene: &mut SceneDescription, choices: &mut Choices) {
    scene.ambient = asset.ambient.unwrap_or(Rgb::BLACK);
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
        return;
    }
    let center = Bounds::around(faces(scene).flat_map(|face| face.triangle.0)).center();
    let arrives = |light: &Light| {
        light
            .illuminate(center)
            .map_or(0.0, |l| l.irradiance.luminance())
    };
    let total: f32 = scene.lights.iter().map(arrives).sum();
    if total.is_finite() && total > 0.0 && !(0.25..=2.0).contains(&total) {
        let stops = -libm::log2f(total);
        choices.exposure = Some(stops);
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
        light("key", v * 1.1 - u * 0.8 - w * 0.9, 0.8),
        light("fill", v * 0.25 - u * 0.15 - w, 0.25),
    ]
}

/// A light in another space: its directions keep their meaning, its intensity does not grow with the scale.
pub(super) fn carried(light: &Light, to_world: &DAffine3) -> Light {
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
