//! glTF 2.0: `.gltf` with its buffers and images beside it or inside it, and `.glb`.
//!
//! Crate `gltf` gives the typed document; what the document points at is read here, with bounds of our own: the crate
//! trusts files, and luch opens any. Each extension has a file of its own, which `extensions.rs` lists.
//!
//! Parts of a file without a name are called by their index in it, from 0, as the file itself does.

mod accessors;
mod animation_pointer;
mod animations;
mod asks;
mod base64;
mod buffers;
mod cameras;
mod container;
mod document;
mod draco;
mod elements;
mod emissive_strength;
mod extensions;
mod faces;
mod images;
mod implicit_shapes;
mod json;
mod kept;
mod lights_punctual;
mod materials;
mod materials_anisotropy;
mod materials_clearcoat;
mod materials_diffuse_transmission;
mod materials_dispersion;
mod materials_extensions;
mod materials_ior;
mod materials_iridescence;
mod materials_sheen;
mod materials_specular;
mod materials_specular_glossiness;
mod materials_transmission;
mod materials_unlit;
mod materials_variants;
mod materials_volume;
mod mesh_gpu_instancing;
mod mesh_quantization;
mod meshes;
mod meshopt;
mod morph_targets;
mod node_visibility;
mod nodes;
mod notes;
mod poses;
mod primitive_modes;
mod primitives;
mod skins;
mod sparse;
mod texture_basisu;
mod texture_info;
mod texture_transform;
mod texture_webp;
mod textures;
mod transforms;
mod uri;

use super::{Budget, Facts, Model, Options, Warnings, files, text_bytes};
use crate::Error;
use buffers::Buffers;
use document::{Document, one_line};
use implicit_shapes::Shapes;
use materials_variants::Variants;
use nodes::Contents;
use std::collections::BTreeMap;
use std::path::Path;
use textures::Textures;

/// The greatest factor that is taken as it is: products of two of these are finite.
const BRIGHTEST: f32 = 1e18;

/// Opens a model.
///
/// Light intensities are divided by π, since luch's are what a white matt surface shows (see
/// [`Light`](crate::light::Light)).
///
/// # Errors
///
/// The file or one of its buffers cannot be read or is malformed, it requires an extension that luch lacks, or it has
/// nothing to draw. An image that cannot be read is a warning.
pub fn open(path: &Path, options: &Options) -> Result<Model, Error> {
    open_within(path, options, &Budget::of(options))
}

/// [`open`] with memory from a budget.
pub(super) fn open_within(path: &Path, options: &Options, budget: &Budget) -> Result<Model, Error> {
    let bytes = files::read(path, budget)?;
    let mut warnings = Warnings::default();
    let container = container::open(path, &bytes, &mut warnings)?;
    let document = Document::parse(path, container.json, options, budget, &mut warnings)?;
    let extensions = extensions::check(&document, &mut warnings)?;
    let buffers = Buffers::read(&document, container.binary)?;

    let variants = Variants::read(&document, &mut warnings)?;

    let extended = materials_extensions::of_materials(&document, &mut warnings);
    let used = materials::textures_used(&document, &extended);
    let mut textures = Textures::decode(&document, &buffers, &used, &mut warnings);
    let materials = materials::all(&document, &extended, &mut textures, &mut warnings)?;
    let geometry = meshes::all(&document, &buffers, &materials, &variants, &mut warnings)?;
    let (cameras, camera_indices) = compact(cameras::all(&document, &mut warnings));
    let (lights, light_indices) = compact(lights_punctual::all(&document, &mut warnings));
    let has_meshes = geometry.shapes.iter().any(|shape| !shape.parts.is_empty());
    let implicit = Shapes::read(&document, materials.len(), !has_meshes, &mut warnings);
    let (skins, skin_indices) = compact(skins::all(&document, &buffers, &mut warnings));
    let contents = Contents {
        shapes: &geometry.shapes,
        cameras: &camera_indices,
        lights: &light_indices,
        implicit: &implicit,
        skins: &skin_indices,
    };
    let instancing = mesh_gpu_instancing::Reader::new(&document, &buffers);
    let tree = nodes::read(&document, &contents, instancing, &mut warnings)?;

    let places = animations::Places {
        cameras: &camera_indices,
        lights: &light_indices,
    };
    let (animations, motion) = animations::read(&document, &buffers, &places, &mut warnings);

    let root = &document.root;
    let name = |name: &Option<String>| name.clone().unwrap_or_default();
    let facts = Facts {
        format: format(&document),
        scenes: root.scenes.iter().map(|scene| name(&scene.name)).collect(),
        triangles: geometry.triangles,
        points: geometry.points,
        lines: geometry.lines,
        textures: textures.facts,
        animations,
        variants: variants.names,
        asks: asks::all(&document, extensions),
        notes: notes::all(&document),
    };
    let own = [path.to_owned()];
    let mut model = Model {
        file: path.to_owned(),
        materials,
        textures: textures.textures,
        meshes: Vec::new(),
        shapes: Vec::new(),
        nodes: tree.nodes,
        roots: tree.roots,
        cameras,
        lights,
        deformations: BTreeMap::new(),
        skins,
        motion,
        facts,
        warnings,
        files: own
            .into_iter()
            .chain(buffers.files.clone())
            .chain(textures.files)
            .collect(),
    };
    let shows = |shape: usize| {
        geometry
            .shapes
            .get(shape)
            .is_some_and(|s| !s.parts.is_empty())
    };
    if !model
        .placed_nodes()
        .iter()
        .any(|(node, _)| node.analytic.is_some() || node.shape.is_some_and(shows))
    {
        return Err(meshes::nothing_to_draw(&document, &geometry));
    }
    (model.meshes, model.shapes) = (geometry.meshes, geometry.shapes);
    model.deformations = geometry.deformations;
    let mut warnings = std::mem::take(&mut model.warnings);
    poses::fit(&mut model, meshes::budget(&buffers), budget, &mut warnings);
    model.warnings = warnings;
    // What was made of them stays taken.
    budget.give_back(bytes.len() as u64 + text_bytes::of_json(container.json));
    Ok(model)
}

/// As in "glTF 2.0 (Blender 4.2)".
fn format(document: &Document) -> String {
    let asset = &document.root.asset;
    let version = one_line(&asset.version);
    match &asset.generator {
        Some(generator) => format!("glTF {version} ({})", one_line(generator)),
        None => format!("glTF {version}"),
    }
}

/// What is there, and where each went.
fn compact<T>(all: Vec<Option<T>>) -> (Vec<T>, Vec<Option<usize>>) {
    let mut kept = Vec::new();
    let indices = all
        .into_iter()
        .map(|one| {
            one.map(|one| {
                kept.push(one);
                kept.len() - 1
            })
        })
        .collect();
    (kept, indices)
}
