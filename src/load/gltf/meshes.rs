//! The meshes of a file: each primitive becomes one mesh of luch, once, whoever shares it.

use super::buffers::Buffers;
use super::document::{Document, named};
use super::materials_variants::Variants;
use super::primitives::{Changing, Drawn, Reader};
use super::{Warnings, draco, morph_targets};
use crate::Error;
use crate::load::pose::Deformation;
use crate::load::{AnimationChoice, ModelMesh, Part};
use crate::material::Material;
use crate::mesh::Mesh;
use crate::texture::TextureUse;
use gltf::json::Index;
use gltf::json::accessor::Accessor;
use gltf::json::mesh::{Mode, Primitive};
use gltf::json::validation::Checked;
use std::collections::{BTreeMap, HashMap};

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
    /// Of those whose shape something may change, what does.
    pub(super) deformations: BTreeMap<u32, Deformation>,
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
}

/// What tells primitives apart, but for their material.
#[derive(PartialEq, Eq, Hash)]
struct Key {
    attributes: Vec<(String, usize)>,
    indices: Option<usize>,
    compressed: Option<draco::Compressed>,
    mode: u32,
    /// The set of texture coordinates, and their transform.
    tangents: Option<(u8, Option<[u32; 9]>)>,
    changing: Changing,
    /// Positions, normals, tangents.
    targets: Vec<[Option<usize>; 3]>,
}

/// How many corners and vertices a file may come to.
pub(super) fn budget(buffers: &Buffers) -> u64 {
    buffers
        .total_bytes
        .saturating_mul(ELEMENTS_A_BYTE)
        .saturating_add(FREE_ELEMENTS)
}

/// Reads every mesh of the file. The last of `materials` is the default.
///
/// # Errors
///
/// A primitive cannot be read, or names a material that does not exist.
pub(super) fn all(
    document: &Document,
    buffers: &Buffers,
    materials: &[Material],
    variants: &Variants,
    warnings: &mut Warnings,
) -> Result<Geometry, Error> {
    let mut geometry = Geometry::default();
    let mut known: HashMap<Key, Option<u32>> = HashMap::new();
    let mut budget = budget(buffers);
    let changes = changes(document);
    for (index, mesh) in document.root.meshes.iter().enumerate() {
        let mut shape = ModelMesh {
            name: mesh.name.clone().unwrap_or_default(),
            parts: Vec::new(),
            weights: match &mesh.weights {
                Some(weights) => morph_targets::fitting(document, weights, index, warnings),
                None => Vec::new(),
            },
        };
        let changing = changes.get(index).copied().unwrap_or_default();
        let name = named("mesh", index, mesh.name.as_ref());
        for (number, primitive) in mesh.primitives.iter().enumerate() {
            let place = format!("{name}, primitive {number}");
            let default = materials.len().saturating_sub(1);
            let material = match variants.material(primitive, &place, warnings) {
                Some(index) => document.checked(place.as_str(), "material", index, default)?,
                None => default,
            };
            let Checked::Valid(mode) = primitive.mode else {
                return Err(
                    document.malformed(place.as_str(), "its mode is unknown, expected 0 to 6")
                );
            };
            let normal_map = materials.get(material).and_then(|m| m.normal_map.as_ref());
            let normal_map = normal_map.map(|map| &map.texture);
            let wrong = |problem| document.malformed(format!("{place}, {}", draco::NAME), problem);
            let compressed = draco::of(primitive).map_err(wrong)?;
            let key = key(primitive, &compressed, mode, normal_map, changing);
            let drawn = match known.get(&key) {
                Some(&drawn) => drawn,
                None => {
                    let stream = compressed
                        .map(|c| c.unpack(document, buffers, primitive, &mut budget))
                        .transpose();
                    let stream = match stream {
                        Err(problem) if draco::is_optional(document, primitive) => {
                            warnings.add(format!(
                                "{place}, {}: {problem}: its accessors are used instead",
                                draco::NAME
                            ));
                            None
                        }
                        stream => stream.map_err(wrong)?,
                    };
                    let reader = Reader {
                        document,
                        buffers,
                        primitive,
                        stream,
                        place: place.clone(),
                    };
                    let drawn = reader.read(mode, normal_map, changing, &mut budget, warnings)?;
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
            Drawn::Triangles(read, left_out) => {
                let (mut mesh, deformation) = *read;
                self.not_finite += left_out;
                if mesh.triangles.is_empty() {
                    return None;
                }
                self.triangles += mesh.triangles.len();
                mesh.name = name.clone().unwrap_or_default();
                self.meshes.push(mesh);
                let index = self.meshes.len() as u32 - 1;
                if !deformation.is_empty() {
                    self.deformations.insert(index, deformation);
                }
                return Some(index);
            }
        }
        None
    }
}

/// How much each morph target of a mesh counts, where a node does not say it.
fn weights(document: &Document, mesh: usize) -> &[f32] {
    let mesh = document.root.meshes.get(mesh);
    mesh.and_then(|mesh| mesh.weights.as_deref())
        .unwrap_or_default()
}

/// What may change the shape of each mesh: joints where a node gives it a skin; morph targets where they count, or an
/// animation may make them count.
fn changes(document: &Document) -> Vec<Changing> {
    let count = |weights: &[f32]| weights.iter().any(|&weight| weight != 0.0);
    let moves =
        document.options.animation != AnimationChoice::None && !document.root.animations.is_empty();
    let mut changes: Vec<Changing> = (0..document.root.meshes.len())
        .map(|mesh| Changing {
            morphs: moves || count(weights(document, mesh)),
            bends: false,
        })
        .collect();
    for node in &document.root.nodes {
        let mesh = node.mesh.and_then(|mesh| changes.get_mut(mesh.value()));
        if let Some(changing) = mesh {
            changing.bends |= node.skin.is_some();
            changing.morphs |= node.weights.as_deref().is_some_and(count);
        }
    }
    changes
}

fn key(
    primitive: &Primitive,
    compressed: &Option<draco::Compressed>,
    mode: Mode,
    normal_map: Option<&TextureUse>,
    changing: Changing,
) -> Key {
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
    let index = |accessor: Option<Index<Accessor>>| accessor.map(|index| index.value());
    let targets = primitive.targets.iter().flatten();
    let targets = targets
        .map(|target| [target.positions, target.normals, target.tangents].map(index))
        .filter(|_| changing.morphs)
        .collect();
    Key {
        attributes,
        indices,
        compressed: compressed.clone(),
        mode: mode.as_gl_enum(),
        tangents,
        changing,
        targets,
    }
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
    let what = if geometry.not_finite > 0 {
        "its triangles have positions that are no numbers"
    } else if geometry.points + geometry.lines > 0 {
        "it shows points and lines only, which are not supported"
    } else {
        "no node of its scene shows a triangle"
    };
    document.malformed("", format!("has nothing to draw: {what}"))
}
