//! What a render says of itself: in words, or as JSON.

use super::arguments::RenderArguments;
use super::{Failure, print_bytes};
use indicatif::{HumanBytes, HumanCount};
use luch::accel::Accel;
use luch::film::Statistics;
use luch::load::{Asset, Choices};
use luch::output::Display;
use luch::render::Settings;
use luch::scene::Scene;
use serde::Serialize;
use std::fmt::Write;
use std::path::PathBuf;
use std::time::Duration;

/// What went in, what was chosen, what came out, and what it took.
#[derive(Serialize)]
pub(super) struct Summary {
    input: PathBuf,
    files_read: Vec<PathBuf>,
    /// The files that were written.
    pub(super) outputs: Vec<PathBuf>,
    width: u32,
    height: u32,
    samples: u32,
    display: &'static str,
    exposure: f32,
    choices: Vec<String>,
    warnings: Vec<String>,
    scene: SceneCounts,
    bvh: Bvh,
    rays: Rays,
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
}

#[derive(Default, Serialize)]
struct Rays {
    camera: u64,
    transparent: u64,
    shadow: u64,
    mirror: u64,
    total: u64,
    millions_per_second: f64,
}

/// What each phase took.
#[derive(Default, Serialize)]
pub(super) struct Seconds {
    load: f64,
    build: f64,
    render: f64,
    write: f64,
}

impl Seconds {
    pub(super) fn of(
        load: Duration,
        build: Duration,
        render: Duration,
        write: Duration,
    ) -> Seconds {
        let [load, build, render, write] =
            [load, build, render, write].map(|phase| phase.as_secs_f64());
        Seconds {
            load,
            build,
            render,
            write,
        }
    }
}

impl Summary {
    /// What is known before the first ray.
    pub(super) fn new(
        asset: &Asset,
        scene: &Scene,
        accel: &Accel,
        settings: &Settings,
        choices: Choices,
        (display, exposure): (Display, f32),
    ) -> Summary {
        let (spheres, planes) = (scene.spheres().len(), scene.planes().len());
        let statistics = accel.statistics();
        Summary {
            input: asset.file.clone(),
            files_read: asset.files.clone(),
            outputs: Vec::new(),
            width: settings.width(),
            height: settings.height(),
            samples: settings.samples(),
            display: display.name(),
            exposure,
            choices: choices.lines,
            warnings: asset.warnings.iter().map(ToString::to_string).collect(),
            scene: SceneCounts {
                triangles: u64::from(scene.primitive_count()) - (spheres + planes) as u64,
                spheres,
                planes,
                lights: scene.lights().len(),
            },
            bvh: Bvh {
                nodes: statistics.nodes,
                leaves: statistics.leaves,
                depth: statistics.depth,
                bytes: statistics.bytes,
                sah_cost: statistics.sah_cost,
            },
            rays: Rays::default(),
            seconds: Seconds::default(),
        }
    }

    /// Says what was ignored, and what was chosen for the user, before the wait.
    pub(super) fn announce(&self, arguments: &RenderArguments, uses_stdout: bool) {
        if arguments.quiet {
            return;
        }
        for warning in &self.warnings {
            eprintln!("warning: {warning}");
        }
        let mut text = String::new();
        self.choices
            .iter()
            .for_each(|line| text += &format!("{line}\n"));
        if arguments.verbose {
            self.files_read
                .iter()
                .for_each(|file| text += &format!("read {}\n", file.display()));
        }
        if !arguments.json {
            // Nobody who closed the pipe wants to know.
            let _ = say(&text, uses_stdout);
        }
    }

    /// What the render took.
    pub(super) fn finish(&mut self, statistics: &Statistics, seconds: Seconds) {
        if statistics.lost_in_layers > 0 {
            let lost = HumanCount(statistics.lost_in_layers);
            let most = luch::whitted::MAX_LAYERS;
            self.warnings.push(format!(
                "{lost} rays ended behind {most} transparent layers; what lies behind is missing"
            ));
        }
        let total = statistics.rays();
        self.rays = Rays {
            camera: statistics.camera_rays,
            transparent: statistics.transparent_rays,
            shadow: statistics.shadow_rays,
            mirror: statistics.mirror_rays,
            total,
            millions_per_second: total as f64 / 1e6 / seconds.render.max(1e-9),
        };
        self.seconds = seconds;
    }

    /// Prints it as the arguments ask.
    pub(super) fn print(
        &self,
        arguments: &RenderArguments,
        uses_stdout: bool,
    ) -> Result<(), Failure> {
        if arguments.json {
            let json = serde_json::to_string_pretty(self).map_err(Failure::output)?;
            return print_bytes(format!("{json}\n").as_bytes());
        }
        if arguments.quiet {
            return Ok(());
        }
        if self.rays.transparent > 0
            && let Some(lost) = self
                .warnings
                .last()
                .filter(|warning| warning.contains("transparent layers"))
        {
            eprintln!("warning: {lost}");
        }
        say(&self.in_words(arguments.verbose), uses_stdout)
    }

    fn in_words(&self, verbose: bool) -> String {
        let Summary {
            scene,
            bvh,
            rays,
            seconds,
            ..
        } = self;
        let count = |n: usize| HumanCount(n as u64);
        let mut text = String::new();
        let mut line = |what: std::fmt::Arguments| {
            // A String never refuses.
            let _ = writeln!(text, "{what}");
        };
        let mut things = vec![format!("{} triangles", HumanCount(scene.triangles))];
        if scene.spheres + scene.planes > 0 {
            things.push(format!(
                "{} spheres, {} planes",
                count(scene.spheres),
                count(scene.planes)
            ));
        }
        things.push(format!(
            "{} nodes, {} with their primitives",
            count(bvh.nodes),
            HumanBytes(bvh.bytes as u64)
        ));
        if verbose {
            things.push(format!(
                "{} leaves, depth {}, SAH cost {:.1}",
                count(bvh.leaves),
                bvh.depth,
                bvh.sah_cost
            ));
        }
        line(format_args!("{}", things.join(", ")));
        let kinds = [
            (rays.camera, "camera"),
            (rays.transparent, "behind transparent surfaces"),
            (rays.shadow, "shadow"),
            (rays.mirror, "mirror"),
        ];
        let kinds = kinds
            .iter()
            .filter(|(n, _)| *n > 0)
            .map(|(n, kind)| format!("{} {kind}", HumanCount(*n)));
        let kinds = kinds.collect::<Vec<_>>().join(", ");
        line(format_args!(
            "rays: {kinds}; {:.1} Mrays/s",
            rays.millions_per_second
        ));
        let Seconds {
            load,
            build,
            render,
            write,
        } = seconds;
        line(format_args!(
            "load {load:.2} s, build {build:.2} s, render {render:.2} s, write {write:.2} s"
        ));
        for output in &self.outputs {
            line(format_args!("wrote {}", output.display()));
        }
        text
    }
}

/// To standard output, or to standard error where that is the picture's.
fn say(text: &str, stdout_is_taken: bool) -> Result<(), Failure> {
    if stdout_is_taken {
        eprint!("{text}");
        return Ok(());
    }
    print_bytes(text.as_bytes())
}
