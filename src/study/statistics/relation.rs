//! How far two measures go together.

/// Pearson's `r`, from -1 to 1: how near the points lie to a straight line.
///
/// `None` for fewer than three points, lists of unlike length, a number that is not finite, and where either measure
/// is the same everywhere.
pub fn correlation(xs: &[f64], ys: &[f64]) -> Option<f64> {
    let moments = Moments::of(xs, ys)?;
    let r = moments.xy / (moments.xx.sqrt() * moments.yy.sqrt());
    r.is_finite().then(|| r.clamp(-1.0, 1.0))
}

/// Spearman's rho, from -1 to 1: how far the order of one measure is the order of the other. Equal numbers share the
/// mean of their ranks.
///
/// `None` where [`correlation`] is.
pub fn rank_correlation(xs: &[f64], ys: &[f64]) -> Option<f64> {
    Moments::of(xs, ys)?;
    correlation(&ranks(xs), &ranks(ys))
}

/// Sums of squares and products about the means.
pub(super) struct Moments {
    pub(super) mean_x: f64,
    pub(super) mean_y: f64,
    pub(super) xx: f64,
    pub(super) yy: f64,
    pub(super) xy: f64,
}

impl Moments {
    /// Of three points or more, finite, that differ in both directions.
    pub(super) fn of(xs: &[f64], ys: &[f64]) -> Option<Moments> {
        let usable = |numbers: &[f64]| {
            // Compared, not from the sum of squares: rounding makes 0.1, 0.1, 0.1 differ from their mean.
            let varies = numbers.windows(2).any(|pair| pair[0] != pair[1]);
            varies && numbers.len() >= 3 && numbers.iter().all(|x| x.is_finite())
        };
        if xs.len() != ys.len() || !usable(xs) || !usable(ys) {
            return None;
        }
        let mean = |numbers: &[f64]| numbers.iter().sum::<f64>() / numbers.len() as f64;
        let (mean_x, mean_y) = (mean(xs), mean(ys));
        let sum = |of: &dyn Fn(f64, f64) -> f64| -> f64 {
            let points = xs.iter().zip(ys);
            points.map(|(x, y)| of(x - mean_x, y - mean_y)).sum()
        };
        Some(Moments {
            mean_x,
            mean_y,
            xx: sum(&|x, _| x * x),
            yy: sum(&|_, y| y * y),
            xy: sum(&|x, y| x * y),
        })
    }
}

/// The place of each number in rising order, from 1; the mean of their places for equal ones.
fn ranks(numbers: &[f64]) -> Vec<f64> {
    let mut order: Vec<(usize, f64)> = numbers.iter().copied().enumerate().collect();
    order.sort_unstable_by(|(_, a), (_, b)| a.total_cmp(b));
    let mut ranks = vec![0.0; numbers.len()];
    let mut before = 0;
    for equal in order.chunk_by(|(_, a), (_, b)| a == b) {
        let rank = before as f64 + (equal.len() + 1) as f64 / 2.0;
        for &(position, _) in equal {
            ranks[position] = rank;
        }
        before += equal.len();
    }
    ranks
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Anscombe 1973, "Graphs in Statistical Analysis".
    const X: [f64; 11] = [10.0, 8.0, 13.0, 9.0, 11.0, 14.0, 6.0, 4.0, 12.0, 7.0, 5.0];
    const X_4: [f64; 11] = [8.0, 8.0, 8.0, 8.0, 8.0, 8.0, 8.0, 19.0, 8.0, 8.0, 8.0];
    const Y: [[f64; 11]; 4] = [
        [
            8.04, 6.95, 7.58, 8.81, 8.33, 9.96, 7.24, 4.26, 10.84, 4.82, 5.68,
        ],
        [
            9.14, 8.14, 8.74, 8.77, 9.26, 8.10, 6.13, 3.10, 9.13, 7.26, 4.74,
        ],
        [
            7.46, 6.77, 12.74, 7.11, 7.81, 8.84, 6.08, 5.39, 8.15, 6.42, 5.73,
        ],
        [
            6.58, 5.76, 7.71, 8.84, 8.47, 7.04, 5.25, 12.50, 5.56, 7.91, 6.89,
        ],
    ];

    #[test]
    fn anscombes_quartet_has_one_correlation() {
        for (xs, ys) in [X, X, X, X_4].iter().zip(&Y) {
            assert!(correlation(xs, ys).is_some_and(|r| (r - 0.8165).abs() < 5e-4));
        }
    }

    #[test]
    fn a_line_has_correlation_one_and_a_falling_one_minus_one() {
        let xs = [1.0, 2.0, 4.0];
        assert_eq!(correlation(&xs, &[3.0, 5.0, 9.0]), Some(1.0));
        assert_eq!(correlation(&xs, &[-1.0, -2.0, -4.0]), Some(-1.0));
    }

    #[test]
    fn ranks_see_order_alone() {
        let xs = [1.0, 2.0, 3.0, 4.0];
        let rising = rank_correlation(&xs, &[1.0, 10.0, 11.0, 1e9]);
        assert!(rising.is_some_and(|rho| (rho - 1.0).abs() < 1e-15));
        // Differences of rank 0, 1, -1, 0: 1 - 6 * 2 / (4 * 15).
        let swapped = rank_correlation(&xs, &[1.0, 3.0, 2.0, 4.0]);
        assert!(swapped.is_some_and(|rho| (rho - 0.8).abs() < 1e-15));
    }

    #[test]
    fn equal_numbers_share_their_ranks() {
        assert_eq!(ranks(&[7.0, 3.0, 7.0, 1.0]), [3.5, 2.0, 3.5, 1.0]);
        assert_eq!(ranks(&[0.0, -0.0]), [1.5, 1.5]);
    }

    #[test]
    fn two_points_constants_and_no_numbers_have_no_correlation() {
        let none: [(&[f64], &[f64]); 5] = [
            (&[1.0, 2.0], &[1.0, 2.0]),
            (&[0.1, 0.1, 0.1], &[1.0, 2.0, 3.0]),
            (&[1.0, 2.0, 3.0], &[5.0, 5.0, 5.0]),
            (&[1.0, 2.0, f64::NAN], &[1.0, 2.0, 3.0]),
            (&[1.0, 2.0, 3.0], &[1.0, 2.0]),
        ];
        for (xs, ys) in none {
            assert_eq!(correlation(xs, ys), None);
            assert_eq!(rank_correlation(xs, ys), None);
        }
    }
}
