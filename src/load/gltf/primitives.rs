//! One primitive of a glTF mesh becomes one mesh of luch.

use super::Warnings;
use super::accessors::{self, Elements};
use super::buffers::Buffers;
use super::document::Document;
use super::primitive_modes;
use crate::Error;
use crate::load::tangents::{self, TooCrowded};
use crate::mesh::Mesh;
use crate::texture::TextureUse;
use glam::{Vec2, Vec3, Vec4};
use gltf::json::accessor::Type;
use gltf::json::mesh::{Mode, Primitive, Semantic};
use gltf::json::validation::Checked;

/// Where a primitive is read from, and what it is called in messages.
pub(super) struct Reader<'a> {
    pub(super) document: &'a Document,
    pub(super) buffers: &'a Buffers<'a>,
    pub(super) primitive: &'a Primitive,
    /// As in `mesh "chair", primitive 2`.
    pub(super) place: String,
}

/// The index, and a third of a triangle; or of a strip, a whole one.
const BYTES_A_CORNER: u64 = 16;
/// Position, normal, tangent, one set of texture coordinates and another attribute.
const BYTES_A_VERTEX: u64 = 64;

/// What a primitive draws.
pub(super) enum Drawn {
    /// Triangles, perhaps none, and how many were left out since a position of theirs is no number.
    Triangles(Mesh, usize),
    /// So many points, which luch does not draw.
    Points(usize),
    /// So many line segments, which luch does not draw.
    Lines(usize),
}

impl Reader<'_> {
    /// Reads the primitive. `normal_map` is the use of a texture for which it needs tangents.
    ///
    /// # Errors
    ///
    /// An accessor does not fit, an index is past the last vertex, attributes disagree in number, or the geometry is
    /// more than `budget` (corners and vertices), from which it is taken.
    pub(super) fn read(
        &self,
        mode: Mode,
        normal_map: Option<&TextureUse>,
        budget: &mut u64,
        warnings: &mut Warnings,
    ) -> Result<Drawn, Error> {
        let Some(positions) = self.attribute(&Semantic::Positions, "POSITION", &[Type::Vec3], 0)?
        else {
            warnings.add(format!("{}: has no POSITION and is not drawn", self.place));
            return Ok(Drawn::Triangles(Mesh::default(), 0));
        };
        let corners = self.corners(&positions, budget)?;
        let left_over = primitive_modes::left_over(mode, corners.len());
        warnings.add_times(
            "a corner that belongs to no whole triangle is ignored",
            left_over,
        );
        match mode {
            Mode::Points => return Ok(Drawn::Points(corners.len())),
            Mode::Lines | Mode::LineLoop | Mode::LineStrip => {
                return Ok(Drawn::Lines(primitive_modes::lines(mode, corners.len())));
            }
            Mode::Triangles | Mode::TriangleStrip | Mode::TriangleFan => {}
        }
        let mut triangles = primitive_modes::triangles(mode, &corners);
        let before = triangles.len();
        let position = |i: usize| Vec3::from(positions.floats::<3>(i));
        triangles.retain(|corners| corners.iter().all(|&i| position(i as usize).is_finite()));
        let left_out = before - triangles.len();
        let problem = "a triangle with a position that is no number is not drawn";
        warnings.add_times(format!("{}: {problem}", self.place), left_out);
        let kept = Kept::of(&mut triangles, positions.count);
        self.spend(budget, kept.count(), BYTES_A_VERTEX)?;
        let mut mesh = Mesh {
            positions: kept.gather(|i| {
                Some(position(i))
                    .filter(|p| p.is_finite())
                    .unwrap_or_default()
            }),
            triangles,
            ..Mesh::default()
        };
        self.attributes(&mut mesh, &kept, positions.count, warnings)?;
        if let Some(map) = normal_map {
            mesh = self.tangents(mesh, &kept, positions.count, map, warnings)?;
        }
        Ok(Drawn::Triangles(mesh, left_out))
    }

    /// Normals, texture coordinates and colours.
    fn attributes(
        &self,
        mesh: &mut Mesh,
        kept: &Kept,
        count: usize,
        warnings: &mut Warnings,
    ) -> Result<(), Error> {
        if let Some(normals) = self.attribute(&Semantic::Normals, "NORMAL", &[Type::Vec3], count)? {
            // A zero is what shading takes for "the face's own".
            mesh.normals = kept.gather(|i| Vec3::from(normals.floats::<3>(i)).normalize_or_zero());
            let without = mesh.normals.iter().filter(|&&n| n == Vec3::ZERO).count();
            warnings.add_times(
                "a normal without direction is replaced by its face's",
                without,
            );
        }
        for (set, name) in [(0, "TEXCOORD_0"), (1, "TEXCOORD_1")] {
            let uvs = self.attribute(&Semantic::TexCoords(set), name, &[Type::Vec2], count)?;
            if let (Some(uvs), Some(place)) = (uvs, mesh.uvs.get_mut(set as usize)) {
                *place = kept.gather(|i| Vec2::from(uvs.floats::<2>(i)));
                let is_nowhere = |uv: &&mut Vec2| !uv.is_finite();
                let nowhere = place.iter_mut().filter(is_nowhere);
                let count = nowhere.map(|uv| *uv = Vec2::ZERO).count();
                let problem = "texture coordinates that are no finite numbers are (0, 0)";
                warnings.add_times(problem, count);
            }
        }
        let kinds = [Type::Vec3, Type::Vec4];
        if let Some(colors) = self.attribute(&Semantic::Colors(0), "COLOR_0", &kinds, count)? {
            let has_alpha = colors.components == 4;
            mesh.colors = kept.gather(|i| {
                let [r, g, b, a] = colors.floats::<4>(i);
                [r, g, b, if has_alpha { a } else { 1.0 }]
            });
            let mut without = 0;
            for channel in mesh.colors.as_flattened_mut() {
                if channel.is_nan() {
                    without += 1;
                    *channel = 0.0; // It multiplies.
                }
                *channel = channel.clamp(0.0, super::BRIGHTEST);
            }
            let problem = "a channel of a vertex colour that is no number is 0";
            warnings.add_times(problem, without);
        }
        Ok(())
    }

    /// `mesh` with the file's tangents or, where those or the normals that they belong to lack, with MikkTSpace's. The
    /// file's stay as they are where the map is turned (KHR_texture_transform): who wrote them knew of that.
    fn tangents(
        &self,
        mut mesh: Mesh,
        kept: &Kept,
        count: usize,
        map: &TextureUse,
        warnings: &mut Warnings,
    ) -> Result<Mesh, Error> {
        let set = usize::from(map.uv_set);
        let given = self.attribute(&Semantic::Tangents, "TANGENT", &[Type::Vec4], count)?;
        if let Some(tangents) = given.filter(|_| !mesh.normals.is_empty()) {
            mesh.tangents = kept.gather(|i| {
                let tangent = Vec4::from(tangents.floats::<4>(i));
                let along = tangent.truncate().normalize_or_zero();
                along.extend(if tangent.w < 0.0 { -1.0 } else { 1.0 })
            });
            return Ok(mesh);
        }
        if mesh.uvs.get(set).is_none_or(Vec::is_empty) {
            warnings.add(format!(
                "{}: has no TEXCOORD_{set}, so that its normal map is ignored",
                self.place
            ));
            return Ok(mesh);
        }
        if let Err(TooCrowded) = tangents::add(&mut mesh, set, map.transform.as_ref()) {
            warnings.add(format!(
                "{}: too many corners meet in one point for tangents, so that its normal map is ignored",
                self.place
            ));
        }
        Ok(mesh)
    }

    /// An attribute with at least `count` elements, if the primitive has it.
    fn attribute(
        &self,
        semantic: &Semantic,
        name: &str,
        kinds: &[Type],
        count: usize,
    ) -> Result<Option<Elements<'_>>, Error> {
        let Some(index) = self
            .primitive
            .attributes
            .get(&Checked::Valid(semantic.clone()))
        else {
            return Ok(None);
        };
        let place = || format!("{}, {name}", self.place);
        let elements = accessors::read(self.document, self.buffers, index.value(), kinds)
            .map_err(|problem| self.document.malformed(place(), problem))?;
        if elements.count < count {
            let problem = format!("has {} elements for {count} positions", elements.count);
            return Err(self.document.malformed(place(), problem));
        }
        Ok(Some(elements))
    }

    /// The vertices in the order in which they are drawn, all of them in range.
    fn corners(&self, positions: &Elements, budget: &mut u64) -> Result<Vec<u32>, Error> {
        let count = positions.count;
        let Some(accessor) = self.primitive.indices else {
            self.spend(budget, count, BYTES_A_CORNER)?;
            let end = u32::try_from(count).map_err(|_| {
                let problem = format!("{count} vertices are more than 32 bits can number");
                self.document.malformed(self.place.as_str(), problem)
            })?;
            return Ok((0..end).collect());
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
        self.spend(budget, indices.count, BYTES_A_CORNER)?;
        let corners: Vec<u32> = (0..indices.count).map(|i| indices.index(i)).collect();
        match corners.iter().find(|&&vertex| vertex as usize >= count) {
            None => Ok(corners),
            Some(vertex) => {
                let problem = match count.checked_sub(1) {
                    Some(last) => format!("index {vertex} is past the last vertex ({last})"),
                    None => format!("index {vertex} names a vertex, there are none"),
                };
                Err(self.document.malformed(self.place.as_str(), problem))
            }
        }
    }

    /// Takes elements from the file's allowance, and their memory.
    fn spend(&self, budget: &mut u64, elements: usize, bytes_each: u64) -> Result<(), Error> {
        let bytes = bytes_each.saturating_mul(elements as u64);
        self.document.take(bytes, self.place.as_str())?;
        match budget.checked_sub(elements as u64) {
            Some(rest) => {
                *budget = rest;
                Ok(())
            }
            None => Err(self.document.malformed(
                self.place.as_str(),
                "the geometry up to here is many times what the buffers hold",
            )),
        }
    }
}

/// Which of an accessor's vertices a mesh keeps. Files share one long accessor between many primitives; each keeps
/// only what it draws.
enum Kept {
    All(usize),
    /// In rising order.
    Some(Vec<u32>),
}

impl Kept {
    /// What `triangles` need of `count` vertices; the triangles then name the kept ones.
    fn of(triangles: &mut [[u32; 3]], count: usize) -> Kept {
        // With so few to gain, vertices stay as they are.
        if count <= triangles.len().saturating_mul(4) {
            return Kept::All(count);
        }
        let mut used: Vec<u32> = triangles.as_flattened().to_vec();
        used.sort_unstable();
        used.dedup();
        for vertex in triangles.as_flattened_mut() {
            *vertex = used.partition_point(|&other| other < *vertex) as u32;
        }
        Kept::Some(used)
    }

    fn count(&self) -> usize {
        match self {
            Kept::All(count) => *count,
            Kept::Some(used) => used.len(),
        }
    }

    fn gather<T>(&self, at: impl Fn(usize) -> T) -> Vec<T> {
        match self {
            Kept::All(count) => (0..*count).map(at).collect(),
            Kept::Some(used) => used.iter().map(|&i| at(i as usize)).collect(),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_small_part_of_a_long_accessor_keeps_its_own_vertices_only() {
        let mut triangles = vec![[90, 7, 40], [40, 7, 3]];
        let kept = Kept::of(&mut triangles, 100);
        assert_eq!(kept.gather(|i| i), [3, 7, 40, 90]);
        assert_eq!(triangles, [[3, 1, 2], [2, 1, 0]]);
    }

    #[test]
    fn a_whole_accessor_is_kept_as_it_is() {
        let mut triangles = vec![[2, 1, 0]];
        assert_eq!(Kept::of(&mut triangles, 4).gather(|i| i), [0, 1, 2, 3]);
        assert_eq!(triangles, [[2, 1, 0]]);
    }
}
