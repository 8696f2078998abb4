//! Who answers: luch, its oracle, and Embree in three ways.

use super::embree::{Build, Embree, EmbreeScene, Quality};
use super::embree_layouts::{Nearest, RtcRay, RtcRay16, RtcRayHit, RtcRayHit16};
use super::scenes;
use luch::accel::{Accel, Isa, Options, linear};
use luch::geometry::Hit;
use luch::ray::Ray;
use luch::scene::Scene;
use luch::study::sets::{self, Kind, RaySet};
use rayon::prelude::*;
use std::hint::black_box;
use std::time::Instant;

/// An engine of the table.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Engine {
    /// `Accel::intersect_all` and `occluded_all`, a tile at a time.
    Luch,
    /// `rtcIntersect1` and `rtcOccluded1`, medium quality, default flags: not watertight.
    Embree,
    /// The same with the robust flag: watertight, as luch is.
    EmbreeRobust,
    /// `rtcIntersect16` and `rtcOccluded16` with the coherent flag, 16 rays of a tile at a time: 4 x 4 pixels.
    Embree16,
    /// `luch::accel::linear`: every primitive in order.
    Linear,
}

impl Engine {
    pub(crate) const ALL: [Engine; 5] = [
        Engine::Luch,
        Engine::Embree,
        Engine::EmbreeRobust,
        Engine::Embree16,
        Engine::Linear,
    ];

    pub(crate) fn name(self) -> &'static str {
        match self {
            Engine::Luch => "luch",
            Engine::Embree => "embree",
            Engine::EmbreeRobust => "embree-robust",
            Engine::Embree16 => "embree16",
            Engine::Linear => "linear",
        }
    }

    /// The one that a kind's ratio is to: rays from surfaces are only fairly held against watertight ones.
    pub(crate) fn rival(kind: Kind) -> Engine {
        match kind {
            Kind::Primary | Kind::Shadow => Engine::Embree,
            Kind::Mirror | Kind::Incoherent => Engine::EmbreeRobust,
        }
    }
}

/// How luch is measured: as it is by default, with the kernels that `LUCH_ISA` asks for.
pub(crate) fn options() -> Options {
    let isa = Isa::asked().unwrap_or_else(|error| {
        eprintln!("error: {error}");
        std::process::exit(1);
    });
    Options {
        isa,
        ..Options::default()
    }
}

/// How many threads trace.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Threads {
    One,
    All,
}

impl Threads {
    pub(crate) fn count(self) -> usize {
        match self {
            Threads::One => 1,
            Threads::All => rayon::current_num_threads(),
        }
    }
}

/// What was found on a ray; for shadow rays only whether anything was.
pub(crate) type Answer = Nearest;

/// The built scenes.
pub(crate) struct Arena<'a> {
    pub(crate) scene: &'a Scene,
    pub(crate) accel: &'a Accel,
    plain: Option<EmbreeScene<'a>>,
    robust: Option<EmbreeScene<'a>>,
}

/// A set of rays in the form of every engine, made before any time is taken.
pub(crate) struct Round<'a> {
    kind: Kind,
    batches: Vec<&'a [Ray]>,
    singles: Vec<RtcRay>,
    sixteens: Vec<RtcRay16>,
    /// Some rays for the oracle.
    few: Vec<Ray>,
}

/// How many rays the oracle gets.
const FEW: usize = 200;

impl<'a> Round<'a> {
    pub(crate) fn new(kind: Kind, set: &'a RaySet, with_embree: bool) -> Round<'a> {
        let batches = set.batches();
        let for_embree = if with_embree { &batches[..] } else { &[] };
        let step = (set.rays.len() / FEW).max(1);
        Round {
            kind,
            singles: for_embree
                .iter()
                .copied()
                .flatten()
                .map(RtcRay::of)
                .collect(),
            // No sixteen has rays of two tiles: lanes without a ray cost less than rays that go apart.
            sixteens: for_embree
                .iter()
                .flat_map(|batch| batch.chunks(16))
                .map(RtcRay16::of)
                .collect(),
            batches,
            few: set.rays.iter().copied().step_by(step).take(FEW).collect(),
        }
    }

    /// How many rays an engine traces.
    pub(crate) fn rays(&self, engine: Engine) -> usize {
        match engine {
            Engine::Linear => self.few.len(),
            _ => self.batches.iter().map(|batch| batch.len()).sum(),
        }
    }

    /// The rays of the oracle.
    pub(crate) fn few(&self) -> &[Ray] {
        &self.few
    }
}

impl<'a> Arena<'a> {
    pub(crate) fn new(
        scene: &'a Scene,
        accel: &'a Accel,
        embree: Option<&'a Embree>,
    ) -> Result<Arena<'a>, String> {
        let triangles = embree.and_then(|embree| Some((embree, scenes::triangles(scene)?)));
        let build = |robust| {
            let Some((embree, (positions, triangles))) = &triangles else {
                return Ok(None);
            };
            let threads = rayon::current_num_threads();
            let quality = Quality::Medium;
            embree
                .build(
                    positions,
                    triangles,
                    Build {
                        quality,
                        robust,
                        threads,
                    },
                )
                .map(Some)
        };
        Ok(Arena {
            scene,
            accel,
            plain: build(false)?,
            robust: build(true)?,
        })
    }

    /// Which instructions an engine uses.
    pub(crate) fn isa(&self, engine: Engine) -> String {
        match engine {
            Engine::Luch => options().isa.to_string(),
            Engine::Linear => "scalar".into(),
            _ => self.embree(engine).map_or("none", EmbreeScene::isa).into(),
        }
    }

    pub(crate) fn has_embree(&self) -> bool {
        self.plain.is_some()
    }

    /// Seconds for every ray of a round.
    pub(crate) fn seconds(&self, engine: Engine, round: &Round, threads: Threads) -> Option<f64> {
        let start = Instant::now();
        self.trace(engine, round, threads)?;
        Some(start.elapsed().as_secs_f64())
    }

    fn trace(&self, engine: Engine, round: &Round, threads: Threads) -> Option<()> {
        /// Calls `trace` with pieces of the work, on one thread or on all.
        fn share<T: Sync>(
            work: &[T],
            piece: usize,
            threads: Threads,
            trace: impl Fn(&[T]) + Sync + Send,
        ) {
            match threads {
                Threads::One => trace(work),
                Threads::All => work.par_chunks(piece).for_each(trace),
            }
        }
        let any = round.kind.is_any_hit();
        match engine {
            Engine::Luch => share(&round.batches, 64, threads, |batches| {
                sets::trace(self.accel, round.kind, batches);
            }),
            Engine::Linear => share(&round.few, 8, threads, |rays| {
                rays.iter().for_each(|ray| {
                    black_box(oracle(self.scene, ray, any));
                })
            }),
            Engine::Embree | Engine::EmbreeRobust => {
                let scene = self.embree(engine)?;
                share(&round.singles, 4096, threads, |rays| {
                    embree_one(scene, rays, any)
                });
            }
            Engine::Embree16 => {
                let scene = self.embree(engine)?;
                share(&round.sixteens, 256, threads, |rays| {
                    embree_sixteen(scene, rays, any)
                });
            }
        }
        Some(())
    }

    fn embree(&self, engine: Engine) -> Option<&EmbreeScene<'a>> {
        match engine {
            Engine::EmbreeRobust => self.robust.as_ref(),
            _ => self.plain.as_ref(),
        }
    }

    /// What an engine finds on every ray of a round; of the oracle, on its few.
    pub(crate) fn answers(&self, engine: Engine, round: &Round) -> Option<Vec<Answer>> {
        let any = round.kind.is_any_hit();
        let flag = |hit: bool| hit.then_some((0.0, 0));
        let answers = match engine {
            Engine::Luch => {
                let (mut hits, mut occluded) = (Vec::new(), Vec::new());
                let mut answers = Vec::with_capacity(round.rays(engine));
                for batch in &round.batches {
                    if any {
                        self.accel.occluded_all(batch, &mut occluded);
                        answers.extend(occluded.iter().map(|&hit| flag(hit)));
                    } else {
                        self.accel.intersect_all(batch, &mut hits);
                        answers.extend(hits.iter().map(answer));
                    }
                }
                answers
            }
            Engine::Linear => round
                .few
                .par_iter()
                .map(|ray| oracle(self.scene, ray, any))
                .collect(),
            Engine::Embree | Engine::EmbreeRobust => {
                let scene = self.embree(engine)?;
                let mut nearest = RtcRayHit::default();
                let mut found = RtcRay::default();
                let one = |ray| {
                    if any {
                        scene.occluded(ray, &mut found);
                        found.found()
                    } else {
                        scene.intersect(ray, &mut nearest);
                        nearest.nearest()
                    }
                };
                round.singles.iter().map(one).collect()
            }
            Engine::Embree16 => {
                let scene = self.embree(engine)?;
                let mut nearest = RtcRayHit16::default();
                let mut found = RtcRay16::default();
                let mut answers = Vec::with_capacity(round.rays(engine));
                for rays in &round.sixteens {
                    if any {
                        scene.occluded16(rays, &mut found);
                        answers.extend(found.found());
                    } else {
                        scene.intersect16(rays, &mut nearest);
                        answers.extend(nearest.nearest());
                    }
                }
                answers
            }
        };
        Some(answers)
    }
}

/// Never inlined, like [`sets::trace`], for profilers. The answers stay in Embree's structures, where a renderer reads them.
#[inline(never)]
fn embree_one(scene: &EmbreeScene, rays: &[RtcRay], any: bool) {
    let mut nearest = RtcRayHit::default();
    let mut found = RtcRay::default();
    for ray in rays {
        if any {
            scene.occluded(ray, &mut found);
            black_box(&found);
        } else {
            scene.intersect(ray, &mut nearest);
            black_box(&nearest);
        }
    }
}

/// See `embree_one`.
#[inline(never)]
fn embree_sixteen(scene: &EmbreeScene, rays: &[RtcRay16], any: bool) {
    let mut nearest = RtcRayHit16::default();
    let mut found = RtcRay16::default();
    for sixteen in rays {
        if any {
            scene.occluded16(sixteen, &mut found);
            black_box(&found);
        } else {
            scene.intersect16(sixteen, &mut nearest);
            black_box(&nearest);
        }
    }
}

fn oracle(scene: &Scene, ray: &Ray, any: bool) -> Answer {
    if any {
        linear::occluded(scene, ray).then_some((0.0, 0))
    } else {
        answer(&linear::intersect(scene, ray))
    }
}

fn answer(hit: &Option<Hit>) -> Answer {
    hit.map(|hit| (hit.t, hit.primitive))
}
