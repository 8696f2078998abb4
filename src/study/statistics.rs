//! Statistics of few, skewed samples, as running times are: what is typical, how sure that is, what goes with what.
//!
//! Every function takes any numbers: where an answer needs samples that are not there, or one of them is not finite,
//! the answer is `None` or an empty list.

mod choice;
mod growth;
mod order;
mod relation;

pub use choice::{break_even, front};
pub use growth::{Fit, Growth, Power, fit, power};
pub use order::{Interval, bootstrap_median, median, outliers, quantile};
pub use relation::{correlation, rank_correlation};
