//! KHR_animation_pointer: channels that move more than nodes, by a JSON pointer into the file.
//!
//! Honoured for what luch shows: nodes' factors, weights and visibility, materials, texture transforms, lights, cameras.

use super::animations::{Change, Places};
use super::document::{Document, one_line};
use super::emissive_strength::{self, EmissiveStrength};
use super::morph_targets::{targets_of_mesh, targets_of_node};
use super::{BRIGHTEST, extensions, lights_punctual, node_visibility};
use crate::color::Rgb;
use crate::load::pose::{
    CameraProperty, Emissive, LightProperty, MaterialProperty, Target, TextureSlot,
    TextureTransform, TransformPart,
};
use glam::Vec2;
use gltf::json::Material;
use gltf::json::animation::Animation;
use serde_json::{Map, Value, json};

/// As files call it.
pub(super) const NAME: &str = "KHR_animation_pointer";

/// Keeps what channels without a node say: crate `gltf` has no room for them in a channel, but in the extensions of an
/// animation, where no file has this one.
pub(super) fn keep(animation: &mut Value, channels: Vec<Value>) {
    let pointer_of = |channel: &Value| {
        let pointer = channel
            .pointer("/target/extensions/KHR_animation_pointer/pointer")?
            .as_str()?
            .to_owned();
        Some(json!([channel.get("sampler")?, pointer]))
    };
    let kept: Vec<Value> = channels.iter().filter_map(pointer_of).collect();
    let extensions = animation
        .as_object_mut()
        .map(|animation| animation.entry("extensions").or_insert_with(|| json!({})))
        .and_then(Value::as_object_mut);
    if let Some(extensions) = extensions.filter(|_| !kept.is_empty()) {
        extensions.insert(NAME.into(), kept.into());
    }
}

/// The channels that were kept: each one's sampler and pointer.
pub(super) fn kept(animation: &Animation) -> impl Iterator<Item = (usize, &str)> {
    let others = animation.extensions.as_ref().map(|e| &e.others);
    let kept = others.and_then(|others| others.get(NAME)?.as_array());
    kept.into_iter().flatten().filter_map(|channel| {
        let sampler = usize::try_from(channel.get(0)?.as_u64()?).ok()?;
        Some((sampler, channel.get(1)?.as_str()?))
    })
}

/// What a pointer leads to.
///
/// # Errors
///
/// One line: there is no such thing, or luch does not show it.
pub(super) fn change(
    pointer: &str,
    document: &Document,
    places: &Places,
) -> Result<Change, String> {
    let parts: Vec<&str> = pointer
        .strip_prefix('/')
        .unwrap_or_default()
        .split('/')
        .collect();
    let found = match parts.as_slice() {
        ["nodes", node, rest @ ..] => {
            of_node(document, index(node, document.root.nodes.len())?, rest)?
        }
        ["meshes", mesh, rest @ ..] => {
            of_mesh(document, index(mesh, document.root.meshes.len())?, rest)?
        }
        ["materials", material, rest @ ..] => {
            let material = index(material, document.root.materials.len())?;
            let property = of_material(&document.root.materials[material], rest);
            property.map(|p| Change::of(Target::Material(material, p), p.width()))
        }
        ["cameras", camera, rest @ ..] => {
            let camera = index(camera, places.cameras.len())?;
            let camera = places.cameras[camera].ok_or("moves a camera that is ignored")?;
            of_camera(rest).map(|property| Change::of(Target::Camera(camera, property), 1))
        }
        [
            "extensions",
            lights_punctual::NAME,
            "lights",
            light,
            rest @ ..,
        ] => {
            let light = index(light, places.lights.len())?;
            let light = places.lights[light].ok_or("moves a light that is ignored")?;
            of_light(rest).map(|p| Change::of(Target::Light(light, p), p.width()))
        }
        _ => None,
    };
    found.ok_or_else(|| format!("moves {}, which luch does not", one_line(pointer)))
}

fn index(text: &str, count: usize) -> Result<usize, String> {
    text.parse()
        .ok()
        .filter(|&index| index < count)
        .ok_or_else(|| {
            format!(
                "its pointer names number {}, there are {count}",
                one_line(text)
            )
        })
}

fn of_node(document: &Document, node: usize, rest: &[&str]) -> Result<Option<Change>, String> {
    Ok(Some(match rest {
        ["translation"] => Change::of(Target::Translation(node), 3),
        ["rotation"] => Change::of(Target::Rotation(node), 4),
        ["scale"] => Change::of(Target::Scale(node), 3),
        ["weights"] => {
            let targets = targets_of_node(document, node)?;
            Change::of_weights(Target::NodeWeights(node), targets)
        }
        ["weights", one] => {
            let targets = targets_of_node(document, node)?;
            let one = index(one, targets)?;
            Change::of_weight(Target::NodeWeight(node, one), targets)
        }
        ["extensions", node_visibility::NAME, "visible"] => Change::of(Target::Visibility(node), 1),
        _ => return Ok(None),
    }))
}

fn of_mesh(document: &Document, mesh: usize, rest: &[&str]) -> Result<Option<Change>, String> {
    Ok(Some(match rest {
        ["weights"] => {
            let targets = targets_of_mesh(document, mesh)?;
            Change::of_weights(Target::ShapeWeights(mesh), targets)
        }
        ["weights", one] => {
            let targets = targets_of_mesh(document, mesh)?;
            let one = index(one, targets)?;
            Change::of_weight(Target::ShapeWeight(mesh, one), targets)
        }
        _ => return Ok(None),
    }))
}

fn of_material(material: &Material, rest: &[&str]) -> Option<MaterialProperty> {
    Some(match rest {
        ["pbrMetallicRoughness", "baseColorFactor"] => MaterialProperty::BaseColor,
        ["pbrMetallicRoughness", "metallicFactor"] => MaterialProperty::Metallic,
        ["pbrMetallicRoughness", "roughnessFactor"] => MaterialProperty::Roughness,
        ["occlusionTexture", "strength"] => MaterialProperty::OcclusionStrength,
        ["normalTexture", "scale"] => MaterialProperty::NormalScale,
        ["alphaCutoff"] => MaterialProperty::AlphaCutoff,
        ["emissiveFactor"] => MaterialProperty::EmissiveFactor(emissive(material)),
        ["extensions", emissive_strength::NAME, "emissiveStrength"] => {
            MaterialProperty::EmissiveStrength(emissive(material))
        }
        [texture @ .., "extensions", TRANSFORM, part] => {
            let (slot, of_texture) = texture_slot(material, texture)?;
            let part = match *part {
                "offset" => TransformPart::Offset,
                "rotation" => TransformPart::Rotation,
                "scale" => TransformPart::Scale,
                _ => return None,
            };
            let rest = extensions::read::<TransformJson>(of_texture, TRANSFORM);
            let rest = rest.ok().flatten().unwrap_or_default();
            MaterialProperty::Transform(slot, part, rest.into())
        }
        _ => return None,
    })
}

fn emissive(material: &Material) -> Emissive {
    let [r, g, b] = material.emissive_factor.0.map(|c| c.clamp(0.0, BRIGHTEST));
    let others = material.extensions.as_ref().map(|e| &e.others);
    let strength = extensions::read::<EmissiveStrength>(others, emissive_strength::NAME);
    let strength = strength.ok().flatten().map_or(1.0, |e| e.emissive_strength);
    Emissive {
        factor: Rgb::new(r, g, b),
        strength: strength.clamp(0.0, BRIGHTEST),
    }
}

/// Textures that are moved.
const TRANSFORM: &str = "KHR_texture_transform";

#[derive(serde::Deserialize)]
#[serde(default)]
struct TransformJson {
    offset: [f32; 2],
    rotation: f32,
    scale: [f32; 2],
}

impl Default for TransformJson {
    fn default() -> TransformJson {
        TransformJson {
            offset: [0.0; 2],
            rotation: 0.0,
            scale: [1.0; 2],
        }
    }
}

impl From<TransformJson> for TextureTransform {
    fn from(json: TransformJson) -> TextureTransform {
        TextureTransform {
            offset: Vec2::from(json.offset),
            rotation: json.rotation,
            scale: Vec2::from(json.scale),
        }
    }
}

/// A texture of a material, and what extensions say of it.
fn texture_slot<'a>(
    material: &'a Material,
    path: &[&str],
) -> Option<(TextureSlot, Option<&'a Map<String, Value>>)> {
    let pbr = &material.pbr_metallic_roughness;
    let plain = |slot, info: &'a Option<gltf::json::texture::Info>| {
        let extensions = info.as_ref()?.extensions.as_ref();
        Some((slot, extensions.map(|e| &e.others)))
    };
    match path {
        ["pbrMetallicRoughness", "baseColorTexture"] => {
            plain(TextureSlot::BaseColor, &pbr.base_color_texture)
        }
        ["pbrMetallicRoughness", "metallicRoughnessTexture"] => plain(
            TextureSlot::MetallicRoughness,
            &pbr.metallic_roughness_texture,
        ),
        ["emissiveTexture"] => plain(TextureSlot::Emissive, &material.emissive_texture),
        ["normalTexture"] => {
            let extensions = material.normal_texture.as_ref()?.extensions.as_ref();
            Some((TextureSlot::Normal, extensions.map(|e| &e.others)))
        }
        ["occlusionTexture"] => {
            let extensions = material.occlusion_texture.as_ref()?.extensions.as_ref();
            Some((TextureSlot::Occlusion, extensions.map(|e| &e.others)))
        }
        _ => None,
    }
}

fn of_camera(rest: &[&str]) -> Option<CameraProperty> {
    Some(match rest {
        ["perspective", "yfov"] => CameraProperty::FovY,
        ["orthographic", "ymag"] => CameraProperty::HalfHeight,
        ["perspective" | "orthographic", "znear"] => CameraProperty::Near,
        ["perspective" | "orthographic", "zfar"] => CameraProperty::Far,
        _ => return None,
    })
}

fn of_light(rest: &[&str]) -> Option<LightProperty> {
    Some(match rest {
        ["color"] => LightProperty::Color,
        ["intensity"] => LightProperty::Intensity,
        ["range"] => LightProperty::Range,
        ["spot", "innerConeAngle"] => LightProperty::InnerConeAngle,
        ["spot", "outerConeAngle"] => LightProperty::OuterConeAngle,
        _ => return None,
    })
}
