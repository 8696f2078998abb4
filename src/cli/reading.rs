//! What every command can be told of how a model is read.

use super::values;
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

    /// Let a model name files outside its own folder
    #[arg(long)]
    allow_external: bool,

    /// The most memory that the file and its picture may take, as in 4G or 500M [default: three quarters of the least of
    /// the machine's and the limits of the process and its control group]
    #[arg(long, value_name = "BYTES", value_parser = values::bytes)]
    max_memory: Option<u64>,
}

impl Reading {
    /// The same to the library.
    pub(super) fn options(&self) -> Options {
        Options {
            scene: self.scene.clone(),
            variant: self.variant.clone(),
            allow: self.allow.clone(),
            allow_external: self.allow_external,
            max_memory: self.max_memory,
            ..Options::default()
        }
    }
}
