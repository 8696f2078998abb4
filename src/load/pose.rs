//! A model at one moment: where its nodes stand, what shape its meshes have, what its materials, lights and cameras are.

mod curve;
mod deformation;
mod meshes;
mod morphing;
mod motion;
mod properties;
mod skinning;

pub(super) use curve::{Curve, Interpolation};
pub(super) use deformation::{Deformation, Influence, MorphTarget, Offset, Skin};
pub(super) use meshes::PosedMeshes;
pub(super) use motion::{Factors, Motion, Target, Track};
pub(super) use properties::{
    CameraProperty, Emissive, LightProperty, MaterialProperty, TextureSlot, TextureTransform,
    TransformPart,
};

use super::{Model, ModelCamera, Node};
use crate::light::Light;
use crate::material::Material;
use glam::DAffine3;
use properties::Changed;
use std::borrow::Cow;
use std::collections::BTreeMap;

/// A model at one moment. What does not move is the model's own.
#[derive(Debug)]
pub(super) struct Pose<'a> {
    model: &'a Model,
    /// The nodes under the roots, parents before their children.
    pub(super) nodes: Vec<PosedNode<'a>>,
    /// By their index in the model.
    pub(super) materials: Cow<'a, [Material]>,
    /// By their index in the model.
    pub(super) lights: Cow<'a, [Light]>,
    /// By their index in the model.
    pub(super) cameras: Cow<'a, [ModelCamera]>,
    moved: Moved,
    /// Of each skin, what takes its meshes from their space to the model's.
    joints: Vec<Vec<DAffine3>>,
    /// Nodes that are left out, since their place is not of finite numbers at this moment.
    pub(super) nowhere: usize,
}

/// A node in its place.
#[derive(Clone, Copy, Debug)]
pub(super) struct PosedNode<'a> {
    /// Its index in the model.
    pub(super) index: usize,
    /// The node itself.
    pub(super) node: &'a Node,
    /// From its space to the model's.
    pub(super) to_model: DAffine3,
    /// Whether what it holds is seen; cameras see in any case (KHR_node_visibility).
    pub(super) is_visible: bool,
}

/// What curves say of nodes and shapes, by index.
#[derive(Debug, Default)]
struct Moved {
    factors: BTreeMap<usize, Factors>,
    hidden: BTreeMap<usize, bool>,
    node_weights: BTreeMap<usize, Vec<f32>>,
    shape_weights: BTreeMap<usize, Vec<f32>>,
}

impl<'a> Pose<'a> {
    /// The model `time` seconds into its animation.
    pub(super) fn at(model: &'a Model, time: f64) -> Pose<'a> {
        let mut pose = Pose {
            model,
            nodes: Vec::new(),
            materials: Cow::Borrowed(&model.materials),
            lights: Cow::Borrowed(&model.lights),
            cameras: Cow::Borrowed(&model.cameras),
            moved: Moved::default(),
            joints: Vec::new(),
            nowhere: 0,
        };
        pose.follow_tracks(time);
        pose.place_nodes();
        pose.place_joints();
        pose
    }

    fn follow_tracks(&mut self, time: f64) {
        let model = self.model;
        let moved = &mut self.moved;
        moved.factors = model.motion.rest.clone();
        let mut changed: BTreeMap<usize, Changed> = BTreeMap::new();
        for Track { target, curve } in &model.motion.tracks {
            let mut change = |node: &usize, change: &dyn Fn(&mut Factors)| {
                if let Some(factors) = moved.factors.get_mut(node) {
                    change(factors);
                }
            };
            match target {
                Target::Translation(node) => {
                    change(node, &|f| f.translation = curve.three_at(time).into());
                }
                Target::Rotation(node) => change(node, &|f| {
                    f.rotation = curve.rotation_at(time).unwrap_or(f.rotation);
                }),
                Target::Scale(node) => change(node, &|f| f.scale = curve.three_at(time).into()),
                Target::Visibility(node) => {
                    moved.hidden.insert(*node, curve.first_at(time) == 0.0);
                }
                Target::NodeWeights(node) => {
                    moved.node_weights.insert(*node, weights_at(curve, time));
                }
                Target::NodeWeight(node, one) => {
                    let rest = || model.nodes.get(*node).map_or(&[][..], |n| model.weights(n));
                    let weights = moved
                        .node_weights
                        .entry(*node)
                        .or_insert_with(|| rest().to_vec());
                    set_weight(weights, *one, curve.first_at(time));
                }
                Target::ShapeWeights(shape) => {
                    moved.shape_weights.insert(*shape, weights_at(curve, time));
                }
                Target::ShapeWeight(shape, one) => {
                    let rest = || model.shapes.get(*shape).map_or(&[][..], |s| &s.weights);
                    let weights = moved
                        .shape_weights
                        .entry(*shape)
                        .or_insert_with(|| rest().to_vec());
                    set_weight(weights, *one, curve.first_at(time));
                }
                Target::Material(index, property) => {
                    if let Some(material) = self.materials.to_mut().get_mut(*index) {
                        let changed = changed.entry(*index).or_default();
                        property.set(material, curve, time, changed);
                    }
                }
                Target::Light(index, property) => {
                    if let Some(light) = self.lights.to_mut().get_mut(*index) {
                        property.set(light, curve, time);
                    }
                }
                Target::Camera(index, property) => {
                    if let Some(camera) = self.cameras.to_mut().get_mut(*index) {
                        property.set(camera, curve, time);
                    }
                }
            }
        }
    }

    fn place_nodes(&mut self) {
        let model = self.model;
        self.nodes.reserve(model.nodes.len());
        // A stack of its own: files have chains of nodes deeper than a thread's stack.
        let mut open: Vec<(usize, DAffine3, bool)> = model
            .roots
            .iter()
            .rev()
            .map(|&root| (root, DAffine3::IDENTITY, true))
            .collect();
        while let Some((index, above, is_visible)) = open.pop() {
            let node = &model.nodes[index];
            let to_model = above * self.to_parent(index, node);
            if !is_somewhere(&to_model) {
                self.nowhere += 1;
                continue;
            }
            let hidden = self.moved.hidden.get(&index).copied();
            let is_visible = is_visible && !hidden.unwrap_or(node.is_hidden);
            self.nodes.push(PosedNode {
                index,
                node,
                to_model,
                is_visible,
            });
            let below = node.children.iter().rev();
            open.extend(below.map(|&child| (child, to_model, is_visible)));
        }
    }

    fn to_parent(&self, index: usize, node: &Node) -> DAffine3 {
        let factors = self.moved.factors.get(&index);
        factors.map_or(node.to_parent, Factors::matrix)
    }

    /// The joints of every skin. Some files keep them outside of what is drawn.
    fn place_joints(&mut self) {
        let model = self.model;
        if model.skins.is_empty() {
            return;
        }
        let mut places: Vec<Option<DAffine3>> = vec![None; model.nodes.len()];
        for posed in &self.nodes {
            places[posed.index] = Some(posed.to_model);
        }
        let mut has_parent = vec![false; model.nodes.len()];
        for &child in model.nodes.iter().flat_map(|node| &node.children) {
            has_parent[child] = true;
        }
        let tops = (0..model.nodes.len()).filter(|&node| !has_parent[node]);
        let mut open: Vec<(usize, DAffine3)> = tops.map(|top| (top, DAffine3::IDENTITY)).collect();
        while let Some((index, above)) = open.pop() {
            let node = &model.nodes[index];
            let to_model = places[index].unwrap_or(above * self.to_parent(index, node));
            places[index] = Some(to_model);
            open.extend(node.children.iter().map(|&child| (child, to_model)));
        }
        let place = |joint: usize| places[joint].unwrap_or(DAffine3::IDENTITY);
        self.joints = model
            .skins
            .iter()
            .map(|skin| {
                let joints = skin.joints.iter().enumerate();
                let moved = joints.map(|(i, &joint)| match skin.inverse_binds.get(i) {
                    Some(inverse_bind) => place(joint) * *inverse_bind,
                    None => place(joint),
                });
                moved.collect()
            })
            .collect();
    }

    /// How much each morph target counts in what a node shows, and the node's index where that is its own.
    fn weights(&self, posed: &PosedNode<'a>) -> (&[f32], Option<usize>) {
        let PosedNode { index, node, .. } = *posed;
        let of_shape = || self.moved.shape_weights.get(&node.shape?);
        match (self.moved.node_weights.get(&index), of_shape()) {
            (Some(of_node), _) => (of_node, Some(index)),
            (None, Some(of_shape)) if node.weights.is_none() => (of_shape, None),
            _ => (
                self.model.weights(node),
                node.weights.is_some().then_some(index),
            ),
        }
    }
}

fn weights_at(curve: &Curve, time: f64) -> Vec<f32> {
    curve.at(time).into_iter().map(|w| w as f32).collect()
}

fn set_weight(weights: &mut Vec<f32>, one: usize, weight: f64) {
    if one >= weights.len() {
        weights.resize(one + 1, 0.0);
    }
    weights[one] = weight as f32;
}

/// Whether a transform is of finite 32-bit numbers.
pub(super) fn is_somewhere(to_model: &DAffine3) -> bool {
    to_model
        .to_cols_array()
        .iter()
        .all(|x| x.abs() <= f64::from(f32::MAX))
}
