//! From a scene to a film: tiles in parallel, each on its own.

mod settings;

pub use settings::{Settings, SettingsError};

use crate::accel::Accel;
use crate::camera::View;
use crate::film::{BEAUTY, Combine, DEPTH, Film, Layer};
use crate::scene::Scene;
use crate::whitted::{Rules, Sample, Tracer};
use rayon::prelude::*;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering::Relaxed};
use std::sync::{Mutex, PoisonError};
use std::time::Instant;

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
    };
    let film = Mutex::new(empty_film(scene, settings));
    let tracer = || Tracer::new(scene, accel, rules);
    tiles.into_par_iter().for_each_init(tracer, |tracer, tile| {
        if progress.is_cancelled() {
            return;
        }
        let pixels = render_tile(tracer, &view, settings, &tile);
        let mut film = film.lock().unwrap_or_else(PoisonError::into_inner);
        tile.put(&pixels, &mut film);
        film.statistics
            .add_counts(&std::mem::take(&mut tracer.statistics));
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
        layers: vec![blank(BEAUTY), blank(DEPTH)],
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

/// The pixels of a tile, row by row: of each sample position a batch of rays for the whole tile.
fn render_tile(tracer: &mut Tracer, view: &View, settings: &Settings, tile: &Tile) -> Vec<Sample> {
    let pixels: Vec<(u32, u32)> = tile.pixels().collect();
    let mut combined: Vec<Sample> = Vec::with_capacity(pixels.len());
    let mut samples = Vec::with_capacity(pixels.len());
    for sample in 0..settings.grid.samples() {
        let ray = |&(i, j): &(u32, u32)| {
            let (x, y) = settings.grid.position(i, j, sample);
            view.primary_ray(x, y)
        };
        let rays: Vec<_> = pixels.iter().map(ray).collect();
        tracer.trace(view, &rays, &mut samples);
        if sample == 0 {
            combined.extend_from_slice(&samples);
        } else {
            combined
                .iter_mut()
                .zip(&samples)
                .for_each(|(pixel, sample)| add(pixel, sample));
        }
    }
    let share = 1.0 / settings.grid.samples() as f32;
    for pixel in &mut combined {
        pixel.color *= share;
        pixel.alpha *= share;
    }
    combined
}

/// Light is summed (and becomes a mean), depth is the nearest.
fn add(pixel: &mut Sample, sample: &Sample) {
    pixel.color += sample.color;
    pixel.alpha += sample.alpha;
    pixel.depth = pixel.depth.min(sample.depth);
}

impl Tile {
    fn pixels(&self) -> impl Iterator<Item = (u32, u32)> {
        let Tile {
            left,
            top,
            width,
            height,
        } = *self;
        (top..top + height).flat_map(move |j| (left..left + width).map(move |i| (i, j)))
    }

    /// Writes the tile's pixels into the film.
    fn put(&self, pixels: &[Sample], film: &mut Film) {
        let width = film.width as usize;
        for layer in &mut film.layers {
            let channels = layer.channels.len();
            for ((i, j), pixel) in self.pixels().zip(pixels) {
                let Sample {
                    color,
                    alpha,
                    depth,
                } = *pixel;
                let values = match layer.combine {
                    Combine::Mean => [color.r, color.g, color.b, alpha],
                    Combine::Nearest => [depth; 4],
                };
                let at = (j as usize * width + i as usize) * channels;
                layer.values[at..at + channels].copy_from_slice(&values[..channels]);
            }
        }
    }
}
