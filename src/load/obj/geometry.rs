//! What an OBJ file says: vertices, faces, and which object and material they belong to.

use super::reader::Reader;
use super::text::Lines;
use crate::load::Warnings;
use glam::{Vec2, Vec3};
use std::ops::Range;

/// Stands for a texture coordinate or a normal that a corner does not name.
pub(super) const NONE: u32 = u32::MAX;

/// A corner of a face: indices into the lists of a [`Geometry`], in range, or [`NOWHERE`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Corner {
    pub(super) position: u32,
    /// Or [`NONE`].
    pub(super) uv: u32,
    /// Or [`NONE`].
    pub(super) normal: u32,
}

/// Stands for the corners of a face that is left out.
pub(super) const NOWHERE: Corner = Corner {
    position: NONE,
    uv: NONE,
    normal: NONE,
};

/// A polygon of three corners or more.
#[derive(Clone, Copy, Debug)]
pub(super) struct Face {
    pub(super) line: u32,
    /// Where in the list of corners the next face begins.
    pub(super) end: u32,
    /// Whether a smoothing group is on.
    pub(super) is_smooth: bool,
}

/// Faces of one object and one material.
#[derive(Clone, Debug)]
pub(super) struct Group {
    /// An index into the object names.
    pub(super) object: u32,
    /// An index into the material names; `None` before any `usemtl`.
    pub(super) material: Option<u32>,
    /// Ranges of faces, in the file's order.
    pub(super) faces: Vec<Range<u32>>,
}

/// A wrong line.
#[derive(Debug, PartialEq, Eq)]
pub(super) struct BadLine {
    pub(super) line: u32,
    /// What was expected and found.
    pub(super) problem: String,
}

/// A file's content, every index in range.
#[derive(Debug, Default)]
pub(super) struct Geometry {
    pub(super) positions: Vec<Vec3>,
    /// Linear; empty or as many as positions.
    pub(super) colors: Vec<[f32; 4]>,
    /// As in the file: (0, 0) at the lower left.
    pub(super) uvs: Vec<Vec2>,
    /// Unit length; zero where the file's has no direction.
    pub(super) normals: Vec<Vec3>,
    pub(super) corners: Vec<Corner>,
    pub(super) faces: Vec<Face>,
    /// In the order of their first face.
    pub(super) groups: Vec<Group>,
    /// Of `o`, or of `g` in a file without `o`.
    pub(super) objects: Vec<String>,
    /// Whether there is an `o`.
    pub(super) has_objects: bool,
    /// Of `usemtl`.
    pub(super) materials: Vec<String>,
    /// What stands after each `mtllib`.
    pub(super) libraries: Vec<String>,
    /// The first face that is left out for its wrong line.
    pub(super) first_dropped: Option<BadLine>,
    pub(super) points: usize,
    pub(super) lines: usize,
    pub(super) warnings: Warnings,
}

impl Geometry {
    /// Reads a file's text.
    ///
    /// # Errors
    ///
    /// The first vertex, texture coordinate or normal that makes no sense: without it the indices after it would mean
    /// other things. A face that makes no sense is left out.
    pub(super) fn read(text: &[u8]) -> Result<Geometry, BadLine> {
        let mut reader = Reader::default();
        let mut lines = Lines::new(text);
        while let Some(line) = lines.next_line() {
            let bad = |problem| BadLine {
                line: line.number,
                problem,
            };
            reader.statement(line.number, line.text).map_err(bad)?;
        }
        Ok(reader.finish())
    }

    /// The corners of a face.
    pub(super) fn face(&self, face: u32) -> &[Corner] {
        self.corners.get(self.range(face)).unwrap_or_default()
    }

    /// The corners of a face, to be changed.
    pub(super) fn face_mut(&mut self, face: u32) -> &mut [Corner] {
        let range = self.range(face);
        self.corners.get_mut(range).unwrap_or_default()
    }

    fn range(&self, face: u32) -> Range<usize> {
        let face = face as usize;
        let end_of = |face: usize| self.faces.get(face).map_or(0, |face| face.end as usize);
        face.checked_sub(1).map_or(0, end_of)..end_of(face)
    }
}
