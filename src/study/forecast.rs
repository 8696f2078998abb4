//! What a case is going to cost, to know what there is time for.

use super::plan::Plan;
use crate::accel::Layout;

/// What a warm-up builds, makes and checks beside the round that is in it, as builds of a case's own tree.
const WARM_UP_BUILDS: f64 = 5.0;

/// What a case costs, in seconds.
#[derive(Clone, Copy)]
pub(super) struct Cost {
    /// Its index.
    pub(super) case: usize,
    /// Of all before the first round.
    pub(super) warm_up: f64,
    /// Of everything that is timed in a round.
    pub(super) round: f64,
    /// Of its tree on all threads.
    pub(super) build: f64,
}

/// What the case at `index` should cost: what others did or, where one of its group is known, what that did. The build
/// grows in proportion to the primitives, all else hardly, unless there is no tree.
pub(super) fn expected(plan: &Plan, costs: &[Cost], index: usize) -> Cost {
    let case = &plan.cases[index];
    let count = costs.len().max(1) as f64;
    let mean = |of: fn(&Cost) -> f64| costs.iter().map(of).sum::<f64>() / count;
    let alike = costs
        .iter()
        .rev()
        .find(|cost| plan.cases[cost.case].group == case.group);
    let Some(cost) = alike else {
        return Cost {
            case: index,
            warm_up: mean(|cost| cost.warm_up),
            round: mean(|cost| cost.round),
            build: mean(|cost| cost.build),
        };
    };
    let before = plan.cases[cost.case].source.primitives.max(1) as f64;
    let times = (case.source.primitives as f64 / before).max(1.0);
    if case.options.layout == Layout::List {
        return Cost {
            case: index,
            warm_up: cost.warm_up * times,
            round: cost.round * times,
            build: 0.0,
        };
    }
    let more = cost.build * (times - 1.0);
    Cost {
        case: index,
        warm_up: cost.warm_up + WARM_UP_BUILDS * more,
        round: cost.round + more,
        build: cost.build * times,
    }
}

#[cfg(test)]
mod tests {
    use super::super::case::{Case, Source};
    use super::super::plan::Effort;
    use super::super::scaling;
    use super::*;
    use crate::accel::Options;
    use crate::camera::Camera;
    use crate::scene::{Scene, SceneDescription};
    use crate::shade::Shading;
    use glam::Vec3;
    use std::sync::Arc;

    fn plan() -> Plan {
        let camera = Camera::looking_at(Vec3::Z, Vec3::ZERO, Vec3::Y, 1.0);
        let scene = Arc::new(Scene::new(SceneDescription::empty(camera)).expect("a scene"));
        let source = |shape: &str, count: u32| Source {
            primitives: u64::from(count),
            ..Source::of(shape, scene.clone())
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
            threads: 1,
            error_against: None,
            heat_maps: Vec::new(),
        }
    }

    #[test]
    fn ten_times_the_primitives_cost_ten_times_the_build_and_without_a_tree_ten_times_all() {
        let cost = |case, build| Cost {
            case,
            warm_up: 8.0,
            round: 2.0,
            build,
        };
        let known = [cost(0, 1.0), cost(1, 0.0)];
        let with_tree = expected(&plan(), &known, 2);
        assert_eq!(
            (with_tree.warm_up, with_tree.round),
            (8.0 + 5.0 * 9.0, 2.0 + 9.0)
        );
        let without = expected(&plan(), &known, 3);
        assert_eq!((without.warm_up, without.round), (80.0, 20.0));
    }
}
