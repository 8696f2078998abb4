//! Times and answers of every engine on one set of rays.

use super::engines::{Answer, Arena, Engine, Round, Threads};

/// What one engine reached.
#[derive(Clone, Debug)]
pub(crate) struct Measured {
    pub(crate) engine: Engine,
    pub(crate) isa: String,
    pub(crate) threads: Threads,
    /// Of every round, in order.
    pub(crate) mrays_per_second: Vec<f64>,
}

impl Measured {
    /// The median round.
    pub(crate) fn median(&self) -> f64 {
        median(&self.mrays_per_second)
    }
}

/// The middle one, or the mean of the middle two; 0 of none.
pub(crate) fn median(values: &[f64]) -> f64 {
    let mut sorted = values.to_vec();
    sorted.sort_by(f64::total_cmp);
    let n = sorted.len();
    match n {
        0 => 0.0,
        _ => (sorted[(n - 1) / 2] + sorted[n / 2]) / 2.0,
    }
}

/// Every engine's turn in every round, so that a slow minute of the machine hits all alike; the first round is not kept.
pub(crate) fn race(
    arena: &Arena,
    round: &Round,
    engines: &[Engine],
    threads: Threads,
    rounds: usize,
) -> Vec<Measured> {
    let mut measured: Vec<Measured> = engines
        .iter()
        .map(|&engine| Measured {
            engine,
            isa: arena.isa(engine),
            threads,
            mrays_per_second: Vec::new(),
        })
        .collect();
    for number in 0..=rounds {
        for of_engine in &mut measured {
            let engine = of_engine.engine;
            // The oracle takes a minute for what the others do in a second: once is enough.
            if engine == Engine::Linear && number != 1 {
                continue;
            }
            let Some(seconds) = arena.seconds(engine, round, threads) else {
                continue;
            };
            if number > 0 {
                let rate = round.rays(engine) as f64 / seconds / 1e6;
                of_engine.mrays_per_second.push(rate);
            }
        }
    }
    measured.retain(|of_engine| !of_engine.mrays_per_second.is_empty());
    measured
}

/// How the answers of two engines differ.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Difference {
    pub(crate) rays: usize,
    /// A hit for one, none for the other.
    pub(crate) hit_or_miss: usize,
    /// Another primitive at another distance.
    pub(crate) primitive: usize,
    /// Another primitive at the same distance, or within rounding of it: shared edges.
    pub(crate) ties: usize,
}

impl Difference {
    /// `rounding` is how far apart two distances may be and still count as one.
    pub(crate) fn between(ours: &[Answer], theirs: &[Answer], rounding: f32) -> Difference {
        let mut difference = Difference {
            rays: ours.len(),
            ..Difference::default()
        };
        for pair in ours.iter().zip(theirs) {
            match pair {
                (Some((t, primitive)), Some((their_t, their_primitive))) => {
                    if primitive != their_primitive {
                        if (t - their_t).abs() <= rounding {
                            difference.ties += 1;
                        } else {
                            difference.primitive += 1;
                        }
                    }
                }
                (None, None) => {}
                _ => difference.hit_or_miss += 1,
            }
        }
        difference
    }
}
