//! The paper's supersampling: a regular k x k grid.

use super::spread;

/// A regular grid of `k x k` samples in every pixel.
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

    /// Where in the pixel a sample lies, 0..1 from its upper left corner. Sample number `a + k b` lies at `(a + 1/2)/k`,
    /// `(b + 1/2)/k`: `a` to the right, `b` down; one sample lies at the pixel's centre (paper, eq. 3 and 4, with the
    /// half pixel its text asks for).
    pub fn place(self, sample: u32) -> [f64; 2] {
        let k = f64::from(self.side);
        let (a, b) = (sample % self.side, sample / self.side);
        [(f64::from(a) + 0.5) / k, (f64::from(b) + 0.5) / k]
    }

    /// The same samples in another order: each is well spread with those before it, which a pixel that stops early needs.
    ///
    /// A cell's turn is that of the first point of the (0, 2)-sequence in it. Of such a sequence, 2^18 points have one in
    /// every square of side 1/512, and no cell is so small that it holds none of these.
    pub(super) fn spread(self) -> Vec<u32> {
        let k = f64::from(self.side);
        let mut turns = Vec::with_capacity(self.samples() as usize);
        let mut is_taken = vec![false; self.samples() as usize];
        for number in 0..1 << 18 {
            let [a, b] = spread::place(number).map(|along| (along * k) as u32);
            let cell = a + self.side * b;
            if let Some(taken @ false) = is_taken.get_mut(cell as usize) {
                *taken = true;
                turns.push(cell);
            }
            if turns.len() == is_taken.len() {
                break;
            }
        }
        turns
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn one_sample_lies_at_the_pixel_centre() {
        assert_eq!(Grid { side: 1 }.place(0), [0.5, 0.5]);
    }

    #[test]
    fn four_samples_go_right_first_then_down() {
        let grid = Grid { side: 2 };
        let places: Vec<_> = (0..4).map(|sample| grid.place(sample)).collect();
        assert_eq!(
            places,
            [[0.25, 0.25], [0.75, 0.25], [0.25, 0.75], [0.75, 0.75]]
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

    #[test]
    fn in_the_other_order_every_sample_has_one_turn() {
        for side in [1, 2, 3, 5, 8, 100, 129, 255, 256] {
            let mut turns = Grid { side }.spread();
            turns.sort_unstable();
            assert!(turns.into_iter().eq(0..side * side), "{side}");
        }
    }

    #[test]
    fn in_the_other_order_four_samples_of_64_lie_in_four_quarters() {
        let grid = Grid { side: 8 };
        let quarter = |&sample: &u32| grid.place(sample).map(|along| along > 0.5);
        let mut quarters: Vec<_> = grid.spread()[..4].iter().map(quarter).collect();
        quarters.sort_unstable();
        let all = [[false, false], [false, true], [true, false], [true, true]];
        assert_eq!(quarters, all);
    }
}
