//! `luch info`: what is in a file, and what luch makes of it.

use super::arguments::InfoArguments;
use super::{Failure, print_bytes};
use indicatif::HumanCount;
use luch::load::{self, Asset, CameraChoice, Model, Viewpoint};
use serde::Serialize;
use std::path::PathBuf;

/// What is in a file.
#[derive(Serialize)]
struct Info {
    file: PathBuf,
    models: Vec<ModelInfo>,
    spheres: usize,
    planes: usize,
    /// In the whole, each light once for every node that places it.
    lights: usize,
    /// Parts of meshes in their places.
    instances: usize,
    /// Of all instances.
    triangles_drawn: u64,
    /// Least and greatest corner in the world; `None` where nothing has bounds.
    bounds: Option<[[f32; 3]; 2]>,
    warnings: Vec<String>,
}

#[derive(Serialize)]
struct ModelInfo {
    file: PathBuf,
    format: String,
    scenes: Vec<String>,
    nodes: usize,
    meshes: Vec<String>,
    triangles: usize,
    points: usize,
    lines: usize,
    materials: Vec<String>,
    textures: Vec<Texture>,
    lights: Vec<String>,
    cameras: Vec<String>,
    animations: Vec<String>,
    extensions: Vec<Extension>,
}

#[derive(Serialize)]
struct Texture {
    name: String,
    /// Width and height; `None` where it could not be read.
    size: Option<(u32, u32)>,
}

#[derive(Serialize)]
struct Extension {
    name: String,
    required: bool,
    honoured: bool,
}

/// Tells what is in a file.
pub(super) fn run(arguments: &InfoArguments) -> Result<(), Failure> {
    let asset = load::open(&arguments.input).map_err(Failure::usage_or_scene)?;
    let info = Info::of(&asset)?;
    if arguments.json {
        let json = serde_json::to_string_pretty(&info).map_err(Failure::output)?;
        return print_bytes(format!("{json}\n").as_bytes());
    }
    print_bytes(info.in_words().as_bytes())
}

impl Info {
    fn of(asset: &Asset) -> Result<Info, Failure> {
        let viewpoint = Viewpoint {
            aspect: 1.0,
            camera: CameraChoice::OfFile,
            fov_y: None,
            background: None,
            exposure: None,
        };
        let (scene, _) = asset
            .scene(0.0, &viewpoint)
            .map_err(Failure::usage_or_scene)?;
        let bounds = scene.bounds();
        let analytic = (scene.spheres().len() + scene.planes().len()) as u64;
        let placed = |m: &Model| {
            m.placed_nodes()
                .iter()
                .filter(|(node, _)| node.light.is_some())
                .count()
        };
        Ok(Info {
            file: asset.file.clone(),
            models: asset
                .models
                .iter()
                .map(|placed| ModelInfo::of(&placed.model))
                .collect(),
            spheres: scene.spheres().len(),
            planes: scene.planes().len(),
            lights: asset.lights.len()
                + asset.models.iter().map(|m| placed(&m.model)).sum::<usize>(),
            instances: scene.instances().len(),
            triangles_drawn: u64::from(scene.primitive_count()) - analytic,
            bounds: (!bounds.is_empty()).then(|| [bounds.min.to_array(), bounds.max.to_array()]),
            warnings: asset.warnings.iter().map(ToString::to_string).collect(),
        })
    }

    fn in_words(&self) -> String {
        let mut lines = vec![self.file.display().to_string()];
        for model in &self.models {
            lines.extend(model.in_words(&self.file));
        }
        if self.spheres + self.planes > 0 {
            lines.push(format!("  spheres     {}", self.spheres));
            lines.push(format!("  planes      {}", self.planes));
        }
        lines.push(format!(
            "  instances   {}, {} triangles in all",
            self.instances,
            HumanCount(self.triangles_drawn)
        ));
        lines.push(format!("  lights on   {}", self.lights));
        if let Some([min, max]) = self.bounds {
            let point = |p: [f32; 3]| p.map(|x| x.to_string()).join(", ");
            lines.push(format!(
                "  bounds      ({}) to ({})",
                point(min),
                point(max)
            ));
        }
        lines.extend(
            self.warnings
                .iter()
                .map(|warning| format!("  warning     {warning}")),
        );
        lines.join("\n") + "\n"
    }
}

impl ModelInfo {
    fn of(model: &Model) -> ModelInfo {
        let facts = &model.facts;
        let texture = |t: &load::TextureFacts| Texture {
            name: t.name.clone(),
            size: t.size,
        };
        let extension = |e: &load::ExtensionFacts| Extension {
            name: e.name.clone(),
            required: e.required,
            honoured: e.honoured,
        };
        // The last material is luch's own, for parts without one.
        let materials = model.materials.len().saturating_sub(1);
        ModelInfo {
            file: model.file.clone(),
            format: facts.format.clone(),
            scenes: facts.scenes.clone(),
            nodes: model.nodes.len(),
            meshes: model
                .shapes
                .iter()
                .map(|shape| shape.name.clone())
                .collect(),
            triangles: facts.triangles,
            points: facts.points,
            lines: facts.lines,
            materials: model
                .materials
                .iter()
                .take(materials)
                .map(|m| m.name.clone())
                .collect(),
            textures: facts.textures.iter().map(texture).collect(),
            lights: model
                .lights
                .iter()
                .map(|light| light.name.clone())
                .collect(),
            cameras: model
                .cameras
                .iter()
                .map(|camera| camera.name.clone())
                .collect(),
            animations: facts.animations.clone(),
            extensions: facts.extensions.iter().map(extension).collect(),
        }
    }

    fn in_words(&self, of_file: &PathBuf) -> Vec<String> {
        let mut lines = Vec::new();
        if &self.file != of_file {
            lines.push(format!("  model       {}", self.file.display()));
        }
        let mut say = |what: &str, text: String| lines.push(format!("  {what:<11} {text}"));
        say("format", self.format.clone());
        say("scenes", listed(&self.scenes));
        say("nodes", self.nodes.to_string());
        say("meshes", listed(&self.meshes));
        say("triangles", HumanCount(self.triangles as u64).to_string());
        if self.points + self.lines > 0 {
            say(
                "not drawn",
                format!("{} points, {} lines", self.points, self.lines),
            );
        }
        say("materials", listed(&self.materials));
        let size = |t: &Texture| {
            t.size
                .map_or("unreadable".into(), |(w, h)| format!("{w} x {h}"))
        };
        let textures: Vec<String> = self
            .textures
            .iter()
            .map(|t| format!("{} ({})", t.name, size(t)))
            .collect();
        say("textures", listed(&textures));
        say("lights", listed(&self.lights));
        say("cameras", listed(&self.cameras));
        say("animations", listed(&self.animations));
        for extension in &self.extensions {
            let required = if extension.required {
                "required"
            } else {
                "used"
            };
            let honoured = if extension.honoured {
                "honoured"
            } else {
                "ignored"
            };
            say(
                "extension",
                format!("{} ({required}, {honoured})", extension.name),
            );
        }
        lines
    }
}

/// How many, and the names of the first few.
fn listed(names: &[String]) -> String {
    const SHOWN: usize = 8;
    let named: Vec<&str> = names
        .iter()
        .map(String::as_str)
        .filter(|name| !name.is_empty())
        .take(SHOWN)
        .collect();
    match (names.len(), named.len()) {
        (count, 0) => count.to_string(),
        (count, shown) if count > shown => format!("{count}: {}, ...", named.join(", ")),
        (count, _) => format!("{count}: {}", named.join(", ")),
    }
}
