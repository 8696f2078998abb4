//! `luch render`: a file becomes a scene, a film, and files.

use super::arguments::{FormatValue, RenderArguments};
use super::interrupt::Interrupt;
use super::summary::{Seconds, Summary};
use super::values::{BackgroundValue, Size};
use super::{Failure, print_bytes, progress};
use glam::Vec3;
use luch::accel::{self, Accel};
use luch::camera::Camera;
use luch::film::Film;
use luch::load::{self, Asset, CameraChoice, Viewpoint};
use luch::output::{self, BitDepth, Destination, Display, Format};
use luch::render::{Progress, Settings, render};
use std::fs;
use std::path::{Path, PathBuf};
use std::time::Instant;

/// The paper's figure 4, for who gives no file.
const FIGURE_4: &str = include_str!("../../assets/scenes/figure-4.toml");
const FIGURE_4_NAME: &str = "figure-4.toml";

/// Renders what the arguments ask for.
pub(super) fn run(arguments: &RenderArguments) -> Result<(), Failure> {
    let threads = arguments.threads.map_or(0, usize::from);
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(Failure::usage_or_scene)?;
    pool.install(|| render_file(arguments))
}

fn render_file(arguments: &RenderArguments) -> Result<(), Failure> {
    let interrupt = Interrupt::watch();
    let outputs = Outputs::claim(arguments, &interrupt)?;

    let start = Instant::now();
    let asset = open(arguments)?;
    outputs.spare(&asset)?;
    let settings = settings(arguments, &asset)?;
    let (scene, choices) = asset
        .scene(0.0, &viewpoint(arguments, &settings))
        .map_err(Failure::usage_or_scene)?;
    let load = start.elapsed();

    let options = accel::Options {
        preset: arguments.bvh.into(),
        leaf_size: arguments.leaf_size,
    };
    let accel = Accel::build(&scene, &options);
    let display = arguments.display.unwrap_or(if asset.is_scene_file {
        Display::Srgb
    } else {
        Display::PbrNeutral
    });
    let exposure = choices.exposure;
    let mut summary = Summary::new(
        &asset,
        &scene,
        &accel,
        &settings,
        choices,
        (display, exposure),
    );
    summary.announce(arguments, outputs.uses_stdout);

    let progress = Progress::default();
    let film = progress::shown(arguments.quiet, &progress, || {
        render(&scene, &accel, &settings, &progress)
    });

    let start = Instant::now();
    let comments = Some(command_line());
    let bit_depth = if arguments.bit_depth == "16" {
        BitDepth::Sixteen
    } else {
        BitDepth::Eight
    };
    summary.outputs = outputs.write(
        &film,
        &output::Options {
            display,
            exposure,
            bit_depth,
            comments,
        },
    )?;
    let (build, render) = (accel.statistics().build_time, film.statistics.time);
    summary.finish(
        &film.statistics,
        Seconds::of(load, build, render, start.elapsed()),
    );
    summary.print(arguments, outputs_to_stdout(arguments))
}

/// The file that was asked for, or figure 4.
fn open(arguments: &RenderArguments) -> Result<Asset, Failure> {
    let asset = match &arguments.input {
        Some(path) => load::open(path),
        None => load::scene_file::parse(FIGURE_4, Path::new(FIGURE_4_NAME)),
    };
    asset.map_err(Failure::usage_or_scene)
}

/// The arguments, where they are silent the file, where that is the defaults.
fn settings(arguments: &RenderArguments, asset: &Asset) -> Result<Settings, Failure> {
    let picture = &asset.picture;
    let (width, height, samples) = if asset.is_scene_file {
        (640, 480, 1)
    } else {
        (1280, 720, 4)
    };
    let size = arguments.size;
    Settings::new(
        size.map(|Size { width, .. }| width)
            .or(arguments.width)
            .or(picture.width)
            .unwrap_or(width),
        size.map(|Size { height, .. }| height)
            .or(arguments.height)
            .or(picture.height)
            .unwrap_or(height),
        arguments.samples.or(picture.samples).unwrap_or(samples),
        arguments.max_depth.or(picture.max_depth).unwrap_or(5),
        arguments
            .shading
            .map(Into::into)
            .or(picture.shading)
            .unwrap_or_default(),
    )
    .map_err(Failure::usage_or_scene)
}

fn viewpoint(arguments: &RenderArguments, settings: &Settings) -> Viewpoint {
    let camera = match (arguments.eye, arguments.target, &arguments.camera) {
        (Some(eye), Some(target), _) => {
            CameraChoice::Given(Camera::looking_at(eye, target, Vec3::Y, 40f64.to_radians()))
        }
        (_, _, Some(name)) => CameraChoice::Named(name.clone()),
        _ => CameraChoice::OfFile,
    };
    Viewpoint {
        aspect: f64::from(settings.width()) / f64::from(settings.height()),
        camera,
        fov_y: arguments.fov.map(f64::to_radians),
        background: arguments
            .background
            .map(|BackgroundValue(background)| background),
        exposure: arguments.exposure,
    }
}

/// Where the picture goes, claimed before it is made.
struct Outputs {
    files: Vec<Destination>,
    /// What goes to standard output.
    format: Format,
    uses_stdout: bool,
}

impl Outputs {
    fn claim(arguments: &RenderArguments, interrupt: &Interrupt) -> Result<Outputs, Failure> {
        let input = arguments
            .input
            .as_deref()
            .unwrap_or(Path::new(FIGURE_4_NAME));
        let default = [
            PathBuf::from(input.file_stem().unwrap_or(input.as_os_str()))
                .with_added_extension("png"),
        ];
        let paths = if arguments.outputs.is_empty() {
            &default[..]
        } else {
            &arguments.outputs
        };
        if let Some(twice) = (1..paths.len()).find(|&i| paths[..i].contains(&paths[i])) {
            return Err(Failure::usage_or_scene(format!(
                "{} is given twice as an output",
                paths[twice].display()
            )));
        }
        let mut files = Vec::new();
        for path in paths.iter().filter(|path| !is_stdout(path)) {
            let destination = Destination::claim(path).map_err(Failure::output)?;
            interrupt.remove_on_interrupt(destination.temporary_path());
            files.push(destination);
        }
        let format = match arguments.format {
            FormatValue::Png => Format::Png,
            FormatValue::Exr => Format::Exr,
        };
        let uses_stdout = outputs_to_stdout(arguments);
        if uses_stdout && arguments.json {
            return Err(Failure::usage_or_scene(
                "-o - and --json both want standard output; give the picture a name",
            ));
        }
        Ok(Outputs {
            files,
            format,
            uses_stdout,
        })
    }

    /// Refuses to overwrite what was read.
    fn spare(&self, asset: &Asset) -> Result<(), Failure> {
        let read: Vec<PathBuf> = asset
            .files
            .iter()
            .filter_map(|file| fs::canonicalize(file).ok())
            .collect();
        let overwritten = self.files.iter().find(|output| {
            fs::canonicalize(output.path()).is_ok_and(|output| read.contains(&output))
        });
        overwritten.map_or(Ok(()), |output| {
            let problem = format!(
                "{}: was read for this picture; choose another output",
                output.path().display()
            );
            Err(Failure::usage_or_scene(problem))
        })
    }

    /// Writes every output; the paths of the files.
    fn write(self, film: &Film, options: &output::Options) -> Result<Vec<PathBuf>, Failure> {
        let mut written = Vec::new();
        for destination in self.files {
            let path = destination.path().to_owned();
            destination.write(film, options).map_err(Failure::output)?;
            written.push(path);
        }
        if self.uses_stdout {
            let mut bytes = Vec::new();
            let name = Path::new("standard output");
            output::encode(film, self.format, options, name, &mut bytes)
                .map_err(Failure::output)?;
            print_bytes(&bytes)?;
        }
        Ok(written)
    }
}

fn is_stdout(path: &Path) -> bool {
    path == Path::new("-")
}

fn outputs_to_stdout(arguments: &RenderArguments) -> bool {
    arguments.outputs.iter().any(|path| is_stdout(path))
}

/// The command as it was given, for the picture's comments.
fn command_line() -> String {
    let words = std::env::args_os()
        .skip(1)
        .map(|word| word.to_string_lossy().into_owned());
    std::iter::once("luch".to_owned())
        .chain(words)
        .collect::<Vec<_>>()
        .join(" ")
}
