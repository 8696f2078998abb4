//! A model as its file has it: one shape for glTF and OBJ, before anything is placed.

use super::pose::{Deformation, Motion, Skin};
use super::{Analytic, Warnings};
use crate::camera::Projection;
use crate::light::Light;
use crate::material::Material;
use crate::mesh::Mesh;
use crate::texture::Texture;
use glam::DAffine3;
use std::collections::BTreeMap;
use std::path::PathBuf;

/// A model: meshes, what they are made of, and the tree of nodes that places them.
///
/// Every index is in range, and the tree is one: loaders see to both.
#[derive(Clone, Debug, Default)]
pub struct Model {
    /// Where it came from.
    pub file: PathBuf,
    /// Named by index. The last one is the default for parts whose file names none.
    pub materials: Vec<Material>,
    /// Named by index.
    pub textures: Vec<Texture>,
    /// The geometry of the parts, named by index.
    pub meshes: Vec<Mesh>,
    /// What nodes show.
    pub shapes: Vec<ModelMesh>,
    /// Named by index.
    pub nodes: Vec<Node>,
    /// The nodes at the top of what is drawn.
    pub roots: Vec<usize>,
    /// Named by index; each looks along -Z with +Y up in the space of its node.
    pub cameras: Vec<ModelCamera>,
    /// Named by index; each at the origin of its node, shining along -Z.
    pub lights: Vec<Light>,
    /// Of the meshes whose shape something may change, what does.
    pub(super) deformations: BTreeMap<u32, Deformation>,
    /// Named by index.
    pub(super) skins: Vec<Skin>,
    /// What the chosen animations do.
    pub(super) motion: Motion,
    /// What `luch info` tells beside.
    pub facts: Facts,
    /// What was ignored or mended.
    pub warnings: Warnings,
    /// Every file that was read, the model's own first.
    pub files: Vec<PathBuf>,
}

/// A mesh of a file: parts of one material each.
#[derive(Clone, Debug, Default)]
pub struct ModelMesh {
    /// As in the file.
    pub name: String,
    /// The parts that can be drawn.
    pub parts: Vec<Part>,
    /// How much each morph target counts, where a node does not say it.
    pub(super) weights: Vec<f32>,
}

/// Triangles of one material.
#[derive(Clone, Copy, Debug)]
pub struct Part {
    /// An index into the model's meshes.
    pub mesh: u32,
    /// An index into the model's materials.
    pub material: u32,
}

/// A place in the tree.
#[derive(Clone, Debug, Default)]
pub struct Node {
    /// As in the file; may be empty.
    pub name: String,
    /// Indices into the model's nodes.
    pub children: Vec<usize>,
    /// To the space of its parent.
    pub to_parent: DAffine3,
    /// An index into the model's shapes.
    pub shape: Option<usize>,
    /// A sphere or a plane.
    pub analytic: Option<Analytic>,
    /// Where the shape stands in the node's space, if not once at its origin: as often as there are transforms.
    pub instances: Option<Vec<DAffine3>>,
    /// An index into the model's cameras.
    pub camera: Option<usize>,
    /// An index into the model's lights.
    pub light: Option<usize>,
    /// An index into the model's skins.
    pub(super) skin: Option<usize>,
    /// How much each morph target of what it shows counts, where it says it.
    pub(super) weights: Option<Vec<f32>>,
    /// Whether it and what is below it is not seen.
    pub is_hidden: bool,
}

/// A camera of a file, before a node places it.
#[derive(Clone, Debug)]
pub struct ModelCamera {
    /// As in the file; may be empty.
    pub name: String,
    /// How wide it sees.
    pub projection: Projection,
    /// Its near plane, along its axis.
    pub near: f32,
    /// Its far plane; infinity where there is none.
    pub far: f32,
}

/// What `luch info` tells of a file beside what a model holds.
#[derive(Clone, Debug, Default)]
pub struct Facts {
    /// As in "glTF 2.0 (Blender 4.2)".
    pub format: String,
    /// Names of the file's scenes; empty strings where they have none.
    pub scenes: Vec<String>,
    /// How many triangles, each mesh once.
    pub triangles: usize,
    /// Points that are not drawn.
    pub points: usize,
    /// Line segments that are not drawn.
    pub lines: usize,
    /// Each image of the file.
    pub textures: Vec<TextureFacts>,
    /// Each animation of the file, chosen or not.
    pub animations: Vec<AnimationFacts>,
    /// Names of the variants of materials; empty strings where they have none.
    pub variants: Vec<String>,
    /// What the file asks for, with what luch does about it.
    pub asks: Vec<Ask>,
    /// What the file says beside the picture.
    pub notes: Vec<Note>,
}

/// An image of a file.
#[derive(Clone, Debug)]
pub struct TextureFacts {
    /// A name or a path.
    pub name: String,
    /// Its size in pixels, where it could be read.
    pub size: Option<(u32, u32)>,
}

/// An animation of a file.
#[derive(Clone, Debug, PartialEq)]
pub struct AnimationFacts {
    /// As in the file; may be empty.
    pub name: String,
    /// When its last key is.
    pub seconds: f64,
    /// What it moves, each kind once.
    pub moves: Vec<Moved>,
}

/// A kind of thing that an animation moves.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Moved {
    /// As the file calls it: `rotation`, or the last part of a pointer, as in `baseColorFactor`.
    pub what: String,
    /// How many channels move one.
    pub count: usize,
}

/// Something that a file asks for: an extension, or a part of its format that not every renderer has.
#[derive(Clone, Debug)]
pub struct Ask {
    /// As in `KHR_materials_unlit` or `texture minification filters`.
    pub what: String,
    /// Whether the file says that it makes no sense without.
    pub required: bool,
    /// What luch does with it.
    pub treatment: Treatment,
}

/// What a file says beside the picture: `extras` and metadata.
#[derive(Clone, Debug)]
pub struct Note {
    /// Of what, as in `node "chair"`.
    pub place: String,
    /// In the file's words.
    pub json: String,
}

/// What luch does with what a file asks.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Treatment {
    /// What it asks.
    Honoured,
    /// What comes near to it in a Whitted renderer, in these words.
    Approximated(&'static str),
    /// Nothing.
    Ignored,
}

impl Treatment {
    /// One word.
    pub fn name(self) -> &'static str {
        match self {
            Treatment::Honoured => "honoured",
            Treatment::Approximated(_) => "approximated",
            Treatment::Ignored => "ignored",
        }
    }
}

impl Node {
    /// Where the node's shape stands, `to_model` being the node's own place.
    pub fn places(&self, to_model: DAffine3) -> impl Iterator<Item = DAffine3> {
        let once = self.instances.is_none().then_some(to_model);
        let instances = self.instances.iter().flatten();
        once.into_iter()
            .chain(instances.map(move |instance| to_model * instance))
    }
}

impl Model {
    /// How much each morph target of what a node shows counts without animation.
    pub(super) fn weights<'a>(&'a self, node: &'a Node) -> &'a [f32] {
        let of_shape = || Some(self.shapes.get(node.shape?)?.weights.as_slice());
        match &node.weights {
            Some(weights) => weights,
            None => of_shape().unwrap_or_default(),
        }
    }

    /// Every node that is drawn, with its transform to the model's space as the file has it: the nodes under the roots,
    /// parents before their children.
    pub fn placed_nodes(&self) -> Vec<(&Node, DAffine3)> {
        let mut placed = Vec::with_capacity(self.nodes.len());
        // A stack of its own: files have chains of nodes deeper than a thread's stack.
        let mut open: Vec<(usize, DAffine3)> = self
            .roots
            .iter()
            .rev()
            .map(|&root| (root, DAffine3::IDENTITY))
            .collect();
        while let Some((index, to_model)) = open.pop() {
            let node = &self.nodes[index];
            let to_model = to_model * node.to_parent;
            placed.push((node, to_model));
            open.extend(node.children.iter().rev().map(|&child| (child, to_model)));
        }
        placed
    }
}
