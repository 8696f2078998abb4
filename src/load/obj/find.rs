//! Where a file lies that an OBJ or an MTL names: writers leave paths of their own machine, and strangers' files may not
//! have others read from this one.

use crate::load::Options;
use std::collections::HashMap;
use std::ffi::OsString;
use std::path::{Component, Path, PathBuf};

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

/// What is said of a file elsewhere on the disk.
const LEADS_OUT: &str =
    "leads out of the model's folder; move it beside the model or use --allow-external";

/// What is said of a device, a pipe or a folder.
const NO_FILE: &str = "is no file";

/// Looks for files; remembers the folders it has listed.
#[derive(Default)]
pub(super) struct Finder {
    /// The folder of the model, and that of the file its path is a link to, as the disk has them.
    roots: Vec<PathBuf>,
    allows_external: bool,
    /// The names in a folder by their lower case.
    listings: HashMap<PathBuf, HashMap<String, OsString>>,
}

impl Finder {
    /// For the files of `model`.
    pub(super) fn new(model: &Path, options: &Options) -> Finder {
        let here = Path::new(".");
        let folder_of = |path: &Path| match path.parent() {
            Some(folder) if !folder.as_os_str().is_empty() => folder.canonicalize(),
            _ => here.canonicalize(),
        };
        let linked = model.canonicalize().and_then(|path| folder_of(&path));
        Finder {
            roots: [folder_of(model), linked].into_iter().flatten().collect(),
            allows_external: options.allow_external,
            listings: HashMap::new(),
        }
    }

    /// Whether a file may be read: the one place that decides.
    fn allows(&self, path: &Path) -> bool {
        let lies_below = |path: PathBuf| self.roots.iter().any(|root| path.starts_with(root));
        self.allows_external || path.canonicalize().is_ok_and(lies_below)
    }

    /// Whether the words of a path alone lead out.
    fn leads_out(&self, folder: &Path, reference: &str) -> bool {
        let folder = if folder.as_os_str().is_empty() {
            Path::new(".")
        } else {
            folder
        };
        let mut path = folder.canonicalize().unwrap_or_default();
        for component in Path::new(reference).components() {
            match component {
                Component::ParentDir => drop(path.pop()),
                other => path.push(other),
            }
        }
        !self.roots.iter().any(|root| path.starts_with(root))
    }

    /// Looks for `reference` from each of `folders`, the earlier first.
    ///
    /// Backslashes part folders as slashes do, except before blanks, which they keep in a name. Of a path that is absolute or leads out of the model's folder only the
    /// name is looked for, unless files elsewhere are allowed.
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
                if path.is_file() && self.allows(&path) {
                    return Found::AsNamed(path);
                }
                // Whether it is there is not said of what leads out.
                if !self.allows_external && self.leads_out(folder, &reference) {
                    refused = Some(LEADS_OUT);
                } else if path.exists() {
                    let why = if self.allows(&path) {
                        NO_FILE
                    } else {
                        LEADS_OUT
                    };
                    refused = refused.or(Some(why));
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
        let exact = folder.join(name);
        if exact.is_file() && self.allows(&exact) {
            return Some(exact);
        }
        let names = self
            .listings
            .entry(folder.to_owned())
            .or_insert_with(|| listing(folder));
        let path = folder.join(names.get(&name.to_lowercase())?);
        (path.is_file() && self.allows(&path)).then_some(path)
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

    #[cfg(unix)]
    #[test]
    fn a_link_is_followed_before_it_is_judged() {
        use std::os::unix::fs::symlink;
        let folder = folder();
        let below = folder.path().join("maps");
        symlink("../Brick.PNG", below.join("out.png")).unwrap();
        symlink("Oak.png", below.join("in.png")).unwrap();
        symlink("/dev/zero", below.join("zero.png")).unwrap();
        assert_eq!(find(&below, "out.png"), Found::Refused(LEADS_OUT));
        assert_eq!(find(&below, "zero.png"), Found::Refused(LEADS_OUT));
        assert_eq!(find(&below, "in.png"), Found::AsNamed(below.join("in.png")));
        // A user's link to a model: its files may lie beside the link or beside the model.
        std::fs::write(below.join("model.obj"), "x").unwrap();
        symlink("maps/model.obj", folder.path().join("link.obj")).unwrap();
        let mut finder = Finder::new(&folder.path().join("link.obj"), &Options::default());
        let found = finder.find("Oak.png", std::slice::from_ref(&below));
        assert_eq!(found, Found::AsNamed(below.join("Oak.png")));
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
