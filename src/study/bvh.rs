//! `luch study bvh`: one model, every setting of the tree, the others being left as they are.

mod advice;
mod plots;
mod report;

pub use report::report;

use super::case::{Case, Measure, Source, Threads, What};
use super::sets::Kind;
use super::setting::{self, DEFAULT_LEAF_SIZE, MOST_LEAF_SIZE};
use crate::accel::{Builder, Isa, Layout, Options, Preset};
use std::num::NonZeroU8;

/// The groups of cases: the questions that are asked.
pub const PRESET: &str = "preset";
/// See [`PRESET`].
pub const LEAF_SIZE: &str = "leaf size";
/// See [`PRESET`].
pub const LAYOUT: &str = "layout";
/// See [`PRESET`].
pub const KERNEL: &str = "kernel";
/// See [`PRESET`].
pub const OBVHS: &str = "obvhs preset";
/// The case that all others differ from in one thing.
pub const DEFAULT: &str = "default";
/// The case without any tree.
pub const NO_TREE: &str = "layout none";

/// What the study varies.
#[derive(Clone, Debug, PartialEq)]
pub struct Choices {
    /// Of luch's own builder.
    pub presets: Vec<Preset>,
    /// Of obvhs's.
    pub obvhs_presets: Vec<Preset>,
    /// The most primitives of a leaf.
    pub leaf_sizes: Vec<NonZeroU8>,
    /// Luch's own two, obvhs's two, and no tree.
    pub layouts: Vec<Layout>,
    /// Instruction sets.
    pub kernels: Vec<Isa>,
}

impl Choices {
    /// Everything there is.
    pub fn all() -> Choices {
        Choices {
            presets: setting::PRESETS.to_vec(),
            obvhs_presets: setting::PRESETS.to_vec(),
            leaf_sizes: (1..=MOST_LEAF_SIZE).filter_map(NonZeroU8::new).collect(),
            layouts: setting::LAYOUTS.to_vec(),
            kernels: Isa::available(),
        }
    }

    /// What a minute suffices for.
    pub fn quick() -> Choices {
        let leaf_sizes = [1, 2, 4, 8, 16];
        Choices {
            obvhs_presets: vec![Preset::Fast, Preset::Medium, Preset::Slow],
            leaf_sizes: leaf_sizes.into_iter().filter_map(NonZeroU8::new).collect(),
            ..Choices::all()
        }
    }
}

/// What is timed of every case.
pub const MEASURES: [Measure; 7] = [
    measure(What::Build, Threads::One),
    measure(What::Build, Threads::All),
    measure(What::Frame, Threads::All),
    measure(What::Rays(Kind::Primary), Threads::One),
    measure(What::Rays(Kind::Shadow), Threads::One),
    measure(What::Rays(Kind::Mirror), Threads::One),
    measure(What::Rays(Kind::Incoherent), Threads::One),
];

const fn measure(what: What, threads: Threads) -> Measure {
    Measure { what, threads }
}

/// One case for each choice, the most telling of every question first.
pub fn cases(source: &Source, choices: &Choices) -> Vec<Case> {
    let kernel = choices.kernels.last().copied().unwrap_or_default();
    let usual = Options {
        isa: kernel,
        ..Options::default()
    };
    let case = |group: &str, name: String, options: Options| Case {
        name,
        group: group.to_owned(),
        source: source.clone(),
        options,
        samples: 1,
    };
    let presets = choices
        .presets
        .iter()
        .filter(|&&preset| preset != usual.preset);
    let presets = presets.map(|&preset| {
        let name = format!("preset {}", setting::preset(preset));
        case(PRESET, name, Options { preset, ..usual })
    });
    let sizes = choices
        .leaf_sizes
        .iter()
        .filter(|size| size.get() != DEFAULT_LEAF_SIZE);
    let leaf_sizes = sizes.map(|&size| {
        let leaf_size = Some(size);
        case(
            LEAF_SIZE,
            format!("leaf size {size}"),
            Options { leaf_size, ..usual },
        )
    });
    let layouts = choices
        .layouts
        .iter()
        .filter(|&&layout| layout != usual.layout);
    let layouts = layouts.map(|&layout| {
        let name = format!("layout {}", setting::layout(layout));
        case(LAYOUT, name, Options { layout, ..usual })
    });
    let kernels = choices.kernels.iter().filter(|&&isa| isa != kernel);
    let kernels =
        kernels.map(|&isa| case(KERNEL, format!("kernel {isa}"), Options { isa, ..usual }));
    let packets = false;
    let alone = case(KERNEL, "packets off".into(), Options { packets, ..usual });
    let obvhs = choices.obvhs_presets.iter().map(|&preset| {
        let (name, builder) = (setting::preset(preset), Builder::Obvhs);
        case(
            OBVHS,
            format!("obvhs {name}"),
            Options {
                builder,
                preset,
                ..usual
            },
        )
    });
    let mut questions: Vec<Vec<Case>> = vec![
        most_telling_first(presets.collect()),
        most_telling_first(leaf_sizes.collect()),
        layouts.collect(),
        kernels.chain([alone]).collect(),
        most_telling_first(obvhs.collect()),
    ];
    let mut cases = vec![case(DEFAULT, DEFAULT.into(), usual)];
    // In turns, so that a small budget has something of every question.
    while questions.iter().any(|question| !question.is_empty()) {
        for question in questions.iter_mut().filter(|question| !question.is_empty()) {
            cases.push(question.remove(0));
        }
    }
    cases
}

/// Both ends, then what halves the gaps.
fn most_telling_first(cases: Vec<Case>) -> Vec<Case> {
    let count = cases.len();
    let mut places: Vec<usize> = Vec::new();
    for parts in [1, 2, 4, 8, 16] {
        let ends = (0..=parts).map(|part| part * count.saturating_sub(1) / parts);
        for place in ends {
            if !places.contains(&place) && place < count {
                places.push(place);
            }
        }
    }
    let mut cases: Vec<Option<Case>> = cases.into_iter().map(Some).collect();
    places
        .into_iter()
        .filter_map(|place| cases[place].take())
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::Camera;
    use crate::generate;
    use crate::scene::Scene;
    use glam::Vec3;
    use std::sync::Arc;

    fn source() -> Source {
        let camera = Camera::looking_at(Vec3::Z, Vec3::ZERO, Vec3::Y, 1.0);
        let scene = Scene::new(generate::sphere_scene(Vec::new(), camera)).expect("a scene");
        Source::of("nothing", Arc::new(scene))
    }

    #[test]
    fn every_choice_has_one_case_and_no_two_have_one_name() {
        let choices = Choices::all();
        let cases = cases(&source(), &choices);
        // The default counts for one of each of the four questions that it answers, packets on being one more.
        let count = 6 + 6 + 16 + 5 + choices.kernels.len() - 3 + 1;
        assert_eq!(cases.len(), count);
        let mut names: Vec<_> = cases.iter().map(|case| &case.name).collect();
        names.sort();
        names.dedup();
        assert_eq!(names.len(), count);
    }

    #[test]
    fn the_default_comes_first_and_then_something_of_every_question() {
        let cases = cases(&source(), &Choices::all());
        let groups: Vec<_> = cases
            .iter()
            .take(6)
            .map(|case| case.group.as_str())
            .collect();
        assert_eq!(groups, [DEFAULT, PRESET, LEAF_SIZE, LAYOUT, KERNEL, OBVHS]);
    }
}
