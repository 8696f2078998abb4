//! What can be said of time.

use super::values::seconds;
use clap::Args;
use clap::builder::NonEmptyStringValueParser;
use luch::load::AnimationChoice;

/// Which animation moves a model, and to which moment.
#[derive(Args, Debug)]
pub(super) struct AnimationArguments {
    /// An animation of the model, by name or by index from 0, or all of them [default: none; the first with --time]
    #[arg(long, value_name = "NAME|INDEX|all", value_parser = NonEmptyStringValueParser::new())]
    animation: Option<String>,

    /// The moment of the animation that is shown, in seconds [default: 0]
    #[arg(long, value_name = "SECONDS", allow_hyphen_values = true, value_parser = seconds)]
    time: Option<f64>,
}

impl AnimationArguments {
    /// Which animations move the model.
    pub(super) fn choice(&self) -> AnimationChoice {
        match (self.animation.as_deref(), self.time) {
            (Some("all"), _) => AnimationChoice::All,
            (Some(name), _) => AnimationChoice::Named(name.to_owned()),
            (None, Some(_)) => AnimationChoice::First,
            (None, None) => AnimationChoice::None,
        }
    }

    /// Whether a moment is asked for.
    pub(super) fn has_time(&self) -> bool {
        self.time.is_some()
    }

    /// The moment that is shown, in seconds.
    pub(super) fn time(&self) -> f64 {
        self.time.unwrap_or(0.0)
    }
}
