//! The tree of nodes: where everything stands.
//!
//! A file's nodes are a graph until someone has looked: here each gets one parent, or the file is refused. Nothing
//! calls itself: files have chains of nodes deeper than a thread's stack.

use super::Warnings;
use super::document::{Document, named};
use super::implicit_shapes::Shapes;
use super::node_visibility::{self, Visibility};
use super::transforms::to_parent;
use super::{extensions, lights_punctual, mesh_gpu_instancing, morph_targets};
use crate::Error;
use crate::load::pose::is_somewhere;
use crate::load::{ModelMesh, Node, choice};
use glam::DAffine3;

/// The nodes of a file and those at the top of what is drawn.
#[derive(Debug, Default)]
pub(super) struct Tree {
    /// By their index in the file.
    pub(super) nodes: Vec<Node>,
    /// The tops, each the only way to what is below it.
    pub(super) roots: Vec<usize>,
}

/// What nodes may hold: the file's meshes, and where in the model each of its cameras, lights and skins went.
pub(super) struct Contents<'a> {
    pub(super) shapes: &'a [ModelMesh],
    pub(super) cameras: &'a [Option<usize>],
    pub(super) lights: &'a [Option<usize>],
    pub(super) implicit: &'a Shapes,
    pub(super) skins: &'a [Option<usize>],
}

/// Reads the nodes of a file and its scene: the one that the user asks for or the file names, else its first, else every
/// node without a parent.
///
/// # Errors
///
/// A node is below itself, an index names nothing, or there is no scene as the user asks for.
pub(super) fn read(
    document: &Document,
    contents: &Contents,
    mut instancing: mesh_gpu_instancing::Reader,
    warnings: &mut Warnings,
) -> Result<Tree, Error> {
    let count = document.root.nodes.len();
    let mut children = Vec::with_capacity(count);
    for (index, node) in document.root.nodes.iter().enumerate() {
        let mut below = Vec::new();
        for child in node.children.iter().flatten() {
            let place = || place(document, index);
            below.push(document.checked(place(), "child node", child.value(), count)?);
        }
        children.push(below);
    }
    let order = parents_first(document, &children)?;
    let mut parents = vec![None; count];
    for (parent, below) in children.iter_mut().enumerate() {
        below.retain(|&child| {
            let first = parents[child].is_none();
            if first {
                parents[child] = Some(parent);
            } else {
                warnings.add("a node with several parents stays with the first");
            }
            first
        });
    }
    let roots = roots(document, &parents, &order, warnings)?;
    let mut nodes = Vec::with_capacity(count);
    for (index, below) in children.into_iter().enumerate() {
        let mut node = one(document, index, below, contents, warnings)?;
        let shape = node.shape.and_then(|shape| contents.shapes.get(shape));
        if let Some(shape) = shape {
            let instances = instancing.read(&document.root.nodes[index], shape.parts.len());
            let instances = instances.map_err(|problem| {
                let name = mesh_gpu_instancing::NAME;
                document.malformed(format!("{}, {name}", place(document, index)), problem)
            })?;
            node.instances = instances;
        }
        nodes.push(node);
    }
    let mut tree = Tree { nodes, roots };
    tree.cut_what_is_nowhere(warnings);
    Ok(tree)
}

fn place(document: &Document, index: usize) -> String {
    let name = document.root.nodes.get(index).and_then(|n| n.name.as_ref());
    named("node", index, name)
}

/// Every node, parents before their children; an error where a node is below itself.
fn parents_first(document: &Document, children: &[Vec<usize>]) -> Result<Vec<usize>, Error> {
    #[derive(Clone, Copy, PartialEq)]
    enum State {
        New,
        Open,
        Done,
    }
    let mut states = vec![State::New; children.len()];
    let mut done = Vec::with_capacity(children.len());
    // Each open node with how many of its children were looked at.
    let mut open: Vec<(usize, usize)> = Vec::new();
    for start in 0..children.len() {
        if states[start] == State::New {
            states[start] = State::Open;
            open.push((start, 0));
        }
        while let Some((node, next)) = open.pop() {
            let Some(&child) = children[node].get(next) else {
                states[node] = State::Done;
                done.push(node);
                continue;
            };
            open.push((node, next + 1));
            match states[child] {
                State::Open => {
                    return Err(document.malformed(place(document, child), "is below itself"));
                }
                State::New => {
                    states[child] = State::Open;
                    open.push((child, 0));
                }
                State::Done => {}
            }
        }
    }
    done.reverse();
    Ok(done)
}

/// The nodes at the top of the scene.
fn roots(
    document: &Document,
    parents: &[Option<usize>],
    order: &[usize],
    warnings: &mut Warnings,
) -> Result<Vec<usize>, Error> {
    let root = &document.root;
    let scene = match (&document.options.scene, root.scene) {
        (Some(wanted), _) => {
            let names = root.scenes.iter().map(|scene| scene.name.as_deref());
            let names: Vec<&str> = names.map(Option::unwrap_or_default).collect();
            let found = choice::find("scene", wanted, &names);
            Some(found.map_err(|problem| document.malformed("", problem))?)
        }
        (None, Some(_)) if root.scenes.is_empty() => {
            warnings.add("names a scene and has none: every node without a parent is drawn");
            None
        }
        (None, Some(index)) => {
            Some(document.checked("", "scene", index.value(), root.scenes.len())?)
        }
        (None, None) => (!root.scenes.is_empty()).then_some(0),
    };
    let Some(scene) = scene.and_then(|index| Some((index, root.scenes.get(index)?))) else {
        return Ok((0..parents.len())
            .filter(|&node| parents[node].is_none())
            .collect());
    };
    let (index, scene) = scene;
    let scene_place = || named("scene", index, scene.name.as_ref());
    let mut listed = vec![false; parents.len()];
    let mut in_order = Vec::with_capacity(scene.nodes.len());
    for node in &scene.nodes {
        let node = document.checked(scene_place(), "node", node.value(), parents.len())?;
        if listed[node] {
            warnings.add("a node that a scene lists twice is drawn once");
        } else {
            listed[node] = true;
            in_order.push(node);
        }
    }
    // Whether a node or one above it is listed.
    let mut drawn = listed.clone();
    for &node in order {
        drawn[node] |= parents[node].is_some_and(|parent| drawn[parent]);
    }
    in_order.retain(|&node| match parents[node] {
        None => true,
        Some(parent) => {
            warnings.add(if drawn[parent] {
                "a node that a scene lists beside one above it is drawn once, below that"
            } else {
                "a node that a scene lists without the one above it stands by itself"
            });
            !drawn[parent]
        }
    });
    Ok(in_order)
}

/// A node with its contents.
fn one(
    document: &Document,
    index: usize,
    children: Vec<usize>,
    contents: &Contents,
    warnings: &mut Warnings,
) -> Result<Node, Error> {
    let json = &document.root.nodes[index];
    let place = || place(document, index);
    let shape = match json.mesh {
        Some(mesh) => {
            Some(document.checked(place(), "mesh", mesh.value(), contents.shapes.len())?)
        }
        None => None,
    };
    let camera = match json.camera {
        Some(camera) => {
            let count = contents.cameras.len();
            contents.cameras[document.checked(place(), "camera", camera.value(), count)?]
        }
        None => None,
    };
    let others = json.extensions.as_ref().map(|e| &e.others);
    let light = match extensions::read::<lights_punctual::OfNode>(others, lights_punctual::NAME) {
        Ok(Some(of_node)) => {
            let count = contents.lights.len();
            let light = usize::try_from(of_node.light).unwrap_or(usize::MAX);
            contents.lights[document.checked(place(), "light", light, count)?]
        }
        Ok(None) => None,
        Err(problem) => {
            warnings.add(format!("{}: {problem}: its light is ignored", place()));
            None
        }
    };
    let skin = match json.skin {
        Some(_) if shape.is_none() => None,
        Some(skin) => {
            let count = contents.skins.len();
            let known = contents.skins.get(skin.value());
            if known.is_none() {
                let skin = skin.value();
                warnings.add(format!(
                    "{}: skin {skin} does not exist, there are {count}: it is ignored",
                    place()
                ));
            }
            known.copied().flatten()
        }
        None => None,
    };
    let weights = match (&json.weights, shape) {
        (Some(weights), Some(mesh)) => {
            Some(morph_targets::fitting(document, weights, mesh, warnings))
        }
        _ => None,
    };
    let visibility = extensions::read::<Visibility>(others, node_visibility::NAME);
    let is_hidden = match visibility {
        Ok(visibility) => visibility.is_some_and(|visibility| !visibility.visible),
        Err(problem) => {
            warnings.add(format!("{}: {problem}: it is seen", place()));
            false
        }
    };
    Ok(Node {
        name: json.name.clone().unwrap_or_default(),
        children,
        to_parent: to_parent(json, warnings),
        shape,
        analytic: contents
            .implicit
            .of_node(document, others, &place(), warnings)?,
        instances: None,
        camera,
        light,
        skin,
        weights,
        is_hidden,
    })
}

impl Tree {
    /// Empties nodes whose transform to the model's space is not of finite 32-bit numbers, and all below them. What a
    /// singular transform flattens stays: a scale of 0 is how files hide things.
    fn cut_what_is_nowhere(&mut self, warnings: &mut Warnings) {
        let mut open: Vec<(usize, DAffine3)> = self
            .roots
            .iter()
            .map(|&root| (root, DAffine3::IDENTITY))
            .collect();
        while let Some((index, above)) = open.pop() {
            let node = &mut self.nodes[index];
            let to_model = above * node.to_parent;
            if is_somewhere(&to_model) {
                if let Some(instances) = &mut node.instances {
                    let count = instances.len();
                    instances.retain(|instance| is_somewhere(&(to_model * *instance)));
                    let problem =
                        "an instance whose transform is not of finite numbers is not drawn";
                    warnings.add_times(problem, count - instances.len());
                }
                if node.to_parent.matrix3.determinant() == 0.0 {
                    let place = named("node", index, Some(&node.name));
                    warnings.add(format!(
                        "{place}: its transform is singular: what it places is flattened"
                    ));
                }
                open.extend(node.children.iter().map(|&child| (child, to_model)));
            } else {
                let place = named("node", index, Some(&node.name));
                warnings.add(format!(
                    "{place}: its transform is not of finite numbers: nothing from it downward is drawn"
                ));
                *node = Node {
                    name: std::mem::take(&mut node.name),
                    ..Node::default()
                };
            }
        }
    }
}
