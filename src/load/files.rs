//! Reading files, the model's own and those it names.

use crate::Error;
use std::fs::{self, Metadata};
use std::path::{Path, PathBuf};

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

/// Reads a whole regular file.
///
/// # Errors
///
/// It does not exist, is a folder, a device or a pipe, or cannot be read.
pub(super) fn read(path: &Path) -> Result<Vec<u8>, Error> {
    let metadata = check(path)?;
    // The system's own files, as in /proc, say that they are empty: some of them never end or wait for ever.
    if metadata.len() == 0 {
        return Ok(Vec::new());
    }
    fs::read(path).map_err(Error::io(path, "read"))
}

/// Where a file that `from` names by the relative reference `reference` lies.
pub(super) fn beside(from: &Path, reference: &Path) -> PathBuf {
    from.parent()
        .map_or_else(|| reference.to_owned(), |folder| folder.join(reference))
}
