//! Models that nobody here wrote: each gives a picture or one line that says why not, and none a panic.
//!
//! They lie in `valid/` and `obj/` in the folder that `LUCH_TEST_MODELS` names, or else in `../shared/models`. The
//! project has none of them, since their licences differ.

use super::common::{models, picture};
use luch::load::{self, Viewpoint};
use luch::material::AlphaMode;
use luch::scene::Scene;
use luch::shade::Shading;
use std::any::Any;
use std::panic::{self, AssertUnwindSafe};
use std::path::{Path, PathBuf};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::thread;
use std::time::{Duration, Instant};

/// A file on one thread takes less, on a slow and busy machine too; the slowest takes a tenth.
const PATIENCE: Duration = Duration::from_secs(30);

/// What became of a file.
struct Outcome {
    file: PathBuf,
    result: Result<Drawn, Refusal>,
    time: Duration,
}

/// A picture, and what was said beside it.
struct Drawn {
    blank: bool,
    /// Whether no triangle has an area and is there at all: then the picture is rightly blank.
    nothing_there: bool,
    finite: bool,
    warnings: Vec<String>,
}

/// Why there is no picture.
enum Refusal {
    Error(String),
    Panic(String),
}

#[test]
fn real_models_give_a_picture_or_one_line() {
    let outcomes = tried(
        "real_models_give_a_picture_or_one_line",
        &["valid", "obj"],
        64,
    );
    assert_calm(&outcomes);
    outcomes
        .iter()
        .for_each(|outcome| models::say(&outcome.row()));
    for outcome in &outcomes {
        // A file may have nothing that luch draws, or a line that makes no sense, and says so; whatever it draws is
        // seen.
        let reason = outcome.reason();
        let is_accepted = reason.contains("has nothing to draw") || reason.contains(": line ");
        assert!(outcome.shows_something() || is_accepted, "{reason}");
    }
}

/// Loads and renders every model in `folders`, and tells what came of it; nothing, and a line that says so, where a
/// folder is absent.
fn tried(test: &str, folders: &[&str], side: u32) -> Vec<Outcome> {
    let mut outcomes = Vec::new();
    for folder in folders.iter().filter_map(|name| models::folder(test, name)) {
        let files = models::below(&folder, &["gltf", "glb", "obj"]);
        let of_folder = each(&files, side);
        models::say(&summary(&folder, &of_folder));
        outcomes.extend(of_folder);
    }
    outcomes
}

/// What becomes of each file. Each is tried by one thread alone, so that its time is its own.
fn each(files: &[PathBuf], side: u32) -> Vec<Outcome> {
    let next = AtomicUsize::new(0);
    let outcomes = Mutex::new(Vec::new());
    thread::scope(|scope| {
        for _ in 0..thread::available_parallelism().map_or(1, usize::from) {
            scope.spawn(|| {
                let alone = rayon::ThreadPoolBuilder::new().num_threads(1).build();
                let alone = alone.expect("a pool");
                while let Some(file) = files.get(next.fetch_add(1, Relaxed)) {
                    let outcome = alone.install(|| one(file, side));
                    outcomes.lock().expect("no panic").push(outcome);
                }
            });
        }
    });
    let mut outcomes = outcomes.into_inner().expect("no panic");
    outcomes.sort_by(|a, b| a.file.cmp(&b.file));
    outcomes
}

fn one(file: &Path, side: u32) -> Outcome {
    let start = Instant::now();
    let result = panic::catch_unwind(AssertUnwindSafe(|| drawn(file, side)));
    let result = match result {
        Ok(result) => result.map_err(Refusal::Error),
        Err(panic) => Err(Refusal::Panic(words(&*panic))),
    };
    Outcome {
        file: file.to_owned(),
        result,
        time: start.elapsed(),
    }
}

fn words(panic: &(dyn Any + Send)) -> String {
    let fixed = panic.downcast_ref::<&str>().map(ToString::to_string);
    let made = || panic.downcast_ref::<String>().cloned();
    fixed.or_else(made).unwrap_or_default()
}

fn drawn(file: &Path, side: u32) -> Result<Drawn, String> {
    let asset = load::open(file, &load::Options::default()).map_err(|error| error.to_string())?;
    let warnings = asset.warnings.iter().map(ToString::to_string).collect();
    let (scene, _) = asset
        .scene(0.0, &Viewpoint::of_file(1.0))
        .map_err(|error| error.to_string())?;
    let film = picture::of(&scene, side, side, Shading::BlinnPhong);
    let beauty = &film.layers[0].values;
    let (pixels, _) = beauty.as_chunks::<4>();
    Ok(Drawn {
        blank: pixels.iter().all(|pixel| *pixel == pixels[0]),
        nothing_there: nothing_there(&scene),
        finite: beauty.iter().all(|number| number.is_finite()),
        warnings,
    })
}

fn nothing_there(scene: &Scene) -> bool {
    scene.instances().iter().all(|instance| {
        let alpha = &scene.material(instance.material).alpha;
        let is_gone = alpha.mode != AlphaMode::Opaque && alpha.coverage.factor == 0.0;
        let mesh = scene.mesh(instance.mesh);
        let mut triangles = (0..mesh.triangles.len() as u32).map(|index| mesh.triangle(index).0);
        is_gone || triangles.all(|[a, b, c]| (b - a).cross(c - a).length() == 0.0)
    })
}

impl Outcome {
    fn shows_something(&self) -> bool {
        matches!(self.result, Ok(Drawn { blank: false, .. }))
    }

    /// A line of the table: what came of it, in how much time, with how many kinds of warnings.
    fn row(&self) -> String {
        let (seconds, file) = (self.time.as_secs_f64(), self.file.display());
        match &self.result {
            Ok(Drawn {
                blank: false,
                warnings,
                ..
            }) => format!("    {seconds:5.1} s  {:2} warnings  {file}", warnings.len()),
            _ => format!("    {seconds:5.1} s  NO PICTURE   {}", self.reason()),
        }
    }

    /// Why nothing is seen.
    fn reason(&self) -> String {
        match &self.result {
            Ok(drawn) => {
                let why = if drawn.nothing_there {
                    "has nothing to draw but what has no area or is transparent"
                } else {
                    "gives a blank picture"
                };
                format!("{}: {why}", self.file.display())
            }
            Err(Refusal::Error(error)) => error.clone(),
            Err(Refusal::Panic(panic)) => format!("{}: panics: {panic}", self.file.display()),
        }
    }
}

/// How many of the files show anything, and the slowest.
fn summary(folder: &Path, outcomes: &[Outcome]) -> String {
    let shown = outcomes.iter().filter(|outcome| outcome.shows_something());
    let slowest = outcomes.iter().max_by_key(|outcome| outcome.time);
    let slowest = slowest.map_or(String::new(), |slowest| {
        let name = slowest.file.display();
        let seconds = slowest.time.as_secs_f64();
        format!("; the slowest took {seconds:.1} s: {name}")
    });
    let (shown, all, folder) = (shown.count(), outcomes.len(), folder.display());
    format!("{folder}: {shown} of {all} models give a picture{slowest}")
}

/// Every file came to its end in time, and what is said of it is a line each, an error's with the name of a file.
fn assert_calm(outcomes: &[Outcome]) {
    let is_line = |text: &str| !text.is_empty() && !text.contains(char::is_control);
    for Outcome { file, result, time } in outcomes {
        let shown = file.display();
        match result {
            Ok(drawn) => {
                assert!(drawn.finite, "{shown}: a pixel is no finite number");
                for warning in &drawn.warnings {
                    assert!(is_line(warning), "{shown}: {warning:?}");
                }
            }
            Err(Refusal::Error(error)) => {
                // The model's name, or that of a file beside it.
                let folder = file.parent().unwrap_or(file).to_string_lossy();
                assert!(
                    is_line(error) && error.starts_with(&*folder),
                    "{shown}: {error:?}"
                );
            }
            Err(Refusal::Panic(panic)) => panic!("{shown}: panics: {panic}"),
        }
        assert!(*time < PATIENCE, "{shown}: took {time:?}");
    }
}
