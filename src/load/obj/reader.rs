//! A piece of an OBJ file, statement by statement.

use super::colors::Colors;
use super::geometry::{BadLine, Corner, Face};
use super::groups::Runs;
use super::numbers::numbers;
use super::pieces::Counts;
use super::text::{Words, name, shown};
use crate::load::Warnings;
use glam::{Vec2, Vec3};

/// What a piece says.
#[derive(Default)]
pub(super) struct Piece {
    pub(super) positions: Vec<Vec3>,
    pub(super) colors: Colors,
    pub(super) uvs: Vec<Vec2>,
    pub(super) normals: Vec<Vec3>,
    /// As the whole file counts what they name.
    pub(super) corners: Vec<Corner>,
    /// As the piece counts corners.
    pub(super) faces: Vec<Face>,
    pub(super) runs: Runs,
    /// Whether a smoothing group is on at the end; `None` where no `s` says so.
    pub(super) smooths: Option<bool>,
    /// How many faces stand before the first `s`.
    pub(super) faces_before_smooths: usize,
    pub(super) libraries: Vec<String>,
    pub(super) first_dropped: Option<BadLine>,
    pub(super) dropped: usize,
    pub(super) points: usize,
    pub(super) lines: usize,
    /// Vertices with a fourth number.
    pub(super) weighted: usize,
    /// Texture coordinates and normals that corners name and that are not there.
    pub(super) strayed: usize,
    /// Parts of the format that luch lacks, each once.
    pub(super) lacks: Vec<&'static str>,
    pub(super) warnings: Warnings,
}

/// Reads a piece.
pub(super) struct Reader {
    /// How many there are of what indices count before the piece.
    before: Counts,
    /// And in the whole file.
    all: Counts,
    pub(super) piece: Piece,
}

impl Reader {
    pub(super) fn new(before: Counts, all: Counts) -> Reader {
        Reader {
            before,
            all,
            piece: Piece::default(),
        }
    }

    /// How many there are up to the statement at hand, and in the whole file.
    pub(super) fn counts(&self) -> (Counts, Counts) {
        let here = Counts {
            positions: self.before.positions + self.piece.positions.len(),
            uvs: self.before.uvs + self.piece.uvs.len(),
            normals: self.before.normals + self.piece.normals.len(),
            lines: self.before.lines,
        };
        (here, self.all)
    }

    /// Takes a line over.
    pub(super) fn statement(&mut self, line: u32, text: &[u8]) -> Result<(), String> {
        let mut words = Words::of(text);
        let Some(keyword) = words.next() else {
            return Ok(());
        };
        let piece = &mut self.piece;
        let faces = piece.faces.len();
        match keyword {
            b"#MRGB" => {
                let count = self.before.positions + piece.positions.len();
                piece.colors.paint(count, words);
            }
            [b'#', ..] => {}
            b"v" => return piece.vertex(words),
            b"vt" => {
                // Of one coordinate the other is 0; a third is for solid textures.
                let (uv, _) = numbers::<2>(words, 1, "a texture coordinate", "u v")?;
                piece.uvs.push(Vec2::from(uv));
            }
            b"vn" => {
                let (normal, _) = numbers::<3>(words, 3, "a normal", "x y z")?;
                let unit = Vec3::from(normal).as_dvec3().normalize_or_zero();
                piece.normals.push(unit.as_vec3());
            }
            // `fo` is what `f` was called before version 2.11 of the format.
            b"f" | b"fo" => self.face(line, words),
            b"p" => piece.points += words.count(),
            b"l" => piece.lines += words.count().saturating_sub(1),
            b"o" => piece.runs.object(faces, words.rest()),
            b"g" => piece.runs.group(faces, words.rest()),
            b"usemtl" => piece.runs.material(faces, words.rest()),
            b"mtllib" => piece.libraries.push(name(words.rest())),
            b"s" => {
                if piece.smooths.is_none() {
                    piece.faces_before_smooths = faces;
                }
                let is_off = matches!(words.next(), None | Some(b"off" | b"0" | b"null"));
                piece.smooths = Some(!is_off);
            }
            unknown => piece.unknown(unknown),
        }
        Ok(())
    }
}

impl Piece {
    /// `x y z`, or `x y z w`, or `x y z r g b`, or `x y z r g b a`.
    fn vertex(&mut self, words: Words) -> Result<(), String> {
        let (numbers, count) = numbers::<7>(words, 3, "a vertex", "x y z")?;
        let [x, y, z, fourth, g, b, a] = numbers;
        let before = self.positions.len();
        self.positions.push(Vec3::new(x, y, z));
        match count {
            0..=3 => {}
            // A weight for rational curves: polygons have no use for it.
            4 | 5 => self.weighted += usize::from(fourth != 1.0),
            6 => self.colors.give(before, [fourth, g, b, 1.0]),
            _ => self.colors.give(before, [fourth, g, b, a]),
        }
        Ok(())
    }

    fn unknown(&mut self, keyword: &[u8]) {
        let message = format!(
            "statement \"{}\" is not supported and ignored",
            shown(keyword)
        );
        self.warnings.add(message);
        if let Some(part) = part_of_format(keyword)
            && !self.lacks.contains(&part)
        {
            self.lacks.push(part);
        }
    }
}

/// What of the format a statement belongs to that luch does not read.
fn part_of_format(keyword: &[u8]) -> Option<&'static str> {
    Some(match keyword {
        b"vp" | b"cstype" | b"deg" | b"bmat" | b"step" | b"curv" | b"curv2" | b"surf" | b"parm"
        | b"trim" | b"hole" | b"scrv" | b"sp" | b"end" | b"con" | b"ctech" | b"stech" => {
            "curves and surfaces"
        }
        b"call" | b"csh" => "other files and programs (call, csh)",
        b"bevel" | b"c_interp" | b"d_interp" | b"lod" | b"shadow_obj" | b"trace_obj" => {
            "display attributes"
        }
        b"maplib" | b"usemap" => "texture maps of its own (usemap)",
        _ => return None,
    })
}
