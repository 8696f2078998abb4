//! `luch render --frames` and `--turntable`: one asset, many pictures, each written while the next is rendered.

mod summary;
mod world;

use super::arguments::{RenderArguments, is_stdout};
use super::interrupt::Interrupt;
use super::outputs::{self, Outputs};
use super::progress::{self, Listener, State};
use super::{Failure, frames, render};
use luch::film::Film;
use luch::output::Options;
use luch::render::Progress;
use rayon::ThreadPool;
use std::path::PathBuf;
use std::sync::mpsc::{Receiver, SyncSender, sync_channel};
use std::sync::{Arc, Mutex, PoisonError};
use std::thread;
use std::time::Instant;
use summary::Summary;
use world::World;

/// So many films wait to be written: while one waits and one is written, a third is rendered, and no more.
const WAITING: usize = 1;
/// Those three, and one being encoded.
pub(super) const FILMS: u64 = 4;

/// A sequence that is asked for.
struct Sequence<'a> {
    arguments: &'a RenderArguments,
    frames: &'a [u32],
    /// Where pictures go, the frame's number open.
    patterns: Vec<PathBuf>,
    interrupt: Interrupt,
    now: Mutex<Now>,
}

/// What is under way.
#[derive(Default)]
struct Now {
    /// So many frames are done or were there.
    done: usize,
    frame: u32,
    progress: Arc<Progress>,
    /// Whether a picture could not be written, so that no other is wanted.
    is_over: bool,
}

/// A frame that is to be rendered, its files claimed.
struct Job {
    /// Its place in the list.
    index: usize,
    frame: u32,
    outputs: Outputs,
}

/// A frame that is to be written.
struct Rendered {
    job: Job,
    film: Film,
    options: Options,
    is_tree_kept: bool,
}

/// Renders the frames on the threads of `pool`.
pub(super) fn run(
    arguments: &RenderArguments,
    frames: &[u32],
    pool: &ThreadPool,
) -> Result<(), Failure> {
    let sequence = Sequence {
        arguments,
        frames,
        patterns: outputs::paths(arguments, render::name(arguments), true),
        interrupt: Interrupt::watch(),
        now: Mutex::default(),
    };
    sequence.check()?;
    // Before anything is read: a picture that cannot be written is found now.
    let mut summary = Summary::new(arguments);
    let Some(first) = sequence.next(0, &mut summary)? else {
        return summary.print(arguments);
    };
    let state = || sequence.state();
    progress::shown(Listener::of(arguments), &state, || {
        let mut world = pool.install(|| World::open(arguments, &first.outputs))?;
        summary.opened(&world);
        sequence.render(&mut world, first, pool, &mut summary)
    })?;
    summary.print(arguments)
}

impl Sequence<'_> {
    /// Finds what is wrong with what is asked, before anything is read.
    fn check(&self) -> Result<(), Failure> {
        let arguments = self.arguments;
        if self.patterns.iter().any(|path| is_stdout(path)) {
            return Err(Failure::usage_or_scene(
                "-o - takes one picture; give the frames names, as in -o shot.####.png",
            ));
        }
        if arguments.sequence.is_of_an_animation() && arguments.animation.has_time() {
            return Err(Failure::usage_or_scene(
                "--time is the moment of one picture; frames have moments of their own (--fps)",
            ));
        }
        self.paths(1).map(|_| ())
    }

    /// Where a frame goes.
    fn paths(&self, frame: u32) -> Result<Vec<PathBuf>, Failure> {
        let patterns = self.patterns.iter();
        patterns
            .map(|pattern| frames::path_of(pattern, frame))
            .collect()
    }

    /// The next frame that is to be rendered, from a place in the list on.
    fn next(&self, from: usize, summary: &mut Summary) -> Result<Option<Job>, Failure> {
        for (index, &frame) in self.frames.iter().enumerate().skip(from) {
            let paths = self.paths(frame)?;
            if self.arguments.sequence.skip_existing && outputs::are_whole(&paths, self.arguments) {
                summary.skipped(frame, &paths, self.arguments)?;
                continue;
            }
            let outputs = Outputs::claim(&paths, self.arguments, &self.interrupt)?;
            return Ok(Some(Job {
                index,
                frame,
                outputs,
            }));
        }
        Ok(None)
    }

    /// Renders the frames, from the first that is wanted on, while another thread writes them.
    fn render(
        &self,
        world: &mut World,
        first: Job,
        pool: &ThreadPool,
        summary: &mut Summary,
    ) -> Result<(), Failure> {
        thread::scope(|scope| {
            let (films, waiting) = sync_channel(WAITING);
            let writer = scope.spawn(|| self.write(waiting, pool));
            let rendered = self.render_all(world, first, &films, pool, summary);
            drop(films);
            let written = match writer.join() {
                Ok(written) => written,
                Err(panic) => std::panic::resume_unwind(panic),
            };
            // Where a file could not be written, that is why there are no more films.
            summary.wrote(written?);
            rendered
        })
    }

    fn render_all(
        &self,
        world: &mut World,
        first: Job,
        films: &SyncSender<Rendered>,
        pool: &ThreadPool,
        summary: &mut Summary,
    ) -> Result<(), Failure> {
        let mut next = Some(first);
        while let Some(job) = next {
            job.outputs.spare(&world.read)?;
            let (frame, after) = (job.frame, job.index + 1);
            let Some(progress) = self.begin(&job) else {
                return Ok(());
            };
            let is_tree_kept = pool.install(|| world.go_to(frame))?;
            let film = pool.install(|| world.render(&progress))?;
            if !film.complete {
                return Err(Failure::render(format!("frame {frame}: was cancelled")));
            }
            summary.rendered(&film, world, is_tree_kept);
            let rendered = Rendered {
                options: world.output_options(frame, &film)?,
                job,
                film,
                is_tree_kept,
            };
            if films.send(rendered).is_err() {
                return Ok(());
            }
            next = self.next(after, summary)?;
        }
        self.lock().done = self.frames.len();
        Ok(())
    }

    /// Writes what comes; the seconds that took.
    fn write(&self, films: Receiver<Rendered>, pool: &ThreadPool) -> Result<f64, Failure> {
        let mut seconds = 0.0;
        for rendered in films {
            let start = Instant::now();
            let written = self.write_one(rendered, pool);
            if written.is_err() {
                let mut now = self.lock();
                now.is_over = true;
                now.progress.cancel();
            }
            written?;
            seconds += start.elapsed().as_secs_f64();
        }
        Ok(seconds)
    }

    fn write_one(&self, rendered: Rendered, pool: &ThreadPool) -> Result<(), Failure> {
        let Rendered {
            job,
            film,
            options,
            is_tree_kept,
        } = rendered;
        // On the threads that render: no more than were asked for.
        let files = pool.install(|| job.outputs.write(&film, &options))?;
        summary::say_written(job.frame, &files, is_tree_kept, self.arguments)
    }

    /// Goes on to a frame; `None` where it is over.
    fn begin(&self, job: &Job) -> Option<Arc<Progress>> {
        let mut now = self.lock();
        now.done = job.index;
        now.frame = job.frame;
        now.progress = Arc::default();
        (!now.is_over).then(|| now.progress.clone())
    }

    fn state(&self) -> State {
        let now = self.lock();
        let all = self.frames.len();
        let share = (now.done as f64 + now.progress.share()) / all as f64;
        State {
            doing: match now.frame {
                0 => "reading".into(),
                frame => format!("frame {frame}, {} of {all}", (now.done + 1).min(all)),
            },
            share: share.min(1.0),
            left: None,
        }
    }

    fn lock(&self) -> std::sync::MutexGuard<'_, Now> {
        self.now.lock().unwrap_or_else(PoisonError::into_inner)
    }
}
