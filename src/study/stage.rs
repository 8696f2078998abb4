//! A scene made ready to be measured: its rays, and the pictures that others are held against.

use super::case::{Case, Threads};
use super::plan::Plan;
use super::results::{Facts, Tests};
use super::run::Pools;
use super::sets::{self, Kind, RaySet};
use super::show::in_words;
use crate::accel::{self, Accel, Isa, Layout, Options, Preset, linear};
use crate::color::linear_to_srgb;
use crate::film::Film;
use crate::ray::Ray;
use crate::render::{Progress, render};
use crate::scene::Scene;
use rayon::ThreadPool;
use rayon::prelude::*;
use std::sync::Arc;
use std::time::Instant;

/// Rays of each kind that are counted.
const COUNTED_RAYS: usize = 8192;
/// Rays of a set, at most: for their memory.
const MOST_RAYS: u64 = 2_000_000;
/// Tests of primitives by brute force that the reference's own check may take.
const CHECKING_TESTS: u64 = 20_000_000;
/// Scenes above this are made again whenever they are needed.
pub(super) const MOST_KEPT_PRIMITIVES: u64 = 2_000_000;
/// So often a few rays are timed to know what all will take: the least counts, since machines have hiccups.
const GUARDS: usize = 3;
/// The share of the budget that one picture may take.
const MOST_OF_THE_BUDGET: f64 = 1.0 / 24.0;

/// The stages of a study, those of huge scenes only as long as they are in use.
#[derive(Default)]
pub(super) struct Stages(Vec<(String, Stage)>);

impl Stages {
    /// The stage of a case.
    ///
    /// # Errors
    ///
    /// Its scene cannot be.
    pub(super) fn of(
        &mut self,
        case: &Case,
        plan: &Plan,
        pools: &Pools,
        warnings: &mut Vec<String>,
    ) -> Result<&mut Stage, String> {
        let name = &case.source.name;
        self.0
            .retain(|(known, stage)| known == name || stage.is_small());
        let at = match self.0.iter().position(|(known, _)| known == name) {
            Some(at) => at,
            None => {
                let scene = (case.source.make)().map_err(|error| error.to_string())?;
                let (stage, unlike) = pools.all.install(|| Stage::new(scene, plan));
                if unlike > 0 {
                    warnings.push(format!(
                        "{name}: {unlike} rays of the reference differ from brute force"
                    ));
                }
                self.0.push((name.clone(), stage));
                self.0.len() - 1
            }
        };
        Ok(&mut self.0[at].1)
    }
}

impl Pools {
    pub(super) fn of(&self, threads: Threads) -> &ThreadPool {
        match threads {
            Threads::One => &self.one,
            Threads::All => &self.all,
        }
    }
}

/// A scene made ready to be measured.
pub(super) struct Stage {
    pub(super) scene: Arc<Scene>,
    /// By kind.
    sets: [RaySet; 4],
    /// By samples a pixel.
    references: Vec<(u32, Film)>,
}

/// The simplest way to a picture that is not hopeless: scalar kernels, ray by ray.
fn reference_options() -> Options {
    Options {
        preset: Preset::Fastest,
        isa: Isa::scalar(),
        packets: false,
        ..Options::default()
    }
}

/// The plan's size, or as much of it as there are rays for.
fn size_of_sets(plan: &Plan) -> [u32; 2] {
    let [mut width, mut height] = plan.effort.size;
    while u64::from(width) * u64::from(height) > MOST_RAYS {
        (width, height) = (width.div_ceil(2), height.div_ceil(2));
    }
    [width, height]
}

impl Stage {
    /// The stage, and on how many rays the reference's own search differs from brute force.
    fn new(scene: Arc<Scene>, plan: &Plan) -> (Stage, usize) {
        let accel = Accel::build(&scene, &reference_options());
        let sets = sets::make(&scene, &accel, sets::light(&scene), size_of_sets(plan));
        let stage = Stage {
            scene,
            sets,
            references: Vec::new(),
        };
        let unlike = stage.unlike_brute_force(&accel);
        (stage, unlike)
    }

    fn is_small(&self) -> bool {
        u64::from(self.scene.primitive_count()) <= MOST_KEPT_PRIMITIVES
    }

    /// On how many rays a search and brute force find unlike things, of as many as there is time for.
    fn unlike_brute_force(&self, accel: &Accel) -> usize {
        let primitives = u64::from(self.scene.primitive_count()).max(1);
        let rays = (CHECKING_TESTS / primitives).clamp(16, 4096) as usize;
        let unlike = |ray: &&Ray| accel.intersect(ray) != linear::intersect(&self.scene, ray);
        let all = &self.sets[Kind::Primary as usize].rays;
        let step = (all.len() / rays).max(1);
        all.iter().step_by(step).filter(unlike).count()
    }

    /// A tree as the case asks, on the threads of `pool`.
    pub(super) fn build(&self, case: &Case, pool: &ThreadPool) -> Accel {
        pool.install(|| Accel::build(&self.scene, &case.options))
    }

    /// Makes sure that a picture without a tree takes no more than its share of the budget.
    ///
    /// # Errors
    ///
    /// It would take longer: how long, by a few of its rays.
    pub(super) fn guard(
        &self,
        accel: &Accel,
        plan: &Plan,
        case: &Case,
        pools: &Pools,
    ) -> Result<(), String> {
        if case.options.layout != Layout::List {
            return Ok(());
        }
        let set = &self.sets[Kind::Primary as usize];
        let batches = set.batches();
        let few: Vec<&[Ray]> = batches
            .iter()
            .step_by((batches.len() / 4).max(1))
            .map(|batch| &batch[..batch.len().min(4)])
            .collect();
        let rays: usize = few.iter().map(|batch| batch.len()).sum();
        let mut least = f64::INFINITY;
        for _ in 0..GUARDS {
            let start = Instant::now();
            pools
                .one
                .install(|| sets::trace(accel, Kind::Primary, &few));
            least = least.min(start.elapsed().as_secs_f64());
        }
        // Camera, shadow and some mirror rays.
        let [width, height] = plan.effort.size.map(f64::from);
        let all = width * height * f64::from(case.samples) * 2.5;
        let seconds = least * all / rays.max(1) as f64 / plan.threads as f64;
        if seconds > plan.effort.budget.as_secs_f64() * MOST_OF_THE_BUDGET {
            return Err(format!("a picture would take about {}", in_words(seconds)));
        }
        Ok(())
    }

    /// What needs no clock, but for the picture.
    pub(super) fn facts(&self, accel: &Accel, case: &Case) -> Facts {
        let statistics = accel.statistics();
        let is_list = case.options.layout == Layout::List;
        let primitives = self.scene.primitive_count().max(1) as usize;
        let most = if is_list {
            (50_000_000 / primitives).max(16)
        } else {
            COUNTED_RAYS
        };
        Facts {
            nodes: statistics.nodes as u64,
            leaves: statistics.leaves as u64,
            depth: statistics.depth as u64,
            leaf_sizes: accel.leaf_sizes(),
            bytes: statistics.bytes as u64,
            sah_cost: f64::from(statistics.sah_cost),
            tests: Kind::ALL
                .map(|kind| self.tests(accel, kind, most.min(COUNTED_RAYS)))
                .to_vec(),
            error: None,
            same_picture: true,
        }
    }

    /// What a ray of a kind tests, over up to `most` rays of all of the picture.
    fn tests(&self, accel: &Accel, kind: Kind, most: usize) -> Tests {
        let all = &self.sets[kind as usize].rays;
        let rays: Vec<_> = all
            .iter()
            .step_by(all.len().div_ceil(most).max(1))
            .collect();
        let counts: Vec<_> = rays
            .par_iter()
            .map(|ray| {
                if kind.is_any_hit() {
                    accel.occluded_counted(ray).1
                } else {
                    accel.intersect_counted(ray).1
                }
            })
            .collect();
        let mean = |of: fn(&accel::Tests) -> u32| {
            let sum: f64 = counts.iter().map(|tests| f64::from(of(tests))).sum();
            sum / rays.len().max(1) as f64
        };
        Tests {
            kind,
            rays: rays.len() as u64,
            nodes: mean(|tests| tests.nodes),
            primitives: mean(|tests| tests.primitives),
        }
    }

    /// Seconds for all rays of a kind, and how many they are.
    pub(super) fn trace(&self, accel: &Accel, kind: Kind, pool: &ThreadPool) -> (f64, u64) {
        let set = &self.sets[kind as usize];
        let batches = set.batches();
        pool.install(|| {
            let start = Instant::now();
            if rayon::current_num_threads() == 1 {
                sets::trace(accel, kind, &batches);
            } else {
                batches
                    .par_chunks(64)
                    .for_each(|batches| sets::trace(accel, kind, batches));
            }
            (start.elapsed().as_secs_f64(), set.rays.len() as u64)
        })
    }

    /// A picture and the seconds it took; nothing where it was interrupted.
    pub(super) fn frame(
        &self,
        accel: &Accel,
        plan: &Plan,
        case: &Case,
        pool: &ThreadPool,
        progress: &Progress,
    ) -> Option<(Film, f64)> {
        let settings = plan.picture(case.samples).ok()?;
        let film = pool.install(|| render(&self.scene, accel, &settings, progress));
        let seconds = film.statistics.time.as_secs_f64();
        film.complete.then_some((film, seconds))
    }

    /// Whether every number of every layer has the bits of the reference.
    pub(super) fn has_the_reference_bits(
        &mut self,
        plan: &Plan,
        case: &Case,
        film: &Film,
        pools: &Pools,
    ) -> bool {
        let Some(reference) = self.reference(plan, case.samples, pools) else {
            return false;
        };
        let bits = |film: &Film| -> Vec<u32> {
            let values = film.layers.iter().flat_map(|layer| &layer.values);
            values.map(|x| x.to_bits()).collect()
        };
        bits(film) == bits(reference)
    }

    /// The root mean square over pixels and channels of the difference to a picture of `samples` a pixel, as a display
    /// shows both (sRGB, 0..1).
    pub(super) fn error(&mut self, plan: &Plan, samples: u32, film: &Film, pools: &Pools) -> f64 {
        let Some(reference) = self.reference(plan, samples, pools) else {
            return f64::NAN;
        };
        let shown = |[r, g, b, _]: [f32; 4]| {
            [r, g, b].map(|x| f64::from(linear_to_srgb(x.clamp(0.0, 1.0))))
        };
        let pixels = film.beauty().map(shown).zip(reference.beauty().map(shown));
        let (sum, count) = pixels.fold((0.0, 0.0), |(sum, count), (a, b)| {
            let squares: f64 = a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum();
            (sum + squares, count + 3.0)
        });
        libm::sqrt(sum / f64::max(count, 1.0))
    }

    /// The picture that others of so many samples are held against; made when it is first asked for.
    fn reference(&mut self, plan: &Plan, samples: u32, pools: &Pools) -> Option<&Film> {
        let known = self
            .references
            .iter()
            .position(|(known, _)| *known == samples);
        let at = match known {
            Some(at) => at,
            None => {
                let settings = plan.picture(samples).ok()?;
                let film = pools.all.install(|| {
                    let accel = Accel::build(&self.scene, &reference_options());
                    render(&self.scene, &accel, &settings, &Progress::default())
                });
                self.references.push((samples, film));
                self.references.len() - 1
            }
        };
        self.references.get(at).map(|(_, film)| film)
    }
}
