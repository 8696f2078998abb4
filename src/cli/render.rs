//! `luch render`: a file becomes a scene, a film, and files.

use super::arguments::{ProgressValue, RenderArguments};
use super::interrupt::Interrupt;
use super::outputs::{self, Outputs};
use super::progress::{self, Listener, State};
use super::provenance::{self, Input, Made};
use super::summary::{self, Done, Seconds, Summary};
use super::values::{BackgroundValue, Size};
use super::{Failure, cameras, command_line, frames, layers, print, sequence};
use glam::Vec3;
use luch::Error;
use luch::accel::{self, Accel, Isa, Layout};
use luch::camera::Camera;
use luch::framing::View;
use luch::load::{self, AnimationChoice, Asset, CameraChoice, Choices, Viewpoint};
use luch::output::{self, Display, Header};
use luch::render::{Progress, Settings, render};
use std::path::{Path, PathBuf};
use std::time::Instant;

/// The paper's figure 4, for who gives no file.
pub(super) const FIGURE_4: &str = include_str!("../../assets/scenes/figure-4.toml");
pub(super) const FIGURE_4_NAME: &str = "figure-4.toml";

/// Renders what the arguments ask for.
pub(super) fn run(arguments: &RenderArguments) -> Result<(), Failure> {
    // Rayon reads none as all cores.
    let threads = arguments.threads.unwrap_or(0) as usize;
    let pool = rayon::ThreadPoolBuilder::new()
        .num_threads(threads)
        .build()
        .map_err(Failure::usage_or_scene)?;
    match arguments.sequence.list()? {
        Some(frames) if !arguments.list_cameras => sequence::run(arguments, &frames, &pool),
        _ => pool.install(|| render_file(arguments)),
    }
}

/// The input's name.
pub(super) fn name(arguments: &RenderArguments) -> &Path {
    let input = arguments.input.as_deref();
    input.unwrap_or(Path::new(FIGURE_4_NAME))
}

/// Refuses what nobody could mean: two answers on one standard output.
pub(super) fn check_stdout(arguments: &RenderArguments) -> Result<(), Failure> {
    if arguments.picture_to_stdout() && arguments.progress == ProgressValue::Openjd {
        return Err(Failure::usage_or_scene(
            "-o - and --progress openjd both want standard output; give the picture a name",
        ));
    }
    Ok(())
}

fn render_file(arguments: &RenderArguments) -> Result<(), Failure> {
    if arguments.list_cameras {
        return cameras::list(arguments);
    }
    let name = name(arguments);
    let accel_options = accel_options(arguments)?;
    let captured = arguments.provenance.captured()?;
    check_stdout(arguments)?;
    let paths = outputs::paths(arguments, name, false);
    if let Some(path) = paths.iter().find(|path| frames::holds_pattern(path)) {
        return Err(Failure::usage_or_scene(format!(
            "{}: is a name for frames; say which, as in --frames 1-48, or --frames 1",
            print::path(path)
        )));
    }
    if arguments.sequence.skip_existing && outputs::are_whole(&paths, arguments) {
        return summary::say_skipped(&paths, arguments);
    }
    let outputs = Outputs::claim(&paths, arguments, &Interrupt::watch())?;

    let start = Instant::now();
    // Nothing of the one is needed for the other.
    let (asset, beside) = rayon::join(|| open(arguments), || arguments.environment.beside(name));
    let (mut asset, (surrounding, environment)) = (asset?, beside?);
    outputs.spare(&asset.files)?;
    let settings = arguments.window.of(settings(arguments, &asset)?)?;
    let viewpoint = Viewpoint {
        environment: surrounding,
        ..viewpoint(arguments, &settings)?
    };
    let (scene, choices) = asset
        .take_scene(arguments.animation.time(), &viewpoint)
        .map_err(Failure::usage_or_scene)?;
    let settings = layers::fitted(settings, &scene, arguments)?;
    // A picture is encoded beside the film.
    let room = asset.check_film(&scene, 2 * settings.film_bytes());
    room.map_err(Failure::usage_or_scene)?;
    let read: Vec<PathBuf> = asset.files.iter().chain(&choices.files).cloned().collect();
    outputs.spare(&read)?;
    let load = start.elapsed();
    summary::announce(arguments, &asset, &choices);

    // None needs another.
    let build = || Accel::build(&scene, &accel_options);
    let inputs = || match outputs.tell_of_inputs() {
        true => inputs(arguments, &read),
        false => Ok(Vec::new()),
    };
    let beside = || rayon::join(|| settings.prepare(&scene), inputs);
    let (accel, ((), inputs)) = rayon::join(build, beside);
    let inputs = inputs?;
    let progress = Progress::default();
    let state = || State {
        doing: "rendering".into(),
        share: progress.share(),
        left: None,
    };
    let film = progress::shown(Listener::of(arguments), &state, || {
        render(&scene, &accel, &settings, &progress)
    });

    let start = Instant::now();
    let header = provenance::header(&Made {
        arguments: &arguments.provenance,
        captured,
        inputs: &inputs,
        scene: &scene,
        accel: &accel,
        settings: &settings,
        film: &film,
    });
    let options = output_options(arguments, &asset, &choices, header);
    let written = outputs.write(&film, &options)?;
    let render = film.statistics.time.as_secs_f64();
    let rays = render * film.statistics.search_share();
    let seconds = Seconds {
        load: load.as_secs_f64(),
        textures: asset.budget.decoding().as_secs_f64(),
        environment: environment.as_secs_f64(),
        build: accel.statistics().build_time.as_secs_f64(),
        render,
        rays,
        shade: render - rays,
        write: start.elapsed().as_secs_f64(),
    };
    let done = Done {
        asset: &asset,
        choices: &choices,
        scene: &scene,
        accel: &accel,
        settings: &settings,
        film: &film,
        options: &options,
        written: &written,
        seconds,
    };
    Summary::of(done).print(arguments)
}

/// The file, or the paper's figure 4.
pub(super) fn open(arguments: &RenderArguments) -> Result<Asset, Failure> {
    let options = load::Options {
        animation: match arguments.animation.choice() {
            AnimationChoice::None if arguments.sequence.is_of_an_animation() => {
                AnimationChoice::First
            }
            choice => choice,
        },
        ..arguments.reading.options()
    };
    match &arguments.input {
        Some(path) => load::open(path, &options),
        None => load::scene_file::parse(FIGURE_4, Path::new(FIGURE_4_NAME), &options),
    }
    .map_err(Failure::usage_or_scene)
}

/// What was read, for the files that tell it.
pub(super) fn inputs(arguments: &RenderArguments, read: &[PathBuf]) -> Result<Vec<Input>, Failure> {
    let given = [arguments.input.as_deref(), arguments.environment.file()];
    let given: Vec<&Path> = given.into_iter().flatten().collect();
    provenance::inputs(read, &given)
}

/// The arguments, where they are silent the file, where that is the defaults.
pub(super) fn settings(arguments: &RenderArguments, asset: &Asset) -> Result<Settings, Failure> {
    let picture = &asset.picture;
    let (width, height) = if asset.is_scene_file {
        (640, 480)
    } else {
        (1280, 720)
    };
    let size = arguments.size;
    let asked_width = size.map(|Size { width, .. }| width).or(arguments.width);
    let asked_height = size.map(|Size { height, .. }| height).or(arguments.height);
    let shading = arguments.shading.map(Into::into).or(picture.shading);
    let texture_filter = arguments.texture_filter.map(Into::into);
    let texture_filter = texture_filter.or(picture.texture_filter);
    let sampling = arguments.sampling.of(arguments.samples, asset);
    Settings::new(
        asked_width.or(picture.width).unwrap_or(width),
        asked_height.or(picture.height).unwrap_or(height),
        1,
        arguments.max_depth.or(picture.max_depth).unwrap_or(5),
        shading.unwrap_or_default(),
    )
    .and_then(|settings| settings.with_sampling(sampling))
    .and_then(|settings| settings.with_layers(arguments.layers.unwrap_or_default()))
    .map(|settings| settings.with_texture_filter(texture_filter.unwrap_or_default()))
    .map_err(|error| {
        let asked = [
            asked_width,
            asked_height,
            arguments.samples,
            arguments.max_depth,
        ];
        if arguments.sampling.is_said() || asked.iter().any(Option::is_some) {
            Failure::usage_or_scene(error)
        } else {
            let problem = error.to_string();
            Failure::usage_or_scene(Error::malformed(&asset.file, "[render]", problem))
        }
    })
}

/// The vertical field of view that goes with `--eye`, in degrees.
const FOV_WITH_EYE: f64 = 40.0;

pub(super) fn viewpoint(
    arguments: &RenderArguments,
    settings: &Settings,
) -> Result<Viewpoint, Failure> {
    let camera = match (arguments.eye, arguments.target, &arguments.camera) {
        (Some(eye), Some(target), _) if eye == target => {
            return Err(Failure::usage_or_scene(
                "--eye and --target are the same point; move one of them",
            ));
        }
        (Some(eye), Some(target), _) => CameraChoice::Given(Camera::looking_at(
            eye,
            target,
            Vec3::Y,
            FOV_WITH_EYE.to_radians(),
        )),
        (_, _, Some(name)) => CameraChoice::Named(name.clone()),
        _ => framed(arguments).map_or(CameraChoice::OfFile, CameraChoice::Framed),
    };
    Ok(Viewpoint {
        aspect: f64::from(settings.width()) / f64::from(settings.height()),
        camera,
        fov_y: arguments.fov.map(f64::to_radians),
        background: arguments
            .background
            .map(|BackgroundValue(background)| background),
        exposure: arguments.exposure,
        lights: arguments.lights.map(Into::into),
        ground: arguments.ground.into(),
        ground_reflectivity: arguments.ground_reflection,
        ..Viewpoint::of_file(1.0)
    })
}

/// The framed view that is asked for, if any is.
fn framed(arguments: &RenderArguments) -> Option<View> {
    let RenderArguments {
        view, orbit, zoom, ..
    } = arguments;
    let usual = View::default();
    let is_asked = view.is_some() || orbit.is_some() || zoom.is_some();
    is_asked.then(|| View {
        direction: view.map_or(usual.direction, Into::into),
        orbit: orbit.unwrap_or(usual.orbit),
        zoom: zoom.unwrap_or(usual.zoom),
    })
}

pub(super) fn accel_options(arguments: &RenderArguments) -> Result<accel::Options, Failure> {
    Ok(accel::Options {
        preset: arguments.bvh.into(),
        leaf_size: arguments.leaf_size,
        builder: arguments.bvh_builder.into(),
        layout: if arguments.small_memory {
            Layout::Small
        } else {
            Layout::Wide
        },
        isa: Isa::asked().map_err(Failure::usage_or_scene)?,
        ..accel::Options::default()
    })
}

pub(super) fn output_options(
    arguments: &RenderArguments,
    asset: &Asset,
    choices: &Choices,
    header: Header,
) -> output::Options {
    // A scene file's colours are taken at their word.
    let display = if asset.is_scene_file {
        Display::Srgb
    } else {
        Display::PbrNeutral
    };
    output::Options {
        display: arguments.display.unwrap_or(display),
        exposure: choices.exposure,
        bit_depth: arguments.bit_depth.into(),
        comments: Some(command_line()),
        header,
    }
}
