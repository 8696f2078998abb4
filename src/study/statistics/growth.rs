//! How a measure grows with the size of the problem.

use super::relation::Moments;

/// `g(n)`, a way to grow.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Growth {
    /// The natural logarithm.
    Log,
    /// The square root.
    Root,
    /// `n` itself.
    Linear,
}

/// `y = offset + factor g(n)`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Fit {
    /// `a`.
    pub offset: f64,
    /// `b`.
    pub factor: f64,
    /// The share of the variance of `y` that the line explains: 1 where it goes through every point.
    pub r_squared: f64,
}

/// `y` in proportion to `n^exponent`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Power {
    /// The slope in a plot of two logarithmic axes.
    pub exponent: f64,
    /// The share of the variance of `ln y` that the line explains.
    pub r_squared: f64,
}

impl Growth {
    /// `g(n)`; not finite where `n` is too small to have one.
    fn of(self, n: f64) -> f64 {
        match self {
            Growth::Log => libm::log(n),
            Growth::Root => n.sqrt(),
            Growth::Linear => n,
        }
    }
}

/// The least-squares line `y = a + b g(n)`.
///
/// `None` for fewer than three points, lists of unlike length, an `n` that has no `g(n)`, a number that is not finite,
/// and where either `n` or `y` is the same everywhere.
pub fn fit(ns: &[f64], ys: &[f64], growth: Growth) -> Option<Fit> {
    let xs: Vec<f64> = ns.iter().map(|&n| growth.of(n)).collect();
    let moments = Moments::of(&xs, ys)?;
    let factor = moments.xy / moments.xx;
    // Of a line of least squares, that is the square of the correlation.
    let r_squared = factor * (moments.xy / moments.yy);
    let offset = moments.mean_y - factor * moments.mean_x;
    (offset.is_finite() && r_squared.is_finite()).then(|| Fit {
        offset,
        factor,
        r_squared: r_squared.min(1.0),
    })
}

/// The power of `n` that fits best, by least squares of the logarithms.
///
/// `None` where [`fit`] is, and where an `n` or `y` is not above zero.
pub fn power(ns: &[f64], ys: &[f64]) -> Option<Power> {
    let logs: Vec<f64> = ys.iter().map(|&y| libm::log(y)).collect();
    let line = fit(ns, &logs, Growth::Log)?;
    Some(Power {
        exponent: line.factor,
        r_squared: line.r_squared,
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    const NS: [f64; 5] = [10.0, 100.0, 1e3, 1e5, 1e7];

    fn near(a: f64, b: f64) -> bool {
        (a - b).abs() <= 1e-9 * b.abs()
    }

    #[test]
    fn exact_data_gives_back_its_coefficients() {
        for growth in [Growth::Log, Growth::Root, Growth::Linear] {
            let ys = NS.map(|n| 3.0 + 0.5 * growth.of(n));
            let fit = fit(&NS, &ys, growth);
            assert!(fit.is_some_and(|f| {
                near(f.offset, 3.0) && near(f.factor, 0.5) && near(f.r_squared, 1.0)
            }));
        }
    }

    #[test]
    fn the_line_of_anscombes_first_set_is_the_published_one() {
        let xs = [10.0, 8.0, 13.0, 9.0, 11.0, 14.0, 6.0, 4.0, 12.0, 7.0, 5.0];
        let ys = [
            8.04, 6.95, 7.58, 8.81, 8.33, 9.96, 7.24, 4.26, 10.84, 4.82, 5.68,
        ];
        // y = 3 + 0.5 x, r^2 = 0.67
        let fit = fit(&xs, &ys, Growth::Linear);
        assert!(fit.is_some_and(|f| {
            let close = |a: f64, b: f64| (a - b).abs() < 5e-3;
            close(f.offset, 3.0) && close(f.factor, 0.5) && close(f.r_squared, 0.67)
        }));
    }

    #[test]
    fn the_right_growth_fits_best() {
        let ys = NS.map(libm::log);
        let goodness = |growth| fit(&NS, &ys, growth).map_or(0.0, |f| f.r_squared);
        assert!(goodness(Growth::Log) > goodness(Growth::Root));
        assert!(goodness(Growth::Root) > goodness(Growth::Linear));
    }

    #[test]
    fn a_power_gives_back_its_exponent() {
        let ys = NS.map(|n| 7.0 / n.sqrt());
        let power = power(&NS, &ys);
        assert!(power.is_some_and(|p| near(p.exponent, -0.5) && near(p.r_squared, 1.0)));
    }

    #[test]
    fn what_has_no_logarithm_or_no_spread_has_no_fit() {
        assert_eq!(fit(&[0.0, 1.0, 2.0], &[1.0, 2.0, 3.0], Growth::Log), None);
        assert_eq!(fit(&[-1.0, 1.0, 2.0], &[1.0, 2.0, 3.0], Growth::Root), None);
        assert_eq!(fit(&[1.0, 2.0], &[1.0, 2.0], Growth::Linear), None);
        assert_eq!(fit(&[5.0; 3], &[1.0, 2.0, 3.0], Growth::Linear), None);
        assert_eq!(power(&[1.0, 2.0, 3.0], &[1.0, 0.0, 3.0]), None);
    }
}
