//! From a scene to a film: tiles in parallel, each on its own.

mod settings;

pub use settings::{Settings, SettingsError};

use crate::accel::Accel;
use crate::camera::View;
use crate::film::{COST, Combine, Film, Layer};
use crate::ray::Ray;
use crate::scene::Scene;
use crate::texture::TextureFilter;
use crate::whitted::{Counts, Rules, Sample, Tracer};
use rayon::prelude::*;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering::Relaxed};
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

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

/// Renders a scene, on the threads of the rayon pool it is called from.
///
/// Every pixel is a function of scene and settings alone: threads, their number and the tiles' order change no bit. A
/// render that is cancelled returns what it has, with [`Film::complete`] false.
pub fn render(scene: &Scene, accel: &Accel, settings: &Settings, progress: &Progress) -> Film {
    let start = Instant::now();
    let tiles = settings.tiles();
    progress.total.store(tiles.len() as u64, Relaxed);
    let view = scene.camera().view(settings.width, settings.height);
    let rules = Rules {
        shading: settings.shading,
        max_depth: settings.max_depth,
        texture_filter: settings.texture_filter,
        samples: settings.samples(),
    };
    settings.prepare(scene);
    let film = Mutex::new(empty_film(scene, settings));
    let painter = || Painter {
        tracer: Tracer::new(scene, accel, rules),
        view: &view,
        settings,
        columns: Vec::new(),
        rows: Vec::new(),
        rays: Vec::new(),
        samples: Vec::new(),
        pixels: Vec::new(),
        costs: Vec::new(),
    };
    let tiles = tiles.into_par_iter().enumerate();
    tiles.for_each_init(painter, |painter, (number, tile)| {
        if progress.is_cancelled() {
            return;
        }
        painter.paint(&tile, number % WATCHED == 0);
        let mut film = film.lock().unwrap_or_else(PoisonError::into_inner);
        tile.put(&painter.pixels, &painter.costs, &mut film);
        film.statistics
            .add_counts(&std::mem::take(&mut painter.tracer.statistics));
        progress.done.fetch_add(1, Relaxed);
    });
    let mut film = film.into_inner().unwrap_or_else(PoisonError::into_inner);
    film.complete = !progress.is_cancelled();
    film.statistics.time = start.elapsed();
    film
}

fn empty_film(scene: &Scene, settings: &Settings) -> Film {
    let pixels = settings.width as usize * settings.height as usize;
    let blank = |layer: Layer| Layer {
        values: vec![0.0; pixels * layer.channels.len()],
        ..layer
    };
    Film {
        width: settings.width,
        height: settings.height,
        layers: settings.layers.list().into_iter().map(blank).collect(),
        background: scene.background(),
        complete: false,
        statistics: Default::default(),
    }
}

/// A rectangle of pixels that is rendered in one go.
#[derive(Clone, Copy, Debug)]
struct Tile {
    left: u32,
    top: u32,
    width: u32,
    height: u32,
}

impl Settings {
    /// Makes ready what a render of `scene` will look up: [`render`] does it by itself; who calls it before has something
    /// else done meanwhile.
    pub fn prepare(&self, scene: &Scene) {
        if self.texture_filter == TextureFilter::Footprint {
            scene.prepare_textures();
        }
    }

    fn tiles(&self) -> Vec<Tile> {
        let side = self.tile_side;
        let across = |top| {
            (0..self.width)
                .step_by(side as usize)
                .map(move |left| Tile {
                    left,
                    top,
                    width: side.min(self.width - left),
                    height: side.min(self.height - top),
                })
        };
        (0..self.height)
            .step_by(side as usize)
            .flat_map(across)
            .collect()
    }
}

/// Who renders tile after tile, in the same memory.
struct Painter<'a> {
    tracer: Tracer<'a>,
    view: &'a View,
    settings: &'a Settings,
    columns: Vec<f64>,
    rows: Vec<f64>,
    rays: Vec<Ray>,
    samples: Vec<Sample>,
    /// The last tile's, row by row.
    pixels: Vec<Sample>,
    /// The same tile's, if they are wanted: nodes and primitives.
    costs: Vec<[f32; 2]>,
}

impl Painter<'_> {
    /// Renders a tile: of each sample position a batch of rays for all of it.
    fn paint(&mut self, tile: &Tile, watched: bool) {
        let start = Instant::now();
        self.tracer.watched = watched;
        if self.settings.layers.cost {
            let pixels = tile.width as usize * tile.height as usize;
            self.tracer.counts = Some(vec![Counts::default(); pixels]);
        }
        let grid = self.settings.grid;
        for sample in 0..grid.samples() {
            let column = |i| grid.position(i, tile.top, sample).0;
            let row = |j| grid.position(tile.left, j, sample).1;
            self.columns.clear();
            self.columns
                .extend((tile.left..tile.left + tile.width).map(column));
            self.rows.clear();
            self.rows
                .extend((tile.top..tile.top + tile.height).map(row));
            self.rays.clear();
            self.view
                .primary_rays(&self.columns, &self.rows, &mut self.rays);
            self.tracer
                .trace(self.view, sample, &self.rays, &mut self.samples);
            if sample == 0 {
                std::mem::swap(&mut self.pixels, &mut self.samples);
            } else {
                let pixels = self.pixels.iter_mut().zip(&self.samples);
                pixels.for_each(|(pixel, sample)| add(pixel, sample));
            }
        }
        let share = 1.0 / grid.samples() as f32;
        for pixel in &mut self.pixels {
            pixel.color *= share;
            pixel.alpha *= share;
        }
        let mean = |count: u64| (count as f64 / f64::from(grid.samples())) as f32;
        self.costs.clear();
        for count in self.tracer.counts.iter().flatten() {
            self.costs.push([mean(count.nodes), mean(count.primitives)]);
        }
        if watched {
            self.tracer.statistics.watched += start.elapsed();
        }
    }
}

/// Light is summed (and becomes a mean), depth is the nearest.
fn add(pixel: &mut Sample, sample: &Sample) {
    pixel.color += sample.color;
    pixel.alpha += sample.alpha;
    pixel.depth = pixel.depth.min(sample.depth);
}

impl Tile {
    /// Writes the tile's pixels into the film, and what they cost where the film has a layer for it.
    fn put(&self, pixels: &[Sample], costs: &[[f32; 2]], film: &mut Film) {
        let (left, width) = (self.left as usize, self.width as usize);
        for layer in &mut film.layers {
            let channels = layer.channels.len();
            let rows = layer
                .values
                .chunks_exact_mut(film.width as usize * channels);
            let rows = rows.skip(self.top as usize);
            if layer.name == COST.name {
                for (row, costs) in rows.zip(costs.chunks_exact(width)) {
                    let row = &mut row[left * channels..(left + width) * channels];
                    row.copy_from_slice(costs.as_flattened());
                }
                continue;
            }
            let rows = rows.zip(pixels.chunks_exact(width));
            for (row, pixels) in rows {
                let row = &mut row[left * channels..(left + width) * channels];
                for (values, pixel) in row.chunks_exact_mut(channels).zip(pixels) {
                    let color = pixel.color;
                    match layer.combine {
                        Combine::Mean => {
                            values.copy_from_slice(&[color.r, color.g, color.b, pixel.alpha]);
                        }
                        Combine::Nearest => values.fill(pixel.depth),
                    }
                }
            }
        }
    }
}
