//! What a study is going to measure, and for how long.

use super::case::{Case, Measure, Threads, What};
use crate::render::{Settings, SettingsError};
use crate::shade::Shading;
use crate::texture::TextureFilter;
use std::time::Duration;

/// The share of the budget that a build on one thread may take to be timed.
const MOST_FOR_ONE_THREAD: f64 = 0.01;

/// What a study is going to measure.
#[derive(Clone)]
pub struct Plan {
    /// Which study: `bvh`, `scaling`, `samples` or `rays`.
    pub study: &'static str,
    /// The most important first: those that time does not suffice for are left out from the end.
    pub cases: Vec<Case>,
    /// What is timed of every case, in each round.
    pub measures: Vec<Measure>,
    /// How long, and how large.
    pub effort: Effort,
    /// The most mirror bounces.
    pub max_depth: u32,
    /// How surfaces answer light.
    pub shading: Shading,
    /// Which part of a texture a ray shows.
    pub texture_filter: TextureFilter,
    /// Threads where all are asked for.
    pub threads: usize,
    /// Samples a pixel of the picture that errors are reckoned against, if they are.
    pub error_against: Option<u32>,
    /// The cases whose heat maps the report shows beside each other.
    pub heat_maps: Vec<String>,
}

/// How long a study may take, and how large its pictures are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Effort {
    /// From the start of the program to the report.
    pub budget: Duration,
    /// Rounds after which medians hardly move any more.
    pub most_rounds: u32,
    /// The size of the pictures, and of the sets of rays.
    pub size: [u32; 2],
}

/// Why there can be no such plan.
#[derive(Clone, Debug, PartialEq, thiserror::Error)]
pub enum PlanError {
    /// No time for a single round.
    #[error(
        "a budget of {minutes} minutes is too small for a study; give it at least {LEAST_MINUTES}"
    )]
    BudgetTooSmall {
        /// As asked.
        minutes: f64,
    },
    /// More than a day.
    #[error("a budget of {minutes} minutes is no number of minutes up to {MOST_MINUTES}")]
    NoBudget {
        /// As asked.
        minutes: f64,
    },
    /// The picture cannot be.
    #[error(transparent)]
    Picture(#[from] SettingsError),
    /// Nothing to do.
    #[error("the plan has nothing to measure; ask for less to be left out")]
    Empty,
}

/// The least budget.
pub const LEAST_MINUTES: f64 = 0.1;
/// The greatest budget, a week.
pub const MOST_MINUTES: f64 = 10_080.0;

impl Effort {
    /// Within a minute.
    pub const QUICK: Effort = Effort {
        budget: Duration::from_secs(48),
        most_rounds: 5,
        size: [320, 180],
    };
    /// Within ten minutes.
    pub const DEFAULT: Effort = Effort {
        budget: Duration::from_secs(540),
        most_rounds: 9,
        size: [640, 360],
    };

    /// Within so many minutes.
    ///
    /// # Errors
    ///
    /// Fewer than [`LEAST_MINUTES`], more than [`MOST_MINUTES`], or no number.
    pub fn within(minutes: f64) -> Result<Effort, PlanError> {
        if minutes < LEAST_MINUTES {
            return Err(PlanError::BudgetTooSmall { minutes });
        }
        if minutes > MOST_MINUTES || minutes.is_nan() {
            return Err(PlanError::NoBudget { minutes });
        }
        // Some of it for the report.
        let budget = Duration::from_secs_f64(minutes * 60.0 * 0.9 - 2.0);
        let few = budget < Effort::DEFAULT.budget / 4;
        Ok(Effort {
            budget,
            most_rounds: if few { Effort::QUICK.most_rounds } else { 25 },
            size: if few {
                Effort::QUICK.size
            } else {
                Effort::DEFAULT.size
            },
        })
    }
}

impl Plan {
    /// The plan, if its pictures can be and there is anything to measure.
    ///
    /// # Errors
    ///
    /// See [`PlanError`].
    pub fn checked(self) -> Result<Plan, PlanError> {
        for case in &self.cases {
            self.picture(case.samples)?;
        }
        if self.cases.is_empty() || self.measures.is_empty() {
            return Err(PlanError::Empty);
        }
        Ok(self)
    }

    /// What the builds of one case should take in a round where one on all threads, which there always is, takes `seconds`.
    pub(super) fn builds_expected(&self, seconds: f64) -> f64 {
        let alone = seconds * self.threads as f64;
        seconds
            + if self.times_one_thread(seconds) {
                alone
            } else {
                0.0
            }
    }

    /// Whether a build on one thread is timed where one on all takes `seconds`: it must not take too much of the budget.
    pub(super) fn times_one_thread(&self, seconds: f64) -> bool {
        let build = Measure {
            what: What::Build,
            threads: Threads::One,
        };
        let most = self.effort.budget.as_secs_f64() * MOST_FOR_ONE_THREAD;
        self.measures.contains(&build) && seconds * self.threads as f64 <= most
    }

    /// How its pictures of so many samples a pixel should be.
    ///
    /// # Errors
    ///
    /// See [`Settings::new`].
    pub fn picture(&self, samples: u32) -> Result<Settings, SettingsError> {
        let [width, height] = self.effort.size;
        Settings::new(width, height, samples, self.max_depth, self.shading)
            .map(|settings| settings.with_texture_filter(self.texture_filter))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_budget_of_a_second_is_refused_with_the_least_there_is() {
        let error = Effort::within(1.0 / 60.0)
            .expect_err("nonsense")
            .to_string();
        assert!(error.contains("too small") && error.ends_with("at least 0.1"));
    }

    #[test]
    fn a_budget_of_no_number_or_of_a_month_is_refused() {
        for minutes in [f64::NAN, f64::INFINITY, 43_200.0] {
            assert!(matches!(
                Effort::within(minutes),
                Err(PlanError::NoBudget { .. })
            ));
        }
    }

    #[test]
    fn what_is_within_a_budget_is_less_than_it() {
        for minutes in [0.1, 1.0, 10.0, 600.0] {
            let effort = Effort::within(minutes).expect("a budget");
            assert!(effort.budget.as_secs_f64() < minutes * 60.0);
        }
    }

    #[test]
    fn an_empty_plan_is_refused() {
        let plan = Plan {
            study: "bvh",
            cases: Vec::new(),
            measures: Vec::new(),
            effort: Effort::QUICK,
            max_depth: 5,
            shading: Shading::BlinnPhong,
            texture_filter: TextureFilter::Footprint,
            threads: 1,
            error_against: None,
            heat_maps: Vec::new(),
        };
        assert_eq!(plan.checked().err(), Some(PlanError::Empty));
    }
}
