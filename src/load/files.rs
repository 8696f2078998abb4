//! Reading files, the model's own and those it names.

use super::{Budget, Options};
use crate::Error;
use std::fs::{self, File, Metadata};
use std::io::Read;
use std::path::{Component, Path, PathBuf};

/// Makes sure that a path leads to a regular file.
///
/// # Errors
///
/// It does not exist, or is a folder, a device or a pipe.
pub(super) fn check(path: &Path) -> Result<Metadata, Error> {
    let metadata = fs::metadata(path).map_err(Error::io(path, "open"))?;
    if !metadata.is_file() {
        let found = if metadata.is_dir() {
            "a folder"
        } else {
            "a device or a pipe"
        };
        return Err(Error::malformed(
            path,
            "",
            format!("is {found}, expected a file"),
        ));
    }
    Ok(metadata)
}

/// Reads a whole regular file, with memory from the budget.
///
/// # Errors
///
/// It does not exist, is a folder, a device or a pipe, is too long, or cannot be read.
pub(super) fn read(path: &Path, budget: &Budget) -> Result<Vec<u8>, Error> {
    let length = check(path)?.len();
    budget
        .take(length)
        .map_err(|problem| problem.of(path, ""))?;
    // The system's own files, as in /proc, say that they are empty: some of them never end or wait for ever.
    let mut bytes = Vec::with_capacity(usize::try_from(length).unwrap_or_default());
    let file = File::open(path).map_err(Error::io(path, "open"))?;
    // Nor more than was counted, should the file grow meanwhile.
    let read = file.take(length).read_to_end(&mut bytes);
    read.map_err(Error::io(path, "read"))?;
    Ok(bytes)
}

/// Where a file that `from` names by the relative reference `reference` lies.
pub(super) fn beside(from: &Path, reference: &Path) -> PathBuf {
    from.parent()
        .map_or_else(|| reference.to_owned(), |folder| folder.join(reference))
}

/// Where the files may lie that a model names: below the model's own folder, unless the user allows all.
///
/// A picture of a stranger's model must not read what else lies on the disk. Links are followed first, so that one of
/// a stranger's leads nowhere else either. Where the model's own path is a link, it is the user's, and files may lie
/// beside the link or beside what it leads to.
#[derive(Clone, Debug, Default)]
pub(super) struct Reach {
    /// As the disk has them, without links.
    folders: Vec<PathBuf>,
    allows_all: bool,
}

/// What is said of a file elsewhere: the end of a sentence about what names it.
pub(super) const LEADS_OUT: &str =
    "leads out of the model's folder; move the file beside the model, or use --allow-external";

impl Reach {
    /// That of a model.
    pub(super) fn of(model: &Path, options: &Options) -> Reach {
        let beside = or_here(&folder_of(model)).canonicalize().ok();
        let target = model.canonicalize().ok().map(folder_of);
        Reach {
            folders: beside.into_iter().chain(target).collect(),
            allows_all: options.allow_external,
        }
    }

    /// Whether what a file in `folder` names so may be read: the one place that decides.
    ///
    /// Where nothing is there, the words of the path decide: what lies elsewhere is not told from what does not.
    pub(super) fn holds(&self, folder: &Path, reference: &Path) -> bool {
        let real = || folder.join(reference).canonicalize().ok();
        let in_words = || Some(followed(or_here(folder).canonicalize().ok()?, reference));
        let lies_below = |path: PathBuf| self.folders.iter().any(|folder| path.starts_with(folder));
        self.allows_all || real().or_else(in_words).is_some_and(lies_below)
    }
}

/// A path from a folder, as its words lead.
fn followed(folder: PathBuf, reference: &Path) -> PathBuf {
    reference
        .components()
        .fold(folder, |mut path, word| match word {
            Component::ParentDir => {
                path.pop();
                path
            }
            other => path.join(other),
        })
}

/// Where a file lies that a model names. One that is not there is left to whoever opens it.
///
/// # Errors
///
/// The end of a sentence about the reference: it leads out of the model's [`Reach`].
pub(super) fn named_by(
    model: &Path,
    reference: &Path,
    options: &Options,
) -> Result<PathBuf, String> {
    let beside_link = folder_of(model);
    let beside_target = model.canonicalize().ok().map(folder_of);
    let is_in = |folder: &Path| folder.join(reference).exists();
    let folder = match beside_target {
        Some(folder) if !is_in(&beside_link) && is_in(&folder) => folder,
        _ => beside_link,
    };
    // An absolute path means one machine's disk, even where it leads back here.
    let is_portable = reference.is_relative() || options.allow_external;
    if is_portable && Reach::of(model, options).holds(&folder, reference) {
        return Ok(folder.join(reference));
    }
    let shown: String = reference.to_string_lossy().chars().take(80).collect();
    let shown = shown.replace(|c: char| c.is_control(), "\u{fffd}");
    Err(format!("\"{shown}\" {LEADS_OUT}"))
}

/// The folder that a file lies in.
fn folder_of(file: impl AsRef<Path>) -> PathBuf {
    file.as_ref()
        .parent()
        .map(Path::to_owned)
        .unwrap_or_default()
}

/// A folder, where nothing stands for the one at hand.
pub(super) fn or_here(folder: &Path) -> &Path {
    match folder.as_os_str().is_empty() {
        true => Path::new("."),
        false => folder,
    }
}

#[cfg(all(test, unix))]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

    use super::*;
    use std::os::unix::fs::symlink;

    /// `out/secret`, and a folder `in` with a file `own`, a file `below/own`, and links out and within.
    fn folders() -> tempfile::TempDir {
        let folder = tempfile::tempdir().unwrap();
        let at = |name: &str| folder.path().join(name);
        fs::create_dir_all(at("in/below")).unwrap();
        fs::create_dir_all(at("out")).unwrap();
        for file in ["in/own", "in/below/own", "in/model.obj", "out/secret"] {
            fs::write(at(file), "x").unwrap();
        }
        symlink("../out/secret", at("in/link-out")).unwrap();
        symlink("../out", at("in/folder-out")).unwrap();
        symlink("/dev/zero", at("in/link-zero")).unwrap();
        symlink("below/own", at("in/link-within")).unwrap();
        symlink("../in/model.obj", at("out/model.obj")).unwrap();
        folder
    }

    fn is_allowed(model: &Path, reference: &str) -> bool {
        named_by(model, Path::new(reference), &Options::default()).is_ok()
    }

    #[test]
    fn what_lies_below_the_folder_is_allowed_and_no_more() {
        let folder = folders();
        let model = folder.path().join("in/model.obj");
        let absolute = folder.path().join("in/own");
        let absolute = absolute.to_str().unwrap();
        for reference in [
            "own",
            "./own",
            "below/own",
            "below/../own",
            "below/../../in/own",
            "link-within",
            "gone",
            "gone/../../in/gone",
        ] {
            assert!(is_allowed(&model, reference), "{reference}");
        }
        for reference in [
            "../out/secret",
            "../out/gone",
            "below/../../out/secret",
            "gone/../../out/gone",
            "link-out",
            "link-zero",
            "folder-out/secret",
            "/dev/zero",
            "/gone",
            absolute,
            "..",
        ] {
            assert!(!is_allowed(&model, reference), "{reference}");
        }
    }

    #[test]
    fn a_model_that_is_a_link_has_two_folders() {
        let folder = folders();
        let link = folder.path().join("out/model.obj");
        let of = |reference: &str| named_by(&link, Path::new(reference), &Options::default());
        let at = |name: &str| folder.path().canonicalize().unwrap().join(name);
        let real = |path: PathBuf| path.canonicalize().unwrap();
        assert_eq!(of("secret").map(real), Ok(at("out/secret")));
        assert_eq!(of("own").map(real), Ok(at("in/own")));
        assert_eq!(of("gone"), Ok(folder.path().join("out/gone")));
        assert_eq!(of("../in/own").map(real), Ok(at("in/own")));
        assert!(of("../secret").is_err());
    }

    #[test]
    fn who_means_it_may_name_anything() {
        let all = Options {
            allow_external: true,
            ..Options::default()
        };
        for (reference, expected) in [("../b", "a/../b"), ("/b", "/b"), ("b", "a/b")] {
            let found = named_by(Path::new("a/model.obj"), Path::new(reference), &all);
            assert_eq!(found, Ok(PathBuf::from(expected)));
        }
    }

    #[test]
    fn a_leading_out_is_said_on_one_line() {
        let problem = named_by(
            Path::new("m.obj"),
            Path::new("../a\nb"),
            &Options::default(),
        );
        let expected = "\"../a\u{fffd}b\" leads out of the model's folder; move the file beside the model, or use --allow-external";
        assert_eq!(problem, Err(expected.into()));
    }
}
