//! `--layers`: the layers of a film by their names, and by the names of groups.

use super::Failure;
use super::arguments::RenderArguments;
use luch::film::Layers;
use luch::render::Settings;
use luch::scene::Scene;

/// Every word, and what it asks for.
const WORDS: [(&str, fn(&mut Layers)); 9] = [
    ("beauty", |_| {}),
    ("data", |layers| layers.depth = true),
    ("Z", |layers| layers.depth = true),
    ("components", |layers| layers.components = true),
    // As many as the scene has: [`fitted`].
    ("lights", |layers| layers.lights = Some(0)),
    ("bounces", |layers| layers.bounces = MOST_BOUNCES),
    ("cost", |layers| layers.cost = true),
    ("samples", |layers| layers.samples = true),
    ("all", |layers| {
        *layers = Layers {
            depth: true,
            cost: true,
            samples: true,
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

/// The settings with a layer for each lamp of the scene where they ask for such, and for no more mirrors than light may
/// meet.
pub(super) fn fitted(
    settings: Settings,
    scene: &Scene,
    arguments: &RenderArguments,
) -> Result<Settings, Failure> {
    let asked = arguments.layers.unwrap_or_default();
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
                ..Layers::NONE
            })
        };
        assert_eq!(parse("beauty"), asked(false, false));
        assert_eq!(parse("beauty, cost"), asked(false, true));
        assert_eq!(parse("cost,Z,beauty"), asked(true, true));
        assert_eq!(parse("beauty,data"), Ok(Layers::default()));
        assert!(parse("beauty,samples").is_ok_and(|layers| layers.samples && !layers.depth));
        assert!(parse("all").is_ok_and(|layers| layers.components && layers.cost));
        assert_eq!(
            parse("cost"),
            Err("beauty is in every picture; ask for beauty,cost".into())
        );
        assert_eq!(
            parse("beauty,normals"),
            Err("there is no layer \"normals\"; known are beauty, data, Z, components, lights, bounces, cost, samples, all, with commas between".into())
        );
        for wrong in ["", "beauty,", "Beauty", "beauty;cost"] {
            assert!(parse(wrong).is_err(), "{wrong}");
        }
    }
}
