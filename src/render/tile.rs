//! Rectangles of pixels.

use crate::film::Window;
use std::ops::Range;

/// A rectangle of pixels that is rendered in one go; its places are those of the whole picture, as a window's are.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tile {
    pub(super) left: i32,
    pub(super) top: i32,
    pub(super) width: u32,
    pub(super) height: u32,
}

impl Tile {
    /// All of a window.
    pub(super) fn all(window: Window) -> Tile {
        Tile {
            left: window.left,
            top: window.top,
            width: window.width,
            height: window.height,
        }
    }

    /// The columns of its pixels.
    pub(super) fn columns(self) -> Range<i32> {
        self.left..self.left.saturating_add_unsigned(self.width)
    }

    /// The rows of its pixels.
    pub(super) fn rows(self) -> Range<i32> {
        self.top..self.top.saturating_add_unsigned(self.height)
    }

    /// The squares of this side that it falls into, row by row; those at its right and lower sides may be smaller.
    pub(super) fn tiles(self, side: u32) -> impl Iterator<Item = Tile> {
        let [right, bottom] = [self.columns().end, self.rows().end];
        let across = move |top: i32| {
            let lefts = self.columns().step_by(side as usize);
            lefts.map(move |left: i32| Tile {
                left,
                top,
                width: side.min(right.abs_diff(left)),
                height: side.min(bottom.abs_diff(top)),
            })
        };
        self.rows().step_by(side as usize).flat_map(across)
    }

    /// Column and row of its pixels, row by row.
    pub(super) fn pixels(self) -> impl Iterator<Item = [i32; 2]> {
        let across = move |j| self.columns().map(move |i| [i, j]);
        self.rows().flat_map(across)
    }
}
