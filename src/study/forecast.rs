//! What a case is going to cost, to know what there is time for.

use super::case::Case;
use super::plan::Plan;
use super::setting::PRESETS;
use crate::accel::{Builder, Layout, Options};

/// What a case costs, in seconds.
#[derive(Clone, Copy)]
pub(super) struct Cost {
    /// Its index.
    pub(super) case: usize,
    /// Of its scene: generated, and made ready.
    pub(super) scene: f64,
    /// Of all else before the first round.
    pub(super) warm_up: f64,
    /// Of everything that is timed in a round.
    pub(super) round: f64,
    /// Of its tree on all threads.
    pub(super) build: f64,
}

/// What the case at `index` should cost, by the last that is known of its group, or else the first of all. Builds grow in
/// proportion to the primitives, frames to the samples and hardly to the primitives, unless there is no tree.
pub(super) fn expected(plan: &Plan, costs: &[Cost], index: usize) -> Cost {
    let case = &plan.cases[index];
    let of_group = costs
        .iter()
        .rev()
        .find(|cost| plan.cases[cost.case].group == case.group);
    let Some(cost) = of_group.or(costs.first()) else {
        return Cost {
            case: index,
            scene: 0.0,
            warm_up: 0.0,
            round: 0.0,
            build: 0.0,
        };
    };
    let known = &plan.cases[cost.case];
    let primitives = |case: &Case| case.source.primitives.max(1) as f64;
    let times = primitives(case) / primitives(known);
    let is_list = case.options.layout == Layout::List;
    let efforts = build_effort(&case.options) / build_effort(&known.options);
    let build = if is_list {
        0.0
    } else {
        cost.build * times * efforts
    };
    let longer = f64::from(case.samples) / f64::from(known.samples)
        * if is_list { times.max(1.0) } else { 1.0 };
    let frames = (cost.round - plan.builds_expected(cost.build)).max(0.0);
    let is_new = case.source.name != known.source.name;
    let scene = if is_new { cost.scene * times } else { 0.0 };
    Cost {
        case: index,
        scene,
        warm_up: (cost.warm_up - cost.build).max(0.0) * longer + build,
        round: plan.builds_expected(build) + frames * longer,
        build,
    }
}

/// What a build takes, about, against the usual one: as measured over a terrain of a million triangles on 2 cores.
fn build_effort(options: &Options) -> f64 {
    let efforts = match options.builder {
        Builder::Own => [0.2, 0.5, 0.6, 1.0, 5.0, 17.0],
        Builder::Obvhs => [0.4, 0.5, 0.8, 1.2, 3.5, 8.0],
    };
    let place = PRESETS.iter().position(|preset| *preset == options.preset);
    efforts[place.unwrap_or(0)]
}

#[cfg(test)]
mod tests {
    use super::super::case::Source;
    use super::super::plan::Effort;
    use super::super::scaling;
    use super::*;
    use crate::camera::Camera;
    use crate::scene::{Scene, SceneDescription};
    use crate::shade::Shading;
    use crate::texture::TextureFilter;
    use glam::Vec3;
    use std::sync::Arc;

    fn plan() -> Plan {
        let camera = Camera::looking_at(Vec3::Z, Vec3::ZERO, Vec3::Y, 1.0);
        let scene = Arc::new(Scene::new(SceneDescription::empty(camera)).expect("a scene"));
        let source = |shape: &str, count: u32| Source {
            primitives: u64::from(count),
            ..Source::of(&format!("{shape}:{count}"), scene.clone())
        };
        let shapes = ["terrain".to_owned()];
        let cases: Vec<Case> = scaling::cases(&shapes, &[100, 1000], &Options::default(), source);
        Plan {
            study: "scaling",
            cases,
            measures: scaling::MEASURES.to_vec(),
            effort: Effort::QUICK,
            max_depth: 5,
            shading: Shading::BlinnPhong,
            texture_filter: TextureFilter::Footprint,
            threads: 1,
            error_against: None,
            heat_maps: Vec::new(),
        }
    }

    #[test]
    fn ten_times_the_primitives_cost_ten_times_the_build_and_without_a_tree_ten_times_all() {
        let cost = |case, build| Cost {
            case,
            scene: 3.0,
            warm_up: 8.0,
            round: 2.0,
            build,
        };
        let known = [cost(0, 1.0), cost(1, 0.0)];
        let with_tree = expected(&plan(), &known, 2);
        assert_eq!(with_tree.scene, 30.0);
        assert_eq!(
            (with_tree.warm_up, with_tree.round),
            (7.0 + 10.0, 1.0 + 10.0)
        );
        let without = expected(&plan(), &known, 3);
        assert_eq!((without.warm_up, without.round), (80.0, 20.0));
    }
}
