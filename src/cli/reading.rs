//! What can be said of reading a file, the same for each command that reads one.

use super::values;
use clap::Args;
use luch::load::Options;

#[derive(Args, Clone, Debug)]
pub(super) struct Reading {
    /// Let a model name files outside its own folder
    #[arg(long)]
    pub(super) allow_external: bool,

    /// The most memory that the file and its picture may take, as in 4G or 500M [default: three quarters of the least of
    /// the machine's and the limits of the process and its control group]
    #[arg(long, value_name = "BYTES", value_parser = values::bytes)]
    pub(super) max_memory: Option<u64>,
}

impl Reading {
    /// The same to the library.
    pub(super) fn options(&self) -> Options {
        Options {
            allow_external: self.allow_external,
            max_memory: self.max_memory,
            ..Options::default()
        }
    }
}
