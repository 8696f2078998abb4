//! Rows of a film, each turned into something by itself.

use crate::film::{Film, Layer};
use rayon::prelude::*;

/// What `f` makes of each row's number, top row first, on the threads of rayon's current pool.
pub(super) fn map_rows<T: Send>(film: &Film, f: impl Fn(usize) -> T + Sync + Send) -> Vec<T> {
    (0..film.height as usize).into_par_iter().map(f).collect()
}

/// The values of row `y` of a layer; none where the layer lacks them.
pub(super) fn row<'a>(film: &Film, layer: &'a Layer, y: usize) -> &'a [f32] {
    let length = film.width as usize * layer.channels.len();
    layer
        .values
        .get(y * length..(y + 1) * length)
        .unwrap_or_default()
}
