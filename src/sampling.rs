//! Where in a pixel its samples lie: a regular k x k grid, a function of pixel and sample alone.

/// A regular grid of `k x k` samples in every pixel, averaged with equal weight (the paper's supersampling).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Grid {
    side: u32,
}

impl Grid {
    /// The grid of `samples` samples, where that is a square number between 1 and 65536.
    pub fn with_samples(samples: u32) -> Option<Grid> {
        let side = samples.isqrt();
        (side * side == samples && (1..=256).contains(&side)).then_some(Grid { side })
    }

    /// Samples a pixel, `k^2`.
    pub fn samples(self) -> u32 {
        self.side * self.side
    }

    /// The continuous picture position of one sample of pixel (`i`, `j`), whose square reaches from (`i`, `j`) to
    /// (`i + 1`, `j + 1`). Sample number `a + k b` lies at `i + (a + 1/2)/k`, `j + (b + 1/2)/k`: `a` to the right,
    /// `b` down; one sample lies at the pixel's centre (paper, eq. 3 and 4, with the half pixel its text asks for).
    ///
    /// In `f64`: a 32-bit position loses the third decimal of a pixel in a picture 65536 wide.
    pub fn position(self, i: u32, j: u32, sample: u32) -> (f64, f64) {
        let k = f64::from(self.side);
        let (a, b) = (sample % self.side, sample / self.side);
        (
            f64::from(i) + (f64::from(a) + 0.5) / k,
            f64::from(j) + (f64::from(b) + 0.5) / k,
        )
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_sample_lies_at_the_pixel_centre() {
        assert_eq!(Grid { side: 1 }.position(3, 7, 0), (3.5, 7.5));
    }

    #[test]
    fn four_samples_go_right_first_then_down() {
        let grid = Grid { side: 2 };
        let positions: Vec<_> = (0..4).map(|s| grid.position(0, 0, s)).collect();
        assert_eq!(
            positions,
            [(0.25, 0.25), (0.75, 0.25), (0.25, 0.75), (0.75, 0.75)]
        );
    }

    #[test]
    fn only_square_numbers_make_a_grid() {
        let squares: Vec<u32> = (0..30)
            .filter(|&n| Grid::with_samples(n).is_some())
            .collect();
        assert_eq!(squares, [1, 4, 9, 16, 25]);
        assert!(Grid::with_samples(u32::MAX).is_none());
    }
}
