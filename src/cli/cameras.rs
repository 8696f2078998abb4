//! `luch render --list-cameras`: what `--camera` can be given.

use super::arguments::RenderArguments;
use super::render::open;
use super::{Failure, print};
use luch::camera::{Fov, Projection};
use luch::load::PlacedCamera;
use serde::Serialize;

/// A camera of a model: the fields of `--json`.
#[derive(Serialize)]
struct Listed {
    index: usize,
    name: String,
    node: String,
    kind: &'static str,
    /// In degrees; of a perspective camera alone.
    vertical_fov: Option<f64>,
    position: [f64; 3],
    look_at: [f64; 3],
}

/// Lists the cameras of the file's models.
pub(super) fn list(arguments: &RenderArguments) -> Result<(), Failure> {
    let asset = open(arguments)?;
    let cameras: Vec<Listed> = (0..).zip(asset.cameras()).map(Listed::of).collect();
    if arguments.json {
        return print::json(&cameras);
    }
    let none = ["none in the file; without one, luch frames the model".to_owned()];
    let lines: Vec<String> = cameras.iter().map(Listed::in_words).collect();
    let lines = if lines.is_empty() { &none[..] } else { &lines };
    let text: String = lines
        .iter()
        .map(|line| print::one_line(line) + "\n")
        .collect();
    print::to_stdout(text.as_bytes())
}

impl Listed {
    fn of((index, placed): (usize, PlacedCamera)) -> Listed {
        let camera = placed.camera;
        let (kind, vertical_fov) = match camera.projection {
            Projection::Perspective { fov } => ("perspective", vertical(fov)),
            Projection::Orthographic { .. } => ("orthographic", None),
        };
        Listed {
            index,
            name: placed.name,
            node: placed.node,
            kind,
            vertical_fov: vertical_fov.map(f64::to_degrees),
            position: camera.position.to_array(),
            look_at: camera.look_at.to_array(),
        }
    }

    fn in_words(&self) -> String {
        let kind = match self.vertical_fov {
            Some(fov) => format!("{}, {fov:.1} degrees", self.kind),
            None => self.kind.to_owned(),
        };
        let [x, y, z] = self.position;
        let Listed {
            index, name, node, ..
        } = self;
        let node = match node.as_str() {
            "" => String::new(),
            same if same == name => String::new(),
            node => format!(", node \"{node}\""),
        };
        format!("{index} \"{name}\"{node}: {kind}, at {x:.3}, {y:.3}, {z:.3}")
    }
}

fn vertical(fov: Fov) -> Option<f64> {
    match fov {
        Fov::Y(y) | Fov::Both(_, y) => Some(y),
        Fov::X(_) => None,
    }
}
