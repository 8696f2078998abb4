//! From raw samples to a figure with its uncertainty, and what is odd about them.

use super::case::Measure;
use super::results::{Measured, NO_TIME, Results, Run};
use super::statistics::{bootstrap_median, median, outliers};

/// Resamples of a bootstrap: its interval moves by less than the noise with more.
const RESAMPLES: usize = 2000;

/// So many of the cases that there was no time for are named.
const FEW_NAMES: usize = 6;

/// A median, and where it lies with a confidence of 95 %.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Estimate {
    /// Seconds.
    pub median: f64,
    /// Seconds.
    pub low: f64,
    /// Seconds.
    pub high: f64,
}

impl Estimate {
    /// Of samples; `None` of none. A single sample is its own interval.
    pub fn of(samples: &[f64]) -> Option<Estimate> {
        let median = median(samples)?;
        let interval = bootstrap_median(samples, RESAMPLES);
        Some(Estimate {
            median,
            low: interval.map_or(median, |interval| interval.low),
            high: interval.map_or(median, |interval| interval.high),
        })
    }
}

impl Estimate {
    /// So many times as much.
    pub fn times(self, factor: f64) -> Estimate {
        Estimate {
            median: self.median * factor,
            low: self.low * factor,
            high: self.high * factor,
        }
    }

    /// What is known without a doubt.
    pub fn exactly(value: f64) -> Estimate {
        Estimate {
            median: value,
            low: value,
            high: value,
        }
    }
}

impl Results {
    /// What a measure of a case comes to; `None` where it was not timed, or gave another picture.
    pub fn estimate(&self, case: &str, measure: Measure) -> Option<Estimate> {
        Estimate::of(&self.seconds(case, measure))
    }

    /// Millions of rays a second, the interval's ends in order; `None` as of [`Results::estimate`].
    pub fn mrays(&self, case: &str, measure: Measure) -> Option<Estimate> {
        let rays = self
            .runs
            .iter()
            .find(|run| run.case == case && run.measure == measure)?
            .rays as f64;
        let of_seconds = self.estimate(case, measure)?;
        let rate = |seconds: f64| rays / seconds.max(1e-9) / 1e6;
        Some(Estimate {
            median: rate(of_seconds.median),
            low: rate(of_seconds.high),
            high: rate(of_seconds.low),
        })
    }

    /// Warnings about the measuring: other pictures, cases left out, outliers, a busy machine.
    pub fn remarks(&self) -> Vec<String> {
        let mut remarks = Vec::new();
        let wrong: Vec<&str> = self
            .cases
            .iter()
            .filter(|case| !self.gave_the_same_picture(&case.name))
            .map(|case| case.name.as_str())
            .collect();
        if !wrong.is_empty() {
            remarks.push(format!(
                "FAILED: another picture than the reference's came from {}; their times are not shown",
                wrong.join(", ")
            ));
        }
        remarks.extend(self.left_out_in_words());
        remarks.extend(self.outliers_in_words());
        let busy = self
            .circumstances
            .others_share
            .filter(|share| *share > 0.05);
        if let Some(share) = busy {
            remarks.push(format!(
                "the machine was busy: other programs used {:.0} % of its processors meanwhile",
                100.0 * share
            ));
        }
        let cores = self.circumstances.logical_cores as f64;
        if let Some(load) = self
            .circumstances
            .load_before
            .filter(|load| *load > 0.25 * cores)
        {
            remarks.push(format!(
                "the machine was busy before the study began: its load was {load:.1} on {cores} cores"
            ));
        }
        let rounds = self.runs.iter().map(|run| run.round).max().unwrap_or(0);
        if (1..3).contains(&rounds) {
            remarks.push(format!(
                "there was time for {rounds} of 3 rounds: the intervals say little; a greater --budget has more"
            ));
        }
        remarks.extend(self.warnings.iter().cloned());
        remarks
    }

    /// Which cases were not measured: those without time in one line.
    fn left_out_in_words(&self) -> Vec<String> {
        let reason = |case: &Measured| case.left_out.clone();
        let (no_time, others): (Vec<&Measured>, Vec<&Measured>) = self
            .cases
            .iter()
            .filter(|case| case.left_out.is_some())
            .partition(|case| reason(case).is_some_and(|reason| reason == NO_TIME));
        let mut lines: Vec<String> = others
            .iter()
            .filter_map(|case| Some(format!("left out: {}: {}", case.name, reason(case)?)))
            .collect();
        if !no_time.is_empty() {
            let few = no_time.iter().take(FEW_NAMES);
            let mut names: Vec<String> = few.map(|case| case.name.clone()).collect();
            if no_time.len() > FEW_NAMES {
                names.push(format!("{} more", no_time.len() - FEW_NAMES));
            }
            lines.push(format!(
                "left out: there was {NO_TIME} for {}; a greater --budget has it",
                names.join("; ")
            ));
        }
        lines
    }

    /// How many runs lie far from the others of their case.
    fn outliers_in_words(&self) -> Option<String> {
        let mut seen: Vec<(&str, Measure)> = Vec::new();
        let mut count = 0;
        for Run { case, measure, .. } in &self.runs {
            if !seen.contains(&(case, *measure)) {
                seen.push((case, *measure));
                let samples = self.seconds(case, *measure);
                // Of four, none can be far from the others' middle half.
                count += if samples.len() < 5 {
                    0
                } else {
                    outliers(&samples).len()
                };
            }
        }
        let all = self.runs.len();
        (count > 0).then(|| {
            format!(
                "{count} of {all} runs are outliers (Tukey's fences); they are kept, since medians hardly feel them"
            )
        })
    }
}

#[cfg(test)]
mod tests {
    use super::super::case::{Threads, What};
    use super::super::results::Circumstances;
    use super::*;

    #[test]
    fn rates_have_the_interval_of_the_times_the_other_way_round() {
        let measure = Measure {
            what: What::Frame,
            threads: Threads::One,
        };
        let mut results = Results::new("rays", Circumstances::default());
        for (round, seconds) in (1..).zip([1.0, 2.0, 4.0]) {
            results.runs.push(Run {
                case: "default".into(),
                round,
                measure,
                seconds,
                rays: 8_000_000,
                same_picture: true,
            });
        }
        let rate = results.mrays("default", measure).expect("three runs");
        assert_eq!(rate.median, 4.0);
        assert!(rate.low >= 2.0 && rate.low <= 4.0 && rate.high >= 4.0 && rate.high <= 8.0);
    }

    #[test]
    fn no_samples_have_no_estimate_and_one_is_its_own_interval() {
        assert_eq!(Estimate::of(&[]), None);
        assert_eq!(Estimate::of(&[3.0]), Some(Estimate::exactly(3.0)));
    }

    #[test]
    fn a_busy_machine_is_said_in_words() {
        let mut results = Results::new("bvh", Circumstances::default());
        assert!(results.remarks().is_empty());
        results.circumstances.others_share = Some(0.5);
        let remarks = results.remarks();
        assert!(remarks[0].contains("other programs used 50 %"));
    }
}
