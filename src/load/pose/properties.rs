//! What curves change in materials, lights and cameras (KHR_animation_pointer).

use super::curve::Curve;
use crate::camera::{Fov, Projection};
use crate::color::Rgb;
use crate::light::{Light, LightKind};
use crate::load::ModelCamera;
use crate::material::{AlphaMode, Material, Model};
use crate::texture::TextureUse;
use glam::{Mat3, Vec2};
use std::f32::consts::{FRAC_PI_2, PI};

/// The greatest factor that is taken as it is: products of two of these are finite.
const BRIGHTEST: f64 = 1e18;

/// What a curve changes in a material.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::load) enum MaterialProperty {
    BaseColor,
    Metallic,
    Roughness,
    OcclusionStrength,
    NormalScale,
    AlphaCutoff,
    /// The factor, and the strength that multiplies it where no curve changes that.
    EmissiveFactor(Emissive),
    /// The strength, and the factor where no curve changes that.
    EmissiveStrength(Emissive),
    /// A part of the transform of a texture, and all of it where no curve changes it.
    Transform(TextureSlot, TransformPart, TextureTransform),
}

/// Light of a material's own, in the two factors that files have.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::load) struct Emissive {
    pub(in crate::load) factor: Rgb,
    pub(in crate::load) strength: f32,
}

/// Where a material uses a texture.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub(in crate::load) enum TextureSlot {
    BaseColor,
    MetallicRoughness,
    Occlusion,
    Emissive,
    Normal,
}

/// A part of KHR_texture_transform.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::load) enum TransformPart {
    Offset,
    Rotation,
    Scale,
}

/// KHR_texture_transform, in its parts.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(in crate::load) struct TextureTransform {
    pub(in crate::load) offset: Vec2,
    /// Radians, counter-clockwise.
    pub(in crate::load) rotation: f32,
    pub(in crate::load) scale: Vec2,
}

/// What a curve changes in a light.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::load) enum LightProperty {
    Color,
    Intensity,
    Range,
    InnerConeAngle,
    OuterConeAngle,
}

/// What a curve changes in a camera.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::load) enum CameraProperty {
    FovY,
    HalfHeight,
    Near,
    Far,
}

impl MaterialProperty {
    /// How many numbers it has.
    pub(in crate::load) fn width(self) -> usize {
        match self {
            MaterialProperty::BaseColor => 4,
            MaterialProperty::EmissiveFactor(_) => 3,
            MaterialProperty::Transform(_, TransformPart::Offset | TransformPart::Scale, _) => 2,
            _ => 1,
        }
    }

    /// Changes the material; `changed` keeps what two curves share.
    pub(super) fn set(
        self,
        material: &mut Material,
        curve: &Curve,
        time: f64,
        changed: &mut Changed,
    ) {
        let number = || curve.first_at(time) as f32;
        let share = || curve.first_at(time).clamp(0.0, 1.0) as f32;
        match (self, &mut material.model) {
            (MaterialProperty::BaseColor, model) => {
                let values = curve.at(time);
                let value = |i: usize| {
                    let value = values.get(i).copied().unwrap_or(1.0);
                    value.clamp(0.0, 1.0) as f32
                };
                let color = Rgb::new(value(0), value(1), value(2));
                match model {
                    Model::MetallicRoughness(m) => m.base_color.factor = color,
                    Model::Unlit { color: shown } => shown.factor = color,
                    _ => {}
                }
                material.alpha.coverage.factor = value(3);
            }
            (MaterialProperty::Metallic, Model::MetallicRoughness(m)) => m.metallic = share(),
            (MaterialProperty::Roughness, Model::MetallicRoughness(m)) => m.roughness = share(),
            (MaterialProperty::OcclusionStrength, Model::MetallicRoughness(m)) => {
                m.occlusion.factor = share();
            }
            (MaterialProperty::NormalScale, _) => {
                if let Some(map) = &mut material.normal_map {
                    map.scale = number();
                }
            }
            (MaterialProperty::AlphaCutoff, _) => {
                if let AlphaMode::Mask { cutoff } = &mut material.alpha.mode {
                    *cutoff = number();
                }
            }
            (MaterialProperty::EmissiveFactor(rest), _) => {
                let emissive = changed.emissive.get_or_insert(rest);
                emissive.factor = color_at(curve, time);
                material.emission.factor = emissive.factor * emissive.strength;
            }
            (MaterialProperty::EmissiveStrength(rest), _) => {
                let emissive = changed.emissive.get_or_insert(rest);
                emissive.strength = curve.first_at(time).clamp(0.0, BRIGHTEST) as f32;
                material.emission.factor = emissive.factor * emissive.strength;
            }
            (MaterialProperty::Transform(slot, part, rest), _) => {
                let [x, y, _] = curve.three_at(time).map(|number| number as f32);
                let transform = changed.transform(slot, rest);
                match part {
                    TransformPart::Offset => transform.offset = Vec2::new(x, y),
                    TransformPart::Rotation => transform.rotation = x,
                    TransformPart::Scale => transform.scale = Vec2::new(x, y),
                }
                let matrix = transform.matrix();
                // What leaves 32 bits stays as it was.
                if matrix.is_finite() {
                    slot.set(material, matrix);
                }
            }
            (
                MaterialProperty::Metallic
                | MaterialProperty::Roughness
                | MaterialProperty::OcclusionStrength,
                _,
            ) => {}
        }
    }
}

/// What curves have changed in a material so far, where several of them make one of its numbers.
#[derive(Default)]
pub(super) struct Changed {
    emissive: Option<Emissive>,
    transforms: Vec<(TextureSlot, TextureTransform)>,
}

impl Changed {
    fn transform(&mut self, slot: TextureSlot, rest: TextureTransform) -> &mut TextureTransform {
        let known = self.transforms.iter().position(|&(other, _)| other == slot);
        let place = known.unwrap_or_else(|| {
            self.transforms.push((slot, rest));
            self.transforms.len() - 1
        });
        &mut self.transforms[place].1
    }
}

impl TextureTransform {
    /// Translation, rotation, scale, as KHR_texture_transform multiplies them.
    fn matrix(&self) -> Mat3 {
        let (sine, cosine) = (libm::sinf(self.rotation), libm::cosf(self.rotation));
        let Vec2 { x: sx, y: sy } = self.scale;
        Mat3::from_cols_array_2d(&[
            [cosine * sx, -sine * sx, 0.0],
            [sine * sy, cosine * sy, 0.0],
            [self.offset.x, self.offset.y, 1.0],
        ])
    }
}

impl TextureSlot {
    /// Gives every use of a texture in this slot the transform.
    fn set(self, material: &mut Material, matrix: Mat3) {
        let give = |used: Option<&mut TextureUse>| {
            if let Some(used) = used {
                used.transform = Some(matrix);
            }
        };
        match (self, &mut material.model) {
            (TextureSlot::BaseColor, model) => {
                match model {
                    Model::MetallicRoughness(m) => give(m.base_color.texture.as_mut()),
                    Model::Unlit { color } => give(color.texture.as_mut()),
                    _ => {}
                }
                give(material.alpha.coverage.texture.as_mut());
            }
            (TextureSlot::MetallicRoughness, Model::MetallicRoughness(m)) => {
                give(m.metallic_roughness.as_mut());
            }
            (TextureSlot::Occlusion, Model::MetallicRoughness(m)) => {
                give(m.occlusion.texture.as_mut());
            }
            (TextureSlot::Emissive, _) => give(material.emission.texture.as_mut()),
            (TextureSlot::Normal, _) => {
                give(material.normal_map.as_mut().map(|map| &mut map.texture));
            }
            (TextureSlot::MetallicRoughness | TextureSlot::Occlusion, _) => {}
        }
    }
}

impl LightProperty {
    /// How many numbers it has.
    pub(in crate::load) fn width(self) -> usize {
        match self {
            LightProperty::Color => 3,
            _ => 1,
        }
    }

    /// Changes the light, within the bounds that light files are read with.
    pub(super) fn set(self, light: &mut Light, curve: &Curve, time: f64) {
        let number = curve.first_at(time) as f32;
        match (self, &mut light.kind) {
            (LightProperty::Color, _) => light.color = color_at(curve, time),
            // luch's intensity is what a white matt surface shows.
            (LightProperty::Intensity, _) => {
                light.intensity = curve.first_at(time).clamp(0.0, BRIGHTEST) as f32 / PI;
            }
            (LightProperty::Range, _) => {
                light.range = Some(number).filter(|&range| range > 0.0 && range.is_finite());
            }
            (
                LightProperty::InnerConeAngle,
                LightKind::Spot {
                    inner_angle,
                    outer_angle,
                    ..
                },
            ) => *inner_angle = number.clamp(0.0, *outer_angle * 0.999),
            (
                LightProperty::OuterConeAngle,
                LightKind::Spot {
                    inner_angle,
                    outer_angle,
                    ..
                },
            ) => {
                // A cone without width would divide by nothing.
                *outer_angle = number.clamp(1e-4, FRAC_PI_2);
                *inner_angle = inner_angle.min(*outer_angle * 0.999);
            }
            (LightProperty::InnerConeAngle | LightProperty::OuterConeAngle, _) => {}
        }
    }
}

impl CameraProperty {
    /// Changes the camera; what makes no camera leaves it as it is.
    pub(super) fn set(self, camera: &mut ModelCamera, curve: &Curve, time: f64) {
        let number = curve.first_at(time);
        let length = number as f32;
        match (self, &mut camera.projection) {
            (CameraProperty::FovY, Projection::Perspective { fov })
                if number > 0.0 && length < PI =>
            {
                *fov = Fov::Y(number);
            }
            (CameraProperty::HalfHeight, Projection::Orthographic { half_height, .. })
                if length != 0.0 && length.is_finite() =>
            {
                *half_height = length.abs();
            }
            (CameraProperty::Near, _) if length >= 0.0 && length < camera.far => {
                camera.near = length;
            }
            (CameraProperty::Far, _) if length > camera.near => camera.far = length,
            _ => {}
        }
    }
}

fn color_at(curve: &Curve, time: f64) -> Rgb {
    let [r, g, b] = curve
        .three_at(time)
        .map(|channel| channel.clamp(0.0, BRIGHTEST) as f32);
    Rgb::new(r, g, b)
}
