//! `luch info`: what is in a file, and what luch makes of it.

mod animation;
mod model;
mod scene_file;

use super::Failure;
use super::arguments::InfoArguments;
use super::print::{self, counted};
use luch::load::{self, Asset, Viewpoint};
use luch::scene::Scene;
use model::ModelInfo;
use scene_file::SceneFileInfo;
use serde::Serialize;

/// What is in a file: the fields of `--json`.
#[derive(Serialize)]
struct Info {
    file: String,
    /// What the file says itself, where it is a scene file.
    scene_file: Option<SceneFileInfo>,
    /// The model, or those that a scene file places, each placing once.
    models: Vec<ModelInfo>,
    /// Parts of meshes in their places.
    instances: usize,
    drawn: Drawn,
    /// Least and greatest corner in the world; `None` where nothing has bounds.
    bounds: Option<[[f32; 3]; 2]>,
    warnings: Vec<String>,
}

/// What stands in the scene, each thing as often as it is placed.
#[derive(Serialize)]
struct Drawn {
    triangles: u64,
    spheres: u64,
    planes: u64,
    lights: u64,
}

/// A line: what it is about, and what is said of it.
type Line = (&'static str, String);

/// Tells what is in a file.
pub(super) fn run(arguments: &InfoArguments) -> Result<(), Failure> {
    let options = load::Options {
        animation: arguments.animation.choice(),
        ..arguments.reading.options()
    };
    let asset = load::open(&arguments.input, &options).map_err(Failure::usage_or_scene)?;
    let viewpoint = Viewpoint::of_file(1.0);
    let (scene, _) = asset
        .scene(arguments.animation.time(), &viewpoint)
        .map_err(Failure::usage_or_scene)?;
    let info = Info::of(&asset, &scene);
    if arguments.json {
        return print::json(&info);
    }
    print::to_stdout(info.in_words().as_bytes())
}

impl Info {
    fn of(asset: &Asset, scene: &Scene) -> Info {
        let models = asset.models.iter().map(|placed| &placed.model);
        let bounds = scene.bounds();
        Info {
            file: print::path(&asset.file),
            scene_file: asset.is_scene_file.then(|| SceneFileInfo::of(asset)),
            models: models.map(ModelInfo::of).collect(),
            instances: scene.instances().len(),
            drawn: Drawn::of(asset, scene),
            bounds: (!bounds.is_empty()).then(|| [bounds.min.to_array(), bounds.max.to_array()]),
            warnings: asset.warnings.iter().map(ToString::to_string).collect(),
        }
    }

    fn in_words(&self) -> String {
        let mut lines: Vec<Line> = Vec::new();
        if let Some(scene_file) = &self.scene_file {
            lines.extend(scene_file.in_words());
        }
        for model in &self.models {
            if self.scene_file.is_some() {
                lines.push(("model", model.file.clone()));
            }
            lines.extend(model.in_words());
        }
        lines.push(("instances", self.instances.to_string()));
        lines.push(("drawn", self.drawn.in_words()));
        let bounds = self.bounds.map_or("none".into(), |[min, max]| {
            format!("({}) to ({})", point(min), point(max))
        });
        lines.push(("bounds", bounds));
        let warnings = self.warnings.iter();
        lines.extend(warnings.map(|warning| ("warning", warning.clone())));
        let lines = lines
            .iter()
            .map(|(what, text)| format!("  {what:<11} {}\n", print::one_line(text)));
        lines.fold(print::one_line(&self.file) + "\n", |text, line| {
            text + &line
        })
    }
}

impl Drawn {
    fn of(asset: &Asset, scene: &Scene) -> Drawn {
        let [spheres, planes] = [scene.spheres().len(), scene.planes().len()].map(|n| n as u64);
        // Not the scene's own: those include luch's, for a file without any.
        let of_models = asset.models.iter().flat_map(|m| m.model.placed_nodes());
        let of_models = of_models.filter(|(node, _)| node.light.is_some()).count();
        Drawn {
            triangles: u64::from(scene.primitive_count()) - spheres - planes,
            spheres,
            planes,
            lights: (asset.lights.len() + of_models) as u64,
        }
    }

    fn in_words(&self) -> String {
        let kinds = [
            (self.triangles, "triangle", "triangles"),
            (self.spheres, "sphere", "spheres"),
            (self.planes, "plane", "planes"),
            (self.lights, "light", "lights"),
        ];
        let there = kinds.into_iter().filter(|(count, ..)| *count > 0);
        let there: Vec<String> = there
            .map(|(count, one, many)| counted(count, one, many))
            .collect();
        there.join(", ")
    }
}

/// A point in six significant digits.
fn point(p: [f32; 3]) -> String {
    let rounded = p.map(|x| {
        format!("{x:.5e}")
            .parse()
            .unwrap_or(f64::from(x))
            .to_string()
    });
    rounded.join(", ")
}

/// How many, and the names of the first few.
fn listed<S: AsRef<str>>(names: &[S]) -> String {
    const SHOWN: usize = 8;
    let named: Vec<&str> = names
        .iter()
        .map(AsRef::as_ref)
        .filter(|name| !name.is_empty())
        .take(SHOWN)
        .collect();
    match (names.len(), named.len()) {
        (count, 0) => count.to_string(),
        (count, shown) if count > shown => format!("{count}: {}, ...", named.join(", ")),
        (count, _) => format!("{count}: {}", named.join(", ")),
    }
}
