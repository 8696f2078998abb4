//! The command line: one file a command, and the only place that prints.
#![expect(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "printing is what this module is for"
)]

mod arguments;
mod info;
mod interrupt;
mod progress;
mod render;
mod summary;
mod values;

use arguments::{Arguments, Command};
use clap::{CommandFactory, Parser};
use std::error::Error;
use std::io::{self, Write};
use std::process::ExitCode;

/// Why a command ended without doing its work.
struct Failure {
    error: Box<dyn Error + Send + Sync>,
    /// The process's exit code.
    code: u8,
}

/// The exit code of wrong usage, and of a scene that cannot be rendered.
const USAGE_OR_SCENE: u8 = 1;
/// The exit code of a picture that cannot be written.
const OUTPUT: u8 = 2;

impl Failure {
    fn usage_or_scene(error: impl Into<Box<dyn Error + Send + Sync>>) -> Failure {
        Failure {
            error: error.into(),
            code: USAGE_OR_SCENE,
        }
    }

    fn output(error: impl Into<Box<dyn Error + Send + Sync>>) -> Failure {
        Failure {
            error: error.into(),
            code: OUTPUT,
        }
    }
}

/// Does what the command line asks.
pub(crate) fn run() -> ExitCode {
    let arguments = match Arguments::try_parse() {
        Ok(arguments) => arguments,
        Err(error) => return explain(&error),
    };
    let (result, verbose) = match &arguments.command {
        Command::Render(arguments) => (render::run(arguments), arguments.verbose),
        Command::Info(arguments) => (info::run(arguments), arguments.verbose),
        Command::Completions { shell } => {
            let mut out = Vec::new();
            clap_complete::generate(*shell, &mut Arguments::command(), "luch", &mut out);
            (print_bytes(&out), false)
        }
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(Failure { error, code }) => {
            complain(error.as_ref(), verbose);
            ExitCode::from(code)
        }
    }
}

/// Writes to standard output, which may be a pipe that somebody closed.
fn print_bytes(bytes: &[u8]) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    match out.write_all(bytes).and_then(|()| out.flush()) {
        // Whoever reads has read enough.
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(Failure::output(format!(
            "standard output: cannot write: {error}"
        ))),
        _ => Ok(()),
    }
}

/// An error's one line, and with `verbose` its causes.
fn complain(error: &dyn Error, verbose: bool) {
    eprintln!("error: {error}");
    let mut cause = error.source().filter(|_| verbose);
    while let Some(error) = cause {
        eprintln!("  because: {error}");
        cause = error.source();
    }
}

/// Help and version where they were asked for, else the one line that says what is wrong with the arguments.
fn explain(error: &clap::Error) -> ExitCode {
    if !error.use_stderr() {
        let said = error.print();
        return if said.is_ok() {
            ExitCode::SUCCESS
        } else {
            ExitCode::from(OUTPUT)
        };
    }
    // What follows the first empty line are tips and usage; a list of what is missing belongs to the sentence.
    let text = error.to_string();
    let mut paragraphs = text
        .split("\n\n")
        .map(|p| p.split_whitespace().collect::<Vec<_>>().join(" "));
    let sentence = paragraphs.next().unwrap_or_default();
    let tip = paragraphs
        .find(|p| p.starts_with("tip: "))
        .map_or(String::new(), |tip| format!("; {tip}"));
    let sentence =
        if error.kind() == clap::error::ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand {
            "error: no command given".to_owned()
        } else {
            sentence
        };
    eprintln!("{sentence}{tip} (see luch --help)");
    ExitCode::from(USAGE_OR_SCENE)
}
