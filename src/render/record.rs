//! What is known of a pixel after some of its samples.

use crate::color::Rgb;
use crate::sampling::{BASE, Filter, Offset};
use crate::whitted::{NO_OBJECT, Sample};
use glam::Vec3;

/// Samples of one pixel, added up, and how much they differ.
#[derive(Clone, Copy, Debug)]
pub(super) struct Record {
    /// Sums, each sample by its weight.
    color: Rgb,
    alpha: f32,
    /// The nearest: of the samples in the pixel's own square, or of all while there is none.
    pub(super) depth: f32,
    /// Whether there is such a sample.
    is_inside: bool,
    pub(super) samples: u32,
    /// Of the samples since the last that were compared, colour and alpha.
    round: [f32; 4],
    /// The least and the greatest of [`seen`].
    least: [u8; 4],
    greatest: [u8; 4],
    /// The first sample's.
    object: u32,
    /// The first sample's, times 127.
    normal: [i8; 3],
    /// Whether another sample's object or normal is not the first one's.
    torn: bool,
}

/// Of `cos(15°)`: normals further apart than that are those of different sides.
const SAME_SIDE: f32 = 0.965_925_8;

impl Record {
    pub(super) const EMPTY: Record = Record {
        color: Rgb::BLACK,
        alpha: 0.0,
        depth: f32::INFINITY,
        is_inside: false,
        samples: 0,
        round: [0.0; 4],
        least: [u8::MAX; 4],
        greatest: [0; 4],
        object: NO_OBJECT,
        normal: [0; 3],
        torn: false,
    };

    /// Light is summed (and becomes a mean), depth is the nearest.
    pub(super) fn add(&mut self, sample: &Sample, offset: &Offset) {
        self.color += sample.color * offset.weight;
        self.alpha += sample.alpha * offset.weight;
        if self.is_passed_by(sample, offset) {
            (self.depth, self.is_inside) = (sample.depth, offset.is_inside());
        }
        self.samples += 1;
    }

    /// Whether a sample becomes the nearest. Filters reach into neighbours, whose surfaces are not this pixel's.
    pub(super) fn is_passed_by(&self, sample: &Sample, offset: &Offset) -> bool {
        match (offset.is_inside(), self.is_inside) {
            (true, false) => true,
            (false, true) => false,
            _ => sample.depth < self.depth,
        }
    }

    /// Takes note of how a sample differs from those before; `add` comes first. Light is compared by rounds of so many
    /// samples: in an environment each of a round sees other lights, and only their mean says what there is.
    pub(super) fn compare(&mut self, sample: &Sample, round: u32) {
        let Rgb { r, g, b } = sample.color;
        for (sum, value) in self.round.iter_mut().zip([r, g, b, sample.alpha]) {
            *sum += value;
        }
        if self.samples.is_multiple_of(round) {
            let mean = std::mem::take(&mut self.round).map(|sum| sum / round as f32);
            for (channel, value) in seen(mean).into_iter().enumerate() {
                self.least[channel] = self.least[channel].min(value);
                self.greatest[channel] = self.greatest[channel].max(value);
            }
        }
        let normal = sample.normal.to_array().map(|along| (along * 127.0) as i8);
        if self.samples == 1 {
            (self.object, self.normal) = (sample.object, normal);
        }
        self.torn |= self.object != sample.object || !same_side(self.normal, normal);
    }

    /// Whether one round of samples more and half another, like those that the pixel has, could change it by more than
    /// `tolerance` of the 256 steps that can be seen; and where few samples see several things, whatever their light.
    pub(super) fn needs_more(&self, round: u32, tolerance: u32) -> bool {
        let rounds = self.samples / round;
        self.torn && self.samples <= BASE
            || differ(
                &self.least,
                &self.greatest,
                (rounds * tolerance * 2).div_ceil(3),
            )
    }

    /// Whether something ends between this pixel and another: objects, sides, or light differ. Light by three quarters of
    /// what a round may change: what ends is seen by less than all samples.
    pub(super) fn differs_from(&self, other: &Record, tolerance: u32) -> bool {
        let least = std::array::from_fn(|i| self.least[i].min(other.least[i]));
        let greatest = std::array::from_fn(|i| self.greatest[i].max(other.greatest[i]));
        self.object != other.object
            || !same_side(self.normal, other.normal)
            || differ(&least, &greatest, self.samples * tolerance * 3 / 4)
    }

    /// The mean colour, premultiplied, and alpha, where the filter's weights of the samples add to `weight`.
    pub(super) fn mean(&self, weight: f32, filter: Filter) -> [f32; 4] {
        let share = 1.0 / weight;
        let Rgb { r, g, b } = self.color * share;
        let mean = [r, g, b, self.alpha * share];
        if !filter.has_negative_lobes() {
            return mean;
        }
        // What rings beyond black and beyond opaque is nothing that a file should hold.
        let [r, g, b, alpha] = mean.map(|value| value.max(0.0));
        [r, g, b, alpha.min(1.0)]
    }
}

/// What of a light and its alpha meets the eye, in 256 steps: its colour as a display may show it, whatever the exposure:
/// half of the steps are for what is darker than 1/3.
fn seen([r, g, b, alpha]: [f32; 4]) -> [u8; 4] {
    // No number counts as nothing.
    let shown = |light: f32| {
        let light = light.clamp(0.0, 1e9);
        ((light / (1.0 + light)).sqrt() * 255.0 + 0.5) as u8
    };
    let alpha = (alpha.clamp(0.0, 1.0) * 255.0 + 0.5) as u8;
    [shown(r), shown(g), shown(b), alpha]
}

/// Whether a channel differs by more than so many steps.
fn differ(least: &[u8; 4], greatest: &[u8; 4], steps: u32) -> bool {
    let channels = least.iter().zip(greatest);
    let mut spreads = channels.map(|(least, greatest)| greatest.saturating_sub(*least));
    spreads.any(|spread| u32::from(spread) > steps)
}

/// Whether normals are less than 15 degrees apart, or one is missing.
fn same_side(a: [i8; 3], b: [i8; 3]) -> bool {
    if a == b {
        return true;
    }
    let [a, b] = [a, b].map(|n| Vec3::from_array(n.map(f32::from)));
    let lengths = (a.length_squared() * b.length_squared()).sqrt();
    a.dot(b) >= SAME_SIDE * lengths
}
