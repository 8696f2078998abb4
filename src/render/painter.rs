//! From tiles to samples, a batch of rays at a time.

use super::Rendering;
use super::known::Known;
use super::matte::{Ranks, Shares};
use super::record::Record;
use super::tile::Tile;
use crate::color::Rgb;
use crate::film::Layers;
use crate::ray::Ray;
use crate::sampling::{BASE, Offset};
use crate::whitted::{Counts, First, Parts, Rules, Sample, Tracer};
use std::time::Instant;

/// Some pixels, and what is known of them.
#[derive(Debug, Default)]
pub(super) struct Pixels {
    /// Column and row.
    pub(super) places: Vec<[i32; 2]>,
    pub(super) records: Vec<Record>,
    /// What their rays were tested against; empty unless somebody wants to know.
    pub(super) counts: Vec<Counts>,
    /// The parts of their light, pixel by pixel, added up as the records are.
    pub(super) parts: Vec<Rgb>,
    /// What the nearest of their samples met, where it is nearer than all that an earlier pass knows; empty unless
    /// somebody wants to know.
    pub(super) firsts: Vec<Option<First>>,
    /// Which objects have shares of them; empty unless somebody wants to know.
    pub(super) shares: Vec<Shares>,
    /// The greatest of these.
    pub(super) ranks: Vec<[Ranks; 2]>,
}

impl Pixels {
    /// Makes room for what samples see in so many pixels.
    fn start_seeing(&mut self, layers: &Layers) {
        let pixels = self.places.len();
        self.firsts.clear();
        if layers.of_surfaces() {
            self.firsts.resize(pixels, None);
        }
        if layers.mattes {
            Shares::clear(&mut self.shares, pixels);
        }
    }

    /// Takes over what a sample of each pixel of `pixel_of` saw, before the records know of it.
    fn add_seen(
        &mut self,
        tracer: &Tracer,
        samples: &[Sample],
        offset: &Offset,
        pixel_of: impl Fn(usize) -> usize,
    ) {
        let firsts = tracer.firsts.iter().flatten();
        for (index, (first, sample)) in firsts.zip(samples).enumerate() {
            let pixel = pixel_of(index);
            let known = self.records.get(pixel);
            let is_passed = known.is_none_or(|known| known.is_passed_by(sample, offset));
            if let (true, Some(nearest)) = (is_passed, self.firsts.get_mut(pixel)) {
                *nearest = Some(*first);
            }
        }
        for share in tracer.shares.iter().flatten() {
            if let Some(shares) = self.shares.get_mut(pixel_of(share.sample as usize)) {
                shares.add(share, offset.weight);
            }
        }
    }

    /// Finds the greatest shares.
    fn rank(&mut self, rendering: &Rendering) {
        self.ranks.clear();
        let shares = self.records.iter().zip(&self.shares);
        let ranks = shares.map(|(record, shares)| rendering.ranks(record, shares));
        self.ranks.extend(ranks);
    }

    /// Adds a sample's parts to those of pixel number `index`.
    fn add_parts(&mut self, index: usize, parts: &[Rgb], weight: f32) {
        let start = index * parts.len();
        let sums = self.parts.get_mut(start..start + parts.len());
        for (sum, part) in sums.into_iter().flatten().zip(parts) {
            *sum += *part * weight;
        }
    }
}

/// Who renders tile after tile, in the same memory.
pub(super) struct Painter<'a> {
    rendering: &'a Rendering<'a>,
    pub(super) tracer: Tracer<'a>,
    columns: Vec<f64>,
    rows: Vec<f64>,
    positions: Vec<[f64; 2]>,
    rays: Vec<Ray>,
    samples: Vec<Sample>,
    /// The last tile's.
    pub(super) pixels: Pixels,
    /// Those of its pixels that get more samples, by their index.
    active: Vec<usize>,
}

impl<'a> Painter<'a> {
    pub(super) fn new(rendering: &'a Rendering<'a>, rules: Rules) -> Painter<'a> {
        Painter {
            rendering,
            tracer: Tracer::new(rendering.scene, rendering.accel, rules),
            columns: Vec::new(),
            rows: Vec::new(),
            positions: Vec::new(),
            rays: Vec::new(),
            samples: Vec::new(),
            pixels: Pixels::default(),
            active: Vec::new(),
        }
    }

    /// Renders the samples that every pixel of a tile gets: of each sample a batch of rays for all of it.
    pub(super) fn paint(&mut self, tile: &Tile, watched: bool) {
        let start = Instant::now();
        self.tracer.watched = watched;
        let Pixels {
            places, records, ..
        } = &mut self.pixels;
        places.clear();
        places.extend(tile.pixels());
        records.clear();
        records.resize(places.len(), Record::EMPTY);
        self.count_costs(self.pixels.places.len());
        let rendering = self.rendering;
        self.pixels.start_seeing(&rendering.settings.layers);
        let parts = self.pixels.places.len() * rendering.settings.layers.parts();
        self.pixels.parts.clear();
        self.pixels.parts.resize(parts, Rgb::BLACK);
        let all = rendering.stops.first().copied().unwrap_or(0);
        for (number, offset) in (0..all).zip(&rendering.offsets) {
            self.columns.clear();
            self.columns
                .extend(tile.columns().map(|i| f64::from(i) + offset.x));
            self.rows.clear();
            self.rows
                .extend(tile.rows().map(|j| f64::from(j) + offset.y));
            self.rays.clear();
            let view = &rendering.view;
            view.primary_rays(&self.columns, &self.rows, &mut self.rays);
            self.trace(number);
            let (pixels, samples) = (&mut self.pixels, &self.samples);
            pixels.add_seen(&self.tracer, samples, offset, |index| index);
            for (record, sample) in self.pixels.records.iter_mut().zip(&self.samples) {
                record.add(sample, offset);
                if rendering.is_adaptive {
                    record.compare(sample, rendering.round);
                }
            }
            let parts = self.tracer.parts.iter().flat_map(Parts::of_samples);
            for (index, parts) in parts.enumerate() {
                self.pixels.add_parts(index, parts, offset.weight);
            }
        }
        self.pixels.counts.clear();
        let counts = self.tracer.counts.iter().flatten();
        self.pixels.counts.extend(counts);
        self.pixels.rank(rendering);
        if watched {
            self.tracer.statistics.watched += start.elapsed();
        }
    }

    /// Adds samples to those pixels of a tile that need them, until these do not: of each sample a batch of rays for all
    /// that still do.
    pub(super) fn refine(&mut self, tile: &Tile, known: &Known, watched: bool) {
        let start = Instant::now();
        self.tracer.watched = watched;
        self.choose(tile, known);
        let rendering = self.rendering;
        for stop in rendering.stops.windows(2) {
            let &[from, to] = stop else { continue };
            if from > BASE {
                let records = &self.pixels.records;
                let (round, tolerance) = (rendering.round, rendering.tolerance);
                self.active
                    .retain(|&index| records[index].needs_more(round, tolerance));
            }
            if self.active.is_empty() {
                break;
            }
            self.count_costs(self.active.len());
            let offsets = rendering.offsets.iter();
            let numbered = (0..).zip(offsets).skip(from as usize);
            for (number, offset) in numbered.take((to - from) as usize) {
                self.positions.clear();
                self.positions.extend(self.active.iter().map(|&index| {
                    let [i, j] = self.pixels.places[index].map(f64::from);
                    [i + offset.x, j + offset.y]
                }));
                self.rays.clear();
                rendering
                    .view
                    .primary_rays_at(&self.positions, &mut self.rays);
                self.trace(number);
                let (pixels, samples) = (&mut self.pixels, &self.samples);
                let pixel_of = |index: usize| self.active.get(index).map_or(usize::MAX, |at| *at);
                pixels.add_seen(&self.tracer, samples, offset, pixel_of);
                for (&index, sample) in self.active.iter().zip(&self.samples) {
                    let record = &mut self.pixels.records[index];
                    record.add(sample, offset);
                    record.compare(sample, rendering.round);
                }
                let parts = self.tracer.parts.iter().flat_map(Parts::of_samples);
                for (&index, parts) in self.active.iter().zip(parts) {
                    self.pixels.add_parts(index, parts, offset.weight);
                }
            }
            let counts = self.tracer.counts.iter().flatten();
            for (&index, count) in self.active.iter().zip(counts) {
                let counts = &mut self.pixels.counts[index];
                counts.nodes += count.nodes;
                counts.primitives += count.primitives;
            }
        }
        self.pixels.rank(rendering);
        if watched {
            self.tracer.statistics.watched += start.elapsed();
        }
    }

    /// Takes up those pixels of a tile whose samples, or those of a neighbour, say that something ends there; tile by
    /// small tile, since rays that lie together are searched for together.
    fn choose(&mut self, tile: &Tile, known: &Known) {
        let Pixels {
            places,
            records,
            counts,
            parts,
            ..
        } = &mut self.pixels;
        places.clear();
        records.clear();
        counts.clear();
        parts.clear();
        let of_pixel = self.rendering.settings.layers.parts();
        let tile_side = self.rendering.settings.tile_side;
        let (round, tolerance) = (self.rendering.round, self.rendering.tolerance);
        for place in tile.tiles(tile_side).flat_map(Tile::pixels) {
            let Some(index) = known.area.index(place) else {
                continue;
            };
            if !known.needs_more(place, round, tolerance) {
                continue;
            }
            places.push(place);
            records.extend(known.records.get(index));
            counts.extend(known.counts.get(index));
            let known = known.parts.get(index * of_pixel..(index + 1) * of_pixel);
            parts.extend(known.into_iter().flatten());
        }
        let count = places.len();
        self.pixels.start_seeing(&self.rendering.settings.layers);
        let pixels = self.pixels.places.iter().zip(&mut self.pixels.shares);
        for (place, shares) in pixels {
            let index = known.area.index(*place);
            if let Some(known) = index.and_then(|index| known.shares.get(index)) {
                shares.go_on_from(known);
            }
        }
        self.active.clear();
        self.active.extend(0..count);
    }

    /// Starts to count what the next batches of rays are tested against, if somebody wants to know.
    fn count_costs(&mut self, pixels: usize) {
        let wanted = self.rendering.settings.layers.cost;
        self.tracer.counts = wanted.then(|| vec![Counts::default(); pixels]);
    }

    /// Follows the rays of sample number `number` of some pixels.
    fn trace(&mut self, number: u32) {
        let (view, rays) = (&self.rendering.view, &self.rays);
        self.tracer.trace(view, number, rays, &mut self.samples);
    }
}
