//! The program as its users meet it: what it prints, what it leaves on the disk, and how it ends.

mod farm;
mod files;
mod help;
mod info;
#[cfg(unix)]
mod interrupt;
mod isa;
mod outputs;
mod pipes;
mod provenance;
mod reading;
mod said;
mod scenes;
mod sequence;
mod study;
mod usage;
mod windows;

use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use tempfile::TempDir;

/// A scene that renders in no time.
const SCENE: &str = "\
[camera]
position = [0, 0, -5]
look_at = [0, 0, 0]
[render]
width = 8
height = 8
[[light]]
type = \"point\"
position = [5, 5, -5]
[[material]]
name = \"red\"
[[sphere]]
center = [0, 0, 0]
radius = 1
material = \"red\"
";

/// A model of one triangle.
const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

/// A folder of its own, with these files in it.
struct Folder(TempDir);

/// What came of a run.
struct Ran {
    code: Option<i32>,
    out: Vec<u8>,
    err: String,
}

impl Folder {
    #[track_caller]
    fn new(files: &[(&str, &[u8])]) -> Folder {
        let folder = Folder(tempfile::tempdir().expect("a temporary folder"));
        for (name, bytes) in files {
            fs::write(folder.path(name), bytes).expect("a writable folder");
        }
        folder
    }

    /// With [`SCENE`] as `scene.toml` and [`TRIANGLE`] as `model.obj`.
    fn with_scene_and_model() -> Folder {
        Folder::new(&[
            ("scene.toml", SCENE.as_bytes()),
            ("model.obj", TRIANGLE.as_bytes()),
        ])
    }

    fn path(&self, name: &str) -> PathBuf {
        self.0.path().join(name)
    }

    fn read(&self, name: &str) -> Vec<u8> {
        fs::read(self.path(name)).unwrap_or_default()
    }

    /// The names of everything in the folder, sorted.
    fn names(&self) -> Vec<String> {
        let entries = fs::read_dir(self.0.path()).expect("a readable folder");
        let mut names: Vec<String> = entries
            .map(|entry| entry.expect("an entry").file_name())
            .map(|name| name.to_string_lossy().into_owned())
            .collect();
        names.sort();
        names
    }

    /// The program with the folder as its current one.
    fn command(&self, arguments: &[&str]) -> Command {
        let mut command = Command::new(env!("CARGO_BIN_EXE_luch"));
        command.current_dir(self.0.path()).args(arguments);
        command.stdin(Stdio::null());
        command
    }

    #[track_caller]
    fn luch(&self, arguments: &[&str]) -> Ran {
        let output = self.command(arguments).output().expect("the program runs");
        Ran {
            code: output.status.code(),
            out: output.stdout,
            err: String::from_utf8(output.stderr).expect("UTF-8"),
        }
    }

    /// Runs what must go well.
    #[track_caller]
    fn luch_succeeds(&self, arguments: &[&str]) -> Ran {
        let ran = self.luch(arguments);
        assert_eq!(ran.code, Some(0), "{arguments:?}: {}", ran.err);
        ran
    }

    /// Runs what must end with this code and this one line.
    #[track_caller]
    fn luch_fails(&self, arguments: &[&str], code: i32, error: &str) {
        let ran = self.luch(arguments);
        let expected = format!("error: {error}\n");
        let found = (ran.code, ran.err.as_str(), ran.out.as_slice());
        assert_eq!(
            found,
            (Some(code), expected.as_str(), &b""[..]),
            "{arguments:?}"
        );
    }
}

impl Ran {
    fn out(&self) -> &str {
        std::str::from_utf8(&self.out).expect("UTF-8")
    }

    #[track_caller]
    fn json(&self) -> Value {
        serde_json::from_slice(&self.out).expect("JSON and nothing else")
    }
}

/// A file that comes with the project.
fn asset(name: &str) -> String {
    let assets = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets");
    assets.join(name).display().to_string()
}

const PNG: &[u8] = b"\x89PNG\r\n\x1a\n";
const EXR: &[u8] = b"\x76\x2f\x31\x01";
