//! One primitive of a glTF mesh becomes one mesh of luch.

use super::Warnings;
use super::accessors;
use super::buffers::Buffers;
use super::document::Document;
use super::draco::Unpacked;
use super::elements::Elements;
use super::faces::{Faces, leave_out};
use super::kept::Kept;
use super::{morph_targets, skins};
use crate::Error;
use crate::load::pose::Deformation;
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
    /// Where it is compressed, what was in its stream.
    pub(super) stream: Option<Unpacked>,
    /// As in `mesh "chair", primitive 2`.
    pub(super) place: String,
}

/// Position, normal, tangent, one set of texture coordinates and another attribute.
pub(super) const BYTES_A_VERTEX: u64 = 64;

/// What a primitive draws.
pub(super) enum Drawn {
    /// Triangles, perhaps none, what may change their shape, and how many were left out since a position of theirs is
    /// no number.
    Triangles(Box<(Mesh, Deformation)>, usize),
    /// So many points, which luch does not draw.
    Points(usize),
    /// So many line segments, which luch does not draw.
    Lines(usize),
}

/// What may change the shape of a primitive, and need not be read where nothing does.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Hash)]
pub(super) struct Changing {
    /// Morph targets.
    pub(super) morphs: bool,
    /// Joints.
    pub(super) bends: bool,
}

impl Reader<'_> {
    /// Reads the primitive. `normal_map` is the use of a texture for which it needs tangents.
    ///
    /// # Errors
    ///
    /// An accessor does not fit, an index is past the last vertex, attributes disagree in number, or the geometry is
    /// more than `budget` (corners and vertices), from which it is taken.
    pub(super) fn read(
        mut self,
        mode: Mode,
        normal_map: Option<&TextureUse>,
        changing: Changing,
        budget: &mut u64,
        warnings: &mut Warnings,
    ) -> Result<Drawn, Error> {
        let in_stream = self.stream.as_mut();
        let in_stream = in_stream.map(|stream| std::mem::take(&mut stream.triangles));
        let Some(positions) = self.attribute(&Semantic::Positions, "POSITION", &[Type::Vec3], 0)?
        else {
            warnings.add(format!("{}: has no POSITION and is not drawn", self.place));
            return Ok(Drawn::Triangles(Box::default(), 0));
        };
        let mut triangles = match self.faces(mode, in_stream, &positions, budget, warnings)? {
            Faces::Triangles(triangles) => triangles,
            Faces::Points(count) => return Ok(Drawn::Points(count)),
            Faces::Lines(count) => return Ok(Drawn::Lines(count)),
        };
        let kept = Kept::of(&mut triangles, positions.count);
        self.spend(budget, kept.count(), BYTES_A_VERTEX)?;
        let mut mesh = Mesh {
            positions: kept.gather(&positions, Vec3::from_array),
            triangles,
            ..Mesh::default()
        };
        let left_out = leave_out(&mut mesh);
        let problem = "a triangle with a position that is no number is not drawn";
        warnings.add_times(format!("{}: {problem}", self.place), left_out);
        self.attributes(&mut mesh, &kept, positions.count, warnings)?;
        let mut old_vertices = None;
        if let Some(map) = normal_map {
            (mesh, old_vertices) = self.tangents(mesh, &kept, positions.count, map, warnings)?;
        }
        let mut deformation = Deformation::default();
        if changing.morphs {
            let count = positions.count;
            deformation.targets = self.morph_targets(&mesh, &kept, count, budget, warnings)?;
        }
        if changing.bends {
            self.influences(&mut deformation, &kept, positions.count, budget, warnings)?;
        }
        if let Some(old_vertices) = old_vertices {
            morph_targets::split(&mut deformation.targets, &old_vertices);
            skins::split(&mut deformation, &old_vertices);
        }
        Ok(Drawn::Triangles(Box::new((mesh, deformation)), left_out))
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
            mesh.normals = kept.gather(&normals, |n| Vec3::from_array(n).normalize_or_zero());
            let without = mesh.normals.iter().filter(|&&n| n == Vec3::ZERO).count();
            warnings.add_times(
                "a normal without direction is replaced by its face's",
                without,
            );
        }
        for (set, name) in [(0, "TEXCOORD_0"), (1, "TEXCOORD_1")] {
            let uvs = self.attribute(&Semantic::TexCoords(set), name, &[Type::Vec2], count)?;
            if let (Some(uvs), Some(place)) = (uvs, mesh.uvs.get_mut(set as usize)) {
                *place = kept.gather(&uvs, Vec2::from_array);
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
            mesh.colors = kept.gather(&colors, |[r, g, b, a]| {
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

    /// `mesh` with the file's tangents or, where those or the normals that they belong to lack, with MikkTSpace's and
    /// which of the old vertices each was. The file's stay as they are where the map is turned (KHR_texture_transform):
    /// who wrote them knew of that.
    fn tangents(
        &self,
        mut mesh: Mesh,
        kept: &Kept,
        count: usize,
        map: &TextureUse,
        warnings: &mut Warnings,
    ) -> Result<(Mesh, Option<Vec<usize>>), Error> {
        let set = usize::from(map.uv_set);
        let given = self.attribute(&Semantic::Tangents, "TANGENT", &[Type::Vec4], count)?;
        if let Some(tangents) = given.filter(|_| !mesh.normals.is_empty()) {
            mesh.tangents = kept.gather(&tangents, |tangent| {
                let tangent = Vec4::from_array(tangent);
                let along = tangent.truncate().normalize_or_zero();
                along.extend(if tangent.w < 0.0 { -1.0 } else { 1.0 })
            });
            return Ok((mesh, None));
        }
        if mesh.uvs.get(set).is_none_or(Vec::is_empty) {
            warnings.add(format!(
                "{}: has no TEXCOORD_{set}, so that its normal map is ignored",
                self.place
            ));
            return Ok((mesh, None));
        }
        let split = tangents::add(&mut mesh, set, map.transform.as_ref());
        if let Err(TooCrowded) = split {
            warnings.add(format!(
                "{}: too many corners meet in one point for tangents, so that its normal map is ignored",
                self.place
            ));
        }
        Ok((mesh, split.ok()))
    }

    /// An attribute with at least `count` elements, if the primitive has it.
    pub(super) fn attribute(
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
        let in_stream = self.stream.as_ref();
        let in_stream = in_stream.map_or(Ok(None), |stream| stream.attribute(name, kinds));
        let elements = in_stream
            .transpose()
            .unwrap_or_else(|| accessors::read(self.document, self.buffers, index.value(), kinds))
            .map_err(|problem| self.document.malformed(place(), problem))?;
        if elements.count < count {
            let problem = format!("has {} elements for {count} positions", elements.count);
            return Err(self.document.malformed(place(), problem));
        }
        Ok(Some(elements))
    }

    /// Takes elements from the file's allowance, and their memory.
    pub(super) fn spend(
        &self,
        budget: &mut u64,
        elements: usize,
        bytes_each: u64,
    ) -> Result<(), Error> {
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
