//! Models that nobody here wrote, in a folder beside the project or wherever a variable says.

use std::env;
use std::fs;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// A folder in the one that `LUCH_TEST_MODELS` names, or else in `../shared/models`; `None`, and a line that says so,
/// where there is none.
pub(crate) fn folder(test: &str, name: &str) -> Option<PathBuf> {
    let root = env::var_os("LUCH_TEST_MODELS").map_or_else(
        || Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/models"),
        PathBuf::from,
    );
    let folder = root.join(name);
    if !folder.is_dir() {
        let folder = folder.display();
        say(&format!(
            "SKIPPED, not passed: {test}: no model was tried, since {folder} is no folder; \
             LUCH_TEST_MODELS can name another that has it"
        ));
        return None;
    }
    Some(folder)
}

/// The files with one of these extensions in a folder and those below it, in order.
pub(crate) fn below(folder: &Path, extensions: &[&str]) -> Vec<PathBuf> {
    let mut files = Vec::new();
    add_below(folder, extensions, &mut files);
    files.sort();
    files
}

fn add_below(folder: &Path, extensions: &[&str], files: &mut Vec<PathBuf>) {
    let entries = fs::read_dir(folder).into_iter().flatten().flatten();
    for path in entries.map(|entry| entry.path()) {
        let extension = path.extension().map(|e| e.to_string_lossy().to_lowercase());
        if path.is_dir() {
            add_below(&path, extensions, files);
        } else if extension.is_some_and(|e| extensions.contains(&e.as_str())) {
            files.push(path);
        }
    }
}

/// Past the harness, which keeps what tests that pass print: whether one did anything must be seen.
pub(crate) fn say(text: &str) {
    let _ = writeln!(io::stderr(), "{text}");
}
