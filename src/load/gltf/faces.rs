//! What the corners of a primitive make: triangles, points, lines.

use super::Warnings;
use super::accessors;
use super::elements::Elements;
use super::primitive_modes;
use super::primitives::Reader;
use crate::Error;
use crate::mesh::Mesh;
use glam::Vec3;
use gltf::json::accessor::Type;
use gltf::json::mesh::Mode;

/// The index, and a third of a triangle; or of a strip, a whole one.
const BYTES_A_CORNER: u64 = 16;

/// What the corners of a primitive make.
pub(super) enum Faces {
    Triangles(Vec<[u32; 3]>),
    Points(usize),
    Lines(usize),
}

impl Reader<'_> {
    /// Which vertices are drawn as what, all of them in range.
    pub(super) fn faces(
        &self,
        mode: Mode,
        in_stream: Option<Vec<[u32; 3]>>,
        positions: &Elements,
        budget: &mut u64,
        warnings: &mut Warnings,
    ) -> Result<Faces, Error> {
        let count = positions.count;
        if let Some(triangles) = in_stream {
            // A list, whatever the mode.
            self.spend(budget, triangles.len() * 3, BYTES_A_CORNER)?;
            self.check_range(triangles.as_flattened(), count)?;
            return Ok(Faces::Triangles(triangles));
        }
        let indices = self.indices()?;
        let corners = indices.as_ref().map_or(count, |indices| indices.count);
        self.spend(budget, corners, BYTES_A_CORNER)?;
        warnings.add_times(
            "a corner that belongs to no whole triangle is ignored",
            primitive_modes::left_over(mode, corners),
        );
        if let (Mode::Triangles, Some(indices)) = (mode, &indices) {
            let triangles = indices.index_triples();
            self.check_range(triangles.as_flattened(), count)?;
            return Ok(Faces::Triangles(triangles));
        }
        let corners: Vec<u32> = match &indices {
            Some(indices) => indices.indices(),
            None => {
                let end = u32::try_from(count).map_err(|_| {
                    let problem = format!("{count} vertices are more than 32 bits can number");
                    self.document.malformed(self.place.as_str(), problem)
                })?;
                (0..end).collect()
            }
        };
        self.check_range(&corners, count)?;
        Ok(match mode {
            Mode::Points => Faces::Points(corners.len()),
            Mode::Lines | Mode::LineLoop | Mode::LineStrip => {
                Faces::Lines(primitive_modes::lines(mode, corners.len()))
            }
            Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan => {
                Faces::Triangles(primitive_modes::triangles(mode, &corners))
            }
        })
    }

    /// The primitive's indices, if it has any.
    fn indices(&self) -> Result<Option<Elements<'_>>, Error> {
        let Some(accessor) = self.primitive.indices else {
            return Ok(None);
        };
        let place = || format!("{}, indices", self.place);
        let wrong = |problem: String| self.document.malformed(place(), problem);
        let kinds = [Type::Scalar];
        let indices = accessors::read(self.document, self.buffers, accessor.value(), &kinds)
            .map_err(wrong)?;
        if !indices.counts() {
            return Err(wrong(
                "are signed or fractions, expected unsigned integers".into(),
            ));
        }
        Ok(Some(indices))
    }

    fn check_range(&self, corners: &[u32], count: usize) -> Result<(), Error> {
        let Some(vertex) = corners.iter().find(|&&vertex| vertex as usize >= count) else {
            return Ok(());
        };
        let problem = match count.checked_sub(1) {
            Some(last) => format!("index {vertex} is past the last vertex ({last})"),
            None => format!("index {vertex} names a vertex, there are none"),
        };
        Err(self.document.malformed(self.place.as_str(), problem))
    }
}

/// Drops triangles with a position that is no number, and says how many.
pub(super) fn leave_out(mesh: &mut Mesh) -> usize {
    if mesh.positions.iter().all(|position| position.is_finite()) {
        return 0;
    }
    let Mesh {
        positions,
        triangles,
        ..
    } = mesh;
    let before = triangles.len();
    let is_finite = |&vertex: &u32| {
        positions
            .get(vertex as usize)
            .is_some_and(|p| p.is_finite())
    };
    triangles.retain(|corners| corners.iter().all(is_finite));
    for position in positions
        .iter_mut()
        .filter(|position| !position.is_finite())
    {
        *position = Vec3::ZERO;
    }
    before - triangles.len()
}
