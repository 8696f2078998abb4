//! How time grows with the number of primitives.

use super::super::case::{Measure, Threads, What};
use super::super::estimate::Estimate;
use super::super::results::{Measured, Results};
use super::super::statistics::{Fit, Growth, Power, fit, power};

/// A figure of a case; `None` where it has none.
pub(super) type Figure<'a> = &'a dyn Fn(&Measured) -> Option<Estimate>;

/// What a measure of a case took on all threads.
pub(super) fn seconds(results: &Results, case: &Measured, what: What) -> Option<Estimate> {
    let threads = Threads::All;
    results.estimate(&case.name, Measure { what, threads })
}

/// The groups of a study, in order of appearance.
pub(super) fn groups(results: &Results) -> Vec<String> {
    let mut groups: Vec<String> = Vec::new();
    for case in &results.cases {
        if !groups.contains(&case.group) {
            groups.push(case.group.clone());
        }
    }
    groups
}

/// A group's figures by the number of primitives, in order.
pub(super) fn by_n(results: &Results, group: &str, of: Figure) -> Vec<(f64, Estimate)> {
    let cases = results.cases.iter().filter(|case| case.group == group);
    let mut figures: Vec<(f64, Estimate)> = cases
        .filter_map(|case| Some((case.primitives as f64, of(case)?)))
        .collect();
    figures.sort_by(|(a, _), (b, _)| a.total_cmp(b));
    figures
}

/// What was fitted to some figures against n.
pub(super) struct Growths {
    /// `a + b g(n)`.
    pub(super) fits: [(&'static str, Option<Fit>); 3],
    pub(super) power: Option<Power>,
    /// The last figure over the first, and how many times as many primitives that was.
    pub(super) whole: Option<[f64; 2]>,
}

impl Growths {
    pub(super) fn of(figures: &[(f64, Estimate)]) -> Growths {
        let (ns, ys): (Vec<f64>, Vec<f64>) = figures.iter().map(|(n, y)| (*n, y.median)).unzip();
        let whole = match (figures.first(), figures.last()) {
            (Some((n0, y0)), Some((n1, y1))) if n1 > n0 => Some([y1.median / y0.median, n1 / n0]),
            _ => None,
        };
        Growths {
            fits: [
                ("log n", fit(&ns, &ys, Growth::Log)),
                ("√n", fit(&ns, &ys, Growth::Root)),
                ("n", fit(&ns, &ys, Growth::Linear)),
            ],
            power: power(&ns, &ys),
            whole,
        }
    }

    /// The growth that explains most.
    pub(super) fn best(&self) -> Option<&'static str> {
        let of_all = self
            .fits
            .iter()
            .filter_map(|(name, fit)| Some((*name, fit.as_ref()?.r_squared)));
        of_all
            .max_by(|(_, a), (_, b)| a.total_cmp(b))
            .map(|(name, _)| name)
    }
}
