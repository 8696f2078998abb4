//! `luch merge`: the tiles of a picture become the picture.

use super::arguments::MergeArguments;
use super::interrupt::Interrupt;
use super::outputs::place;
use super::{Failure, command_line, print};
use luch::output::{self, Format};

/// Merges what the arguments name.
pub(super) fn run(arguments: &MergeArguments) -> Result<(), Failure> {
    // Rayon reads none as all cores.
    let threads = arguments.threads.unwrap_or(0) as usize;
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(Failure::usage_or_scene)?;
    pool.install(|| merge(arguments))
}

fn merge(arguments: &MergeArguments) -> Result<(), Failure> {
    let path = &arguments.output;
    let destination = Interrupt::watch().claim(path).map_err(Failure::output)?;
    let shown = print::path(path);
    if destination.format() != Format::Exr {
        return Err(Failure::usage_or_scene(format!(
            "{shown}: its name does not end in .exr; tiles are merged to an EXR"
        )));
    }
    if arguments
        .tiles
        .iter()
        .any(|tile| place(tile) == place(path))
    {
        return Err(Failure::usage_or_scene(format!(
            "{shown}: is one of the tiles; choose another output"
        )));
    }
    let merged = output::merge(&arguments.tiles, Some(&command_line()));
    let merged = merged.map_err(Failure::usage_or_scene)?;
    destination.write_bytes(&merged).map_err(Failure::output)?;
    if arguments.quiet {
        return Ok(());
    }
    print::to_stdout(format!("wrote {shown}\n").as_bytes())
}
