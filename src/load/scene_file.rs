//! Scene files: the paper's scenes and others, written by hand in TOML.
//!
//! Angles are in degrees, colours linear, lengths in the scene's unit, paths relative to the file. Every key that is not
//! known is an error, so that a slip of the pen never renders as something else.

mod camera;
mod environment;
mod kind;
mod lights;
mod materials;
mod models;
mod nearest;
mod picture;
mod shapes;
mod source;
mod table;
mod transmission;

use super::{Asset, Budget, CameraSource, Model, Options, animated, files, gltf, obj, text_bytes};
use crate::Error;
use materials::Materials;
use models::Models;
use source::Source;
use std::path::Path;
use table::Table;

/// What may stand at the top of a scene file.
const TABLES: [&str; 10] = [
    "camera",
    "render",
    "background",
    "ambient",
    "environment",
    "material",
    "sphere",
    "plane",
    "model",
    "light",
];

/// Opens a scene file.
///
/// # Errors
///
/// The file or a model it names cannot be read, is not UTF-8 or TOML, has a key or a value that makes no sense, draws
/// nothing, or says neither where to look from nor names a model to look at.
pub fn open(path: &Path, options: &Options) -> Result<Asset, Error> {
    let budget = Budget::of(options);
    let text = source::decode(path, files::read(path, &budget)?)?;
    let open_model = |path: &Path| open_model(path, options, &budget);
    let mut asset = parse_with(&text, path, &budget, open_model)?;
    asset.files.insert(0, path.to_owned());
    Ok(asset)
}

/// Reads a scene from `text`; errors name it `path`, whose folder is where the paths of its models start.
///
/// # Errors
///
/// Those of [`open`], as far as they are not about the file itself.
pub fn parse(text: &str, path: &Path, options: &Options) -> Result<Asset, Error> {
    let budget = Budget::of(options);
    let asset = parse_with(text, path, &budget, |path| {
        open_model(path, options, &budget)
    })?;
    animated::check(asset, options)
}

/// [`parse`] with another way to open a model.
fn parse_with(
    text: &str,
    path: &Path,
    budget: &Budget,
    open_model: impl FnMut(&Path) -> Option<Result<Model, Error>>,
) -> Result<Asset, Error> {
    let taken = text_bytes::of_toml(text.as_bytes());
    budget
        .take(taken)
        .map_err(|problem| problem.of(path, "its TOML"))?;
    let asset = read(text, path, budget, open_model);
    budget.give_back(taken);
    asset
}

fn read(
    text: &str,
    path: &Path,
    budget: &Budget,
    open_model: impl FnMut(&Path) -> Option<Result<Model, Error>>,
) -> Result<Asset, Error> {
    let source = Source { file: path, text };
    let document = source.document()?;
    let root = Table::root(&source, &document, &TABLES)?;
    let materials = Materials::read(&root)?;
    let spheres = shapes::spheres(&root, &materials)?;
    let planes = shapes::planes(&root, &materials)?;
    let lights = lights::read(&root)?;
    let background = picture::color_of(&root, &picture::BACKGROUND)?;
    let ambient = picture::color_of(&root, &picture::AMBIENT)?;
    let environment = environment::read(&root, path)?;
    let picture = picture::read(&root)?;
    let camera = camera::read(&root)?;
    let models = Models::open(&root, &materials, path, budget, open_model)?;
    if spheres.is_empty() && planes.is_empty() && models.placed.is_empty() {
        let problem = "has nothing to draw; write a [[sphere]], a [[plane]] or a [[model]]";
        return Err(Error::malformed(path, "", problem));
    }
    match &camera {
        Some(CameraSource::OfModel(name)) => camera::check_name(name, &root, &models)?,
        None if models.placed.is_empty() => {
            let problem =
                "has no [camera]; write one with position = [x, y, z] and look_at = [x, y, z]";
            return Err(Error::malformed(path, "", problem));
        }
        _ => {}
    }
    Ok(Asset {
        file: path.to_owned(),
        is_scene_file: true,
        models: models.placed,
        materials: materials.list,
        spheres,
        planes,
        lights,
        camera,
        background,
        ambient,
        environment,
        picture,
        warnings: models.warnings,
        files: models.files,
        budget: budget.clone(),
    })
}

/// Opens a model by its extension; `None` where that is none of a model's.
fn open_model(path: &Path, options: &Options, budget: &Budget) -> Option<Result<Model, Error>> {
    let extension = path.extension()?.to_string_lossy().to_lowercase();
    match extension.as_str() {
        "gltf" | "glb" => Some(gltf::open_within(path, options, budget)),
        "obj" => Some(obj::open_within(path, options, budget)),
        _ => None,
    }
}

#[cfg(test)]
mod tests;
