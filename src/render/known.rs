//! What the first pass finds out for the second.

use super::record::Record;
use crate::color::Rgb;
use crate::film::Window;
use crate::whitted::Counts;

/// What is known of every pixel of an area, row by row from the top; nothing where there is no second pass.
#[derive(Debug, Default)]
pub(super) struct Known {
    pub(super) area: Window,
    /// The whole picture.
    pub(super) display: Window,
    pub(super) records: Vec<Record>,
    /// What its rays were tested against, where that is wanted.
    pub(super) counts: Vec<Counts>,
    /// The parts of its light, added up, where they are wanted.
    pub(super) parts: Vec<Rgb>,
}

impl Known {
    /// Whether a pixel's samples differ from one another, or from those of one of the eight pixels around it. What lies
    /// outside the picture is around the pixels outside it alone, so that those inside do not depend on overscan.
    pub(super) fn needs_more(&self, [i, j]: [i32; 2], round: u32, tolerance: u32) -> bool {
        let at = |place| self.area.index(place).and_then(|at| self.records.get(at));
        let Some(record) = at([i, j]) else {
            return false;
        };
        let is_inside = self.display.contains([i, j]);
        let around = |along: i32| along.saturating_sub(1)..=along.saturating_add(1);
        let mut neighbours = around(j)
            .flat_map(|j| around(i).map(move |i| [i, j]))
            .filter(|&place| !is_inside || self.display.contains(place));
        record.needs_more(round, tolerance)
            || neighbours
                .any(|place| at(place).is_some_and(|it| record.differs_from(it, tolerance)))
    }
}
