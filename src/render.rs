//! From a scene to a film: tiles in parallel, each on its own.
//!
//! Where sampling is adaptive (Whitted 1980: more samples only where neighbouring ones differ), there are two passes over
//! all tiles: the first takes a few samples of every pixel, the second more of those that differ from one another or from
//! a neighbour's. All that the second needs of other pixels is from the first, so that no pixel depends on tiles; and
//! the first takes those around the window, too, so that none depends on the window.

mod canvas;
mod known;
mod matte;
mod painter;
mod record;
mod settings;
mod tile;

pub use settings::{Settings, SettingsError};

use crate::accel::Accel;
use crate::camera::View;
use crate::color::Rgb;
use crate::environment::MAX_ROUNDS;
use crate::film::{Film, Manifest, Window};
use crate::sampling::Offset;
use crate::scene::Scene;
use crate::whitted::Rules;
use canvas::Canvas;
use known::Known;
use matte::{Ids, Ranks, Shares};
use painter::Painter;
use rayon::prelude::*;
use record::Record;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering::Relaxed};
use std::sync::{Mutex, PoisonError};
use std::time::Instant;
use tile::Tile;

/// Of so many tiles one has its search measured: a number that no row of tiles is likely to be a multiple of.
pub const WATCHED: usize = 13;

/// How far a render is, and whether it should go on: shared with whoever watches.
#[derive(Debug, Default)]
pub struct Progress {
    done: AtomicU64,
    total: AtomicU64,
    cancelled: AtomicBool,
}

impl Progress {
    /// The share that is done, 0..1.
    pub fn share(&self) -> f64 {
        self.done.load(Relaxed) as f64 / self.total.load(Relaxed).max(1) as f64
    }

    /// Asks the render to stop after the tiles that are under way.
    pub fn cancel(&self) {
        self.cancelled.store(true, Relaxed);
    }

    /// Whether somebody asked the render to stop.
    pub fn is_cancelled(&self) -> bool {
        self.cancelled.load(Relaxed)
    }
}

/// How many tiles of the first pass lie side by side, and one above the other, in one of the second: few of their pixels
/// need more samples, and rays are fastest in large batches.
const TILES_TOGETHER: u32 = 4;

/// Renders a scene, on the threads of the rayon pool it is called from.
///
/// Every pixel is a function of scene and settings alone: threads, their number and the tiles' order change no bit. A
/// render that is cancelled returns what it has, with [`Film::complete`] false.
pub fn render(scene: &Scene, accel: &Accel, settings: &Settings, progress: &Progress) -> Film {
    let start = Instant::now();
    settings.prepare(scene);
    let rendering = Rendering::new(scene, accel, settings);
    let mut passes = vec![rendering.tiles(settings.area(), settings.tile_side)];
    if rendering.is_adaptive {
        let side = settings.tile_side.saturating_mul(TILES_TOGETHER);
        passes.push(rendering.tiles(settings.window, side));
    }
    // As if both passes took the same time.
    let steps = passes.iter().flatten().map(|tile| rendering.steps(tile));
    progress.total.store(steps.sum(), Relaxed);

    let mut known = Known::default();
    let mut canvas = Canvas::new(scene, settings);
    for (number, tiles) in passes.into_iter().enumerate() {
        let work = |painter: &mut Painter, tile: &Tile, watched: bool| match number {
            0 => painter.paint(tile, watched),
            _ => painter.refine(tile, &known, watched),
        };
        canvas = rendering.pass(&tiles, canvas, progress, &work);
        known = std::mem::take(&mut canvas.known);
    }
    let mut film = canvas.film;
    film.manifests = rendering.manifests;
    film.complete = !progress.is_cancelled();
    film.statistics.time = start.elapsed();
    film
}

/// What every tile of a picture needs.
struct Rendering<'a> {
    scene: &'a Scene,
    accel: &'a Accel,
    settings: &'a Settings,
    view: View,
    /// In the order in which samples are taken.
    offsets: Vec<Offset>,
    /// What the weights of the first so many samples add to.
    weights: Vec<f32>,
    /// The numbers of samples after which a pixel may stop.
    stops: Vec<u32>,
    /// By so many of 256 steps one sample more may change a pixel that gets none.
    tolerance: u32,
    /// So many samples see all lights of the environment, if there is one.
    round: u32,
    is_adaptive: bool,
    /// What mattes need, if there are any.
    ids: Ids,
    manifests: Vec<Manifest>,
}

impl<'a> Rendering<'a> {
    fn new(scene: &'a Scene, accel: &'a Accel, settings: &'a Settings) -> Rendering<'a> {
        let offsets = settings.sampling.offsets();
        let mut weight = 0.0;
        let mut weights = vec![weight];
        weights.extend(offsets.iter().map(|offset| {
            weight += offset.weight;
            weight
        }));
        let mattes = settings.layers.mattes.then(|| Ids::of(scene));
        let (ids, manifests) = mattes.unwrap_or_default();
        Rendering {
            scene,
            accel,
            settings,
            view: scene.camera().view(settings.width, settings.height),
            offsets,
            weights,
            stops: settings.sampling.stops(),
            tolerance: settings.sampling.tolerance(),
            round: scene.environment().map_or(1, |_| MAX_ROUNDS),
            is_adaptive: settings.is_adaptive(),
            ids,
            manifests,
        }
    }

    /// A window in tiles of this side.
    fn tiles(&self, window: Window, side: u32) -> Vec<Tile> {
        Tile::all(window).tiles(side).collect()
    }

    /// How far a tile brings a pass: so many tiles of the first are in it.
    fn steps(&self, tile: &Tile) -> u64 {
        tile.tiles(self.settings.tile_side).count() as u64
    }

    /// Does `work` on every tile, which puts its pixels onto the canvas.
    fn pass(
        &self,
        tiles: &[Tile],
        canvas: Canvas,
        progress: &Progress,
        work: &(dyn Fn(&mut Painter, &Tile, bool) + Sync),
    ) -> Canvas {
        let rules = Rules {
            shading: self.settings.shading,
            max_depth: self.settings.max_depth,
            texture_filter: self.settings.texture_filter,
            samples: self.settings.samples(),
            layers: self.settings.layers,
        };
        let canvas = Mutex::new(canvas);
        let painter = || Painter::new(self, rules);
        let numbered = tiles.par_iter().enumerate();
        numbered.for_each_init(painter, |painter, (number, tile)| {
            if progress.is_cancelled() {
                return;
            }
            work(painter, tile, number % WATCHED == 0);
            let mut canvas = canvas.lock().unwrap_or_else(PoisonError::into_inner);
            canvas.put(self, &painter.pixels);
            let counts = std::mem::take(&mut painter.tracer.statistics);
            canvas.film.statistics.add_counts(&counts);
            progress.done.fetch_add(self.steps(tile), Relaxed);
        });
        canvas.into_inner().unwrap_or_else(PoisonError::into_inner)
    }

    /// A pixel's light: its premultiplied colour and alpha.
    fn mean(&self, record: &Record) -> [f32; 4] {
        let weight = self.weights.get(record.samples as usize).copied();
        record.mean(weight.unwrap_or(1.0), self.settings.sampling.filter)
    }

    /// Which objects and materials have the greatest shares of a pixel.
    fn ranks(&self, record: &Record, shares: &Shares) -> [Ranks; 2] {
        let weight = self.weights.get(record.samples as usize).copied();
        let filter = self.settings.sampling.filter;
        self.ids.ranks(shares, weight.unwrap_or(1.0), filter)
    }

    /// The mean of a part of a pixel's light, whose sum is `part`.
    fn mean_part(&self, record: &Record, part: Rgb) -> [f32; 3] {
        let weight = self.weights.get(record.samples as usize).copied();
        let Rgb { r, g, b } = part * (1.0 / weight.unwrap_or(1.0));
        let mut mean = [r, g, b];
        if self.settings.sampling.filter.has_negative_lobes() {
            for (part, whole) in mean.iter_mut().zip(self.mean(record)) {
                // Where a filter rings below black nothing is left to have parts.
                if whole == 0.0 {
                    *part = 0.0;
                }
            }
        }
        mean
    }
}
