//! Wavefront OBJ with MTL.
//!
//! The reader is our own. Crate `tobj` (4.0.5) was looked at: it makes fans of concave faces, of points and lines too,
//! shifts vertex colours where only some vertices have them, forgets the names of materials whose MTL is missing, names
//! no line in its errors, fails on continuation, byte order marks and Latin-1, and gives up a whole MTL for one wrong
//! line. It stands beside ours in the tests, as an oracle for plain files.
//!
//! What is read how:
//!
//! - A shape is an object (`o`), in files without one a group (`g`); a part of it is what has one material.
//! - A face without normals is flat. Smoothing groups are not followed.
//! - Colours after a vertex are sRGB, as painting and scanning programs write them.
//! - `v` of texture coordinates is turned over: OBJ's image begins at its lower edge, luch's at its upper one.
//! - Materials: see `obj/materials.rs`. Pictures of heights become normals: see `obj/bump.rs`.

mod bump;
mod find;
mod geometry;
mod map;
mod materials;
mod meshes;
mod mtl;
mod numbers;
mod polygon;
mod reader;
mod text;
mod textures;

use super::{Facts, Model, ModelMesh, Node, Part, Warnings, files, tangents};
use crate::Error;
use find::Found;
use geometry::Geometry;
use meshes::{Mended, MeshMaker, Needs};
use mtl::MtlMaterial;
use std::collections::{HashMap, HashSet};
use std::path::{Path, PathBuf};
use textures::Textures;

/// Longer files could have more corners than 32 bits can number.
const MOST_BYTES: usize = u32::MAX as usize;

/// Opens a model.
///
/// # Errors
///
/// The file cannot be read, has a line that makes no sense, or nothing to draw. A missing MTL or texture is a warning.
pub fn open(path: &Path) -> Result<Model, Error> {
    let bytes = files::read(path)?;
    if bytes.len() > MOST_BYTES {
        return Err(Error::Unsupported {
            file: path.to_owned(),
            what: "is longer than 4 GiB, which is not supported".into(),
            way_out: "split it, or convert it to glTF".into(),
        });
    }
    let mut geometry = Geometry::read(&text::plain(&bytes))
        .map_err(|bad| Error::malformed(path, format!("line {}", bad.line), bad.problem))?;
    drop(bytes);
    let mut model = Model {
        file: path.to_owned(),
        files: vec![path.to_owned()],
        warnings: std::mem::take(&mut geometry.warnings),
        ..Model::default()
    };
    let material_of = add_materials(&mut model, &geometry);
    add_shapes(&mut model, &geometry, &material_of);
    if model.shapes.is_empty() {
        let problem = "has nothing to draw, expected a face with finite vertices";
        return Err(Error::malformed(path, "", problem));
    }
    model.facts = Facts {
        format: "OBJ".into(),
        triangles: model.meshes.iter().map(|mesh| mesh.triangles.len()).sum(),
        points: geometry.points,
        lines: geometry.lines,
        ..model.facts
    };
    Ok(model)
}

/// A material and the folder that its textures' names start from.
struct Known {
    mtl: MtlMaterial,
    folder: PathBuf,
}

/// Reads MTLs and textures; for each material that the geometry names, its index in the model. The default comes last.
fn add_materials(model: &mut Model, geometry: &Geometry) -> Vec<u32> {
    let folder = folder_of(&model.file);
    let mut textures = Textures::default();
    let known = read_libraries(model, geometry, &folder, &mut textures);
    let mut indices = Vec::with_capacity(geometry.materials.len());
    for name in &geometry.materials {
        let Some(known) = known.get(name) else {
            let name = text::shown(name.as_bytes());
            model
                .warnings
                .add(format!("material \"{name}\" is in no MTL; it is grey"));
            indices.push(None);
            continue;
        };
        textures.folders = vec![known.folder.clone(), folder.clone()];
        indices.push(Some(model.materials.len() as u32));
        model
            .materials
            .push(materials::material(&known.mtl, &mut textures));
    }
    let default = model.materials.len() as u32;
    model.materials.push(materials::default_material());
    model.textures = textures.list;
    model.facts.textures = textures.facts;
    model.files.append(&mut textures.files);
    model.warnings.append(textures.warnings);
    indices
        .into_iter()
        .map(|index| index.unwrap_or(default))
        .collect()
}

fn folder_of(path: &Path) -> PathBuf {
    path.parent().map(Path::to_owned).unwrap_or_default()
}

/// The materials of every MTL that the geometry names, by name.
fn read_libraries(
    model: &mut Model,
    geometry: &Geometry,
    folder: &Path,
    textures: &mut Textures,
) -> HashMap<String, Known> {
    let mut known: HashMap<String, Known> = HashMap::new();
    let folders = [folder.to_owned()];
    let mut read = HashSet::new();
    for names in &geometry.libraries {
        // `mtllib` may list several files, and the name of one may have blanks.
        let all = match textures.finder.find(names, &folders) {
            Found::Missing => separate_libraries(names),
            _ => vec![names.as_str()],
        };
        for name in all {
            let Some(path) = library_path(model, &textures.finder.find(name, &folders), name)
            else {
                continue;
            };
            // However many names it goes by.
            if read.insert(path.canonicalize().unwrap_or_else(|_| path.clone())) {
                read_library(model, &path, &mut known);
            }
        }
    }
    known
}

/// The names in a list: each ends in `.mtl`, so that blanks within names are kept.
fn separate_libraries(names: &str) -> Vec<&str> {
    const ENDING: &str = ".mtl";
    let mut separate = Vec::new();
    let mut start = 0;
    let lower = names.to_ascii_lowercase();
    for (at, _) in lower.match_indices(ENDING) {
        let end = at + ENDING.len();
        let ends_word = names[end..].chars().next().is_none_or(char::is_whitespace);
        if ends_word {
            separate.push(names[start..end].trim());
            start = end;
        }
    }
    let last = names[start..].trim();
    if !last.is_empty() {
        separate.push(last);
    }
    separate
}

fn library_path(model: &mut Model, found: &Found, name: &str) -> Option<PathBuf> {
    let name = text::shown(name.as_bytes());
    match found {
        Found::AsNamed(path) => Some(path.clone()),
        Found::Elsewhere(path) => {
            let there = path.display();
            model
                .warnings
                .add(format!("MTL \"{name}\" is not there; {there} is taken"));
            Some(path.clone())
        }
        Found::Missing => {
            model
                .warnings
                .add(format!("MTL \"{name}\" is missing; its materials are grey"));
            None
        }
    }
}

fn read_library(model: &mut Model, path: &Path, known: &mut HashMap<String, Known>) {
    let bytes = match files::read(path) {
        Ok(bytes) => bytes,
        Err(error) => {
            model
                .warnings
                .add(format!("{error}; its materials are grey"));
            return;
        }
    };
    model.files.push(path.to_owned());
    let file = path.file_name().unwrap_or_default().to_string_lossy();
    let folder = folder_of(path);
    for mtl in mtl::read(&text::plain(&bytes), &file, &mut model.warnings) {
        let (name, shown) = (mtl.name.clone(), text::shown(mtl.name.as_bytes()));
        let folder = folder.clone();
        if known.insert(name, Known { mtl, folder }).is_some() {
            model.warnings.add(format!(
                "{file}: material \"{shown}\" was there before; the later one counts"
            ));
        }
    }
}

/// A shape and its node for each object, and in it a part for each material.
fn add_shapes(model: &mut Model, geometry: &Geometry, material_of: &[u32]) {
    let default = (model.materials.len() as u32).saturating_sub(1);
    let mut maker = MeshMaker::new(geometry);
    let mut shape_of: HashMap<u32, usize> = HashMap::new();
    let mut mended = Mended::default();
    for group in &geometry.groups {
        let named = group
            .material
            .and_then(|index| material_of.get(index as usize));
        let material = named.copied().unwrap_or(default);
        let made_of = model.materials.get(material as usize);
        let has_normal_map = made_of.is_some_and(|material| material.normal_map.is_some());
        let needs = Needs {
            uvs: made_of.is_some_and(|material| material.textures().next().is_some()),
            normals: has_normal_map,
        };
        let (mut mesh, more) = maker.mesh(group, needs);
        mended = mended.and(more);
        if mesh.triangles.is_empty() {
            continue;
        }
        if has_normal_map {
            mesh = tangents::with_tangents(mesh, 0).unwrap_or_else(|mesh| mesh);
        }
        let name = geometry.objects.get(group.object as usize);
        mesh.name = name.cloned().unwrap_or_default();
        let shape = *shape_of
            .entry(group.object)
            .or_insert_with(|| new_shape(model, &mesh.name));
        let part = Part {
            mesh: model.meshes.len() as u32,
            material,
        };
        model.meshes.push(mesh);
        if let Some(shape) = model.shapes.get_mut(shape) {
            shape.parts.push(part);
        }
    }
    model.warnings.add_times(
        "a face of very many corners is not convex and may be cut wrongly",
        maker.fans(),
    );
    tell(mended, &mut model.warnings);
}

/// A shape without parts, with a node that shows it.
fn new_shape(model: &mut Model, name: &str) -> usize {
    let shape = model.shapes.len();
    model.shapes.push(ModelMesh {
        name: name.to_owned(),
        parts: Vec::new(),
    });
    model.roots.push(model.nodes.len());
    model.nodes.push(Node {
        name: name.to_owned(),
        shape: Some(shape),
        ..Node::default()
    });
    shape
}

fn tell(mended: Mended, warnings: &mut Warnings) {
    for (message, count) in [
        (
            "a triangle with a vertex that is no finite point is dropped",
            mended.dropped,
        ),
        (
            "a corner without texture coordinates, of a material with a texture, is at (0, 0)",
            mended.without_uv,
        ),
        (
            "texture coordinates that are no finite numbers are (0, 0)",
            mended.broken_uvs,
        ),
    ] {
        warnings.add_times(message, count);
    }
}
