//! Where about a pixel its samples lie, and what each counts: a function of the sample's number alone, so that a picture
//! has no noise and a batch of rays is the same sample of many pixels.

mod filter;
mod grid;
mod spread;

pub use filter::Filter;
pub use grid::Grid;

use filter::Warp;

/// How the samples of a pixel are laid out before the filter moves them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Pattern {
    /// A regular grid (the paper's): only square numbers of samples.
    #[default]
    Grid,
    /// A progressive (0, 2)-sequence: any number, and the first of them are well spread, too.
    Spread,
}

impl Pattern {
    /// Both.
    pub const ALL: [Pattern; 2] = [Pattern::Grid, Pattern::Spread];

    /// As on the command line and in scene files.
    pub fn name(self) -> &'static str {
        match self {
            Pattern::Grid => "grid",
            Pattern::Spread => "spread",
        }
    }
}

/// Which samples a pixel gets.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Sampling {
    /// How many; the most, where `adaptive`.
    pub samples: u32,
    /// How they lie.
    pub pattern: Pattern,
    /// How they become a colour.
    pub filter: Filter,
    /// Whether a pixel gets more than [`BASE`] only where these, or its neighbours', differ.
    pub adaptive: bool,
}

/// The most samples a pixel, 256 x 256.
pub const MAX_SAMPLES: u32 = 65_536;

/// What every pixel gets where sampling is adaptive, if there are so many.
pub const BASE: u32 = 4;

/// Who asks for so many samples wants to see nothing of their number.
const FINE: u32 = 64;

impl Sampling {
    /// The paper's: a regular grid, averaged with equal weight.
    pub fn grid(samples: u32) -> Sampling {
        Sampling {
            samples,
            pattern: Pattern::Grid,
            filter: Filter::Box,
            adaptive: false,
        }
    }

    /// The numbers of samples after which an adaptive pixel may stop, the last of them all: four times as many after the
    /// first, and then twice as many each time, since of a (0, 2)-sequence each power of two is as well spread as it can
    /// be. Of any other pixel only the last.
    ///
    /// To stop at twice as many as the first misses edges: of figure 5, 0.7 % of the pixels were then off by more than
    /// 2 of 255, for a tenth fewer rays (2026-11-22).
    pub fn stops(&self) -> Vec<u32> {
        let mut stops = Vec::new();
        let mut next = u64::from(BASE);
        while self.adaptive && next < u64::from(self.samples) {
            stops.push(next as u32);
            next *= if next == u64::from(BASE) { 4 } else { 2 };
        }
        stops.push(self.samples);
        stops
    }

    /// By how much of what can be seen, in 256 steps, one sample more may change a pixel that gets none: one step where 64
    /// samples and more are asked for, and four times as much for a quarter of them.
    pub fn tolerance(&self) -> u32 {
        (FINE / self.samples.max(1)).max(1)
    }

    /// Where the samples are, in the order in which they are taken. A grid of no square number has none.
    pub fn offsets(&self) -> Vec<Offset> {
        let warp = Warp::new(self.filter);
        let offset = |place: [f64; 2]| {
            let [(x, x_sign), (y, y_sign)] = place.map(|along| warp.place(along));
            Offset {
                x,
                y,
                weight: (x_sign * y_sign) as f32,
            }
        };
        match self.pattern {
            Pattern::Spread => {
                let place = |number| spread::place_of(number, self.samples);
                (0..self.samples).map(place).map(offset).collect()
            }
            Pattern::Grid => {
                let Some(grid) = Grid::with_samples(self.samples) else {
                    return Vec::new();
                };
                let order = if self.adaptive {
                    grid.spread()
                } else {
                    (0..self.samples).collect()
                };
                let places = order.into_iter().map(|number| grid.place(number));
                places.map(offset).collect()
            }
        }
    }
}

/// A sample's place about every pixel.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Offset {
    /// To the right of the pixel's left side, in pixels: of a pixel in column `i`, the sample is at `i + x`. In `f64`: a
    /// 32-bit position loses the third decimal of a pixel in a picture 65536 wide.
    pub x: f64,
    /// Down from the pixel's upper side.
    pub y: f64,
    /// 1, or -1 where the filter is below zero.
    pub weight: f32,
}

impl Offset {
    /// Whether it is in the pixel's own square, not in a neighbour's.
    pub fn is_inside(&self) -> bool {
        let inside = 0.0..1.0;
        inside.contains(&self.x) && inside.contains(&self.y)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn spread(samples: u32, filter: Filter) -> Sampling {
        Sampling {
            samples,
            pattern: Pattern::Spread,
            filter,
            adaptive: false,
        }
    }

    #[test]
    fn the_papers_samples_lie_on_its_grid_to_the_last_bit() {
        for samples in [1, 4, 9, 25, 64] {
            let grid = Grid::with_samples(samples).expect("a grid");
            let expected = (0..samples).map(|number| grid.place(number));
            let offsets = Sampling::grid(samples).offsets();
            let found = offsets.iter().map(|offset| [offset.x, offset.y]);
            assert!(found.eq(expected), "{samples}");
            assert!(offsets.iter().all(|offset| offset.weight == 1.0));
        }
    }

    #[test]
    fn any_number_of_samples_is_there_and_only_mitchells_have_weights() {
        for filter in Filter::ALL {
            for samples in [1, 2, 3, 7, 10, 1000] {
                let offsets = spread(samples, filter).offsets();
                assert_eq!(offsets.len(), samples as usize);
                for offset in &offsets {
                    let distance = (offset.x - 0.5).abs().max((offset.y - 0.5).abs());
                    assert!(distance <= filter.radius(), "{filter:?}");
                    assert!(offset.weight == 1.0 || filter.has_negative_lobes());
                }
            }
        }
    }

    /// What a pixel is divided by.
    #[test]
    fn the_weights_of_however_many_samples_are_far_from_adding_to_nothing() {
        let all = [spread(1000, Filter::Mitchell), spread(5, Filter::Mitchell)];
        let grid = |samples| Sampling {
            filter: Filter::Mitchell,
            ..Sampling::grid(samples)
        };
        for sampling in all.into_iter().chain([4, 9, 64, 1024].map(grid)) {
            let mut sum = 0.0;
            for (count, offset) in (1u16..).zip(sampling.offsets()) {
                sum += offset.weight;
                let stops =
                    sampling.pattern == Pattern::Spread || u32::from(count) == sampling.samples;
                assert!(
                    !stops || sum >= 0.5 * f32::from(count),
                    "{count} of {sampling:?}"
                );
            }
        }
    }

    #[test]
    fn an_adaptive_pixel_may_stop_at_powers_of_two() {
        let stops = |samples, adaptive| {
            let sampling = Sampling {
                adaptive,
                ..spread(samples, Filter::Box)
            };
            sampling.stops()
        };
        assert_eq!(stops(64, false), [64]);
        assert_eq!(stops(64, true), [4, 16, 32, 64]);
        assert_eq!(stops(10, true), [4, 10]);
        assert_eq!(stops(4, true), [4]);
        assert_eq!(stops(1, true), [1]);
        assert_eq!(stops(MAX_SAMPLES, true).len(), 14);
    }
}
