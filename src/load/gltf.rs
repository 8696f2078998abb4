//! gltf

use super::Model;
use crate::Error;
use std::path::Path;

/// Opens a model.
///
/// # Errors
///
/// Not yet.
pub fn open(path: &Path) -> Result<Model, Error> {
    Err(Error::malformed(path, "", "not yet"))
}
