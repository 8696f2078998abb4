//! `--layers`: the layers of a film by their names, and by the names of groups.

use super::Failure;
use super::arguments::{RenderArguments, is_stdout};
use luch::film::Layers;
use luch::output::Format;
use luch::render::Settings;
use luch::scene::Scene;
use std::path::PathBuf;

/// Every word, and what it asks for.
const WORDS: [(&str, fn(&mut Layers)); 14] = [
    ("beauty", |_| {}),
    ("data", |layers| {
        *layers = Layers {
            depth: true,
            normal: true,
            position: true,
            uv: true,
            albedo: true,
            ..*layers
        }
    }),
    ("Z", |layers| layers.depth = true),
    ("N", |layers| layers.normal = true),
    ("P", |layers| layers.position = true),
    ("UV", |layers| layers.uv = true),
    ("albedo", |layers| layers.albedo = true),
    ("cryptomatte", |layers| layers.mattes = true),
    ("components", |layers| layers.components = true),
    // As many as the scene has: [`fitted`].
    ("lights", |layers| layers.lights = Some(0)),
    ("bounces", |layers| layers.bounces = MOST_BOUNCES),
    ("cost", |layers| {
        layers.cost = true;
        layers.samples = true;
    }),
    ("samples", |layers| layers.samples = true),
    ("all", |layers| {
        *layers = Layers {
            depth: true,
            cost: true,
            samples: true,
            normal: true,
            position: true,
            uv: true,
            albedo: true,
            mattes: true,
            components: true,
            lights: Some(0),
            bounces: MOST_BOUNCES,
        }
    }),
];

/// Mirrors behind mirrors beyond these share a layer.
const MOST_BOUNCES: u32 = 8;

/// The layers of a film, by their names.
pub(super) fn parse(text: &str) -> Result<Layers, String> {
    let mut layers = Layers::NONE;
    let mut beauty = false;
    for word in text.split(',').map(str::trim) {
        let Some((name, ask)) = WORDS.iter().find(|(name, _)| *name == word) else {
            let names = WORDS.map(|(name, _)| name).join(", ");
            return Err(format!(
                "there is no layer {word:?}; known are {names}, with commas between"
            ));
        };
        ask(&mut layers);
        beauty |= ["beauty", "all"].contains(name);
    }
    if beauty {
        Ok(layers)
    } else {
        Err(format!("beauty is in every picture; ask for beauty,{text}"))
    }
}

/// What the arguments ask for: what compositors use most, if it is for an EXR and they say nothing.
pub(super) fn asked(arguments: &RenderArguments) -> Layers {
    let exr = |path: &PathBuf| match is_stdout(path) {
        true => Format::from(arguments.format) == Format::Exr,
        false => Format::of(path).is_ok_and(|format| format == Format::Exr),
    };
    let usual = match arguments.outputs.iter().any(exr) {
        true => Layers::FOR_EXR,
        false => Layers::NONE,
    };
    arguments.layers.unwrap_or(usual)
}

/// The settings with a layer for each lamp of the scene where they ask for such, and for no more mirrors than light may
/// meet.
pub(super) fn fitted(
    settings: Settings,
    scene: &Scene,
    arguments: &RenderArguments,
) -> Result<Settings, Failure> {
    let asked = asked(arguments);
    let layers = Layers {
        lights: asked.lights.map(|_| scene.lights().len() as u32),
        bounces: asked.bounces.min(settings.max_depth()),
        ..asked
    };
    let fitted = settings.with_layers(layers);
    fitted.map_err(Failure::usage_or_scene)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn layers_are_known_names_and_the_beauty_is_one_of_them() {
        let asked = |depth, cost| {
            Ok(Layers {
                depth,
                cost,
                samples: cost,
                ..Layers::NONE
            })
        };
        assert_eq!(parse("beauty"), asked(false, false));
        assert_eq!(parse("beauty, cost"), asked(false, true));
        assert_eq!(parse("cost,Z,beauty"), asked(true, true));
        assert_eq!(parse("beauty,Z,N,albedo,cryptomatte"), Ok(Layers::FOR_EXR));
        assert_eq!(parse("beauty,data"), parse("P,Z,N,UV,albedo,beauty"));
        assert!(parse("beauty,samples").is_ok_and(|layers| layers.samples && !layers.depth));
        assert!(parse("all").is_ok_and(|layers| layers.components && layers.cost));
        assert_eq!(
            parse("cost"),
            Err("beauty is in every picture; ask for beauty,cost".into())
        );
        assert_eq!(
            parse("beauty,normals"),
            Err("there is no layer \"normals\"; known are beauty, data, Z, N, P, UV, albedo, cryptomatte, components, lights, bounces, cost, samples, all, with commas between".into())
        );
        for wrong in ["", "beauty,", "Beauty", "beauty;cost"] {
            assert!(parse(wrong).is_err(), "{wrong}");
        }
    }
}
