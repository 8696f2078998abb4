//! What every command can be told of how a model is read.

use clap::Args;
use clap::builder::NonEmptyStringValueParser;
use luch::load::Options;

/// How a model is read.
#[derive(Args, Clone, Debug)]
#[command(next_help_heading = "How the model is read")]
pub(super) struct Reading {
    /// Another scene of the file than its own, by name or by index from 0
    #[arg(long, value_name = "NAME|INDEX", value_parser = NonEmptyStringValueParser::new())]
    scene: Option<String>,

    /// A variant of the model's materials, by name or by index from 0
    #[arg(long, value_name = "NAME|INDEX", value_parser = NonEmptyStringValueParser::new())]
    variant: Option<String>,

    /// Go on without an extension that the file requires and luch lacks; may be repeated
    #[arg(long, value_name = "EXTENSION")]
    allow: Vec<String>,
}

impl Reading {
    pub(super) fn options(&self) -> Options {
        Options {
            scene: self.scene.clone(),
            variant: self.variant.clone(),
            allow: self.allow.clone(),
            ..Options::default()
        }
    }
}
