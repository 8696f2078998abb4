//! What the first pass finds out for the second.

use super::matte::KnownShares;
use super::record::Record;
use crate::color::Rgb;
use crate::whitted::Counts;

/// What is known of every pixel, row by row from the top; nothing where there is no second pass.
#[derive(Debug, Default)]
pub(super) struct Known {
    pub(super) records: Vec<Record>,
    /// What its rays were tested against, where that is wanted.
    pub(super) counts: Vec<Counts>,
    /// The parts of its light, added up, where they are wanted.
    pub(super) parts: Vec<Rgb>,
    /// Whose shares it has, where that is wanted.
    pub(super) shares: Vec<KnownShares>,
}

impl Known {
    /// Whether a pixel's samples differ from one another, or from those of one of the eight pixels around it, in a
    /// picture of this width and height.
    pub(super) fn needs_more(
        &self,
        [width, height]: [u32; 2],
        [i, j]: [u32; 2],
        round: u32,
        tolerance: u32,
    ) -> bool {
        let at = |i: u32, j: u32| self.records.get(j as usize * width as usize + i as usize);
        let Some(record) = at(i, j) else { return false };
        let around = |along: u32, size: u32| along.saturating_sub(1)..(along + 2).min(size);
        let mut neighbours = around(j, height).flat_map(|j| around(i, width).map(move |i| (i, j)));
        record.needs_more(round, tolerance)
            || neighbours
                .any(|(i, j)| at(i, j).is_some_and(|it| record.differs_from(it, tolerance)))
    }
}
