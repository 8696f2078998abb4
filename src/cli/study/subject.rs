//! What is studied: a model, a scene file, or generated shapes.

use super::super::reading::Reading;
use super::super::render::{FIGURE_4, FIGURE_4_NAME};
use super::super::{Failure, print};
use luch::load::{self, Asset, CameraChoice, Viewpoint};
use luch::scene::Scene;
use luch::shade::Shading;
use luch::study::hash::hash_of;
use luch::study::scenes::{FEWEST, MOST, Shape};
use luch::study::{Source, resize, scenes};
use luch::texture::TextureFilter;
use luch::{Error, generate};
use std::path::Path;
use std::sync::Arc;

/// What is studied.
pub(super) struct Subject {
    /// As the report has it.
    pub(super) name: String,
    /// Its scene; of several shapes, one of them.
    pub(super) source: Source,
    /// Of its files; empty of what is generated.
    pub(super) sha256: String,
    /// What the file says of the picture.
    pub(super) max_depth: Option<u32>,
    /// What the file says of the picture.
    pub(super) shading: Option<Shading>,
    pub(super) texture_filter: Option<TextureFilter>,
    /// What was ignored, and what was chosen for the user.
    pub(super) lines: Vec<String>,
}

impl Subject {
    /// A file, or a generated scene such as `terrain:1000000`.
    pub(super) fn open(
        path: &Path,
        camera: Option<&str>,
        size: [u32; 2],
        reading: &Reading,
    ) -> Result<Subject, Failure> {
        if let Some((shape, count)) = shape_and_count(path)?.filter(|_| !path.exists()) {
            let scene = (generated(shape, count).make)().map_err(Failure::usage_or_scene)?;
            let name = format!("{}:{count}", shape.name());
            return Ok(Subject::of_scene(&name, scene));
        }
        let asset = load::open(path, &reading.options()).map_err(Failure::usage_or_scene)?;
        let name = path.file_name().unwrap_or(path.as_os_str());
        let hash = hash_of(&asset.files).map_err(|error| {
            Failure::usage_or_scene(format!(
                "{}: cannot read this again: {error}",
                print::path(path)
            ))
        })?;
        Subject::of_asset(&asset, &name.to_string_lossy(), hash, camera, size)
    }

    /// The paper's figure 4.
    pub(super) fn figure_4(size: [u32; 2]) -> Result<Subject, Failure> {
        let name = Path::new(FIGURE_4_NAME);
        let asset = load::scene_file::parse(FIGURE_4, name, &load::Options::default())
            .map_err(Failure::usage_or_scene)?;
        Subject::of_asset(&asset, FIGURE_4_NAME, String::new(), None, size)
    }

    fn of_asset(
        asset: &Asset,
        name: &str,
        sha256: String,
        camera: Option<&str>,
        [width, height]: [u32; 2],
    ) -> Result<Subject, Failure> {
        let viewpoint = Viewpoint {
            camera: camera.map_or(CameraChoice::OfFile, |camera| {
                CameraChoice::Named(camera.into())
            }),
            ..Viewpoint::of_file(f64::from(width) / f64::from(height.max(1)))
        };
        let made: Result<_, Error> = asset.scene(0.0, &viewpoint);
        let (scene, choices) = made.map_err(Failure::usage_or_scene)?;
        let warnings = asset
            .warnings
            .iter()
            .map(|warning| format!("warning: {warning}"));
        Ok(Subject {
            sha256,
            max_depth: asset.picture.max_depth,
            shading: asset.picture.shading,
            texture_filter: asset.picture.texture_filter,
            lines: warnings.chain(choices.lines).collect(),
            ..Subject::of_scene(name, Arc::new(scene))
        })
    }

    /// Generated shapes.
    pub(super) fn of_shapes(shapes: &[Shape]) -> Subject {
        let names: Vec<&str> = shapes.iter().map(|shape| shape.name()).collect();
        let source = generated(shapes.first().copied().unwrap_or(Shape::Grid), 10);
        Subject::of_source(&names.join(", "), source)
    }

    fn of_scene(name: &str, scene: Arc<Scene>) -> Subject {
        Subject::of_source(name, Source::of(name, scene))
    }

    fn of_source(name: &str, source: Source) -> Subject {
        Subject {
            name: name.to_owned(),
            source,
            sha256: String::new(),
            max_depth: None,
            shading: None,
            texture_filter: None,
            lines: Vec::new(),
        }
    }

    /// The scene's triangles, thinned or subdivided to any number, from the same camera.
    pub(super) fn resized(&self) -> impl Fn(&str, u32) -> Source + use<> {
        let source = self.source.clone();
        move |name, count| {
            let (source, name) = (source.clone(), format!("{name}:{count}"));
            Source {
                name,
                primitives: u64::from(count),
                make: Arc::new(move || {
                    let scene = (source.make)()?;
                    let mesh = resize::resized(&resize::triangles_of(&scene), count as usize);
                    let camera = *scene.camera();
                    Scene::new(generate::mesh_scene(mesh, camera)).map(Arc::new)
                }),
            }
        }
    }
}

/// A generated scene of about so many primitives.
pub(super) fn generated(shape: Shape, count: u32) -> Source {
    Source {
        name: format!("{}:{count}", shape.name()),
        primitives: u64::from(count),
        make: Arc::new(move || Scene::new(scenes::generated(shape, count)).map(Arc::new)),
    }
}

/// What a generated scene is asked for by; `None` where that is the name of no shape.
fn shape_and_count(path: &Path) -> Result<Option<(Shape, u32)>, Failure> {
    let parts = path.to_str().and_then(|text| text.split_once(':'));
    let Some((shape, count)) = parts.and_then(|(name, n)| Some((Shape::named(name)?, n))) else {
        return Ok(None);
    };
    let count = count
        .parse()
        .ok()
        .filter(|count| (FEWEST..=MOST).contains(count));
    count.map(|count| Some((shape, count))).ok_or_else(|| {
        Failure::usage_or_scene(format!(
            "{}: expected a whole number of primitives from {FEWEST} to {MOST} after the colon",
            print::path(path)
        ))
    })
}
