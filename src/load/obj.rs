//! Wavefront OBJ with MTL.
//!
//! The reader is our own. Crate `tobj` (4.0.5) was looked at: it makes fans of concave faces, of points and lines too,
//! shifts vertex colours where only some vertices have them, forgets the names of materials whose MTL is missing, names
//! no line in its errors, fails on continuation, byte order marks and Latin-1, and gives up a whole MTL for one wrong
//! line. It stands beside ours in the tests, as an oracle for plain files.
//!
//! A file is read in pieces at the same time, see `obj/pieces.rs`, and so are its textures. What is read how:
//!
//! - A shape is an object (`o`), in files without one a group (`g`); a part of it is what has one material.
//! - A face without normals is flat, or smooth where a smoothing group is on: see `obj/smooth.rs`.
//! - Colours after a vertex, or after many of them in `#MRGB`, are sRGB, as painting and scanning programs write them.
//! - What cannot be drawn (points, lines, curves, surfaces) is counted. `call` and `csh`, which have other files read
//!   and programs started, are ignored like every statement that luch does not know.
//! - `v` of texture coordinates is turned over: OBJ's image begins at its lower edge, luch's at its upper one.
//! - A face that makes no sense is left out; a vertex that makes no sense is an error, since indices count them.
//! - Materials: see `obj/materials.rs`, `obj/pbr.rs` and `obj/glass.rs`. Pictures of heights become normals: see
//!   `obj/bump.rs`.
//! - Blender 4.5 was the measure: of 170 files that both read, 150 have the same triangles, area, shading normals and
//!   colours; of the others Blender finds nothing to draw in 9, and differs by triangles without area in 4.

mod asks;
mod bump;
mod colors;
mod faces;
mod find;
mod geometry;
mod glass;
mod groups;
mod libraries;
mod map;
mod materials;
mod meshes;
mod mtl;
mod numbers;
mod pbr;
mod pieces;
mod polygon;
mod reader;
mod smooth;
mod text;
mod textures;
mod values;

use super::{
    Budget, Facts, Model, ModelMesh, Node, Options, Part, Warnings, files, tangents, text_bytes,
};
use crate::Error;
use find::Finder;
use geometry::Geometry;
use libraries::{Known, folder_of, read_libraries};
use meshes::{Mended, MeshMaker};
use std::collections::HashMap;
use std::path::Path;
use textures::Textures;

/// Longer files could have more corners than 32 bits can number.
const MOST_BYTES: usize = u32::MAX as usize;

/// Opens a model.
///
/// # Errors
///
/// The file cannot be read, has a line that makes no sense, or nothing to draw. A missing MTL or texture is a warning.
pub fn open(path: &Path, options: &Options) -> Result<Model, Error> {
    open_within(path, options, &Budget::of(options))
}

/// [`open`] with memory from a budget.
pub(super) fn open_within(path: &Path, options: &Options, budget: &Budget) -> Result<Model, Error> {
    budget.reading(|| read(path, options, budget))
}

fn read(path: &Path, options: &Options, budget: &Budget) -> Result<Model, Error> {
    let bytes = files::read(path, budget)?;
    budget
        .take(text_bytes::of_obj(&bytes))
        .map_err(|problem| problem.of(path, ""))?;
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
    smooth::add_normals(&mut geometry);
    let mut model = Model {
        file: path.to_owned(),
        files: vec![path.to_owned()],
        warnings: std::mem::take(&mut geometry.warnings),
        ..Model::default()
    };
    let textures = Textures::new(Finder::new(path, options), budget);
    let (material_of, lacking) = add_materials(&mut model, &geometry, textures);
    add_shapes(&mut model, &geometry, &material_of);
    if model.shapes.is_empty() {
        return Err(match geometry.first_dropped {
            Some(bad) => Error::malformed(path, format!("line {}", bad.line), bad.problem),
            None => {
                let problem = "has nothing to draw, expected a face with finite vertices";
                Error::malformed(path, "", problem)
            }
        });
    }
    model.facts = Facts {
        format: "OBJ".into(),
        triangles: model.meshes.iter().map(|mesh| mesh.triangles.len()).sum(),
        points: geometry.points,
        lines: geometry.lines,
        asks: asks::all(&geometry, &model.materials, &lacking),
        ..model.facts
    };
    Ok(model)
}

/// Reads MTLs and textures; for each material that the geometry names, its index in the model, and what luch lacks of
/// what they say. The default comes last.
fn add_materials(
    model: &mut Model,
    geometry: &Geometry,
    mut textures: Textures,
) -> (Vec<u32>, Vec<String>) {
    let folder = folder_of(&model.file);
    let known = read_libraries(
        model,
        geometry,
        &folder,
        &mut textures.finder,
        &textures.budget,
    );
    let make = |known: &Known, textures: &mut Textures| {
        textures.folders = vec![known.folder.clone(), folder.clone()];
        materials::material(&known.mtl, textures)
    };
    for known in geometry.materials.iter().filter_map(|name| known.get(name)) {
        drop(make(known, &mut textures));
    }
    let mut textures = textures.with_wanted();
    let mut indices = Vec::with_capacity(geometry.materials.len());
    let mut lacking: Vec<String> = Vec::new();
    for name in &geometry.materials {
        let Some(known) = known.get(name) else {
            let name = text::shown(name.as_bytes());
            model
                .warnings
                .add(format!("material \"{name}\" is in no MTL; it is grey"));
            indices.push(None);
            continue;
        };
        for part in &known.mtl.lacks {
            if !lacking.contains(part) {
                lacking.push(part.clone());
            }
        }
        indices.push(Some(model.materials.len() as u32));
        model.materials.push(make(known, &mut textures));
    }
    let default = model.materials.len() as u32;
    model.materials.push(materials::default_material());
    model.textures = textures.list;
    model.facts.textures = textures.facts;
    model.files.append(&mut textures.files);
    model.warnings.append(textures.warnings);
    let indices = indices.into_iter().map(|index| index.unwrap_or(default));
    (indices.collect(), lacking)
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
        let needs_uvs = made_of.is_some_and(|material| material.textures().next().is_some());
        let has_normal_map = made_of.is_some_and(|material| material.normal_map.is_some());
        let (mut mesh, more) = maker.mesh(group, needs_uvs);
        mended = mended.and(more);
        if mesh.triangles.is_empty() {
            continue;
        }
        let name = geometry.objects.get(group.object as usize);
        mesh.name = name.cloned().unwrap_or_default();
        if has_normal_map
            && !mesh.uvs[0].is_empty()
            && let Err(tangents::TooCrowded) = tangents::add(&mut mesh, 0, None)
        {
            let name = text::shown(mesh.name.as_bytes());
            model.warnings.add(format!(
                "mesh \"{name}\": too many corners meet in one point for tangents; its normal map is not used"
            ));
        }
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
        maker.uncut(),
    );
    tell(mended, &mut model.warnings);
}

/// A shape without parts, with a node that shows it.
fn new_shape(model: &mut Model, name: &str) -> usize {
    let shape = model.shapes.len();
    model.shapes.push(ModelMesh {
        name: name.to_owned(),
        ..ModelMesh::default()
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
            "a corner without texture coordinates, of a material with a texture, shows a corner of it",
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
