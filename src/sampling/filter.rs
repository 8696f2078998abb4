//! How the samples about a pixel's centre become its colour.
//!
//! Not by weights: samples are placed as densely as the filter weighs, so that they all count the same and no pixel needs
//! those of another (Ernst, Stamminger and Greiner 2006, "Filter Importance Sampling"). A pixel then never depends on
//! tiles or on what else is in the picture. Every filter is the product of one along x and one along y.

use libm::{cos, exp};
use std::f64::consts::PI;

/// A reconstruction filter.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Filter {
    /// All of the pixel's square alike, nothing else: radius 1/2 pixel (the paper's).
    #[default]
    Box,
    /// A normal distribution, less what it has left at the radius, 1.5 pixels; its deviation is half a pixel.
    Gaussian,
    /// Mitchell and Netravali 1988, "Reconstruction Filters in Computer Graphics", B = C = 1/3: radius 2 pixels. It is
    /// below zero from 8/7 on, which sharpens, and can ring about bright edges.
    Mitchell,
    /// The window of four cosines (Harris 1978, "On the Use of Windows for Harmonic Analysis with the Discrete Fourier
    /// Transform"): radius 1.5 pixels.
    BlackmanHarris,
}

impl Filter {
    /// Every filter, the narrowest first.
    pub const ALL: [Filter; 4] = [
        Filter::Box,
        Filter::BlackmanHarris,
        Filter::Gaussian,
        Filter::Mitchell,
    ];

    /// As on the command line and in scene files.
    pub fn name(self) -> &'static str {
        match self {
            Filter::Box => "box",
            Filter::Gaussian => "gaussian",
            Filter::Mitchell => "mitchell",
            Filter::BlackmanHarris => "blackman-harris",
        }
    }

    /// How far from the pixel's centre samples lie along x and along y, in pixels.
    pub fn radius(self) -> f64 {
        match self {
            Filter::Box => 0.5,
            Filter::Gaussian | Filter::BlackmanHarris => 1.5,
            Filter::Mitchell => 2.0,
        }
    }

    /// Whether it is below zero anywhere.
    pub fn has_negative_lobes(self) -> bool {
        self == Filter::Mitchell
    }

    /// What it weighs at a distance from the centre along one axis, in pixels, up to a factor; 0 past the radius.
    pub fn weight(self, x: f64) -> f64 {
        let (x, radius) = (x.abs(), self.radius());
        if x > radius {
            return 0.0;
        }
        match self {
            Filter::Box => 1.0,
            Filter::Gaussian => {
                const DEVIATION: f64 = 0.5;
                let normal = |x: f64| exp(-x * x / (2.0 * DEVIATION * DEVIATION));
                normal(x) - normal(radius)
            }
            Filter::Mitchell => {
                // Equation 8 with B = C = 1/3, times 18.
                if x < 1.0 {
                    (21.0 * x - 36.0) * x * x + 16.0
                } else {
                    ((-7.0 * x + 36.0) * x - 60.0) * x + 32.0
                }
            }
            Filter::BlackmanHarris => {
                let angle = PI * x / radius;
                0.35875
                    + 0.48829 * cos(angle)
                    + 0.14128 * cos(2.0 * angle)
                    + 0.01168 * cos(3.0 * angle)
            }
        }
    }
}

/// Steps from the centre to the radius: the distance of a sample is right to a thousandth of a pixel.
const STEPS: usize = 1024;

/// A filter made ready to place samples.
#[derive(Clone, Debug)]
pub(super) struct Warp {
    filter: Filter,
    /// The weight, taken without its sign, from the centre to each step.
    sums: Vec<f64>,
}

impl Warp {
    pub(super) fn new(filter: Filter) -> Warp {
        let mut sums = vec![0.0];
        let mut sum = 0.0;
        for step in 0..STEPS {
            let middle = (step as f64 + 0.5) / STEPS as f64;
            sum += filter.weight(middle * filter.radius()).abs();
            sums.push(sum);
        }
        Warp { filter, sums }
    }

    /// Where along one axis the sample lies that would be at `u` (0..1) of the pixel's square, in pixels from that
    /// square's beginning, and the sign of its weight.
    pub(super) fn place(&self, u: f64) -> (f64, f64) {
        if self.filter == Filter::Box {
            return (u, 1.0);
        }
        let side = 2.0 * u - 1.0;
        let all = self.sums.last().copied().unwrap_or(0.0);
        let wanted = side.abs() * all;
        let past = self.sums.partition_point(|&sum| sum <= wanted);
        let distance = match (self.sums.get(past.wrapping_sub(1)), self.sums.get(past)) {
            (Some(from), Some(to)) => (past - 1) as f64 + (wanted - from) / (to - from),
            _ => STEPS as f64,
        };
        let x = distance / STEPS as f64 * self.filter.radius();
        let sign = if self.filter.weight(x) < 0.0 {
            -1.0
        } else {
            1.0
        };
        (0.5 + x.copysign(side), sign)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn filters_are_whole_at_the_centre_and_nothing_at_their_radius() {
        for filter in [Filter::Gaussian, Filter::Mitchell, Filter::BlackmanHarris] {
            let [centre, edge] = [0.0, filter.radius()].map(|x| filter.weight(x));
            assert!(centre > 0.0 && (edge / centre).abs() < 1e-4, "{filter:?}");
        }
    }

    #[test]
    fn mitchells_pieces_meet_and_its_copies_add_to_one() {
        let filter = Filter::Mitchell;
        assert_eq!(filter.weight(1.0), 1.0);
        assert!((filter.weight(1.0 - 1e-9) - 1.0).abs() < 1e-7);
        for x in [0.0, 0.1, 0.5, 0.9] {
            let copies = (-3..=3).map(|i| filter.weight(x + f64::from(i)));
            assert!((copies.sum::<f64>() - 18.0).abs() < 1e-12);
        }
    }

    #[test]
    fn the_middle_of_a_pixel_stays_there_and_sides_are_mirrored() {
        for filter in Filter::ALL {
            let warp = Warp::new(filter);
            assert_eq!(warp.place(0.5), (0.5, 1.0), "{filter:?}");
            for u in [1e-9, 0.125, 0.25, 0.4999] {
                let ((left, sign), (right, same)) = (warp.place(u), warp.place(1.0 - u));
                assert!((left + right - 1.0).abs() < 1e-6 && sign == same && left < 0.5);
                assert!(left >= 0.5 - filter.radius());
            }
        }
    }

    /// Samples at even steps have the mean and the variance of the filter.
    #[test]
    fn samples_are_as_dense_as_the_filter_weighs() {
        const COUNT: u32 = 4096;
        for filter in Filter::ALL {
            let warp = Warp::new(filter);
            let (mut signs, mut squares) = (0.0, 0.0);
            for number in 0..COUNT {
                let (x, sign) = warp.place((f64::from(number) + 0.5) / f64::from(COUNT));
                signs += sign;
                squares += sign * (x - 0.5) * (x - 0.5);
            }
            let (mut weights, mut moments) = (0.0, 0.0);
            for step in 0..100_000 {
                let x = (f64::from(step) + 0.5) / 100_000.0 * filter.radius();
                weights += filter.weight(x);
                moments += filter.weight(x) * x * x;
            }
            let (found, expected) = (squares / signs, moments / weights);
            assert!(
                (found - expected).abs() < 2e-3,
                "{filter:?}: {found}, {expected}"
            );
        }
    }
}
