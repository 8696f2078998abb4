//! What every pixel costs: nodes and primitives tested, of two settings over one scale.

use super::case::Case;
use super::heat::heat_map;
use super::plan::Plan;
use super::report::Picture;
use super::run::Pools;
use super::stage::Stage;
use crate::film::{COST, Film, Layers, SAMPLES};
use crate::render::{Progress, render};
use std::io;

/// What every pixel of a case costs.
pub(super) struct HeatMap {
    case: String,
    width: u32,
    height: u32,
    /// Of nodes and of primitives, row by row from the top.
    tests: [Vec<f32>; 2],
}

impl HeatMap {
    /// Renders the case once more, counting; `None` where it was interrupted.
    pub(super) fn of(
        stage: &Stage,
        plan: &Plan,
        case: &Case,
        pools: &Pools,
        progress: &Progress,
    ) -> Option<HeatMap> {
        let layers = Layers {
            cost: true,
            ..Layers::default()
        };
        let settings = plan.picture(case.samples).ok()?.with_layers(layers).ok()?;
        let accel = stage.build(case, &pools.all);
        let film = pools
            .all
            .install(|| render(&stage.scene, &accel, &settings, progress));
        film.complete.then_some(HeatMap {
            case: case.name.clone(),
            width: film.width,
            height: film.height,
            tests: [tests(&film, 0)?, tests(&film, 1)?],
        })
    }
}

/// One channel of a film's cost, row by row from the top; `None` where it has no such layer.
fn tests(film: &Film, channel: usize) -> Option<Vec<f32>> {
    let values = film.layer(COST.channels)?.values.iter();
    Some(
        values
            .skip(channel)
            .step_by(COST.channels.len())
            .copied()
            .collect(),
    )
}

/// What a film's layers can be mapped to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Mapped {
    /// A channel of [`COST`].
    Tests(usize),
    /// [`SAMPLES`].
    Samples,
}

impl Mapped {
    /// The maps of a film that has these layers.
    pub fn of(layers: &Layers) -> Vec<Mapped> {
        let tests = (0..COST.channels.len()).map(Mapped::Tests);
        let tests = tests.filter(|_| layers.cost);
        tests
            .chain(layers.samples.then_some(Mapped::Samples))
            .collect()
    }

    /// One word, for the names of files.
    pub fn name(self) -> &'static str {
        match self {
            Mapped::Tests(channel) => COST.channels.get(channel).copied().unwrap_or("cost"),
            Mapped::Samples => "samples",
        }
    }

    /// A PNG of it, over a scale of its own; `None` where the film has no such layer.
    pub fn png(self, film: &Film) -> Option<io::Result<Vec<u8>>> {
        let name = self.name();
        let (values, title) = match self {
            Mapped::Tests(channel) => (tests(film, channel)?, format!("{name} tested a sample")),
            Mapped::Samples => {
                let layer = film.layer(SAMPLES.channels)?;
                (layer.values.clone(), format!("{name} a pixel"))
            }
        };
        let greatest = most_of(values.clone());
        Some(heat_map(&values, film.width, film.height, &title, greatest))
    }
}

/// The maps as pictures, those of one count side by side over one scale.
pub(super) fn pictures(maps: &[HeatMap]) -> Vec<Picture> {
    let mut pictures = Vec::new();
    for (channel, what) in COST.channels.iter().enumerate() {
        let all = maps.iter().flat_map(|map| &map.tests[channel]);
        let greatest = most_of(all.copied().collect());
        for map in maps {
            let title = format!("{what} tested a pixel: {}", map.case);
            let (values, mean) = (&map.tests[channel], mean(&map.tests[channel]));
            let png = heat_map(values, map.width, map.height, &title, greatest);
            let Ok(png) = png else { continue };
            pictures.push(Picture {
                name: format!("heat map of {what}, {}", map.case),
                group: (*what).into(),
                caption: format!(
                    "{}: {mean:.1} {what} tested a pixel on average, by all its rays.",
                    map.case
                ),
                png,
            });
        }
    }
    pictures
}

/// What all but a thousandth stay below: one pixel must not darken all others.
fn most_of(mut values: Vec<f32>) -> f32 {
    values.sort_by(f32::total_cmp);
    let last = values.len().saturating_sub(1);
    values.get(last - last / 1000).copied().unwrap_or(0.0)
}

fn mean(values: &[f32]) -> f64 {
    let sum: f64 = values.iter().map(|&value| f64::from(value)).sum();
    sum / values.len().max(1) as f64
}
