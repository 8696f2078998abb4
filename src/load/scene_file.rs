//! Scene files

use super::Asset;
use crate::Error;
use std::path::Path;

/// Opens a scene file.
///
/// # Errors
///
/// Not yet.
pub fn open(path: &Path) -> Result<Asset, Error> {
    Err(Error::malformed(path, "", "not yet"))
}

/// Stub.
pub fn parse(_: &str, path: &Path) -> Result<Asset, Error> {
    open(path)
}
