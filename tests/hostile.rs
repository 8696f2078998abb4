//! Hostile files through the program, each in a process of its own with little memory and little time: a picture, or one
//! line that says why not.
//!
//! They lie in `hostile/` in the folder that `LUCH_TEST_MODELS` names, or else in `../shared/models`. The project has
//! none of them, since their licences differ.

use super::common::models;
use std::collections::HashSet;
use std::fs::{self, File};
use std::os::unix::process::ExitStatusExt;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};
use std::thread;
use std::time::{Duration, Instant};

/// RLIMIT_DATA, in the KiB of `ulimit -d`.
const MEMORY: &str = "1048576";

/// From start to end of a process.
const PATIENCE: Duration = Duration::from_secs(10);

/// As many as the machine of the smallest kind has cores.
const AT_A_TIME: usize = 2;

/// Legal files.
const CONTROLS: &str = "made/ok";

/// The table of all files in the folder above, where each has a line: its path first and, second to last, how many errors
/// the Khronos validator finds in it.
const TABLE: &str = "INDEX.tsv";

/// What luch says of a legal file that shows nothing.
const NOTHING: &str = "has nothing to draw";

/// Legal files of the validator's that show something or might, and what luch says of them all the same.
const NOT_SHOWN: &[(&str, &str)] = &[
    (
        "validator/base/data/asset/min_version_valid.gltf",
        "needs glTF 2.1 at least",
    ),
    // Its buffer is not in the folder.
    (
        "validator/base/data/buffer/valid.gltf",
        "valid.bin: cannot open",
    ),
    (
        "validator/base/data/image/valid.gltf",
        "magenta.png: cannot open",
    ),
    // No node shows its mesh, of which there are no bytes.
    (
        "validator/base/data/root/unused_objects.gltf",
        "buffer 0 has neither a URI nor",
    ),
];

/// A triangle whose texture is `IMAGE`.
const TEXTURED: &str = r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"material":0}]}],
"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],
"extensionsUsed":["EXT_texture_webp","KHR_texture_basisu"],
"textures":[{"source":0,"extensions":{"EXT_texture_webp":{"source":0},"KHR_texture_basisu":{"source":0}}}],
"images":[{"uri":"IMAGE"}],"accessors":[
{"bufferView":0,"componentType":5126,"type":"VEC3","count":3},{"bufferView":0,"componentType":5126,"type":"VEC2","count":3}],
"bufferViews":[{"buffer":0,"byteLength":36}],
"buffers":[{"byteLength":36,"uri":"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]}"#;

/// What became of a file.
enum Outcome {
    Picture,
    /// One line on standard error, and exit code 1.
    Line(String),
    /// Anything else.
    Broken(String),
}

impl Outcome {
    fn told(&self) -> &str {
        match self {
            Outcome::Picture => "gives a picture",
            Outcome::Line(line) => line,
            Outcome::Broken(how) => how,
        }
    }
}

#[test]
fn hostile_files_give_a_picture_or_one_line() {
    let Some(root) = models::folder("hostile_files_give_a_picture_or_one_line", "hostile") else {
        return;
    };
    let scratch = tempfile::tempdir().expect("a temporary folder");
    let mut files = models::below(&root, &["gltf", "glb", "obj"]);
    let models = files.len();
    files.extend(wrapped_images(&root.join("images"), scratch.path()));
    let start = Instant::now();
    let outcomes = each(&files, scratch.path());
    let count = |kind: fn(&Outcome) -> bool| outcomes.iter().filter(|(_, o)| kind(o)).count();
    models::say(&format!(
        "{}: {models} models and {} images: {} pictures, {} lines, {} neither, {:.0} s",
        root.display(),
        files.len() - models,
        count(|o| matches!(o, Outcome::Picture)),
        count(|o| matches!(o, Outcome::Line(_))),
        count(|o| matches!(o, Outcome::Broken(_))),
        start.elapsed().as_secs_f64(),
    ));
    let legal = legal(&root);
    let mut shown = 0;
    let mut wrong = Vec::new();
    for (file, outcome) in &outcomes {
        let name = file.strip_prefix(&root).unwrap_or(file).to_string_lossy();
        let is_legal = name.starts_with(CONTROLS) || legal.contains(&*name);
        let is_image = file.starts_with(scratch.path());
        let expected = NOT_SHOWN.iter().find(|(known, _)| name == *known);
        let is_right = match (outcome, expected) {
            (Outcome::Broken(_), _) | (Outcome::Picture, Some(_)) => false,
            (Outcome::Picture, None) => true,
            (Outcome::Line(line), Some((_, words))) => line.contains(words),
            (Outcome::Line(line), None) => !is_image && (!is_legal || line.contains(NOTHING)),
        };
        shown += usize::from(is_legal && matches!(outcome, Outcome::Picture));
        if !is_right {
            wrong.push(format!("{name}: {}", outcome.told()));
        }
    }
    models::say(&format!(
        "    {shown} of {} legal ones show something",
        legal.len() + 1
    ));
    assert!(wrong.is_empty(), "\n{}", wrong.join("\n"));
}

/// The validator's files in which it finds no error, relative to `root`.
fn legal(root: &Path) -> HashSet<String> {
    let table = root.parent().map(|above| above.join(TABLE));
    let table = table.and_then(|table| fs::read_to_string(table).ok());
    let table = table.unwrap_or_default();
    let legal = table.lines().filter_map(|line| {
        let mut fields = line.rsplit('\t').skip(1);
        let is_legal = fields.next() == Some("0");
        let name = fields.last()?.strip_prefix("hostile/")?;
        (is_legal && name.starts_with("validator/")).then(|| name.to_owned())
    });
    legal.collect()
}

/// For each image a model of one triangle in a folder of its own: what is wrong with an image costs that texture.
fn wrapped_images(images: &Path, scratch: &Path) -> Vec<PathBuf> {
    let images = models::below(images, &["png", "jpg", "webp", "ktx2", "bmp", "tga", "gif"]);
    let wrap = |(number, image): (usize, &PathBuf)| {
        let extension = image.extension().unwrap_or_default().to_string_lossy();
        let (folder, name) = (
            scratch.join(number.to_string()),
            format!("image.{extension}"),
        );
        fs::create_dir(&folder).expect("a writable folder");
        fs::copy(image, folder.join(&name)).expect("a readable image");
        let model = folder.join("textured.gltf");
        fs::write(&model, TEXTURED.replace("IMAGE", &name)).expect("a writable folder");
        model
    };
    images.iter().enumerate().map(wrap).collect()
}

/// What becomes of each file.
fn each<'a>(files: &'a [PathBuf], scratch: &Path) -> Vec<(&'a PathBuf, Outcome)> {
    let next = AtomicUsize::new(0);
    let outcomes = Mutex::new(Vec::new());
    thread::scope(|scope| {
        for worker in 0..AT_A_TIME {
            let (next, outcomes) = (&next, &outcomes);
            scope.spawn(move || {
                let at = |name: &str| scratch.join(format!("{worker}.{name}"));
                let (picture, said) = (at("png"), at("txt"));
                while let Some(file) = files.get(next.fetch_add(1, Relaxed)) {
                    let outcome = one(file, &picture, &said);
                    outcomes.lock().expect("no panic").push((file, outcome));
                }
            });
        }
    });
    let mut outcomes = outcomes.into_inner().expect("no panic");
    outcomes.sort_by_key(|(file, _)| *file);
    outcomes
}

/// Renders a file into `picture`; `said` gets what the program says.
fn one(file: &Path, picture: &Path, said: &Path) -> Outcome {
    let _ = fs::remove_file(picture);
    let said_file = File::create(said).expect("a writable folder");
    let mut child = Command::new("sh")
        .args(["-c", r#"ulimit -d "$0" && exec "$@""#, MEMORY])
        .arg(env!("CARGO_BIN_EXE_luch"))
        .args(["render", "--quiet", "--size", "16x16", "--samples", "1"])
        .arg("--output")
        .arg(picture)
        .arg(file)
        .stdin(Stdio::null())
        .stdout(Stdio::null())
        .stderr(said_file)
        .spawn()
        .expect("a shell");
    let Some(status) = ended(&mut child) else {
        return Outcome::Broken(format!("takes more than {PATIENCE:?}"));
    };
    let said = fs::read_to_string(said).unwrap_or_else(|e| format!("{e}\n"));
    let is_line = said.starts_with("error: ")
        && said.ends_with('\n')
        && !said.trim_end_matches('\n').contains(char::is_control)
        && said.matches('\n').count() == 1;
    let is_picture = picture.metadata().is_ok_and(|m| m.len() > 0);
    match status.code() {
        Some(0) if said.is_empty() && is_picture => Outcome::Picture,
        Some(1) if is_line && !picture.exists() => Outcome::Line(said.trim_end().to_owned()),
        code => {
            let signal = status.signal();
            Outcome::Broken(format!("exit code {code:?}, signal {signal:?}: {said:?}"))
        }
    }
}

/// How a process ended; `None` where it had to be.
fn ended(child: &mut Child) -> Option<ExitStatus> {
    let start = Instant::now();
    loop {
        match child.try_wait().expect("a child") {
            Some(status) => return Some(status),
            None if start.elapsed() < PATIENCE => thread::sleep(Duration::from_millis(2)),
            None => {
                let _ = child.kill();
                let _ = child.wait();
                return None;
            }
        }
    }
}
