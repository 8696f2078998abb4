//! The colours of vertices: after their coordinates, or after many of them in `#MRGB`.

use super::text::Words;
use crate::color::srgb_to_linear;
use crate::load::Warnings;
use rayon::prelude::*;

/// Colours above this are bytes: some writers leave out the division by 255.
const BRIGHTEST_SHARE: f32 = 2.0;

const WHITE: [f32; 4] = [1.0; 4];

/// Colours as a piece of a file has them.
#[derive(Default)]
pub(super) struct Colors {
    /// Of the piece's first vertices, up to the last that has one.
    given: Vec<[f32; 4]>,
    /// Of `#MRGB`, each with how many vertices the file has before that: it colours the latest of them.
    painted: Vec<(u32, [u8; 3])>,
    brightest: f32,
}

impl Colors {
    /// The colour of a vertex that has `before` others before it in the piece.
    pub(super) fn give(&mut self, before: usize, color: [f32; 4]) {
        self.given.resize(before, WHITE);
        self.given.push(color);
        let most = color.into_iter().fold(0.0, f32::max);
        if most.is_finite() {
            self.brightest = self.brightest.max(most);
        }
    }

    /// ZBrush's colours: eight hexadecimal digits each, a mask, red, green and blue, for as many vertices before it;
    /// the file has `count` before it.
    pub(super) fn paint(&mut self, count: usize, words: Words) {
        for word in words {
            for digits in word.as_chunks::<8>().0 {
                let text = str::from_utf8(digits).unwrap_or_default();
                let Ok(color) = u32::from_str_radix(text, 16) else {
                    return;
                };
                let [_, r, g, b] = color.to_be_bytes();
                self.painted.push((count as u32, [r, g, b]));
            }
        }
    }

    /// Takes over the piece after; the file has `before` vertices before that.
    pub(super) fn append(&mut self, piece: Colors, before: usize) {
        if !piece.given.is_empty() {
            self.given.resize(before, WHITE);
            self.given.extend(piece.given);
        }
        self.painted.extend(piece.painted);
        self.brightest = self.brightest.max(piece.brightest);
    }

    /// Linear colours of all the file's `count` vertices; none where none has one.
    pub(super) fn finish(mut self, count: usize, warnings: &mut Warnings) -> Vec<[f32; 4]> {
        if !self.given.is_empty() || !self.painted.is_empty() {
            self.given.resize(count, WHITE);
        }
        for block in self.painted.chunk_by(|one, other| one.0 == other.0) {
            let end = block.first().map_or(0, |first| first.0 as usize);
            let skipped = block.len().saturating_sub(end);
            let start = end.saturating_sub(block.len());
            let colors = self.given.get_mut(start..end).unwrap_or_default();
            for (color, (_, painted)) in colors.iter_mut().zip(block.iter().skip(skipped)) {
                let [r, g, b] = painted.map(|channel| f32::from(channel) / 255.0);
                *color = [r, g, b, 1.0];
            }
        }
        let are_bytes = self.brightest > BRIGHTEST_SHARE;
        if are_bytes {
            warnings.add("vertex colors go above 1 and are taken as 0 to 255");
        }
        let scale = if are_bytes { 1.0 / 255.0 } else { 1.0 };
        let mended = self.given.par_iter_mut().map(|color| mend(color, scale));
        let broken = mended.filter(|is_broken| *is_broken).count();
        warnings.add_times("a vertex color that is no finite number is white", broken);
        self.given
    }
}

/// Makes a colour linear; whether it was none.
fn mend(color: &mut [f32; 4], scale: f32) -> bool {
    if !color.iter().all(|channel| channel.is_finite()) {
        *color = WHITE;
        return true;
    }
    if *color != WHITE {
        let [r, g, b, a] = *color;
        let scaled = |channel: f32| (channel * scale).clamp(0.0, 1.0);
        let [r, g, b] = [r, g, b].map(|channel| srgb_to_linear(scaled(channel)));
        // An alpha of 1 is opaque in both, and is what colors without alpha have.
        let a = if a > 1.0 { scaled(a) } else { a.max(0.0) };
        *color = [r, g, b, a];
    }
    false
}
