//! Whether tiles cover a picture, each pixel once.

use super::tile::{Tile, window_of as window_of_bounds};
use crate::Error;
use crate::film::Window;

/// All pixels of a picture: those it shows, and a margin as wide on each side as the tiles' widest.
pub(super) fn window_of(tiles: &[Tile]) -> Result<Window, Error> {
    let Some(first) = tiles.first() else {
        return Ok(Window::default());
    };
    let display = window_of_display(first)?;
    let margins = tiles.iter().map(|tile| margin(tile.window, display));
    let margin = margins.max().unwrap_or(0);
    let whole = display.grown(u32::try_from(margin).unwrap_or(u32::MAX));
    for (number, tile) in tiles.iter().enumerate() {
        let mut others = tiles[..number].iter();
        let overlap = others.find_map(|other| Some((other, other.window.shared(tile.window)?)));
        if let Some((other, shared)) = overlap {
            let other = other
                .file
                .to_string_lossy()
                .replace(char::is_control, "\u{fffd}");
            let problem = format!(
                "has the pixels {}, which are in {other}, too, expected each in one tile; leave one of the files out",
                place(shared)
            );
            return Err(Error::malformed(&tile.file, "dataWindow", problem));
        }
    }
    match gap(tiles, whole) {
        Some(gap) => {
            let problem = format!(
                "the picture, {}, lacks the pixels {} in all of the files, expected each in one; render the tile that has them",
                place(whole),
                place(gap)
            );
            Err(Error::malformed(&first.file, "", problem))
        }
        None => Ok(whole),
    }
}

fn window_of_display(first: &Tile) -> Result<Window, Error> {
    window_of_bounds(first.header().shared_attributes.display_window)
        .ok_or_else(|| Error::malformed(&first.file, "displayWindow", "is beyond reason"))
}

/// By how many pixels a window reaches beyond another, on its farthest side.
fn margin(window: Window, display: Window) -> i64 {
    [
        i64::from(display.left) - i64::from(window.left),
        i64::from(display.top) - i64::from(window.top),
        window.right() - display.right(),
        window.bottom() - display.bottom(),
    ]
    .into_iter()
    .fold(0, i64::max)
}

/// The first pixels from the top that no tile has.
fn gap(tiles: &[Tile], whole: Window) -> Option<Window> {
    let mut edges: Vec<i64> = tiles
        .iter()
        .flat_map(|tile| [i64::from(tile.window.top), tile.window.bottom()])
        .chain([whole.top.into(), whole.bottom()])
        .filter(|edge| (i64::from(whole.top)..=whole.bottom()).contains(edge))
        .collect();
    edges.sort_unstable();
    edges.dedup();
    let mut sorted: Vec<Window> = tiles.iter().map(|tile| tile.window).collect();
    sorted.sort_by_key(|window| window.left);
    for rows in edges.windows(2) {
        let &[from, to] = rows else { continue };
        let across = sorted
            .iter()
            .filter(|window| i64::from(window.top) <= from && from < window.bottom());
        let mut covered = i64::from(whole.left);
        let mut missing = None;
        for window in across {
            if i64::from(window.left) > covered {
                missing = Some(i64::from(window.left));
                break;
            }
            covered = covered.max(window.right());
        }
        let end = missing.unwrap_or(whole.right());
        if covered < end {
            return Some(Window {
                left: i32::try_from(covered).ok()?,
                top: i32::try_from(from).ok()?,
                width: u32::try_from(end - covered).ok()?,
                height: u32::try_from(to - from).ok()?,
            });
        }
    }
    None
}

/// A window as `--crop` takes it.
fn place(window: Window) -> String {
    let (right, bottom) = (window.right(), window.bottom());
    format!("{},{},{right},{bottom}", window.left, window.top)
}
