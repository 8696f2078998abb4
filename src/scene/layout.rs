//! How a scene numbers its primitives.

use super::sharing::InstanceSpace;
use super::{Instance, Scene, SceneDescription, SceneError};
use crate::geometry::Triangle;
use crate::mesh::Mesh;

/// A mesh in its place.
#[derive(Clone, Debug)]
pub struct PlacedInstance {
    /// As in the file; may be empty.
    pub name: String,
    /// An index into the scene's meshes.
    pub mesh: u32,
    /// An index into the scene's materials.
    pub material: u32,
    /// The number of its first triangle among the scene's primitives.
    pub first_primitive: u32,
    /// The way to the mesh's own space, where several instances share it; `None` where the mesh is in world space.
    pub space: Option<InstanceSpace>,
}

/// What a primitive's number stands for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Primitive {
    /// An index into the scene's spheres.
    Sphere(usize),
    /// An index into the scene's planes.
    Plane(usize),
    /// A triangle of an instance's mesh.
    Triangle {
        /// An index into the scene's instances.
        instance: usize,
        /// An index into the triangles of its mesh.
        triangle: u32,
    },
}

/// The instance that was met last: the hits of neighbouring rays tend to lie in one.
#[derive(Clone, Copy, Debug, Default)]
pub struct Recent {
    instance: usize,
    /// Its primitives.
    first: u32,
    count: u32,
}

impl Scene {
    /// What primitive number `primitive` is; numbers come from this scene's own hits.
    pub fn primitive(&self, primitive: u32) -> Primitive {
        self.primitive_near(primitive, &mut Recent::default())
    }

    /// [`Scene::primitive`], at once where it is of the instance that `recent` remembers.
    #[inline]
    pub(super) fn primitive_near(&self, primitive: u32, recent: &mut Recent) -> Primitive {
        let triangle = primitive.wrapping_sub(recent.first);
        if triangle < recent.count {
            return Primitive::Triangle {
                instance: recent.instance,
                triangle,
            };
        }
        self.primitive_anywhere(primitive, recent)
    }

    fn primitive_anywhere(&self, primitive: u32, recent: &mut Recent) -> Primitive {
        let (spheres, planes) = (self.spheres.len(), self.planes.len());
        let number = primitive as usize;
        if number < spheres {
            return Primitive::Sphere(number);
        }
        if number < spheres + planes {
            return Primitive::Plane(number - spheres);
        }
        let instance = self
            .instances
            .partition_point(|i| i.first_primitive <= primitive)
            .saturating_sub(1);
        let placed = &self.instances[instance];
        *recent = Recent {
            instance,
            first: placed.first_primitive,
            count: self.mesh(placed.mesh).triangles.len() as u32,
        };
        Primitive::Triangle {
            instance,
            triangle: primitive - recent.first,
        }
    }

    /// The number of the object that a primitive is of: spheres first, then planes, then instances.
    #[inline]
    pub fn object_of(&self, primitive: u32, recent: &mut Recent) -> u32 {
        match self.primitive_near(primitive, recent) {
            Primitive::Sphere(_) | Primitive::Plane(_) => primitive,
            Primitive::Triangle { instance, .. } => {
                (self.spheres.len() + self.planes.len() + instance) as u32
            }
        }
    }

    /// A triangle in the space of its mesh.
    pub fn triangle(&self, instance: usize, triangle: u32) -> Triangle {
        self.mesh(self.instances[instance].mesh).triangle(triangle)
    }

    /// The index of a primitive's material.
    pub fn material_of(&self, primitive: u32) -> u32 {
        match self.primitive(primitive) {
            Primitive::Sphere(sphere) => self.spheres[sphere].material,
            Primitive::Plane(plane) => self.planes[plane].material,
            Primitive::Triangle { instance, .. } => self.instances[instance].material,
        }
    }
}

/// How many primitives a description has, where 31 bits can number them: search keeps the last one for a mark.
pub(super) fn count_primitives(scene: &SceneDescription) -> Result<u32, SceneError> {
    let count = triangles_of_instances(&scene.meshes, &scene.instances)
        + scene.spheres.len() as u64
        + scene.planes.len() as u64;
    i32::try_from(count)
        .map(i32::cast_unsigned)
        .map_err(|_| SceneError::TooManyPrimitives { count })
}

pub(super) fn triangles_of_instances(meshes: &[Mesh], instances: &[Instance]) -> u64 {
    instances
        .iter()
        .map(|i| meshes[i.mesh as usize].triangles.len() as u64)
        .sum()
}
