//! An OBJ file, statement by statement.

use super::geometry::{BadLine, Corner, Face, Geometry, Group, NONE, NOWHERE};
use super::numbers::{Index, index, no_such, numbers};
use super::text::{Words, name, shown};
use crate::color::srgb_to_linear;
use glam::{Vec2, Vec3};
use std::collections::HashMap;
use std::ops::Range;

/// Vertex colours above this are bytes: some writers leave out the division by 255.
const BRIGHTEST_SHARE: f32 = 2.0;

const WHITE: [f32; 4] = [1.0; 4];

/// Names in the order in which they first appear.
#[derive(Default)]
struct Names {
    list: Vec<String>,
    indices: HashMap<Vec<u8>, u32>,
}

impl Names {
    fn index(&mut self, bytes: &[u8]) -> u32 {
        if let Some(&known) = self.indices.get(bytes) {
            return known;
        }
        let index = self.list.len() as u32;
        self.list.push(name(bytes));
        self.indices.insert(bytes.to_owned(), index);
        index
    }
}

/// Faces between two statements that change what they belong to.
struct Run {
    object: Option<u32>,
    group: Option<u32>,
    material: Option<u32>,
    faces: Range<u32>,
}

/// What was read so far, and what the next face belongs to.
#[derive(Default)]
pub(super) struct Reader {
    read: Geometry,
    objects: Names,
    groups: Names,
    materials: Names,
    object: Option<u32>,
    group: Option<u32>,
    material: Option<u32>,
    runs: Vec<Run>,
    run_start: u32,
    smooths: bool,
    /// Colours of `#MRGB`, of the vertices just before the next one.
    painted: Vec<[u8; 3]>,
    dropped: usize,
    weighted: usize,
    strayed: usize,
    brightest: f32,
}

impl Reader {
    /// Takes a line over.
    pub(super) fn statement(&mut self, line: u32, text: &[u8]) -> Result<(), String> {
        let mut words = Words::of(text);
        let Some(keyword) = words.next() else {
            return Ok(());
        };
        match keyword {
            b"#MRGB" => self.polypaint(words),
            [b'#', ..] => {}
            b"v" => return self.vertex(words),
            b"vt" => {
                // Of one coordinate the other is 0; a third is for solid textures.
                let (uv, _) = numbers::<2>(words, 1, "a texture coordinate", "u v")?;
                self.read.uvs.push(Vec2::from(uv));
            }
            b"vn" => {
                let (normal, _) = numbers::<3>(words, 3, "a normal", "x y z")?;
                let unit = Vec3::from(normal).as_dvec3().normalize_or_zero();
                self.read.normals.push(unit.as_vec3());
            }
            // `fo` is what `f` was called before version 2.11 of the format.
            b"f" | b"fo" => {
                let start = self.read.corners.len();
                if let Err(problem) = self.face(line, words) {
                    self.read.corners.truncate(start);
                    self.drop_face(line, problem);
                }
            }
            b"p" => self.read.points += words.count(),
            b"l" => self.read.lines += words.count().saturating_sub(1),
            b"o" => {
                self.end_run();
                self.object = Some(self.objects.index(words.rest()));
            }
            b"g" => {
                self.end_run();
                self.group = Some(self.groups.index(words.rest()));
            }
            b"usemtl" => {
                self.end_run();
                let name = words.rest();
                self.material = (!name.is_empty()).then(|| self.materials.index(name));
            }
            b"mtllib" => self.read.libraries.push(name(words.rest())),
            b"s" => self.smooths = !matches!(words.next(), None | Some(b"off" | b"0" | b"null")),
            unknown => self.read.warnings.add(format!(
                "statement \"{}\" is not supported and ignored",
                shown(unknown)
            )),
        }
        Ok(())
    }

    /// `x y z`, or `x y z w`, or `x y z r g b`, or `x y z r g b a`.
    fn vertex(&mut self, words: Words) -> Result<(), String> {
        let (numbers, count) = numbers::<7>(words, 3, "a vertex", "x y z")?;
        let [x, y, z, fourth, g, b, a] = numbers;
        self.end_polypaint();
        let before = self.read.positions.len();
        self.read.positions.push(Vec3::new(x, y, z));
        let color = match count {
            0..=3 => None,
            4 | 5 => {
                // A weight for rational curves: polygons have no use for it.
                self.weighted += usize::from(fourth != 1.0);
                None
            }
            6 => Some([fourth, g, b, 1.0]),
            _ => Some([fourth, g, b, a]),
        };
        if let Some(color) = color {
            self.read.colors.resize(before, WHITE);
            self.read.colors.push(color);
            let most = color.into_iter().fold(0.0, f32::max);
            if most.is_finite() {
                self.brightest = self.brightest.max(most);
            }
        } else if !self.read.colors.is_empty() {
            self.read.colors.push(WHITE);
        }
        Ok(())
    }

    /// ZBrush's colours: eight hexadecimal digits each, a mask, red, green and blue, for as many vertices before it.
    fn polypaint(&mut self, words: Words) {
        for word in words {
            for digits in word.as_chunks::<8>().0 {
                let text = str::from_utf8(digits).unwrap_or_default();
                let Ok(color) = u32::from_str_radix(text, 16) else {
                    return;
                };
                let [_, r, g, b] = color.to_be_bytes();
                self.painted.push([r, g, b]);
            }
        }
    }

    /// Gives the colours of `#MRGB` to their vertices, the latest.
    fn end_polypaint(&mut self) {
        if self.painted.is_empty() {
            return;
        }
        let count = self.read.positions.len();
        self.read.colors.resize(count, WHITE);
        let skipped = self.painted.len().saturating_sub(count);
        let first = count.saturating_sub(self.painted.len());
        let colors = self.read.colors.get_mut(first..).unwrap_or_default();
        for (color, painted) in colors.iter_mut().zip(self.painted.iter().skip(skipped)) {
            let [r, g, b] = painted.map(|channel| f32::from(channel) / 255.0);
            *color = [r, g, b, 1.0];
        }
        self.painted.clear();
    }

    fn face(&mut self, line: u32, words: Words) -> Result<(), String> {
        let start = self.read.corners.len();
        for word in words.take_while(|word| !word.starts_with(b"#")) {
            let corner = self.corner(word)?;
            self.read.corners.push(corner);
        }
        match self.read.corners.len() - start {
            0 => return Err("face has no corner, expected 3 or more".into()),
            1 => self.read.points += 1,
            2 => self.read.lines += 1,
            _ => {
                let end = self.read.corners.len() as u32;
                let is_smooth = self.smooths;
                self.read.faces.push(Face {
                    line,
                    end,
                    is_smooth,
                });
                return Ok(());
            }
        }
        self.read.corners.truncate(start);
        Ok(())
    }

    /// Goes on without a face: no index after it means another thing for that.
    fn drop_face(&mut self, line: u32, problem: String) {
        self.dropped += 1;
        let first = &mut self.read.first_dropped;
        if first.as_ref().is_none_or(|first| line < first.line) {
            *first = Some(BadLine { line, problem });
        }
    }

    fn corner(&mut self, word: &[u8]) -> Result<Corner, String> {
        let mut parts = word.split(|&byte| byte == b'/');
        let mut part = |kind, count| match parts.next() {
            None | Some([]) => Ok(Index::None),
            Some(digits) => index(digits, kind, count),
        };
        let position = part("vertex", self.read.positions.len())?;
        let uv = part("texture coordinate", self.read.uvs.len())?;
        let normal = part("normal", self.read.normals.len())?;
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
            Index::Nowhere(problem) => return Err(problem),
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

    fn end_run(&mut self) {
        let end = self.read.faces.len() as u32;
        if end > self.run_start {
            self.runs.push(Run {
                object: self.object,
                group: self.group,
                material: self.material,
                faces: self.run_start..end,
            });
        }
        self.run_start = end;
    }

    /// All of it, checked.
    pub(super) fn finish(mut self) -> Geometry {
        self.end_run();
        self.end_polypaint();
        self.check_indices();
        self.sort_into_groups();
        self.finish_colors();
        let warnings = &mut self.read.warnings;
        warnings.add_times("a point is not drawn", self.read.points);
        warnings.add_times("a line segment is not drawn", self.read.lines);
        warnings.add_times(
            "the fourth number of a vertex, its weight, is ignored",
            self.weighted,
        );
        warnings.add_times(
            "a corner names a texture coordinate or a normal that is not there, and has none",
            self.strayed,
        );
        if let Some(BadLine { line, problem }) = &self.read.first_dropped {
            let first = format!("line {line}: {problem}; the face is left out");
            warnings.add(first);
            warnings.add_times(
                "a further face with a wrong line is left out",
                self.dropped.saturating_sub(1),
            );
        }
        self.read.materials = self.materials.list;
        self.read
    }

    /// Only now: a face may name vertices that come after it. Without its vertex a face has no shape and is left out;
    /// without a texture coordinate or a normal it still has one.
    fn check_indices(&mut self) {
        let read = &mut self.read;
        let count = read.positions.len();
        let (uvs, normals) = (read.uvs.len(), read.normals.len());
        let mut start = 0;
        let mut missing = Vec::new();
        for face in &read.faces {
            let end = face.end as usize;
            let corners = read.corners.get_mut(start..end).unwrap_or_default();
            start = end;
            if let Some(bad) = corners.iter().find(|c| c.position as usize >= count) {
                missing.push((face.line, u64::from(bad.position) + 1));
                corners.iter_mut().for_each(|corner| *corner = NOWHERE);
                continue;
            }
            for corner in corners {
                for (index, count) in [(&mut corner.uv, uvs), (&mut corner.normal, normals)] {
                    if *index as usize >= count && *index != NONE {
                        *index = NONE;
                        self.strayed += 1;
                    }
                }
            }
        }
        for (line, index) in missing {
            self.drop_face(line, no_such("vertex", index, count));
        }
    }

    fn sort_into_groups(&mut self) {
        let has_objects = !self.objects.list.is_empty();
        self.read.has_objects = has_objects;
        let mut names = if has_objects {
            std::mem::take(&mut self.objects)
        } else {
            std::mem::take(&mut self.groups)
        };
        let mut known: HashMap<(u32, Option<u32>), usize> = HashMap::new();
        for run in &self.runs {
            let object = if has_objects { run.object } else { run.group };
            let object = object.unwrap_or_else(|| names.index(b""));
            let next = self.read.groups.len();
            let at = *known.entry((object, run.material)).or_insert(next);
            match self.read.groups.get_mut(at) {
                Some(group) => group.faces.push(run.faces.clone()),
                None => self.read.groups.push(Group {
                    object,
                    material: run.material,
                    faces: vec![run.faces.clone()],
                }),
            }
        }
        self.read.objects = names.list;
    }

    fn finish_colors(&mut self) {
        let are_bytes = self.brightest > BRIGHTEST_SHARE;
        let scale = if are_bytes { 1.0 / 255.0 } else { 1.0 };
        if are_bytes {
            self.read
                .warnings
                .add("vertex colors go above 1 and are taken as 0 to 255");
        }
        let mut broken = 0;
        for color in &mut self.read.colors {
            if !color.iter().all(|channel| channel.is_finite()) {
                *color = WHITE;
                broken += 1;
            } else if *color != WHITE {
                let [r, g, b, a] = *color;
                let scaled = |channel: f32| (channel * scale).clamp(0.0, 1.0);
                let [r, g, b] = [r, g, b].map(|channel| srgb_to_linear(scaled(channel)));
                // An alpha of 1 is opaque in both, and is what colors without alpha have.
                let a = if a > 1.0 { scaled(a) } else { a.max(0.0) };
                *color = [r, g, b, a];
            }
        }
        self.read
            .warnings
            .add_times("a vertex color that is no finite number is white", broken);
    }
}
