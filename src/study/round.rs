//! One run of everything that is timed of a case.

use super::case::{Case, Measure, Threads, What};
use super::plan::Plan;
use super::results::Run;
use super::run::Pools;
use super::stage::Stage;
use super::watch::Watch;
use crate::accel::Accel;
use std::time::Instant;

/// Frames and rays are timed so often after a build, as long as that takes less than this share of the builds.
const MOST_REPEATS: usize = 5;
/// See [`MOST_REPEATS`].
pub(super) const SHARE_OF_BUILDS: f64 = 0.3;

/// One run of everything that is timed of a case.
pub(super) struct Round<'a> {
    pub(super) stage: &'a mut Stage,
    pub(super) plan: &'a Plan,
    pub(super) case: &'a Case,
    pub(super) pools: &'a Pools,
    pub(super) watch: &'a Watch,
    /// From 1; 0 is the warm-up.
    pub(super) number: u32,
}

impl Round<'_> {
    /// Every run; none where one was interrupted, so that a study that goes on repeats them all.
    pub(super) fn run(self) -> Vec<Run> {
        let (mut runs, accel) = self.built();
        let builds: f64 = runs.iter().map(|run| run.seconds).sum();
        let start = Instant::now();
        let mut round = self;
        for _ in 0..MOST_REPEATS {
            let Some(searched) = round.searched(&accel) else {
                return Vec::new();
            };
            runs.extend(searched);
            // Where builds take most of the time, a few frames more cost nothing and say much.
            if start.elapsed().as_secs_f64() > SHARE_OF_BUILDS * builds {
                break;
            }
        }
        runs
    }

    /// The builds that are timed, of which the tree of the last comes back: first on all threads, then on one if there is
    /// time for that.
    fn built(&self) -> (Vec<Run>, Accel) {
        let mut accel = self.stage.build(self.case, &self.pools.all);
        let seconds = accel.statistics().build_time.as_secs_f64();
        let build = |threads| Measure {
            what: What::Build,
            threads,
        };
        let mut runs = Vec::new();
        if self.plan.measures.contains(&build(Threads::All)) {
            runs.push(self.timed(build(Threads::All), seconds, 0, true));
        }
        if self.plan.times_one_thread(seconds) {
            // The tree before goes first: two at once are no build's memory.
            drop(accel);
            accel = self.stage.build(self.case, &self.pools.one);
            let seconds = accel.statistics().build_time.as_secs_f64();
            runs.push(self.timed(build(Threads::One), seconds, 0, true));
        }
        (runs, accel)
    }

    /// Rays and frames; `None` where one was interrupted.
    pub(super) fn searched(&mut self, accel: &Accel) -> Option<Vec<Run>> {
        let mut runs = Vec::new();
        for &measure in &self.plan.measures {
            if self.watch.is_cancelled() {
                return None;
            }
            let pool = self.pools.of(measure.threads);
            match measure.what {
                What::Build => {}
                What::Rays(kind) => {
                    let (seconds, rays) = self.stage.trace(accel, kind, pool);
                    runs.push(self.timed(measure, seconds, rays, true));
                }
                What::Frame => {
                    let (plan, case, progress) = (self.plan, self.case, &self.watch.picture);
                    let (film, seconds) = self.stage.frame(accel, plan, case, pool, progress)?;
                    let same = self
                        .stage
                        .has_the_reference_bits(plan, case, &film, self.pools);
                    let rays = film.statistics.rays();
                    runs.push(self.timed(measure, seconds, rays, same));
                }
            }
        }
        Some(runs)
    }

    fn timed(&self, measure: Measure, seconds: f64, rays: u64, same_picture: bool) -> Run {
        Run {
            case: self.case.name.clone(),
            round: self.number,
            measure,
            seconds,
            rays,
            same_picture,
        }
    }
}
