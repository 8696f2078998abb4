//! KHR_implicit_shapes: spheres and planes without triangles.
//!
//! The extension lists shapes and leaves their use to others. Here a node shows one that it names itself:
//! `"extensions": {"KHR_implicit_shapes": {"shape": 0, "material": 1}}`, the material being the file's default where it
//! is not said. Colliders of KHR_physics_rigid_bodies are not for the eye, but they are shown where a file has nothing
//! else to show. Boxes, cylinders and capsules are left out with a warning.

use super::Warnings;
use super::document::Document;
use super::extensions;
use crate::Error;
use crate::load::{Analytic, AnalyticKind};
use serde_json::{Map, Value};

/// As files call it.
pub(super) const NAME: &str = "KHR_implicit_shapes";
/// What it is used by.
const PHYSICS: &str = "KHR_physics_rigid_bodies";

/// The shapes of a file.
#[derive(Debug)]
pub(super) struct Shapes {
    /// By their index in the file; `None` where one is left out.
    shapes: Vec<Option<(AnalyticKind, bool)>>,
    /// How many there are, the default last.
    materials: usize,
    /// Whether colliders are shown.
    colliders: bool,
}

#[derive(serde::Deserialize)]
struct List {
    shapes: Vec<Value>,
}

#[derive(serde::Deserialize)]
struct ShapeJson {
    #[serde(rename = "type")]
    kind: String,
    #[serde(default)]
    sphere: SphereJson,
    #[serde(default)]
    plane: PlaneJson,
}

#[derive(serde::Deserialize)]
#[serde(default)]
struct SphereJson {
    radius: f32,
}

impl Default for SphereJson {
    fn default() -> SphereJson {
        SphereJson { radius: 0.5 }
    }
}

#[derive(Default, serde::Deserialize)]
#[serde(rename_all = "camelCase", default)]
struct PlaneJson {
    size_x: Option<f32>,
    size_z: Option<f32>,
    double_sided: bool,
}

/// What a node says: which shape it shows, and of what.
#[derive(serde::Deserialize)]
struct OfNode {
    shape: u64,
    material: Option<u64>,
}

impl Shapes {
    /// The shapes of a file whose materials are `materials` with the default.
    pub(super) fn read(
        document: &Document,
        materials: usize,
        colliders: bool,
        warnings: &mut Warnings,
    ) -> Shapes {
        let others = document.root.extensions.as_ref().map(|e| &e.others);
        let list = extensions::read::<List>(others, NAME).unwrap_or_else(|problem| {
            warnings.add(format!("{NAME}: {problem}: its shapes are left out"));
            None
        });
        let list = list.map(|list| list.shapes).unwrap_or_default();
        let mut shapes = Vec::with_capacity(list.len());
        for (index, shape) in list.iter().enumerate() {
            let read = serde::Deserialize::deserialize(shape)
                .map_err(|error: serde_json::Error| error.to_string())
                .and_then(kind);
            shapes.push(
                read.map_err(|problem| {
                    let problem = super::document::one_line(&problem);
                    warnings.add(format!("{NAME}, shape {index}: {problem}: it is left out"));
                })
                .ok(),
            );
        }
        Shapes {
            shapes,
            materials,
            colliders,
        }
    }

    /// The shape that a node shows.
    ///
    /// # Errors
    ///
    /// It names a shape or a material that does not exist.
    pub(super) fn of_node(
        &self,
        document: &Document,
        node: Option<&Map<String, Value>>,
        place: &str,
        warnings: &mut Warnings,
    ) -> Result<Option<Analytic>, Error> {
        let of_node = extensions::read::<OfNode>(node, NAME).unwrap_or_else(|problem| {
            warnings.add(format!("{place}: {problem}: its shape is left out"));
            None
        });
        let collider = || {
            let shape = node?.get(PHYSICS)?.pointer("/collider/geometry/shape")?;
            let shape = shape.as_u64()?;
            let material = None;
            Some(OfNode { shape, material })
        };
        let collider = || {
            let collider = collider().filter(|_| self.colliders)?;
            warnings.add("shows colliders, since it has no mesh to show");
            Some(collider)
        };
        let Some(used) = of_node.or_else(collider) else {
            return Ok(None);
        };
        let checked = |kind: &str, index: u64, count: usize| {
            let index = usize::try_from(index).unwrap_or(usize::MAX);
            document.checked(place, kind, index, count)
        };
        let default = self.materials.saturating_sub(1);
        let material = match used.material {
            Some(index) => checked("material", index, default)?,
            None => default,
        };
        let shape = checked("implicit shape", used.shape, self.shapes.len())?;
        let shape = self.shapes.get(shape).copied().flatten();
        Ok(shape.map(|(kind, double_sided)| Analytic {
            kind,
            double_sided,
            material: material as u32,
        }))
    }
}

/// A shape, and whether it is seen from behind in any case.
fn kind(json: ShapeJson) -> Result<(AnalyticKind, bool), String> {
    let size = |name: &str, size: f32| {
        if size > 0.0 && size.is_finite() {
            Ok(size)
        } else {
            Err(format!("its {name} is {size}, expected a number above 0"))
        }
    };
    let plane = &json.plane;
    match (json.kind.as_str(), plane.size_x, plane.size_z) {
        ("sphere", ..) => {
            let radius = size("radius", json.sphere.radius)?;
            Ok((AnalyticKind::Sphere { radius }, false))
        }
        ("plane", None, None) => Ok((AnalyticKind::Plane, plane.double_sided)),
        ("plane", Some(x), Some(z)) => {
            let sides = [size("sizeX", x)?, size("sizeZ", z)?];
            Ok((AnalyticKind::Rectangle { sides }, plane.double_sided))
        }
        ("plane", ..) => Err("it is endless to one side only, which is not supported".into()),
        (other, ..) => Err(format!("a {other} is no shape that luch draws")),
    }
}
