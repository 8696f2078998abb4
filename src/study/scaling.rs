//! `luch study scaling`: shapes of ever more primitives. The paper says that cost depends only weakly on a scene's
//! complexity; this says how weakly.

mod growth;
mod report;

pub use report::report;

use super::case::{Case, Measure, Source, Threads, What};
use crate::accel::{Layout, Options};

/// What is timed of every case.
pub const MEASURES: [Measure; 2] = [
    Measure {
        what: What::Build,
        threads: Threads::All,
    },
    Measure {
        what: What::Frame,
        threads: Threads::All,
    },
];

/// The least and the greatest number of primitives that are tried unless others are asked for.
pub const COUNTS: [u32; 7] = [10, 100, 1_000, 10_000, 100_000, 1_000_000, 10_000_000];
/// What the group of a shape without a tree is called, after the shape.
pub(super) const WITHOUT_TREE: &str = ", no tree";

/// Every shape at every count with a tree, and without one, the least counts first. `source` gives a shape of about so
/// many primitives.
pub fn cases(
    shapes: &[String],
    counts: &[u32],
    options: &Options,
    source: impl Fn(&str, u32) -> Source,
) -> Vec<Case> {
    let mut cases = Vec::new();
    for &count in counts {
        for shape in shapes {
            let source = source(shape, count);
            let case = |group: String, layout| Case {
                name: format!("{group}, {count}"),
                group,
                source: source.clone(),
                options: Options { layout, ..*options },
                samples: 1,
            };
            cases.push(case(shape.clone(), options.layout));
            cases.push(case(format!("{shape}{WITHOUT_TREE}"), Layout::List));
        }
    }
    cases
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::Camera;
    use crate::scene::{Scene, SceneDescription};
    use glam::Vec3;
    use std::sync::Arc;

    fn nothing(shape: &str, count: u32) -> Source {
        let camera = Camera::looking_at(Vec3::Z, Vec3::ZERO, Vec3::Y, 1.0);
        let scene = Scene::new(SceneDescription::empty(camera)).expect("a scene");
        Source::of(&format!("{shape}:{count}"), Arc::new(scene))
    }

    #[test]
    fn every_shape_comes_with_and_without_a_tree_the_least_counts_first() {
        let shapes = ["grid".to_owned(), "hair".to_owned()];
        let cases = cases(&shapes, &[10, 100], &Options::default(), nothing);
        let names: Vec<&str> = cases.iter().map(|case| case.name.as_str()).collect();
        let of_ten = [
            "grid, 10",
            "grid, no tree, 10",
            "hair, 10",
            "hair, no tree, 10",
        ];
        assert_eq!(names[..4], of_ten);
        assert_eq!(names.len(), 8);
    }
}
