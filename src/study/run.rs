//! The measuring itself: a warm-up of every case, then round after round of all of them.

use super::case::Case;
use super::forecast::{Cost, expected};
use super::heat_maps::{self, HeatMap};
use super::plan::Plan;
use super::report::Picture;
use super::results::{Facts, Measured, NO_TIME, Results};
use super::round::{Round, SHARE_OF_BUILDS};
use super::stage::{MOST_KEPT_PRIMITIVES, Stages};
use super::watch::Watch;
use rayon::{ThreadPool, ThreadPoolBuildError, ThreadPoolBuilder};
use std::time::{Duration, Instant};

/// Rounds that every case should get: fewer say nothing about the spread.
const WANTED_ROUNDS: f64 = 3.0;

/// The threads of a study: one, and all.
pub(super) struct Pools {
    pub(super) one: ThreadPool,
    pub(super) all: ThreadPool,
}

impl Pools {
    fn new(threads: usize) -> Result<Pools, ThreadPoolBuildError> {
        let pool = |threads| ThreadPoolBuilder::new().num_threads(threads).build();
        Ok(Pools {
            one: pool(1)?,
            all: pool(threads)?,
        })
    }
}

/// Measures what of `plan` is not in `results` yet; stops when the budget, reckoned from `started`, is used up, or when
/// `watch` says so. `save` gets what there is whenever a round is done.
///
/// The heat maps that the plan asks for come back.
///
/// # Errors
///
/// The system gives no threads.
pub fn run(
    plan: &Plan,
    results: &mut Results,
    watch: &Watch,
    started: Instant,
    save: &mut dyn FnMut(&Results),
) -> Result<Vec<Picture>, ThreadPoolBuildError> {
    results.cases = merged(plan, &results.cases);
    results.partial = true;
    let mut study = Study {
        plan,
        watch,
        started,
        pools: Pools::new(plan.threads)?,
        stages: Stages::default(),
    };
    let costs = study.warm_up(results, save);
    study.rounds(results, &costs, save);
    results.partial = watch.is_cancelled();
    Ok(study.heat_maps(results, &costs))
}

/// The plan's cases, with what is known of them already.
fn merged(plan: &Plan, known: &[Measured]) -> Vec<Measured> {
    let measured = |case: &Case| Measured {
        name: case.name.clone(),
        group: case.group.clone(),
        scene: case.source.name.clone(),
        primitives: case.source.primitives,
        settings: case.settings(),
        facts: known
            .iter()
            .find(|known| known.name == case.name)
            .and_then(|known| known.facts.clone()),
        left_out: None,
    };
    plan.cases.iter().map(measured).collect()
}

/// What is learnt of a case before it is timed.
struct WarmUp {
    facts: Facts,
    primitives: u64,
    /// Seconds until the scene was there.
    scene: f64,
    /// Seconds of a round.
    round: f64,
    /// Seconds of a build on all threads.
    build: f64,
}

struct Study<'a> {
    plan: &'a Plan,
    watch: &'a Watch,
    started: Instant,
    pools: Pools,
    stages: Stages,
}

impl Study<'_> {
    fn left(&self) -> f64 {
        self.plan.effort.budget.as_secs_f64() - self.started.elapsed().as_secs_f64()
    }

    /// A round of every case that is not kept, and what needs no clock; as many cases as there is time for.
    fn warm_up(&mut self, results: &mut Results, save: &mut dyn FnMut(&Results)) -> Vec<Cost> {
        let mut costs: Vec<Cost> = Vec::new();
        let count = self.plan.cases.len();
        for (index, case) in self.plan.cases.iter().enumerate() {
            let done = index as f64 / count as f64;
            let to_come = Duration::from_secs_f64(self.left().max(0.0));
            self.watch
                .tell(&format!("warming up: {}", case.name), 0.3 * done, to_come);
            if self.watch.is_cancelled() {
                break;
            }
            let rounds: f64 = costs.iter().map(|cost| cost.round).sum();
            let next = expected(self.plan, &costs, index);
            if !costs.is_empty()
                && next.scene + next.warm_up + WANTED_ROUNDS * (rounds + next.round) > self.left()
            {
                results.cases[index].left_out = Some(NO_TIME.into());
                continue;
            }
            let start = Instant::now();
            match self.warm_up_of(case, &mut results.warnings) {
                Ok(Some(learnt)) => {
                    results.cases[index].primitives = learnt.primitives;
                    results.cases[index].facts = Some(learnt.facts);
                    // What is too large to be kept is made again in every round.
                    let is_kept = learnt.primitives <= MOST_KEPT_PRIMITIVES;
                    let made_again = if is_kept { 0.0 } else { learnt.scene };
                    costs.push(Cost {
                        case: index,
                        scene: learnt.scene,
                        warm_up: start.elapsed().as_secs_f64() - learnt.scene,
                        round: learnt.round + made_again,
                        build: learnt.build,
                    });
                }
                Ok(None) => {}
                Err(reason) => results.cases[index].left_out = Some(reason),
            }
            save(results);
        }
        costs
    }

    /// What is learnt of a case before it is timed; nothing where it was interrupted.
    fn warm_up_of(
        &mut self,
        case: &Case,
        warnings: &mut Vec<String>,
    ) -> Result<Option<WarmUp>, String> {
        let (plan, pools, watch) = (self.plan, &self.pools, self.watch);
        let start = Instant::now();
        let stage = self.stages.of(case, plan, pools, warnings)?;
        let scene = start.elapsed().as_secs_f64();
        let accel = stage.build(case, &pools.all);
        stage.guard(&accel, plan, case, pools)?;
        let mut facts = stage.facts(&accel, case);
        let Some((film, _)) = stage.frame(&accel, plan, case, &pools.all, &watch.picture) else {
            return Ok(None);
        };
        facts.same_picture = stage.has_the_reference_bits(plan, case, &film, pools);
        facts.error = plan
            .error_against
            .map(|samples| stage.error(plan, samples, &film, pools));
        let primitives = u64::from(stage.scene.primitive_count());
        let build = accel.statistics().build_time.as_secs_f64();
        let start = Instant::now();
        let mut round = Round {
            stage,
            plan,
            case,
            pools,
            watch,
            number: 0,
        };
        let builds = plan.builds_expected(build);
        let runs = round.searched(&accel);
        Ok(runs.map(|_| WarmUp {
            facts,
            primitives,
            scene,
            round: builds + start.elapsed().as_secs_f64().max(SHARE_OF_BUILDS * builds),
            build,
        }))
    }

    /// Round after round, every second one backward, so that no case always has the same one before it.
    fn rounds(&mut self, results: &mut Results, costs: &[Cost], save: &mut dyn FnMut(&Results)) {
        let cost: f64 = costs.iter().map(|cost| cost.round).sum();
        let most = self.plan.effort.most_rounds;
        let start = self.started.elapsed().as_secs_f64();
        for round in 1..=most {
            // One round there is always, so that there is a result at all.
            if round > 1 && cost * 1.05 > self.left() {
                break;
            }
            let mut order: Vec<usize> = costs.iter().map(|cost| cost.case).collect();
            if round % 2 == 0 {
                order.reverse();
            }
            let rounds = (self.left() / cost.max(1e-3))
                .min(f64::from(most - round + 1))
                .max(1.0);
            for (place, &index) in order.iter().enumerate() {
                if self.watch.is_cancelled() {
                    return;
                }
                let case = &self.plan.cases[index];
                // Machines can become slower than they were in the warm-up.
                if self.left() < 0.0 && (round > 1 || place > 0) {
                    if round == 1 {
                        results.cases[index].left_out = Some(NO_TIME.into());
                    }
                    continue;
                }
                if results
                    .runs
                    .iter()
                    .any(|run| run.round == round && run.case == case.name)
                {
                    continue;
                }
                let to_come = cost * (rounds - place as f64 / order.len() as f64).max(0.0);
                let passed = self.started.elapsed().as_secs_f64() - start;
                self.watch.tell(
                    &format!("round {round}: {}", case.name),
                    0.3 + 0.7 * passed / (passed + to_come).max(1e-3),
                    Duration::from_secs_f64(to_come),
                );
                let (plan, pools) = (self.plan, &self.pools);
                match self.stages.of(case, plan, pools, &mut results.warnings) {
                    Ok(stage) => results.runs.extend(
                        Round {
                            stage,
                            plan,
                            case,
                            pools,
                            watch: self.watch,
                            number: round,
                        }
                        .run(),
                    ),
                    Err(reason) => results.cases[index].left_out = Some(reason),
                }
            }
            save(results);
        }
    }

    /// The heat maps of the plan, of the cases that were measured and whose builds there is time for.
    fn heat_maps(&mut self, results: &mut Results, costs: &[Cost]) -> Vec<Picture> {
        let (plan, pools, watch) = (self.plan, &self.pools, self.watch);
        let mut maps = Vec::new();
        for name in &plan.heat_maps {
            let place = plan.cases.iter().position(|case| case.name == *name);
            let cost = costs.iter().find(|cost| Some(cost.case) == place);
            let left = self.left();
            let has_time = |cost: &&Cost| cost.build <= left && !watch.is_cancelled();
            let Some(cost) = cost.filter(has_time) else {
                continue;
            };
            let case = &plan.cases[cost.case];
            watch.tell(&format!("heat maps: {name}"), 1.0, Duration::ZERO);
            if let Ok(stage) = self.stages.of(case, plan, pools, &mut results.warnings) {
                maps.extend(HeatMap::of(stage, plan, case, pools, &watch.picture));
            }
        }
        heat_maps::pictures(&maps)
    }
}
