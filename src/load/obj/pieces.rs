//! An OBJ file in pieces of whole lines, which are read at the same time and then joined.
//!
//! First each piece is counted: what a face names by a negative number, and whether it is there at all, depends on how
//! much stands before it. Then each is read. What a piece does not say of the faces at its beginning, their object,
//! group, material and smoothing, is what the pieces before it said last.
//!
//! Where the cuts are depends on the text alone, so that one file gives one model on every machine.

use super::colors::Colors;
use super::geometry::{BadLine, Geometry};
use super::groups::{Runs, Sorted};
use super::reader::{Piece, Reader};
use super::text::{Lines, Words, continued};
use rayon::prelude::*;

/// About how long a piece is, in bytes: small beside what a thread has to do, great beside what a piece costs.
const LENGTH: usize = 1 << 20;

/// How many there are of what indices count, and lines.
#[derive(Clone, Copy, Default)]
pub(super) struct Counts {
    pub(super) positions: usize,
    pub(super) uvs: usize,
    pub(super) normals: usize,
    pub(super) lines: u32,
}

impl Counts {
    fn of(text: &[u8]) -> Counts {
        let mut counts = Counts::default();
        let mut lines = Lines::new(text, 0);
        while let Some(line) = lines.next_line() {
            match Words::of(line.text).next() {
                Some(b"v") => counts.positions += 1,
                Some(b"vt") => counts.uvs += 1,
                Some(b"vn") => counts.normals += 1,
                _ => {}
            }
        }
        counts.lines = lines.number();
        counts
    }

    fn and(self, other: Counts) -> Counts {
        Counts {
            positions: self.positions + other.positions,
            uvs: self.uvs + other.uvs,
            normals: self.normals + other.normals,
            lines: self.lines.saturating_add(other.lines),
        }
    }
}

impl Geometry {
    /// Reads a file's text.
    ///
    /// # Errors
    ///
    /// The first vertex, texture coordinate or normal that makes no sense: without it the indices after it would mean
    /// other things. A face that makes no sense is left out.
    pub(super) fn read(text: &[u8]) -> Result<Geometry, BadLine> {
        Geometry::read_in_pieces(text, LENGTH)
    }

    fn read_in_pieces(text: &[u8], length: usize) -> Result<Geometry, BadLine> {
        let texts = cut(text, length);
        let counts: Vec<Counts> = texts.par_iter().map(|text| Counts::of(text)).collect();
        let mut all = Counts::default();
        let mut before = Vec::with_capacity(counts.len());
        for count in counts {
            before.push(all);
            all = all.and(count);
        }
        let pieces = texts.par_iter().zip(before);
        let pieces: Vec<Result<Piece, BadLine>> = pieces
            .map(|(text, before)| read_piece(text, before, all))
            .collect();
        let mut joined = Joined::of(&all);
        for piece in pieces {
            joined.append(piece?);
        }
        Ok(joined.finish())
    }
}

/// Pieces of whole lines, each a little longer than `length`.
fn cut(text: &[u8], length: usize) -> Vec<&[u8]> {
    let mut pieces = Vec::new();
    let mut rest = text;
    while !rest.is_empty() {
        let mut lines = Lines::new(rest.get(length..).unwrap_or_default(), 0);
        // It may have begun before, and be a comment or not.
        lines.next_raw();
        while lines.next_raw().is_some_and(|l| continued(l).is_some()) {}
        let (piece, after) = rest.split_at(rest.len() - lines.rest().len());
        pieces.push(piece);
        rest = after;
    }
    pieces
}

fn read_piece(text: &[u8], before: Counts, all: Counts) -> Result<Piece, BadLine> {
    let mut reader = Reader::new(before, all);
    let mut lines = Lines::new(text, before.lines);
    while let Some(line) = lines.next_line() {
        let bad = |problem| BadLine {
            line: line.number,
            problem,
        };
        reader.statement(line.number, line.text).map_err(bad)?;
    }
    let mut piece = reader.piece;
    piece.runs.end(piece.faces.len());
    Ok(piece)
}

/// The pieces so far.
#[derive(Default)]
struct Joined {
    geometry: Geometry,
    colors: Colors,
    runs: Runs,
    smooths: bool,
    dropped: usize,
    weighted: usize,
    strayed: usize,
}

impl Joined {
    /// None yet, with room for all.
    fn of(all: &Counts) -> Joined {
        let mut joined = Joined::default();
        joined.geometry.positions.reserve_exact(all.positions);
        joined.geometry.uvs.reserve_exact(all.uvs);
        joined.geometry.normals.reserve_exact(all.normals);
        joined
    }

    fn append(&mut self, mut piece: Piece) {
        let geometry = &mut self.geometry;
        for face in piece.faces.iter_mut().take(match piece.smooths {
            Some(_) => piece.faces_before_smooths,
            None => usize::MAX,
        }) {
            face.is_smooth = self.smooths;
        }
        self.smooths = piece.smooths.unwrap_or(self.smooths);
        self.colors.append(piece.colors, geometry.positions.len());
        self.runs.append(&piece.runs, geometry.faces.len());
        let corners = geometry.corners.len() as u32;
        geometry.positions.append(&mut piece.positions);
        geometry.uvs.append(&mut piece.uvs);
        geometry.normals.append(&mut piece.normals);
        geometry.corners.append(&mut piece.corners);
        geometry
            .faces
            .extend(piece.faces.into_iter().map(|mut face| {
                face.end += corners;
                face
            }));
        geometry.libraries.append(&mut piece.libraries);
        geometry.warnings.append(piece.warnings);
        geometry.points += piece.points;
        geometry.lines += piece.lines;
        for part in piece.lacks {
            if !geometry.lacks.contains(&part) {
                geometry.lacks.push(part);
            }
        }
        if geometry.first_dropped.is_none() {
            geometry.first_dropped = piece.first_dropped;
        }
        self.dropped += piece.dropped;
        self.weighted += piece.weighted;
        self.strayed += piece.strayed;
    }

    fn finish(self) -> Geometry {
        let mut read = self.geometry;
        let warnings = &mut read.warnings;
        read.colors = self.colors.finish(read.positions.len(), warnings);
        warnings.add_times("a point is not drawn", read.points);
        warnings.add_times("a line segment is not drawn", read.lines);
        warnings.add_times(
            "the fourth number of a vertex, its weight, is ignored",
            self.weighted,
        );
        warnings.add_times(
            "a corner names a texture coordinate or a normal that is not there, and has none",
            self.strayed,
        );
        if let Some(BadLine { line, problem }) = &read.first_dropped {
            let first = format!("line {line}: {problem}; the face is left out");
            warnings.add(first);
            warnings.add_times(
                "a further face with a wrong line is left out",
                self.dropped.saturating_sub(1),
            );
        }
        let sorted: Sorted = self.runs.sorted();
        Geometry {
            groups: sorted.groups,
            objects: sorted.objects,
            has_objects: sorted.has_objects,
            materials: sorted.materials,
            ..read
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

    use super::*;

    /// Everything that reaches over lines.
    const TEXT: &str = "\u{fc}\nmtllib a.mtl\nv 0 0 0\nv 1 0 0\r\nv 0 1 0 .5 .25 1\n#MRGB ff102030ff405060\n\
        #MRGB ff708090\nf 1 2 3\no b\nusemtl x\ns 1\nf -1 -2 \\\n -3\nf 4 5 \\\n # 6 \\\nv 0 0 1 2\nvt 1 0\nvn 0 0 2\n\
        # no \\\nf 1//1 2/1 -1/9/-1\ns off\ng gr\u{fc}n\rf 4 3 2\nusemtl\nf 1 3 2\nusemtl y\nf 1 2 99\nf 1 2 -9\n\
        f 1 2\nf 3\ncurv 0 1\ncall a\nl 1 2 3\n#MRGB 00ffffff\np 1\no b\nusemtl x\nf 2 3 4\ncurv 1\ncurv";

    #[test]
    fn wherever_a_text_is_cut_it_says_the_same() {
        let whole = Geometry::read(TEXT.as_bytes()).unwrap();
        assert_eq!((whole.positions.len(), whole.faces.len()), (4, 6));
        assert_eq!(whole.colors.len(), 4);
        assert_eq!(whole.warnings.iter().count(), 9);
        for length in 0..TEXT.len() {
            let pieces = Geometry::read_in_pieces(TEXT.as_bytes(), length).unwrap();
            assert_eq!(format!("{pieces:?}"), format!("{whole:?}"), "{length}");
        }
    }

    #[test]
    fn the_first_wrong_line_is_told_whatever_piece_it_is_in() {
        let text = TEXT.replace("vt 1 0", "vt x\nvn y\nv z");
        let whole = Geometry::read(text.as_bytes()).unwrap_err();
        for length in 0..text.len() {
            let found = Geometry::read_in_pieces(text.as_bytes(), length).unwrap_err();
            assert_eq!(found, whole, "{length}");
        }
    }

    #[test]
    fn pieces_end_where_a_line_ends_that_is_not_continued() {
        let text: &[u8] = b"one\ntwo\\\nthree\n# four \\\nfive\r\nsix\rseven";
        assert_eq!(cut(text, 1), [&text[..15], &text[15..30], &text[30..]]);
        assert_eq!(cut(text, 100), [text]);
        assert!(cut(b"", 1).is_empty());
    }
}
