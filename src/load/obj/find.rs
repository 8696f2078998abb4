//! Where a file lies that an OBJ or an MTL names: writers leave paths of their own machine, and strangers' files may not
//! have others read from this one.

use crate::load::Options;
use crate::load::files::{LEADS_OUT, Reach, or_here};
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
    /// Where a model's files may not lie, or at what is no file; the end of a sentence that says which.
    Refused(&'static str),
}

/// What is said of a device, a pipe or a folder.
const NO_FILE: &str = "is no file";

/// Looks for files; remembers the folders it has listed.
#[derive(Default)]
pub(super) struct Finder {
    reach: Reach,
    /// The names in a folder by their lower case.
    listings: HashMap<PathBuf, HashMap<String, OsString>>,
}

impl Finder {
    /// For the files of `model`.
    pub(super) fn new(model: &Path, options: &Options) -> Finder {
        Finder {
            reach: Reach::of(model, options),
            listings: HashMap::new(),
        }
    }

    /// Looks for `reference` from each of `folders`, the earlier first.
    ///
    /// Backslashes part folders as slashes do, except before blanks, which they keep in a name. Of a path that leads out
    /// of the model's folder only the name is looked for, unless files elsewhere are allowed.
    pub(super) fn find(&mut self, reference: &str, folders: &[PathBuf]) -> Found {
        let reference = reference.replace("\\ ", " ").replace('\\', "/");
        let name = reference.rsplit('/').next().unwrap_or_default();
        if name.is_empty() || name == "." || name == ".." {
            return Found::Missing;
        }
        let mut refused = None;
        // `file:`, drives and addresses on the net are no paths of this machine.
        let is_foreign = reference
            .split('/')
            .next()
            .is_some_and(|first| first.contains(':'))
            && !folders
                .iter()
                .any(|folder| folder.join(&reference).exists());
        if is_foreign {
            refused = Some(LEADS_OUT);
        } else {
            for folder in folders {
                // An absolute path replaces the folder.
                let path = folder.join(&reference);
                if !self.reach.holds(folder, Path::new(&reference)) {
                    refused = Some(LEADS_OUT);
                } else if path.is_file() {
                    return Found::AsNamed(path);
                } else if path.exists() {
                    refused = refused.or(Some(NO_FILE));
                }
            }
        }
        if !is_foreign && !reference.starts_with('/') {
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
        refused.map_or(Found::Missing, Found::Refused)
    }

    /// A file in a folder, whatever the capitals of its name.
    fn in_any_case(&mut self, folder: &Path, name: &str) -> Option<PathBuf> {
        let is_file = |name: &Path| folder.join(name).is_file() && self.reach.holds(folder, name);
        if is_file(Path::new(name)) {
            return Some(folder.join(name));
        }
        let names = self
            .listings
            .entry(folder.to_owned())
            .or_insert_with(|| listing(folder));
        let name = Path::new(names.get(&name.to_lowercase())?);
        is_file(name).then(|| folder.join(name))
    }
}

/// Of names that differ in capitals alone the first in order, so that the choice does not depend on the disk.
fn listing(folder: &Path) -> HashMap<String, OsString> {
    let entries = std::fs::read_dir(or_here(folder))
        .into_iter()
        .flatten()
        .flatten();
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
        find_with(folder, reference, false)
    }

    fn find_with(folder: &Path, reference: &str, allow_external: bool) -> Found {
        let options = Options {
            allow_external,
            ..Options::default()
        };
        let mut finder = Finder::new(&folder.join("model.obj"), &options);
        finder.find(reference, &[folder.to_owned()])
    }

    #[test]
    fn a_right_path_is_taken_as_it_is() {
        let folder = folder();
        let at = |reference: &str| Found::AsNamed(folder.path().join(reference));
        for reference in ["maps/Oak.png", "a b.png", "maps/../Brick.PNG"] {
            assert_eq!(find(folder.path(), reference), at(reference));
        }
        assert_eq!(find(folder.path(), "maps\\Oak.png"), at("maps/Oak.png"));
        assert_eq!(find(folder.path(), "a\\ b.png"), at("a b.png"));
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
    fn what_lies_elsewhere_is_read_only_where_that_is_allowed() {
        let folder = folder();
        let below = folder.path().join("maps");
        let absolute = folder.path().join("a b.png");
        for reference in [absolute.to_str().unwrap(), "../a b.png"] {
            assert_eq!(find(&below, reference), Found::Refused(LEADS_OUT));
            let allowed = find_with(&below, reference, true);
            assert_eq!(allowed, Found::AsNamed(below.join(reference)));
        }
        // Inside, however the path goes about it.
        let about = "../maps/Oak.png";
        assert_eq!(find(&below, about), Found::AsNamed(below.join(about)));
        for reference in [
            "file:///etc/passwd",
            "C:/gone.png",
            "http://a.b/c.png",
            "/gone.png",
            "../gone.png",
            "a/../../gone.png",
        ] {
            assert_eq!(find(&below, reference), Found::Refused(LEADS_OUT));
        }
    }

    #[test]
    fn folders_and_nothing_are_no_files() {
        let folder = folder();
        assert_eq!(find(folder.path(), "maps"), Found::Refused(NO_FILE));
        for reference in ["", "..", "maps/", "gone.png"] {
            assert_eq!(find(folder.path(), reference), Found::Missing);
        }
    }
}
