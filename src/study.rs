//! Studies: how the choices of search affect time, measured on any model.
//!
//! A [`Plan`] has cases; [`run`] measures them in rounds, so that a slow minute of the machine hits all alike, and keeps
//! every raw sample in [`Results`]; [`report`] says what they mean. Nothing is timed together: not the build with the
//! frame, not loading, writing or counting with either. Every picture is held against the reference's, bit for bit.

pub mod bvh;
pub mod case;
pub mod csv;
pub mod estimate;
mod forecast;
pub mod hash;
pub mod heat;
pub mod heat_maps;
pub mod machine;
pub mod opening;
pub mod plan;
pub mod plot;
pub mod rays;
pub mod report;
pub mod resize;
pub mod results;
mod round;
mod run;
pub mod samples;
pub mod scaling;
pub mod scenes;
pub mod sets;
pub mod setting;
mod show;
mod stage;
pub mod statistics;
pub mod watch;

pub use case::{Case, Source};
pub use plan::{Plan, PlanError};
pub use results::Results;
pub use run::run;
pub use watch::Watch;
