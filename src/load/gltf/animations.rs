//! Animations: which there are, and the curves of those that were chosen (glTF 2.0, section 3.11).
//!
//! A channel that cannot be followed costs itself, with a warning, not the model.

use super::accessors;
use super::animation_pointer;
use super::buffers::Buffers;
use super::document::{Document, named, one_line};
use super::morph_targets::targets_of_node;
use super::{Warnings, meshes, transforms};
use crate::load::pose::{Curve, Interpolation, Motion, Target, Track};
use crate::load::{AnimationFacts, Moved};
use gltf::json::accessor::Type;
use gltf::json::animation::{Animation, Interpolation as InterpolationJson, Property, Sampler};
use gltf::json::validation::Checked;
use std::collections::HashMap;
use std::sync::Arc;

/// Where in the model each camera and light of the file went.
pub(super) struct Places<'a> {
    pub(super) cameras: &'a [Option<usize>],
    pub(super) lights: &'a [Option<usize>],
}

/// What a channel changes.
pub(super) struct Change {
    pub(super) target: Target,
    /// How many numbers a value has.
    width: usize,
    /// How many of them an element of the accessor has.
    components: usize,
    /// How many numbers it comes to at every moment.
    cost: usize,
}

impl Change {
    /// Something whose values are elements of an accessor.
    pub(super) fn of(target: Target, width: usize) -> Change {
        Change {
            target,
            width,
            components: width,
            cost: width,
        }
    }

    /// Weights, which lie one by one.
    pub(super) fn of_weights(target: Target, width: usize) -> Change {
        Change {
            target,
            width,
            components: 1,
            cost: width,
        }
    }

    /// One of so many weights.
    pub(super) fn of_weight(target: Target, among: usize) -> Change {
        Change {
            target,
            width: 1,
            components: 1,
            cost: among,
        }
    }
}

/// What each animation of a file is, and what those do that the options choose.
pub(super) fn read(
    document: &Document,
    buffers: &Buffers,
    places: &Places,
    warnings: &mut Warnings,
) -> (Vec<AnimationFacts>, Motion) {
    let animations = &document.root.animations;
    let mut numbers = Numbers {
        document,
        buffers,
        known: HashMap::new(),
        ends: HashMap::new(),
        budget: meshes::budget(buffers),
    };
    let facts: Vec<AnimationFacts> = animations
        .iter()
        .map(|animation| facts(animation, &mut numbers))
        .collect();
    let mut motion = Motion::default();
    for index in document.options.animation.chosen(&facts) {
        let Some(animation) = animations.get(index) else {
            continue;
        };
        let name = named("animation", index, animation.name.as_ref());
        for (number, channel) in channels(animation).into_iter().enumerate() {
            let change = channel.change(document, places);
            let track = change.and_then(|change| numbers.track(animation, channel.sampler, change));
            match track {
                Ok(track) => {
                    if let Target::Translation(node) | Target::Rotation(node) | Target::Scale(node) =
                        track.target
                        && let Some(json) = document.root.nodes.get(node)
                    {
                        motion.rest.insert(node, transforms::factors_of(json));
                    }
                    motion.tracks.push(track);
                }
                Err(problem) => {
                    warnings.add(format!(
                        "{name}, channel {number}: {problem}: it moves nothing"
                    ));
                }
            }
        }
    }
    (facts, motion)
}

/// A channel of either kind.
struct Channel<'a> {
    sampler: usize,
    moves: Moves<'a>,
}

/// What a channel says that it moves.
enum Moves<'a> {
    /// A node, by its index.
    OfNode(usize, Checked<Property>),
    /// What a pointer leads to (KHR_animation_pointer).
    Pointer(&'a str),
}

/// The channels that name something, those of nodes first.
fn channels(animation: &Animation) -> Vec<Channel<'_>> {
    let of_nodes = animation.channels.iter().map(|channel| Channel {
        sampler: channel.sampler.value(),
        moves: Moves::OfNode(channel.target.node.value(), channel.target.path),
    });
    let pointers = animation_pointer::kept(animation);
    let pointers = pointers.map(|(sampler, pointer)| Channel {
        sampler,
        moves: Moves::Pointer(pointer),
    });
    of_nodes.chain(pointers).collect()
}

impl Channel<'_> {
    fn change(&self, document: &Document, places: &Places) -> Result<Change, String> {
        let (node, path) = match self.moves {
            Moves::Pointer(pointer) => return animation_pointer::change(pointer, document, places),
            Moves::OfNode(node, path) => (node, path),
        };
        let count = document.root.nodes.len();
        if node >= count {
            return Err(format!("node {node} does not exist, there are {count}"));
        }
        let Checked::Valid(path) = path else {
            return Err("its path is unknown".into());
        };
        match path {
            Property::Translation => Ok(Change::of(Target::Translation(node), 3)),
            Property::Rotation => Ok(Change::of(Target::Rotation(node), 4)),
            Property::Scale => Ok(Change::of(Target::Scale(node), 3)),
            Property::MorphTargetWeights => {
                let targets = targets_of_node(document, node)?;
                Ok(Change::of_weights(Target::NodeWeights(node), targets))
            }
        }
    }

    /// What it moves, in a word of the file.
    fn what(&self) -> String {
        match self.moves {
            Moves::OfNode(_, Checked::Valid(Property::Translation)) => "translation".into(),
            Moves::OfNode(_, Checked::Valid(Property::Rotation)) => "rotation".into(),
            Moves::OfNode(_, Checked::Valid(Property::Scale)) => "scale".into(),
            Moves::OfNode(_, Checked::Valid(Property::MorphTargetWeights)) => "weights".into(),
            Moves::OfNode(_, Checked::Invalid) => "unknown".into(),
            Moves::Pointer(pointer) => {
                let is_word = |part: &&str| !part.bytes().all(|b| b.is_ascii_digit());
                one_line(pointer.rsplit('/').find(is_word).unwrap_or(pointer))
            }
        }
    }
}

fn facts(animation: &Animation, numbers: &mut Numbers) -> AnimationFacts {
    let mut seconds = 0.0;
    let mut moves: Vec<Moved> = Vec::new();
    let mut places: HashMap<String, usize> = HashMap::new();
    for channel in channels(animation) {
        if let Some(sampler) = animation.samplers.get(channel.sampler) {
            seconds = numbers.end(sampler.input.value()).max(seconds);
        }
        let what = channel.what();
        let place = *places.entry(what).or_insert_with_key(|what| {
            let what = what.clone();
            moves.push(Moved { what, count: 0 });
            moves.len() - 1
        });
        moves[place].count += 1;
    }
    AnimationFacts {
        name: animation.name.clone().unwrap_or_default(),
        seconds,
        moves,
    }
}

/// An accessor's numbers, and how many an element has; or why there are none.
type Read = Result<(Arc<[f32]>, usize), String>;

/// The numbers of accessors, each accessor once.
struct Numbers<'a> {
    document: &'a Document,
    buffers: &'a Buffers<'a>,
    known: HashMap<usize, Read>,
    /// The last number of those that are times.
    ends: HashMap<usize, f64>,
    /// How many more there may be: many accessors can be of the same bytes.
    budget: u64,
}

impl Numbers<'_> {
    /// The last of an accessor's numbers; 0 where there is none.
    fn end(&mut self, accessor: usize) -> f64 {
        let (document, buffers) = (self.document, self.buffers);
        *self.ends.entry(accessor).or_insert_with(|| {
            let times = accessors::read(document, buffers, accessor, &[Type::Scalar]).ok();
            let last = times.and_then(|times| {
                let [last] = times.floats::<1>(times.count.checked_sub(1)?);
                Some(f64::from(last)).filter(|last| last.is_finite())
            });
            last.unwrap_or_default()
        })
    }

    fn of(&mut self, accessor: usize) -> Read {
        if let Some(known) = self.known.get(&accessor) {
            return known.clone();
        }
        let read = self.read(accessor);
        self.known.insert(accessor, read.clone());
        read
    }

    fn read(&mut self, accessor: usize) -> Read {
        let kinds = [Type::Scalar, Type::Vec2, Type::Vec3, Type::Vec4];
        let elements = accessors::read(self.document, self.buffers, accessor, &kinds)?;
        self.spend(elements.count.saturating_mul(elements.components))?;
        let bytes = (elements.count as u64).saturating_mul(elements.components as u64 * 8);
        let taken = self.document.budget.take(bytes);
        taken.map_err(|problem| format!("accessor {accessor}: {problem}"))?;
        let numbers = elements.all_numbers();
        if !numbers.iter().all(|number| number.is_finite()) {
            return Err(format!("accessor {accessor}: is not of finite numbers"));
        }
        Ok((numbers.into(), elements.components))
    }

    fn spend(&mut self, numbers: usize) -> Result<(), String> {
        let rest = self.budget.checked_sub(numbers as u64);
        self.budget = rest.ok_or("the keys up to here are many times what the buffers hold")?;
        Ok(())
    }

    /// What a sampler makes of a change.
    fn track(
        &mut self,
        animation: &Animation,
        sampler: usize,
        change: Change,
    ) -> Result<Track, String> {
        let Change {
            target,
            width,
            components,
            cost,
        } = change;
        self.spend(cost)?;
        let count = animation.samplers.len();
        let sampler = animation
            .samplers
            .get(sampler)
            .ok_or_else(|| format!("sampler {sampler} does not exist, there are {count}"))?;
        let interpolation = interpolation(sampler)?;
        let (times, of_time) = self.of(sampler.input.value())?;
        let (values, of_value) = self.of(sampler.output.value())?;
        for (what, found, expected) in [("times", of_time, 1), ("values", of_value, components)] {
            if found != expected {
                return Err(format!(
                    "its {what} have {found} numbers each, expected {expected}"
                ));
            }
        }
        if times.is_empty() {
            return Err("has no keys".into());
        }
        if !times.is_sorted() {
            return Err("its times do not rise".into());
        }
        let expected = Curve::numbers(times.len(), width, interpolation);
        if expected != Some(values.len()) {
            let keys = times.len();
            let found = values.len() / components.max(1);
            let expected = expected.unwrap_or(usize::MAX) / components.max(1);
            return Err(format!(
                "has {found} values for {keys} times, expected {expected}"
            ));
        }
        let curve = Curve {
            times,
            values,
            width,
            interpolation,
        };
        Ok(Track { target, curve })
    }
}

fn interpolation(sampler: &Sampler) -> Result<Interpolation, String> {
    match sampler.interpolation {
        Checked::Valid(InterpolationJson::Step) => Ok(Interpolation::Step),
        Checked::Valid(InterpolationJson::Linear) => Ok(Interpolation::Linear),
        Checked::Valid(InterpolationJson::CubicSpline) => Ok(Interpolation::Cubic),
        Checked::Invalid => Err("its interpolation is unknown".into()),
    }
}
