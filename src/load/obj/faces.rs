//! Faces: `f` with corners that name a vertex, and perhaps a texture coordinate and a normal.

use super::geometry::{BadLine, Corner, Face, NONE};
use super::numbers::{Index, index};
use super::pieces::Counts;
use super::reader::{Piece, Reader};
use super::text::{Words, shown};

impl Reader {
    /// Takes a face over, or goes on without it: no index after it means another thing for that.
    pub(super) fn face(&mut self, line: u32, words: Words) {
        let (here, all) = self.counts();
        let piece = &mut self.piece;
        let (start, strayed) = (piece.corners.len(), piece.strayed);
        match piece.face(words, start, &here, &all) {
            Ok(true) => return,
            Ok(false) => {}
            Err(problem) => {
                piece.strayed = strayed;
                piece.dropped += 1;
                let bad = BadLine { line, problem };
                piece.first_dropped.get_or_insert(bad);
            }
        }
        piece.corners.truncate(start);
    }
}

impl Piece {
    /// Whether there is a face; of one or two corners it is points or lines.
    fn face(
        &mut self,
        words: Words,
        start: usize,
        here: &Counts,
        all: &Counts,
    ) -> Result<bool, String> {
        for word in words.take_while(|word| !word.starts_with(b"#")) {
            let corner = self.corner(word, here, all)?;
            self.corners.push(corner);
        }
        match self.corners.len() - start {
            0 => return Err("face has no corner, expected 3 or more".into()),
            1 => self.points += 1,
            2 => self.lines += 1,
            _ => {
                self.faces.push(Face {
                    end: self.corners.len() as u32,
                    is_smooth: self.smooths == Some(true),
                });
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Without its vertex a face has no shape; without a texture coordinate or a normal it still has one. What it names
    /// may come later in the file.
    fn corner(&mut self, word: &[u8], here: &Counts, all: &Counts) -> Result<Corner, String> {
        let mut parts = word.split(|&byte| byte == b'/');
        let mut part = |here, all| match parts.next() {
            None | Some([]) => Ok(Index::None),
            Some(digits) => index(digits, here, all),
        };
        let position = part(here.positions, all.positions)?;
        let uv = part(here.uvs, all.uvs)?;
        let normal = part(here.normals, all.normals)?;
        let more = parts.count();
        if more > 0 {
            return Err(format!(
                "face corner \"{}\" has {} numbers, expected at most 3",
                shown(word),
                more + 3
            ));
        }
        let position = match position {
            Index::At(index) => index,
            Index::Nowhere(nowhere) => return Err(nowhere.of("vertex")),
            Index::None => {
                let word = shown(word);
                return Err(format!("face corner \"{word}\" names no vertex"));
            }
        };
        let mut optional = |index| match index {
            Index::At(index) => index,
            Index::None => NONE,
            Index::Nowhere(_) => {
                self.strayed += 1;
                NONE
            }
        };
        Ok(Corner {
            position,
            uv: optional(uv),
            normal: optional(normal),
        })
    }
}
