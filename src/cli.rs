//! The command line: one file a command, and the only place that prints.

mod animation;
mod arguments;
mod asks;
mod cameras;
mod environment;
mod frames;
mod info;
mod interrupt;
mod layers;
mod outputs;
mod print;
mod progress;
mod provenance;
mod reading;
mod render;
mod sampling;
mod sequence;
mod study;
mod summary;
mod values;
mod windows;

use arguments::{Arguments, Command};
use clap::error::ErrorKind;
use clap::{CommandFactory, Parser};
use std::error::Error;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::process::ExitCode;

/// Why a command ended without doing its work.
struct Failure {
    error: Box<dyn Error + Send + Sync>,
    /// The process's exit code.
    code: u8,
}

/// The exit code of wrong usage, and of a scene that cannot be rendered.
const USAGE_OR_SCENE: u8 = 1;
/// The exit code of a picture or a text that cannot be written.
const OUTPUT: u8 = 2;
/// The exit code of a render that did not come to its end.
const RENDER: u8 = 3;

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

    fn render(error: impl Into<Box<dyn Error + Send + Sync>>) -> Failure {
        Failure {
            error: error.into(),
            code: RENDER,
        }
    }
}

/// Does what the command line asks.
pub(crate) fn run() -> ExitCode {
    let (result, verbose, is_for_openjd) = match Arguments::try_parse() {
        Ok(Arguments { command }) => (
            caught(|| obey(&command)),
            command.is_verbose(),
            command.is_for_openjd(),
        ),
        Err(error) => (explain(&error), false, false),
    };
    match result {
        Ok(()) => ExitCode::SUCCESS,
        Err(Failure { error, code }) => {
            if is_for_openjd {
                progress::to_openjd("fail", &error.to_string());
            }
            complain(error.as_ref(), verbose);
            ExitCode::from(code)
        }
    }
}

/// Does `work`; a panic, of which the standard library has said where it was, is a failed render.
fn caught(work: impl FnOnce() -> Result<(), Failure>) -> Result<(), Failure> {
    // Nothing that the work changes is looked at again.
    catch_unwind(AssertUnwindSafe(work)).unwrap_or_else(|_| {
        Err(Failure::render(
            "the program broke off, which is a fault of its own; please report it",
        ))
    })
}

fn obey(command: &Command) -> Result<(), Failure> {
    match command {
        Command::Render(arguments) => render::run(arguments),
        Command::Info(arguments) => info::run(arguments),
        Command::Study(arguments) => study::run(arguments),
        Command::Completions { shell } => {
            let mut script = Vec::new();
            clap_complete::generate(*shell, &mut Arguments::command(), "luch", &mut script);
            print::to_stdout(&script)
        }
    }
}

/// The command as it was given, for what is written.
fn command_line() -> String {
    let words = std::env::args_os()
        .skip(1)
        .map(|word| word.to_string_lossy().into_owned());
    let command: Vec<String> = std::iter::once("luch".to_owned()).chain(words).collect();
    command.join(" ")
}

/// An error's one line, and with `verbose` its causes, of as many lines as they like.
fn complain(error: &dyn Error, verbose: bool) {
    print::to_stderr(&format!("error: {error}"));
    let mut cause = error.source().filter(|_| verbose);
    while let Some(error) = cause {
        let text = error.to_string();
        let mut lines = text.trim_end().lines();
        print::to_stderr(&format!("  because: {}", lines.next().unwrap_or_default()));
        lines.for_each(|line| print::to_stderr(&format!("  {line}")));
        cause = error.source();
    }
}

/// Prints help and version where they were asked for; else says in one line what is wrong with the arguments.
fn explain(error: &clap::Error) -> Result<(), Failure> {
    if !error.use_stderr() {
        return print::written(error.print());
    }
    let command = std::env::args_os().nth(1).unwrap_or_default();
    let help = Arguments::command()
        .get_subcommands()
        .find(|known| command == known.get_name())
        .map_or("luch --help".into(), |known| {
            format!("luch {} --help", known.get_name())
        });
    let problem = match error.kind() {
        ErrorKind::DisplayHelpOnMissingArgumentOrSubcommand => "no command given".into(),
        _ => problem(&error.to_string()),
    };
    Err(Failure::usage_or_scene(format!("{problem} (see {help})")))
}

/// The problem and the tip in clap's text, on one line.
fn problem(text: &str) -> String {
    let without_usage = ["\n\nUsage:", "\n\nFor more information"]
        .into_iter()
        .fold(text, |text, end| {
            text.rsplit_once(end).map_or(text, |(start, _)| start)
        });
    let text = without_usage.replace("\n\n  tip:", "; tip:");
    // A list of what is missing has a line for each.
    let words: Vec<&str> = text.split_whitespace().collect();
    let sentence = words.join(" ");
    sentence
        .strip_prefix("error: ")
        .unwrap_or(&sentence)
        .to_owned()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_panic_is_a_failed_render() {
        let code = |result: Result<(), Failure>| result.err().map(|failure| failure.code);
        assert_eq!(code(caught(|| panic!("on purpose"))), Some(3));
        assert_eq!(code(caught(|| Ok(()))), None);
    }
}
