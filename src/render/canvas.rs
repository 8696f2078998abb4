//! Where tiles put their pixels.

use super::known::Known;
use super::painter::Pixels;
use super::record::Record;
use super::{Rendering, Settings};
use crate::film::{COST, Combine, Film, Layer};
use crate::scene::Scene;
use crate::whitted::Counts;

/// The film, and what is known of its pixels beside.
pub(super) struct Canvas {
    pub(super) film: Film,
    pub(super) known: Known,
}

impl Canvas {
    pub(super) fn new(scene: &Scene, settings: &Settings) -> Canvas {
        let pixels = settings.width as usize * settings.height as usize;
        let blank = |layer: Layer| Layer {
            values: vec![0.0; pixels * layer.channels.len()],
            ..layer
        };
        let mut known = Known::default();
        if settings.is_adaptive() {
            known.records = vec![Record::EMPTY; pixels];
            if settings.layers.cost {
                known.counts = vec![Counts::default(); pixels];
            }
        }
        Canvas {
            film: Film {
                width: settings.width,
                height: settings.height,
                layers: settings.layers.list().into_iter().map(blank).collect(),
                background: scene.background(),
                complete: false,
                statistics: Default::default(),
            },
            known,
        }
    }

    /// Puts the records of some pixels, and what they cost where somebody wants to know, into the film.
    pub(super) fn put(&mut self, rendering: &Rendering, pixels: &Pixels) {
        let width = self.film.width as usize;
        for layer in &mut self.film.layers {
            let channels = layer.channels.len();
            for (number, ([i, j], record)) in pixels.places.iter().zip(&pixels.records).enumerate()
            {
                let start = (*j as usize * width + *i as usize) * channels;
                let Some(values) = layer.values.get_mut(start..start + channels) else {
                    continue;
                };
                match layer.combine {
                    Combine::Mean if layer.name == COST.name => {
                        let count = pixels.counts.get(number).copied().unwrap_or_default();
                        let mean = |count: u64| (count as f64 / f64::from(record.samples)) as f32;
                        values.copy_from_slice(&[mean(count.nodes), mean(count.primitives)]);
                    }
                    Combine::Mean => values.copy_from_slice(&rendering.mean(record)),
                    Combine::Nearest => values.fill(record.depth),
                    Combine::Count => values.fill(record.samples as f32),
                }
            }
        }
        self.keep(pixels);
    }

    /// Keeps what is known of them for a second pass.
    fn keep(&mut self, pixels: &Pixels) {
        let width = self.film.width as usize;
        let Known { records, counts } = &mut self.known;
        for (number, [i, j]) in pixels.places.iter().enumerate() {
            let index = *j as usize * width + *i as usize;
            if let (Some(kept), Some(record)) = (records.get_mut(index), pixels.records.get(number))
            {
                *kept = *record;
            }
            if let (Some(kept), Some(count)) = (counts.get_mut(index), pixels.counts.get(number)) {
                *kept = *count;
            }
        }
    }
}
