//! What a render says of itself: in words, or as JSON.

use super::arguments::RenderArguments;
use super::asks::Asked;
use super::{Failure, print};
use indicatif::{HumanBytes, HumanCount};
use luch::accel::Accel;
use luch::film::{Film, Statistics};
use luch::load::{Asset, Choices};
use luch::output::Options;
use luch::render::Settings;
use luch::scene::Scene;
use luch::whitted::MAX_LAYERS;
use print::counted;
use serde::Serialize;
use std::path::PathBuf;

/// Says what was ignored, and what was chosen for the user, before the wait.
pub(super) fn announce(arguments: &RenderArguments, asset: &Asset, choices: &Choices) {
    if arguments.quiet {
        return;
    }
    asset
        .warnings
        .iter()
        .for_each(|warning| warn(&warning.to_string()));
    let mut lines = choices.lines.clone();
    if arguments.verbose {
        let read = asset.files.iter();
        lines.extend(read.map(|file| format!("read {}", print::path(file))));
    }
    if !arguments.json {
        // Whoever does not get these lines will not get the summary either, and that tells.
        let _ = say(&lines, arguments);
    }
}

/// Everything that a render is made of.
pub(super) struct Done<'a> {
    pub(super) asset: &'a Asset,
    pub(super) choices: &'a Choices,
    pub(super) scene: &'a Scene,
    pub(super) accel: &'a Accel,
    pub(super) settings: &'a Settings,
    pub(super) film: &'a Film,
    pub(super) options: &'a Options,
    pub(super) written: &'a [PathBuf],
    pub(super) seconds: Seconds,
}

/// What went in, what was chosen, what came out, and what it took: the fields of `--json`.
#[derive(Serialize)]
pub(super) struct Summary {
    input: String,
    files_read: Vec<String>,
    /// The files that were written.
    outputs: Vec<String>,
    width: u32,
    height: u32,
    /// The most a pixel.
    samples: u32,
    /// What pixels got on average.
    mean_samples: f64,
    display: &'static str,
    exposure: f32,
    choices: Vec<String>,
    warnings: Vec<String>,
    /// What the models ask for, by what luch does with it.
    asks: Asked,
    scene: SceneCounts,
    bvh: Bvh,
    rays: Rays,
    threads: usize,
    seconds: Seconds,
}

#[derive(Serialize)]
struct SceneCounts {
    triangles: u64,
    spheres: usize,
    planes: usize,
    lights: usize,
}

#[derive(Serialize)]
struct Bvh {
    nodes: usize,
    leaves: usize,
    depth: usize,
    bytes: usize,
    sah_cost: f32,
    /// The instruction set of the kernels that search it.
    kernels: &'static str,
}

#[derive(Serialize)]
struct Rays {
    camera: u64,
    transparent: u64,
    shadow: u64,
    mirror: u64,
    refracted: u64,
    total: u64,
    /// Of the total, those that stopped before they had passed every transparent layer.
    lost_in_layers: u64,
    millions_per_second: f64,
    /// The share of the time that went into search: the picture's rays a second are this share of those of search alone.
    search_share: f64,
}

/// What each phase took.
#[derive(Clone, Copy, Serialize)]
pub(super) struct Seconds {
    /// All of it, textures included.
    pub(super) load: f64,
    /// What decoding images took of that.
    pub(super) textures: f64,
    /// What preparing the environment took, beside loading.
    pub(super) environment: f64,
    pub(super) build: f64,
    pub(super) render: f64,
    /// What searching for what rays meet took of that, and all the rest of it: estimates from one tile of so many.
    pub(super) rays: f64,
    pub(super) shade: f64,
    pub(super) write: f64,
}

impl Summary {
    pub(super) fn of(done: Done) -> Summary {
        let Done {
            asset, scene, film, ..
        } = done;
        let (spheres, planes) = (scene.spheres().len(), scene.planes().len());
        let tree = done.accel.statistics();
        let mut warnings: Vec<String> = asset.warnings.iter().map(ToString::to_string).collect();
        warnings.extend(lost_in_layers(film.statistics.lost_in_layers));
        Summary {
            input: print::path(&asset.file),
            files_read: asset.files.iter().map(|file| print::path(file)).collect(),
            outputs: done.written.iter().map(|file| print::path(file)).collect(),
            width: film.width,
            height: film.height,
            samples: done.settings.samples(),
            mean_samples: mean_samples(film),
            display: done.options.display.name(),
            exposure: done.options.exposure,
            choices: done.choices.lines.clone(),
            warnings,
            asks: Asked::of(asset),
            scene: SceneCounts {
                triangles: u64::from(scene.primitive_count()) - (spheres + planes) as u64,
                spheres,
                planes,
                lights: scene.lights().len(),
            },
            bvh: Bvh {
                nodes: tree.nodes,
                leaves: tree.leaves,
                depth: tree.depth,
                bytes: tree.bytes,
                sah_cost: tree.sah_cost,
                kernels: done.accel.isa().name(),
            },
            rays: Rays::of(&film.statistics),
            threads: rayon::current_num_threads(),
            seconds: done.seconds,
        }
    }

    /// Prints it as the arguments ask.
    pub(super) fn print(&self, arguments: &RenderArguments) -> Result<(), Failure> {
        if !arguments.quiet
            && let Some(warning) = lost_in_layers(self.rays.lost_in_layers)
        {
            warn(&warning);
        }
        match (arguments.json, arguments.quiet) {
            (true, _) => print::json(self),
            (false, true) => Ok(()),
            (false, false) => say(&self.in_words(), arguments),
        }
    }

    fn in_words(&self) -> Vec<String> {
        let Seconds {
            load,
            textures,
            environment,
            build,
            render,
            rays,
            shade,
            write,
        } = self.seconds;
        let mut lines: Vec<String> = self.asks.in_words().into_iter().collect();
        lines.extend([
            format!("{}, {}", self.scene.in_words(), self.bvh.in_words()),
            self.rays.in_words(self.mean_samples),
            format!(
                "load {load:.2} s (textures {textures:.2} s; beside it environment {environment:.2} s), build {build:.2} s, \
                 render {render:.2} s (rays {rays:.2} s, shade {shade:.2} s), write {write:.2} s"
            ),
        ]);
        lines.extend(self.outputs.iter().map(|output| format!("wrote {output}")));
        lines
    }
}

impl SceneCounts {
    fn in_words(&self) -> String {
        let triangles = counted(self.triangles, "triangle", "triangles");
        if self.spheres + self.planes == 0 {
            return triangles;
        }
        let spheres = counted(self.spheres as u64, "sphere", "spheres");
        let planes = counted(self.planes as u64, "plane", "planes");
        format!("{triangles}, {spheres}, {planes}")
    }
}

impl Bvh {
    fn in_words(&self) -> String {
        let nodes = counted(self.nodes as u64, "node", "nodes");
        let leaves = counted(self.leaves as u64, "leaf", "leaves");
        let bytes = HumanBytes(self.bytes as u64);
        let (depth, cost, kernels) = (self.depth, self.sah_cost, self.kernels);
        format!("{nodes}, {leaves}, depth {depth}, {bytes}, SAH cost {cost:.1}, {kernels} kernels")
    }
}

impl Rays {
    fn of(statistics: &Statistics) -> Rays {
        let total = statistics.rays();
        // A picture of a few pixels can take less than the clock's step.
        let seconds = statistics.time.as_secs_f64().max(1e-9);
        Rays {
            camera: statistics.camera_rays,
            transparent: statistics.transparent_rays,
            shadow: statistics.shadow_rays,
            mirror: statistics.mirror_rays,
            refracted: statistics.refracted_rays,
            total,
            lost_in_layers: statistics.lost_in_layers,
            millions_per_second: total as f64 / 1e6 / seconds,
            search_share: statistics.search_share(),
        }
    }

    fn in_words(&self, samples: f64) -> String {
        let camera = format!("camera ({samples:.1} a pixel)");
        let kinds = [
            (self.camera, camera.as_str()),
            (self.transparent, "behind transparent surfaces"),
            (self.shadow, "shadow"),
            (self.mirror, "mirror"),
            (self.refracted, "refracted"),
        ];
        let kinds = kinds.iter().filter(|(count, _)| *count > 0);
        let kinds: Vec<String> = kinds
            .map(|(count, kind)| format!("{} {kind}", HumanCount(*count)))
            .collect();
        let (kinds, speed) = (kinds.join(", "), self.millions_per_second);
        let share = self.search_share * 100.0;
        format!("rays: {kinds}; {speed:.1} Mrays/s, {share:.0} % of what search alone reaches")
    }
}

/// Samples a pixel.
fn mean_samples(film: &Film) -> f64 {
    let pixels = f64::from(film.width) * f64::from(film.height);
    film.statistics.samples() as f64 / pixels
}

/// The warning about rays that met too many transparent layers, if there are any.
pub(super) fn lost_in_layers(count: u64) -> Option<String> {
    let rays = counted(count, "ray", "rays");
    let warning =
        format!("{rays} ended behind {MAX_LAYERS} transparent layers; what lies behind is missing");
    (count > 0).then_some(warning)
}

/// Says that there was nothing to do.
pub(super) fn say_skipped(paths: &[PathBuf], arguments: &RenderArguments) -> Result<(), Failure> {
    if arguments.quiet {
        return Ok(());
    }
    let lines: Vec<String> = paths
        .iter()
        .map(|path| format!("{} is there and whole", print::path(path)))
        .collect();
    say(&lines, arguments)
}

pub(super) fn warn(warning: &str) {
    print::to_stderr(&format!("warning: {warning}"));
}

/// Lines to standard output, or to standard error where that is the picture's.
pub(super) fn say(lines: &[String], arguments: &RenderArguments) -> Result<(), Failure> {
    if arguments.picture_to_stdout() {
        lines.iter().for_each(|line| print::to_stderr(line));
        return Ok(());
    }
    let text: String = lines
        .iter()
        .map(|line| print::one_line(line) + "\n")
        .collect();
    print::to_stdout(text.as_bytes())
}
