//! The errors of the doors: which file, where in it, what was expected and found, and the way out.

use crate::scene::SceneError;
use std::fmt;
use std::io;
use std::path::{Path, PathBuf};

/// Why a file could not become a scene, or a film a file.
///
/// `Display` is one line; the cause, where there is one, stands in `source`.
#[derive(Debug, thiserror::Error)]
pub enum Error {
    /// The operating system refused.
    #[error("{}: cannot {doing}: {reason}", shown(file))]
    Io {
        /// The file.
        file: PathBuf,
        /// What was being done, as in "cannot read".
        doing: &'static str,
        /// What the system said. It is in the message, so it is no `source`.
        reason: io::Error,
    },
    /// The file is wrong.
    #[error("{}: {}{problem}", shown(file), Place(place))]
    Malformed {
        /// The file.
        file: PathBuf,
        /// Where in it, as in `mesh "chair", primitive 2`; may be empty.
        place: String,
        /// What was expected and found.
        problem: String,
        /// A reader's own words.
        source: Option<Box<dyn std::error::Error + Send + Sync>>,
    },
    /// The file is right, and luch does not do what it asks.
    #[error("{}: {what}; {way_out}", shown(file))]
    Unsupported {
        /// The file.
        file: PathBuf,
        /// What it asks, as in "needs KHR_example, which is not supported".
        what: String,
        /// What to do, as in "re-export without it".
        way_out: String,
    },
    /// The file is right, and there is not the memory for it.
    #[error("{}: {}{problem}", shown(file), What(what))]
    OutOfMemory {
        /// The file.
        file: PathBuf,
        /// What of it, as in `mesh "chair"`; all of it where empty.
        what: String,
        /// How much it takes, and how much there is.
        problem: OutOfMemory,
    },
    /// What the file says makes no scene.
    #[error("{}: {problem}", shown(file))]
    Scene {
        /// The file.
        file: PathBuf,
        /// What is wrong with it.
        problem: SceneError,
    },
}

impl Error {
    /// A [`Error::Malformed`] without a reader's own words.
    pub fn malformed(file: &Path, place: impl Into<String>, problem: impl Into<String>) -> Error {
        Error::Malformed {
            file: file.to_owned(),
            place: place.into(),
            problem: problem.into(),
            source: None,
        }
    }

    /// A closure that makes an [`Error::Io`] of what the system said.
    pub fn io(file: &Path, doing: &'static str) -> impl FnOnce(io::Error) -> Error {
        let file = file.to_owned();
        move |reason| Error::Io {
            file,
            doing,
            reason,
        }
    }
}

/// Something takes more memory than is left.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct OutOfMemory {
    /// What it takes, in bytes.
    pub needs: u64,
    /// What there is for it, in bytes.
    pub left: u64,
}

impl OutOfMemory {
    /// An error of `what` in a file, as in "mesh 3".
    pub(crate) fn of(self, file: &Path, what: impl Into<String>) -> Error {
        Error::OutOfMemory {
            file: file.to_owned(),
            what: what.into(),
            problem: self,
        }
    }
}

impl fmt::Display for OutOfMemory {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let megabytes = |bytes: u64| bytes.div_ceil(1_000_000);
        let (needs, left) = (megabytes(self.needs), self.left / 1_000_000);
        write!(
            f,
            "takes {needs} MB of memory, {left} MB are left; make it smaller, or allow more with --max-memory"
        )
    }
}

/// A place and what parts it from the problem, or nothing.
struct Place<'a>(&'a str);

impl fmt::Display for Place<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.0.is_empty() {
            Ok(())
        } else {
            write!(f, "{}: ", self.0)
        }
    }
}

/// What a sentence is about, or nothing.
struct What<'a>(&'a str);

impl fmt::Display for What<'_> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        if self.0.is_empty() {
            Ok(())
        } else {
            write!(f, "{} ", self.0)
        }
    }
}

/// A path on one line, whatever characters it has.
fn shown(path: &Path) -> String {
    path.to_string_lossy()
        .chars()
        .map(|c| if c.is_control() { '\u{fffd}' } else { c })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_error_is_one_line_with_file_place_and_problem() {
        let error = Error::malformed(
            Path::new("a\nb.glb"),
            "mesh \"chair\"",
            "index 91 is past the last vertex (88)",
        );
        assert_eq!(
            error.to_string(),
            "a\u{fffd}b.glb: mesh \"chair\": index 91 is past the last vertex (88)"
        );
    }

    #[test]
    fn an_empty_place_leaves_no_trace() {
        assert_eq!(
            Error::malformed(Path::new("x"), "", "is empty").to_string(),
            "x: is empty"
        );
    }
}
