//! What sorted samples tell: the median, quantiles, how sure the median is, what lies far out.

use crate::generate::Random;

/// From one number to another, both included.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Interval {
    /// The lower end.
    pub low: f64,
    /// The upper end, at least `low`.
    pub high: f64,
}

/// The middle of the samples, or the mean of the two in the middle. `None` where there are none, or one is not finite.
pub fn median(samples: &[f64]) -> Option<f64> {
    quantile(samples, 0.5)
}

/// The number below which the share `p` of the samples lies, `p` in 0..=1: between sorted samples, the straight line
/// from one to the next, the first at 0 and the last at 1 (Hyndman and Fan 1996, "Sample Quantiles in Statistical
/// Packages", definition 7).
///
/// `None` where there are no samples, one is not finite, or `p` lies outside.
pub fn quantile(samples: &[f64], p: f64) -> Option<f64> {
    of_sorted(&sorted(samples)?, p)
}

/// The seed of every bootstrap: the same samples give the same interval.
const SEED: u64 = 1993;

/// Where the median of the whole population is to be expected, 19 times out of 20: of `resamples` sets as large as
/// `samples`, drawn from them with replacement, the range of the medians without the outer 2.5 % at either end (Efron
/// and Tibshirani 1993, "An Introduction to the Bootstrap", the percentile interval).
///
/// A thousand resamples make it steady to about its second digit. `None` where there are no samples or no resamples,
/// or a sample is not finite.
pub fn bootstrap_median(samples: &[f64], resamples: usize) -> Option<Interval> {
    // Drawing from the sorted ones, so that the order of the runs does not matter.
    let population = sorted(samples)?;
    let mut random = Random::new(SEED);
    let mut drawn = population.clone();
    let mut medians = Vec::new();
    for _ in 0..resamples {
        drawn
            .iter_mut()
            .for_each(|sample| *sample = any_of(&population, &mut random));
        drawn.sort_unstable_by(f64::total_cmp);
        medians.extend(of_sorted(&drawn, 0.5));
    }
    medians.sort_unstable_by(f64::total_cmp);
    Some(Interval {
        low: of_sorted(&medians, 0.025)?,
        high: of_sorted(&medians, 0.975)?,
    })
}

/// The positions of the samples that lie more than one and a half interquartile ranges below the first quartile or
/// above the third (Tukey 1977, "Exploratory Data Analysis": the inner fences), in their order. None where a sample is
/// not finite.
pub fn outliers(samples: &[f64]) -> Vec<usize> {
    let (Some(first), Some(third)) = (quantile(samples, 0.25), quantile(samples, 0.75)) else {
        return Vec::new();
    };
    let reach = 1.5 * (third - first);
    let inside = first - reach..=third + reach;
    let positions = samples.iter().enumerate();
    positions
        .filter(|(_, sample)| !inside.contains(sample))
        .map(|(position, _)| position)
        .collect()
}

/// The samples in rising order, if they are all finite.
fn sorted(samples: &[f64]) -> Option<Vec<f64>> {
    let mut sorted = samples.to_vec();
    sorted.sort_unstable_by(f64::total_cmp);
    sorted.iter().all(|x| x.is_finite()).then_some(sorted)
}

/// [`quantile`] of what is sorted already.
fn of_sorted(sorted: &[f64], p: f64) -> Option<f64> {
    if !(0.0..=1.0).contains(&p) {
        return None;
    }
    let last = sorted.len().checked_sub(1)?;
    let place = p * last as f64;
    let below = place as usize;
    let (low, high) = (*sorted.get(below)?, *sorted.get((below + 1).min(last))?);
    Some(low + (high - low) * (place - below as f64))
}

/// One of `population`, each as likely; zero of none.
fn any_of(population: &[f64], random: &mut Random) -> f64 {
    let position = (u128::from(random.next_u64()) * population.len() as u128) >> 64;
    population
        .get(position as usize)
        .copied()
        .unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_median_is_the_middle_or_the_mean_of_both_middles() {
        assert_eq!(median(&[3.0, 1.0, 2.0]), Some(2.0));
        assert_eq!(median(&[4.0, 1.0, 3.0, 2.0]), Some(2.5));
        assert_eq!(median(&[7.0]), Some(7.0));
    }

    #[test]
    fn quantiles_are_those_worked_by_hand() {
        // Places 0.75, 1.5 and 2.25 of 0..=3.
        let samples = [20.0, 15.0, 50.0, 35.0];
        assert_eq!(quantile(&samples, 0.25), Some(18.75));
        assert_eq!(quantile(&samples, 0.5), Some(27.5));
        assert_eq!(quantile(&samples, 0.75), Some(38.75));
        assert_eq!(quantile(&samples, 0.0), Some(15.0));
        assert_eq!(quantile(&samples, 1.0), Some(50.0));
    }

    #[test]
    fn no_samples_and_no_numbers_have_no_answer() {
        for samples in [&[][..], &[1.0, f64::NAN], &[1.0, f64::INFINITY]] {
            assert_eq!(median(samples), None);
            assert_eq!(bootstrap_median(samples, 100), None);
            assert!(outliers(samples).is_empty());
        }
        for p in [-0.1, 1.1, f64::NAN] {
            assert_eq!(quantile(&[1.0, 2.0], p), None);
        }
        assert_eq!(bootstrap_median(&[1.0], 0), None);
    }

    #[test]
    fn the_interval_of_a_constant_is_that_constant() {
        let interval = bootstrap_median(&[0.1; 7], 500);
        let (low, high) = (0.1, 0.1);
        assert_eq!(interval, Some(Interval { low, high }));
    }

    #[test]
    fn the_interval_lies_where_the_binomial_distribution_says() {
        // The median of a resample of 1..=101 is at most k where 51 or more of 101 draws are: by the binomial
        // distribution, with a probability that passes 2.5 % at k = 41 and 97.5 % at 61.
        let samples: Vec<f64> = (1..=101).map(f64::from).collect();
        let interval = bootstrap_median(&samples, 4000);
        assert!(
            interval.is_some_and(|i| (i.low - 41.0).abs() <= 1.0 && (i.high - 61.0).abs() <= 1.0)
        );
    }

    #[test]
    fn the_interval_does_not_depend_on_the_order_of_the_runs() {
        let forth = bootstrap_median(&[3.0, 1.0, 4.0, 1.5, 9.0], 200);
        let back = bootstrap_median(&[9.0, 1.5, 4.0, 1.0, 3.0], 200);
        assert_eq!(forth, back);
    }

    #[test]
    fn what_lies_past_the_fences_is_an_outlier() {
        // Quartiles 2 and 4 of 1..=5: the fences stand at -1 and 7.
        assert!(outliers(&[1.0, 2.0, 3.0, 4.0, 5.0]).is_empty());
        // Quartiles 2.25 and 4.75 of 1..=5 and 100, the fences at -1.5 and 8.5.
        assert_eq!(outliers(&[1.0, 100.0, 2.0, 3.0, 4.0, 5.0]), [1]);
        assert!(outliers(&[5.0; 4]).is_empty());
        assert_eq!(outliers(&[5.0, 5.0, 4.9, 5.0, 5.0]), [2]);
    }
}
