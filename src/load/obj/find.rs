//! Where a file lies that an OBJ or an MTL names: writers leave paths of their own machine.

use std::collections::HashMap;
use std::ffi::OsString;
use std::path::{Path, PathBuf};

/// Where a file lies.
#[derive(Debug, PartialEq, Eq)]
pub(super) enum Found {
    /// Where the reference says.
    AsNamed(PathBuf),
    /// Beside the file that names it, or under a name that differs in capitals.
    Elsewhere(PathBuf),
    /// Nowhere.
    Missing,
}

/// Looks for files; remembers the folders it has listed.
#[derive(Default)]
pub(super) struct Finder {
    /// The names in a folder by their lower case.
    listings: HashMap<PathBuf, HashMap<String, OsString>>,
}

impl Finder {
    /// Looks for `reference` from each of `folders`, the earlier first.
    ///
    /// Backslashes part folders as slashes do. An absolute path is not followed: the same model would look different
    /// on another machine. Only its name is looked for.
    pub(super) fn find(&mut self, reference: &str, folders: &[PathBuf]) -> Found {
        let reference = reference.replace('\\', "/");
        let name = reference.rsplit('/').next().unwrap_or_default();
        if name.is_empty() || name == "." || name == ".." {
            return Found::Missing;
        }
        let has_drive = reference.as_bytes().get(1) == Some(&b':');
        if !has_drive && !reference.starts_with('/') {
            let named = folders.iter().map(|folder| folder.join(&reference));
            if let Some(path) = named.into_iter().find(|path| path.is_file()) {
                return Found::AsNamed(path);
            }
            for folder in folders {
                let path = folder.join(&reference);
                let parent = path.parent().unwrap_or(folder);
                if let Some(path) = self.in_any_case(parent, name) {
                    return Found::Elsewhere(path);
                }
            }
        }
        for folder in folders {
            if let Some(path) = self.in_any_case(folder, name) {
                return Found::Elsewhere(path);
            }
        }
        Found::Missing
    }

    /// A file in a folder, whatever the capitals of its name.
    fn in_any_case(&mut self, folder: &Path, name: &str) -> Option<PathBuf> {
        let exact = folder.join(name);
        if exact.is_file() {
            return Some(exact);
        }
        let names = self
            .listings
            .entry(folder.to_owned())
            .or_insert_with(|| listing(folder));
        let path = folder.join(names.get(&name.to_lowercase())?);
        path.is_file().then_some(path)
    }
}

/// Of names that differ in capitals alone the first in order, so that the choice does not depend on the disk.
fn listing(folder: &Path) -> HashMap<String, OsString> {
    let here = Path::new(".");
    let folder = if folder.as_os_str().is_empty() {
        here
    } else {
        folder
    };
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    let mut all: Vec<OsString> = entries.map(|entry| entry.file_name()).collect();
    all.sort_by(|a, b| b.cmp(a));
    all.into_iter()
        .map(|name| (name.to_string_lossy().to_lowercase(), name))
        .collect()
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

    use super::*;

    fn folder() -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        std::fs::create_dir(folder.path().join("maps")).unwrap();
        for file in ["maps/Oak.png", "Brick.PNG", "a b.png"] {
            std::fs::write(folder.path().join(file), "x").unwrap();
        }
        folder
    }

    fn find(folder: &Path, reference: &str) -> Found {
        Finder::default().find(reference, &[folder.to_owned()])
    }

    #[test]
    fn a_right_path_is_taken_as_it_is() {
        let folder = folder();
        let at = |reference: &str| Found::AsNamed(folder.path().join(reference));
        for reference in ["maps/Oak.png", "a b.png", "maps/../Brick.PNG"] {
            assert_eq!(find(folder.path(), reference), at(reference));
        }
        assert_eq!(find(folder.path(), "maps\\Oak.png"), at("maps/Oak.png"));
    }

    #[test]
    fn a_wrong_path_leads_to_the_name_beside() {
        let folder = folder();
        let brick = || Found::Elsewhere(folder.path().join("Brick.PNG"));
        for reference in [
            "C:\\Users\\me\\Brick.PNG",
            "/home/me/brick.png",
            "gone/brick.png",
            "BRICK.png",
            "\\\\server\\share\\brick.png",
        ] {
            assert_eq!(find(folder.path(), reference), brick(), "{reference}");
        }
        let oak = Found::Elsewhere(folder.path().join("maps/Oak.png"));
        assert_eq!(find(folder.path(), "maps/oak.PNG"), oak);
    }

    #[test]
    fn an_absolute_path_is_not_followed() {
        let folder = folder();
        let elsewhere = tempfile::tempdir().unwrap();
        let absolute = folder.path().join("a b.png");
        let absolute = absolute.to_str().unwrap();
        assert_eq!(find(elsewhere.path(), absolute), Found::Missing);
    }

    #[test]
    fn folders_and_nothing_are_no_files() {
        let folder = folder();
        for reference in ["maps", "", "..", "maps/", "gone.png"] {
            assert_eq!(find(folder.path(), reference), Found::Missing);
        }
    }
}
