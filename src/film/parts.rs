//! The layers that the light of the beauty is told apart into: each kind adds up to the beauty.

use super::{Combine, Layer, Layers, Precision, Quantity};
use crate::light::Light;
use std::borrow::Cow;
use std::collections::HashSet;

/// What happened to light on its way to the camera, by the names of the layers.
///
/// `reflection` and `transmission` hold all that came by a mirror or through glass first, seen from the camera; the others
/// what is seen itself: light of lamps and of the environment as surfaces scatter it, their highlights and their gloss,
/// what shines by itself and the background where it is part of the picture, and constant ambient light.
pub const COMPONENTS: [&str; 6] = [
    "diffuse",
    "specular",
    "reflection",
    "transmission",
    "emission",
    "ambient",
];

/// Where light comes from that comes from no lamp, by the names of the layers: each by whatever path it came.
pub const FROM_NO_LAMP: [&str; 4] = [
    "light_emission",
    "light_ambient",
    "light_environment",
    "light_background",
];

/// Where light comes from.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Source {
    /// One of the scene's lamps.
    Lamp(u32),
    /// Surfaces that shine by themselves.
    Emission,
    /// Constant ambient light.
    Ambient,
    /// The environment.
    Environment,
    /// The background's colour.
    Background,
}

impl Layers {
    /// How many parts light has.
    pub fn parts(&self) -> usize {
        self.of_components() + self.of_lights() + self.bounces as usize
    }

    fn of_components(&self) -> usize {
        if self.components { COMPONENTS.len() } else { 0 }
    }

    fn of_lights(&self) -> usize {
        let count = |lamps: u32| lamps as usize + FROM_NO_LAMP.len();
        self.lights.map_or(0, count)
    }

    /// The part of a component, by its place in [`COMPONENTS`].
    pub(crate) fn component(&self, component: usize) -> Option<usize> {
        self.components.then_some(component)
    }

    /// The part of what comes from somewhere.
    pub(crate) fn source(&self, source: Source) -> Option<usize> {
        let lamps = self.lights?;
        let number = match source {
            Source::Lamp(number) => number.min(lamps.saturating_sub(1)),
            Source::Emission => lamps,
            Source::Ambient => lamps + 1,
            Source::Environment => lamps + 2,
            Source::Background => lamps + 3,
        };
        Some(self.of_components() + number as usize)
    }

    /// The part of what came by so many mirrors, above zero.
    pub(crate) fn mirrored(&self, bounces: u16) -> Option<usize> {
        let number = u32::from(bounces).min(self.bounces).checked_sub(1)?;
        Some(self.of_components() + self.of_lights() + number as usize)
    }

    /// The layers of all parts, in order, still without values. Lamps without a name, with one that others have, or with
    /// letters that files cannot have, get one that is like it.
    pub fn of_parts(&self, lights: &[Light]) -> Vec<Layer> {
        let mut names: Vec<Cow<'static, str>> = Vec::new();
        if self.components {
            names.extend(COMPONENTS.map(Cow::Borrowed));
        }
        if let Some(lamps) = self.lights {
            let lamps = names_of(lights).into_iter().take(lamps as usize);
            names.extend(lamps.map(Cow::Owned));
            names.extend(FROM_NO_LAMP.map(Cow::Borrowed));
        }
        let mirrors = 1..=self.bounces;
        names.extend(mirrors.map(|bounces| Cow::Owned(format!("reflection_{bounces}"))));
        let layer = |(part, name)| Layer {
            name,
            quantity: Quantity::Part(part),
            channels: &["R", "G", "B"],
            precision: Precision::Half,
            unit: "linear Rec. 709",
            combine: Combine::Mean,
            values: Vec::new(),
        };
        names.into_iter().enumerate().map(layer).collect()
    }
}

/// A name for each lamp, `light_` before its own.
fn names_of(lights: &[Light]) -> Vec<String> {
    let mut taken: HashSet<String> = FROM_NO_LAMP.map(String::from).into();
    let mut names = Vec::new();
    for (number, light) in (1..).zip(lights) {
        let letter = |c: char| if c.is_ascii_alphanumeric() { c } else { '_' };
        let own: String = light.name.chars().map(letter).collect();
        let first = match own.as_str() {
            "" => format!("light_{number}"),
            own => format!("light_{own}"),
        };
        let mut name = first.clone();
        let mut again = 2u32;
        while !taken.insert(name.clone()) {
            name = format!("{first}_{again}");
            again += 1;
        }
        names.push(name);
    }
    names
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::color::Rgb;
    use crate::light::{Falloff, LightKind};
    use glam::Vec3;

    fn lamp(name: &str) -> Light {
        Light {
            name: name.into(),
            kind: LightKind::Directional {
                direction: Vec3::NEG_Y,
            },
            color: Rgb::WHITE,
            intensity: 1.0,
            falloff: Falloff::None,
            range: None,
        }
    }

    #[test]
    fn every_lamp_has_a_name_of_its_own_that_files_can_have() {
        let lamps = ["key", "", "key", "environment", "Лампа 1", "key_2"].map(lamp);
        assert_eq!(
            names_of(&lamps),
            [
                "light_key",
                "light_2",
                "light_key_2",
                "light_environment_2",
                "light_______1",
                "light_key_2_2"
            ]
        );
    }

    #[test]
    fn every_part_has_a_layer_and_every_layer_a_part() {
        let layers = Layers {
            components: true,
            lights: Some(2),
            bounces: 3,
            ..Layers::default()
        };
        let list = layers.of_parts(&["a", "b"].map(lamp));
        assert_eq!(list.len(), layers.parts());
        let part = |name: &str| list.iter().position(|layer| layer.name == name);
        assert_eq!(part("emission"), layers.component(4));
        assert_eq!(part("light_b"), layers.source(Source::Lamp(1)));
        assert_eq!(part("light_background"), layers.source(Source::Background));
        assert_eq!(part("reflection_3"), layers.mirrored(9));
        assert_eq!(part("reflection_1"), layers.mirrored(1));
        assert_eq!(Layers::default().parts(), 0);
    }
}
