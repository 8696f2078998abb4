//! What the frames of a sequence show: read once, and built again only where something moves.

use super::super::arguments::RenderArguments;
use super::super::outputs::Outputs;
use super::super::provenance::{self, Input, Made};
use super::super::summary::announce;
use super::super::{Failure, layers, print, render};
use super::FILMS;
use luch::accel::{self, Accel};
use luch::film::Film;
use luch::load::{Asset, Choices, Viewpoint};
use luch::output::{Frame, Options};
use luch::render::{Progress, Settings};
use luch::scene::Scene;
use std::path::PathBuf;
use std::time::{Duration, Instant};

/// An asset at one moment, and what it takes to go on to another.
pub(super) struct World<'a> {
    arguments: &'a RenderArguments,
    asset: Asset,
    viewpoint: Viewpoint,
    /// As asked, before they are fitted to a scene.
    asked: Settings,
    accel_options: accel::Options,
    /// Of the first frame, for all of them.
    choices: Choices,
    /// Every file that was read.
    pub(super) read: Vec<PathBuf>,
    /// The same for files that tell of them.
    inputs: Vec<Input>,
    /// The moment that files name.
    captured: Option<u64>,
    /// What was said of frames.
    said: Vec<String>,
    /// `None` only while the next one is made.
    shown: Option<Shown>,
    /// How long it took until the first scene was there.
    pub(super) load: Duration,
}

/// A scene with its tree, and its moment in seconds.
struct Shown {
    time: f64,
    scene: Scene,
    settings: Settings,
    /// `None` before the first picture of it.
    accel: Option<Accel>,
}

impl<'a> World<'a> {
    /// Reads the input; the stage is set as frame 1 needs it.
    pub(super) fn open(
        arguments: &'a RenderArguments,
        first: &Outputs,
    ) -> Result<World<'a>, Failure> {
        let start = Instant::now();
        let captured = arguments.provenance.captured()?;
        let accel_options = render::accel_options(arguments)?;
        let name = render::name(arguments);
        // Nothing of the one is needed for the other.
        let (asset, beside) = rayon::join(
            || render::open(arguments),
            || arguments.environment.beside(name),
        );
        let (mut asset, (surrounding, _)) = (asset?, beside?);
        let asked = arguments.window.of(render::settings(arguments, &asset)?)?;
        let mut viewpoint = Viewpoint {
            environment: surrounding,
            ..render::viewpoint(arguments, &asked)?
        };
        let time = match arguments.sequence.is_of_an_animation() {
            true => arguments.sequence.time(1),
            false => arguments.animation.time(),
        };
        // What moves is posed again and again, from what the asset keeps.
        let scene = match asset.moves() && arguments.sequence.is_of_an_animation() {
            true => asset.scene(time, &viewpoint),
            false => asset.take_scene(time, &viewpoint),
        };
        let (scene, choices) = scene.map_err(Failure::usage_or_scene)?;
        viewpoint.stage = choices.stage.clone();
        viewpoint.exposure = Some(choices.exposure);
        let read: Vec<PathBuf> = asset.files.iter().chain(&choices.files).cloned().collect();
        first.spare(&read)?;
        let inputs = match first.tell_of_inputs() {
            true => render::inputs(arguments, &read)?,
            false => Vec::new(),
        };
        announce(arguments, &asset, &choices);
        let mut world = World {
            arguments,
            asset,
            viewpoint,
            asked,
            accel_options,
            read,
            inputs,
            captured,
            said: choices.lines.clone(),
            choices,
            shown: None,
            load: Duration::ZERO,
        };
        world.show(time, scene)?;
        world.load = start.elapsed();
        Ok(world)
    }

    /// Goes on to a frame; whether the search tree is still that of the frame before.
    pub(super) fn go_to(&mut self, frame: u32) -> Result<bool, Failure> {
        let sequence = &self.arguments.sequence;
        let Some(shown) = self.shown.take() else {
            return Err(Failure::render("no scene is left of the frame before"));
        };
        let time = match sequence.is_of_an_animation() {
            true => sequence.time(frame),
            false => shown.time,
        };
        let asset = &self.asset;
        let camera = asset.camera_of_the_same_scene(shown.time, time, &self.viewpoint);
        match camera.map_err(Failure::usage_or_scene)? {
            Some(camera) => {
                let pivot = self.viewpoint.stage.as_ref().map(|stage| stage.pivot());
                let angle = sequence.angle(frame);
                let camera = pivot.map_or(camera, |pivot| camera.carried_around(pivot, angle));
                let scene = shown.scene.with_camera(camera);
                self.shown = Some(Shown {
                    time,
                    scene: scene.map_err(Failure::usage_or_scene)?,
                    ..shown
                });
            }
            None => {
                // All else is gone before the next is there.
                let textures = shown.scene.into_textures();
                drop(shown.accel);
                let scene = asset.scene(time, &self.viewpoint);
                let (scene, choices) = scene.map_err(Failure::usage_or_scene)?;
                self.say_news(frame, choices);
                self.show(time, scene.with_textures(textures))?;
            }
        }
        Ok(self.build())
    }

    /// Makes a scene the one that is shown.
    fn show(&mut self, time: f64, scene: Scene) -> Result<(), Failure> {
        let settings = layers::fitted(self.asked, &scene, self.arguments)?;
        let room = self.asset.check_film(&scene, FILMS * settings.film_bytes());
        room.map_err(Failure::usage_or_scene)?;
        self.shown = Some(Shown {
            time,
            scene,
            settings,
            accel: None,
        });
        Ok(())
    }

    /// Builds the tree and what else a picture needs, unless they are there; whether they are.
    fn build(&mut self) -> bool {
        let Some(shown) = self.shown.as_mut().filter(|shown| shown.accel.is_none()) else {
            return true;
        };
        // Neither needs the other.
        let build = || Accel::build(&shown.scene, &self.accel_options);
        let (accel, ()) = rayon::join(build, || shown.settings.prepare(&shown.scene));
        shown.accel = Some(accel);
        false
    }

    /// The picture of the frame that it was brought to.
    pub(super) fn render(&self, progress: &Progress) -> Result<Film, Failure> {
        let (shown, accel) = self.ready()?;
        Ok(luch::render::render(
            &shown.scene,
            accel,
            &shown.settings,
            progress,
        ))
    }

    /// The scene and its tree, once a frame was gone to.
    fn ready(&self) -> Result<(&Shown, &Accel), Failure> {
        let shown = self.shown.as_ref();
        let ready = shown.and_then(|shown| Some((shown, shown.accel.as_ref()?)));
        ready.ok_or_else(|| Failure::render("no scene is ready"))
    }

    /// What the tree's build took, in seconds.
    pub(super) fn build_seconds(&self) -> f64 {
        let accel = self.shown.as_ref().and_then(|shown| shown.accel.as_ref());
        accel.map_or(0.0, |accel| accel.statistics().build_time.as_secs_f64())
    }

    /// How a frame becomes a file.
    pub(super) fn output_options(&self, frame: u32, film: &Film) -> Result<Options, Failure> {
        let (shown, accel) = self.ready()?;
        let made = Made {
            arguments: &self.arguments.provenance,
            captured: self.captured,
            inputs: &self.inputs,
            scene: &shown.scene,
            accel,
            settings: &shown.settings,
            film,
        };
        let mut header = provenance::header(&made);
        header.frame = Some(Frame {
            // At most a million.
            number: frame as i32,
            per_second: self.arguments.sequence.per_second(),
        });
        let choices = &self.choices;
        Ok(render::output_options(
            self.arguments,
            &self.asset,
            choices,
            header,
        ))
    }

    /// Says what was not said of another frame: nothing is left out in silence.
    fn say_news(&mut self, frame: u32, choices: Choices) {
        for line in choices.lines {
            // The number of what is left out may be another one in each frame.
            if !self.said.contains(&line) && self.said.len() < MOST_SAID {
                if !self.arguments.quiet {
                    print::to_stderr(&format!("frame {frame}: {line}"));
                }
                self.said.push(line);
            }
        }
    }
}

/// So many lines are enough.
const MOST_SAID: usize = 100;
