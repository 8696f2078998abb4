//! The meshes of a file: each primitive becomes one mesh of luch, once, whoever shares it.

use super::buffers::Buffers;
use super::document::{Document, named};
use super::primitives::{Drawn, Reader};
use super::{Warnings, extensions};
use crate::Error;
use crate::load::{ModelMesh, Part};
use crate::material::Material;
use crate::mesh::Mesh;
use crate::texture::TextureUse;
use gltf::json::mesh::{Mode, Primitive};
use gltf::json::validation::Checked;
use std::collections::HashMap;

/// How many corners and vertices a file may come to for each byte of its buffers: one byte can be the index of three
/// corners in a strip. Files that come to more read the same bytes again and again.
const ELEMENTS_A_BYTE: u64 = 8;
/// And how many beside, so that small files may repeat what they like.
const FREE_ELEMENTS: u64 = 1 << 20;

/// What the meshes of a file come to.
#[derive(Debug, Default)]
pub(super) struct Geometry {
    /// One for each primitive that draws triangles.
    pub(super) meshes: Vec<Mesh>,
    /// One for each mesh of the file, by its index in it.
    pub(super) shapes: Vec<ModelMesh>,
    /// How many triangles.
    pub(super) triangles: usize,
    /// Points that are not drawn.
    pub(super) points: usize,
    /// Line segments that are not drawn.
    pub(super) lines: usize,
    /// Triangles that are left out, since a position of theirs is no number.
    not_finite: usize,
    /// The first extension that holds geometry which is not drawn.
    compressed_by: Option<&'static str>,
}

/// What tells primitives apart, but for their material.
type Key = (
    Vec<(String, usize)>,
    Option<usize>,
    u32,
    Option<(u8, Option<[u32; 9]>)>,
);

/// Extensions that hold geometry outside accessors.
const COMPRESSIONS: [&str; 1] = ["KHR_draco_mesh_compression"];

/// Reads every mesh of the file. The last of `materials` is the default.
///
/// # Errors
///
/// A primitive cannot be read, or names a material that does not exist.
pub(super) fn all(
    document: &Document,
    buffers: &Buffers,
    materials: &[Material],
    warnings: &mut Warnings,
) -> Result<Geometry, Error> {
    let mut geometry = Geometry::default();
    let mut known: HashMap<Key, Option<u32>> = HashMap::new();
    let mut budget = buffers
        .total_bytes
        .saturating_mul(ELEMENTS_A_BYTE)
        .saturating_add(FREE_ELEMENTS);
    for (index, mesh) in document.root.meshes.iter().enumerate() {
        let mut shape = ModelMesh {
            name: mesh.name.clone().unwrap_or_default(),
            parts: Vec::new(),
        };
        let name = named("mesh", index, mesh.name.as_ref());
        for (number, primitive) in mesh.primitives.iter().enumerate() {
            let reader = Reader {
                document,
                buffers,
                primitive,
                place: format!("{name}, primitive {number}"),
            };
            let place = reader.place.as_str();
            let default = materials.len().saturating_sub(1);
            let material = match primitive.material {
                Some(index) => document.checked(place, "material", index.value(), default)?,
                None => default,
            };
            if let Some(extension) = compression(document, primitive) {
                warnings.add(format!(
                    "{place}: its geometry is in {extension} and is not drawn"
                ));
                geometry.compressed_by.get_or_insert(extension);
                continue;
            }
            if primitive
                .targets
                .as_ref()
                .is_some_and(|targets| !targets.is_empty())
            {
                warnings.add("morph targets are ignored: meshes have their own shape");
            }
            let Checked::Valid(mode) = primitive.mode else {
                return Err(document.malformed(place, "its mode is unknown, expected 0 to 6"));
            };
            let normal_map = materials.get(material).and_then(|m| m.normal_map.as_ref());
            let normal_map = normal_map.map(|map| &map.texture);
            let key = key(primitive, mode, normal_map);
            let drawn = match known.get(&key) {
                Some(&drawn) => drawn,
                None => {
                    let drawn = reader.read(mode, normal_map, &mut budget, warnings)?;
                    let drawn = geometry.take(drawn, &mesh.name);
                    known.insert(key, drawn);
                    drawn
                }
            };
            if let Some(mesh) = drawn {
                let material = material as u32;
                warn_of_missing_coordinates(
                    &geometry,
                    mesh,
                    materials.get(material as usize),
                    warnings,
                );
                shape.parts.push(Part { mesh, material });
            }
        }
        geometry.shapes.push(shape);
    }
    warnings.add_times("a point is not drawn", geometry.points);
    warnings.add_times("a line is not drawn", geometry.lines);
    Ok(geometry)
}

impl Geometry {
    /// Takes over what a primitive draws; the index of its mesh, if it has triangles.
    fn take(&mut self, drawn: Drawn, name: &Option<String>) -> Option<u32> {
        match drawn {
            Drawn::Points(count) => self.points += count,
            Drawn::Lines(count) => self.lines += count,
            Drawn::Triangles(mut mesh, left_out) => {
                self.not_finite += left_out;
                if mesh.triangles.is_empty() {
                    return None;
                }
                self.triangles += mesh.triangles.len();
                mesh.name = name.clone().unwrap_or_default();
                self.meshes.push(mesh);
                return Some(self.meshes.len() as u32 - 1);
            }
        }
        None
    }
}

/// The extension that holds a primitive's geometry, where its accessors have no bytes for it.
fn compression(document: &Document, primitive: &Primitive) -> Option<&'static str> {
    let others = &primitive.extensions.as_ref()?.others;
    let name = COMPRESSIONS
        .into_iter()
        .find(|&name| others.contains_key(name))?;
    let has_bytes = |index: usize| {
        let accessor = document.root.accessors.get(index);
        // One that does not exist is left to be an error.
        accessor.is_none_or(|a| a.buffer_view.is_some() || a.sparse.is_some())
    };
    let accessors = primitive.attributes.values().chain(&primitive.indices);
    let whole = accessors.into_iter().all(|index| has_bytes(index.value()));
    (!whole).then_some(name)
}

fn key(primitive: &Primitive, mode: Mode, normal_map: Option<&TextureUse>) -> Key {
    let attributes = primitive.attributes.iter();
    let attributes = attributes
        .filter_map(|(semantic, accessor)| match semantic {
            Checked::Valid(semantic) => Some((semantic.to_string(), accessor.value())),
            Checked::Invalid => None,
        })
        .collect();
    let indices = primitive.indices.map(|index| index.value());
    let tangents = normal_map.map(|map| {
        let transform = map.transform.map(|m| m.to_cols_array().map(f32::to_bits));
        (map.uv_set, transform)
    });
    (attributes, indices, mode.as_gl_enum(), tangents)
}

fn warn_of_missing_coordinates(
    geometry: &Geometry,
    mesh: u32,
    material: Option<&Material>,
    warnings: &mut Warnings,
) {
    let Some(mesh) = geometry.meshes.get(mesh as usize) else {
        return;
    };
    for (set, coordinates) in mesh.uvs.iter().enumerate() {
        let needed = |material: &Material| {
            material
                .textures()
                .any(|used| usize::from(used.uv_set) == set)
        };
        if coordinates.is_empty() && material.is_some_and(needed) {
            warnings.add(format!(
                "a mesh whose material has a texture lacks TEXCOORD_{set}: the texture's upper left corner is used"
            ));
        }
    }
}

/// The error for a file of which nothing can be seen.
pub(super) fn nothing_to_draw(document: &Document, geometry: &Geometry) -> Error {
    let Some(extension) = geometry.compressed_by else {
        let what = if geometry.not_finite > 0 {
            "its triangles have positions that are no numbers"
        } else if geometry.points + geometry.lines > 0 {
            "it shows points and lines only, which are not supported"
        } else {
            "no node of its scene shows a triangle"
        };
        return document.malformed("", format!("has nothing to draw: {what}"));
    };
    Error::Unsupported {
        file: document.file.clone(),
        what: format!("has its geometry in {extension}, which is not supported"),
        way_out: extensions::way_out(extension).into(),
    }
}
