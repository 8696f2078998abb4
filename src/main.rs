//! The program: everything it does is in the library `luch`, everything it says is in [`cli`].

mod cli;

use std::process::ExitCode;

fn main() -> ExitCode {
    cli::run()
}
