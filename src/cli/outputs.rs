//! Where the picture goes: claimed before it is made, and never a file that was read.

use super::arguments::{RenderArguments, is_stdout};
use super::interrupt::Interrupt;
use super::{Failure, layers, print};
use luch::Error;
use luch::film::Film;
use luch::output::{self, Destination, Format, Options};
use luch::study::heat_maps::Mapped;
use std::fs;
use std::path::{Path, PathBuf};

/// Every place that the picture goes to.
pub(super) struct Outputs {
    files: Vec<Destination>,
    /// Beside each PNG a heat map of each layer that is no picture, where such are asked for.
    heat_maps: Vec<(Mapped, Destination)>,
    /// What goes to standard output, if anything does.
    to_stdout: Option<Format>,
}

/// Where the arguments say that pictures go, or the current folder under the name of `input`: for a sequence with a place
/// for the frame's number.
pub(super) fn paths(arguments: &RenderArguments, input: &Path, is_sequence: bool) -> Vec<PathBuf> {
    if !arguments.outputs.is_empty() {
        return arguments.outputs.clone();
    }
    let mut name = input.file_stem().unwrap_or(input.as_os_str()).to_owned();
    name.push(if is_sequence { ".####.png" } else { ".png" });
    vec![PathBuf::from(name)]
}

/// Whether every file that a picture becomes is there and whole.
pub(super) fn are_whole(paths: &[PathBuf], arguments: &RenderArguments) -> bool {
    let maps = Mapped::of(&layers::asked(arguments));
    let is_whole = |path: &PathBuf| {
        let is_png = matches!(Format::of(path), Ok(Format::Png));
        let mut beside = maps.iter().filter(|_| is_png);
        output::is_whole(path) && beside.all(|map| output::is_whole(&heat_map(path, map)))
    };
    paths.iter().all(is_whole)
}

/// The heat map beside a PNG.
fn heat_map(path: &Path, map: &Mapped) -> PathBuf {
    path.with_extension(format!("{}.png", map.name()))
}

impl Outputs {
    /// Makes sure that the picture can be written to all of `paths`.
    pub(super) fn claim(
        paths: &[PathBuf],
        arguments: &RenderArguments,
        interrupt: &Interrupt,
    ) -> Result<Outputs, Failure> {
        let to_stdout = arguments
            .picture_to_stdout()
            .then(|| arguments.format.into());
        if to_stdout.is_some() && arguments.json {
            return Err(Failure::usage_or_scene(
                "-o - and --json both want standard output; give the picture a name",
            ));
        }
        let mut files = Vec::new();
        let mut heat_maps = Vec::new();
        let maps = Mapped::of(&layers::asked(arguments));
        for path in paths.iter().filter(|path| !is_stdout(path)) {
            let file = interrupt.claim(path).map_err(Failure::output)?;
            if file.format() == Format::Png {
                for map in &maps {
                    let beside = interrupt
                        .claim(&heat_map(path, map))
                        .map_err(Failure::output)?;
                    heat_maps.push((*map, beside));
                }
            }
            files.push(file);
        }
        let places: Vec<PathBuf> = paths.iter().map(|path| place(path)).collect();
        match (1..paths.len()).find(|&i| places[..i].contains(&places[i])) {
            Some(twice) => Err(Failure::usage_or_scene(format!(
                "{}: is given twice as an output",
                print::path(&paths[twice])
            ))),
            None => Ok(Outputs {
                files,
                heat_maps,
                to_stdout,
            }),
        }
    }

    /// Whether one of them says where a picture comes from.
    pub(super) fn tell_of_inputs(&self) -> bool {
        let mut files = self.files.iter().map(Destination::format);
        self.to_stdout == Some(Format::Exr) || files.any(|format| format == Format::Exr)
    }

    /// Refuses to overwrite what was read.
    pub(super) fn spare(&self, read: &[PathBuf]) -> Result<(), Failure> {
        let read: Vec<PathBuf> = read.iter().map(|file| place(file)).collect();
        let mut outputs = self.files.iter().map(Destination::path);
        match outputs.find(|output| read.contains(&place(output))) {
            Some(output) => Err(Failure::usage_or_scene(format!(
                "{}: was read for this picture; choose another output",
                print::path(output)
            ))),
            None => Ok(()),
        }
    }

    /// Writes every output; the paths of the files.
    pub(super) fn write(self, film: &Film, options: &Options) -> Result<Vec<PathBuf>, Failure> {
        let mut written = Vec::new();
        for destination in self.files {
            let path = destination.path().to_owned();
            destination.write(film, options).map_err(Failure::output)?;
            written.push(path);
        }
        for (map, destination) in self.heat_maps {
            let path = destination.path().to_owned();
            let Some(png) = map.png(film) else {
                continue;
            };
            let png = png.map_err(Error::io(&path, "draw"));
            let put = png.and_then(|png| destination.write_bytes(&png));
            put.map_err(Failure::output)?;
            written.push(path);
        }
        if let Some(format) = self.to_stdout {
            let mut bytes = Vec::new();
            let name = Path::new("standard output");
            output::encode(film, format, options, name, &mut bytes).map_err(Failure::output)?;
            print::to_stdout(&bytes)?;
        }
        Ok(written)
    }
}

/// The one spelling of a path, links followed; of a file that is still to come, its folder's and its name.
pub(super) fn place(path: &Path) -> PathBuf {
    fs::canonicalize(path).unwrap_or_else(|_| {
        let folder = match path.parent() {
            Some(folder) if folder != "" => folder,
            _ => Path::new("."),
        };
        let folder = fs::canonicalize(folder).unwrap_or_else(|_| folder.to_owned());
        folder.join(path.file_name().unwrap_or_default())
    })
}
