//! Where tiles put their pixels.

use super::known::Known;
use super::painter::Pixels;
use super::record::Record;
use super::{Rendering, Settings};
use crate::color::Rgb;
use crate::film::{Film, Layer, Quantity, Window};
use crate::scene::Scene;
use crate::whitted::Counts;

/// The film, and what is known of its pixels beside.
pub(super) struct Canvas {
    pub(super) film: Film,
    pub(super) known: Known,
}

impl Canvas {
    pub(super) fn new(scene: &Scene, settings: &Settings) -> Canvas {
        let window = settings.window;
        let pixels = window.pixels() as usize;
        let blank = |layer: Layer| Layer {
            values: vec![0.0; pixels * layer.channels.len()],
            ..layer
        };
        let list = settings.layers.list(scene.lights());
        let mut known = Known::default();
        if settings.is_adaptive() {
            known.area = settings.area();
            known.display = Window::whole(settings.width, settings.height);
            let pixels = known.area.pixels() as usize;
            known.records = vec![Record::EMPTY; pixels];
            known.parts = vec![Rgb::BLACK; pixels * settings.layers.parts()];
            if settings.layers.cost {
                known.counts = vec![Counts::default(); pixels];
            }
        }
        Canvas {
            film: Film {
                width: window.width,
                height: window.height,
                left: window.left,
                top: window.top,
                display_width: settings.width,
                display_height: settings.height,
                layers: list.into_iter().map(blank).collect(),
                background: scene.background(),
                complete: false,
                statistics: Default::default(),
            },
            known,
        }
    }

    /// Puts the records of some pixels, and what they cost where somebody wants to know, into the film, where they are
    /// in its window.
    pub(super) fn put(&mut self, rendering: &Rendering, pixels: &Pixels) {
        let window = self.film.window();
        let of_pixel = rendering.settings.layers.parts();
        for layer in &mut self.film.layers {
            let channels = layer.channels.len();
            for (number, (place, record)) in pixels.places.iter().zip(&pixels.records).enumerate() {
                let Some(index) = window.index(*place) else {
                    continue;
                };
                let start = index * channels;
                let Some(values) = layer.values.get_mut(start..start + channels) else {
                    continue;
                };
                match layer.quantity {
                    Quantity::Cost => {
                        let count = pixels.counts.get(number).copied().unwrap_or_default();
                        let mean = |count: u64| (count as f64 / f64::from(record.samples)) as f32;
                        values.copy_from_slice(&[mean(count.nodes), mean(count.primitives)]);
                    }
                    Quantity::Light => values.copy_from_slice(&rendering.mean(record)),
                    Quantity::Part(part) => {
                        let parts = pixels.parts.get(number * of_pixel + part).copied();
                        let light = rendering.mean_part(record, parts.unwrap_or_default());
                        values.copy_from_slice(&light);
                    }
                    Quantity::Depth => values.fill(record.depth),
                    Quantity::Samples => values.fill(record.samples as f32),
                }
            }
        }
        self.keep(pixels, of_pixel);
    }

    /// Keeps what is known of them for a second pass.
    fn keep(&mut self, pixels: &Pixels, of_pixel: usize) {
        let area = self.known.area;
        let Known {
            records,
            counts,
            parts,
            ..
        } = &mut self.known;
        for (number, place) in pixels.places.iter().enumerate() {
            let Some(index) = area.index(*place) else {
                continue;
            };
            if let (Some(kept), Some(record)) = (records.get_mut(index), pixels.records.get(number))
            {
                *kept = *record;
            }
            if let (Some(kept), Some(count)) = (counts.get_mut(index), pixels.counts.get(number)) {
                *kept = *count;
            }
            let part_of = |pixel: usize| pixel * of_pixel..(pixel + 1) * of_pixel;
            let found = pixels.parts.get(part_of(number));
            if let (Some(kept), Some(found)) = (parts.get_mut(part_of(index)), found) {
                kept.copy_from_slice(found);
            }
        }
    }
}
