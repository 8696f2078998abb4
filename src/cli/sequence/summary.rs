//! What a sequence says of itself.

use super::super::arguments::RenderArguments;
use super::super::print::{self, counted};
use super::super::summary::{lost_in_layers, say, warn};
use super::super::{Failure, render};
use super::world::World;
use luch::film::Film;
use serde::Serialize;
use std::io::{IsTerminal, stderr};
use std::path::PathBuf;

/// What came of the frames: the fields of `--json`. It does not grow with their number.
#[derive(Serialize)]
pub(super) struct Summary {
    input: String,
    rendered: u64,
    /// Whole files were there.
    skipped: u64,
    trees: Trees,
    /// Rays that stopped before they had passed every transparent layer.
    lost_in_layers: u64,
    seconds: Seconds,
}

/// For how many frames the search tree was built, and for how many it was still that of the frame before.
#[derive(Serialize)]
struct Trees {
    built: u64,
    kept: u64,
}

/// In all; writing goes on beside rendering.
#[derive(Serialize)]
struct Seconds {
    load: f64,
    build: f64,
    render: f64,
    write: f64,
}

impl Summary {
    pub(super) fn new(arguments: &RenderArguments) -> Summary {
        Summary {
            input: print::path(render::name(arguments)),
            rendered: 0,
            skipped: 0,
            trees: Trees { built: 0, kept: 0 },
            lost_in_layers: 0,
            seconds: Seconds {
                load: 0.0,
                build: 0.0,
                render: 0.0,
                write: 0.0,
            },
        }
    }

    pub(super) fn opened(&mut self, world: &World) {
        self.seconds.load = world.load.as_secs_f64();
    }

    pub(super) fn rendered(&mut self, film: &Film, world: &World, is_tree_kept: bool) {
        self.rendered += 1;
        self.seconds.render += film.statistics.time.as_secs_f64();
        self.lost_in_layers += film.statistics.lost_in_layers;
        if is_tree_kept {
            self.trees.kept += 1;
        } else {
            self.trees.built += 1;
            self.seconds.build += world.build_seconds();
        }
    }

    pub(super) fn skipped(
        &mut self,
        frame: u32,
        paths: &[PathBuf],
        arguments: &RenderArguments,
    ) -> Result<(), Failure> {
        self.skipped += 1;
        let names = names(paths);
        say_of_frame(
            arguments,
            &format!("frame {frame}: {names} there and whole"),
        )
    }

    pub(super) fn wrote(&mut self, seconds: f64) {
        self.seconds.write = seconds;
    }

    /// Prints it as the arguments ask.
    pub(super) fn print(&self, arguments: &RenderArguments) -> Result<(), Failure> {
        if arguments.quiet && !arguments.json {
            return Ok(());
        }
        if let Some(warning) = lost_in_layers(self.lost_in_layers).filter(|_| !arguments.quiet) {
            warn(&warning);
        }
        if arguments.json {
            return print::json(self);
        }
        let Seconds {
            load,
            build,
            render,
            write,
        } = self.seconds;
        let frames = counted(self.rendered, "frame", "frames");
        let (skipped, Trees { built, kept }) = (self.skipped, &self.trees);
        let lines = [
            format!(
                "{frames} rendered, {skipped} there and whole; search tree built {built} times, kept {kept} times"
            ),
            format!(
                "load {load:.2} s, build {build:.2} s, render {render:.2} s, write {write:.2} s beside it"
            ),
        ];
        say(&lines, arguments)
    }
}

/// Says that a frame is there.
pub(super) fn say_written(
    frame: u32,
    files: &[PathBuf],
    is_tree_kept: bool,
    arguments: &RenderArguments,
) -> Result<(), Failure> {
    let tree = if is_tree_kept { "kept" } else { "built" };
    let names: Vec<String> = files.iter().map(|file| print::path(file)).collect();
    let names = names.join(", ");
    say_of_frame(
        arguments,
        &format!("frame {frame}: wrote {names} (search tree {tree})"),
    )
}

fn names(paths: &[PathBuf]) -> String {
    let names: Vec<String> = paths.iter().map(|path| print::path(path)).collect();
    let verb = if paths.len() == 1 { "is" } else { "are" };
    format!("{} {verb}", names.join(", "))
}

/// A line of each frame is for logs: on a terminal there is the bar.
fn say_of_frame(arguments: &RenderArguments, line: &str) -> Result<(), Failure> {
    if arguments.quiet || arguments.json || stderr().is_terminal() {
        return Ok(());
    }
    say(&[line.to_owned()], arguments)
}
