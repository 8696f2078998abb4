//! Rectangles of pixels.

use super::Settings;

/// A rectangle of pixels that is rendered in one go.
#[derive(Clone, Copy, Debug)]
pub(super) struct Tile {
    pub(super) left: u32,
    pub(super) top: u32,
    pub(super) width: u32,
    pub(super) height: u32,
}

impl Tile {
    /// The whole picture.
    pub(super) fn whole(settings: &Settings) -> Tile {
        Tile {
            left: 0,
            top: 0,
            width: settings.width,
            height: settings.height,
        }
    }

    /// The squares of this side that it falls into, row by row; those at its right and lower sides may be smaller.
    pub(super) fn tiles(self, side: u32) -> impl Iterator<Item = Tile> {
        let [right, bottom] = [self.left + self.width, self.top + self.height];
        let across = move |top| {
            (self.left..right)
                .step_by(side as usize)
                .map(move |left| Tile {
                    left,
                    top,
                    width: side.min(right - left),
                    height: side.min(bottom - top),
                })
        };
        (self.top..bottom).step_by(side as usize).flat_map(across)
    }

    /// Column and row of its pixels, row by row.
    pub(super) fn pixels(self) -> impl Iterator<Item = [u32; 2]> {
        let across = move |j| (self.left..self.left + self.width).map(move |i| [i, j]);
        (self.top..self.top + self.height).flat_map(across)
    }
}
