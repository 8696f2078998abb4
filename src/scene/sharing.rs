//! Which meshes the instances of a scene share, and what all of them take.

use super::layout::{PlacedInstance, triangles_of_instances};
use super::{Instance, SceneDescription};
use crate::geometry::Bounds;
use crate::mesh::Mesh;
use glam::{Affine3, DAffine3};

/// The space of a shared mesh.
///
/// A scene shares meshes only where that saves much: where every instance in world space would take at most twice the
/// triangles of the meshes, or at most 65,536, all are carried there, and a ray never changes its space. A mesh of one
/// instance is carried there in any case, and so is one whose transform cannot be undone. The choice depends on counts alone, before there is any
/// acceleration structure, so that each of them sees the same triangles.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InstanceSpace {
    /// From the mesh's space to the world's.
    pub to_world: Affine3,
    /// Back.
    pub to_object: Affine3,
    /// A box in world space that holds every hit, rounding in either space included.
    pub bounds: Bounds,
}

impl InstanceSpace {
    /// What an error of a point in the mesh's space becomes in the world's, rounding on the way included.
    pub(super) fn error_in_world(&self, error: f32) -> f32 {
        let carried = largest_row_sum(&self.to_world) * error;
        carried + 4.0 * f32::EPSILON * self.bounds.extent()
    }
}

/// So many triangles in all, or fewer, are never worth a second level of search.
const FEW_TRIANGLES: u64 = 65_536;

/// To the world, and back to the mesh's own space.
type ThereAndBack = (Affine3, Affine3);

/// The space of each instance whose mesh is worth sharing, and how many instances each mesh has.
fn spaces(meshes: &[Mesh], instances: &[Instance]) -> (Vec<Option<ThereAndBack>>, Vec<u32>) {
    let in_world = triangles_of_instances(meshes, instances);
    let mut uses = vec![0u32; meshes.len()];
    instances.iter().for_each(|i| uses[i.mesh as usize] += 1);
    let stored: u64 = meshes
        .iter()
        .zip(&uses)
        .filter(|(_, u)| **u > 0)
        .map(|(m, _)| m.triangles.len() as u64)
        .sum();
    let flatten = in_world <= FEW_TRIANGLES || in_world <= 2 * stored;
    let spaces = instances
        .iter()
        .map(|i| {
            if flatten || uses[i.mesh as usize] == 1 {
                None
            } else {
                there_and_back(&i.to_world)
            }
        })
        .collect();
    (spaces, uses)
}

/// What building a search tree takes for each of its primitives, and what stays of it, in bytes.
const TREE_BYTES: u64 = 256;

/// What the meshes that [`place`] makes take, and search trees over them, in bytes. Indices must be in range.
pub(super) fn bytes(scene: &SceneDescription) -> u64 {
    let (spaces, _) = spaces(&scene.meshes, &scene.instances);
    let mut is_shared = vec![false; scene.meshes.len()];
    let of_instances = scene.instances.iter().zip(spaces).map(|(instance, space)| {
        let index = instance.mesh as usize;
        let known = space.is_some() && std::mem::replace(&mut is_shared[index], true);
        let mesh = &scene.meshes[index];
        let of_mesh = mesh.bytes() + mesh.triangles.len() as u64 * TREE_BYTES;
        let of_instance = TREE_BYTES + size_of::<PlacedInstance>() as u64;
        of_instance + if known { 0 } else { of_mesh }
    });
    let of_spheres = scene.spheres.len() as u64 * TREE_BYTES;
    of_instances.fold(of_spheres, u64::saturating_add)
}

/// Carries into world space what is not worth sharing.
pub(super) fn place(
    meshes: Vec<Mesh>,
    instances: Vec<Instance>,
    first_triangle: u32,
) -> (Vec<Mesh>, Vec<PlacedInstance>) {
    let (spaces, mut uses) = spaces(&meshes, &instances);
    // What is left to be used: the last one in world space takes the mesh itself, not a copy of it.
    let mut meshes: Vec<Option<Mesh>> = meshes.into_iter().map(Some).collect();
    let mut shared_as: Vec<Option<u32>> = vec![None; meshes.len()];
    let mut out_meshes: Vec<Mesh> = Vec::new();
    let mut placed = Vec::with_capacity(instances.len());
    let mut first_primitive = first_triangle;
    for (instance, space) in instances.into_iter().zip(spaces) {
        let source = instance.mesh as usize;
        uses[source] -= 1;
        let mesh = match space {
            Some(_) => match shared_as[source] {
                Some(mesh) => mesh,
                None => {
                    out_meshes.push(meshes[source].clone().unwrap_or_default());
                    let mesh = (out_meshes.len() - 1) as u32;
                    shared_as[source] = Some(mesh);
                    mesh
                }
            },
            None => {
                let mesh = if uses[source] == 0 {
                    meshes[source].take()
                } else {
                    meshes[source].clone()
                };
                out_meshes.push(mesh.unwrap_or_default().transformed(&instance.to_world));
                (out_meshes.len() - 1) as u32
            }
        };
        let stored = &out_meshes[mesh as usize];
        let space = space.map(|(to_world, to_object)| InstanceSpace {
            to_world,
            to_object,
            bounds: world_bounds(stored, &to_world, &to_object),
        });
        let count = stored.triangles.len() as u32;
        let Instance { name, material, .. } = instance;
        placed.push(PlacedInstance {
            name,
            mesh,
            material,
            first_primitive,
            space,
        });
        first_primitive += count;
    }
    (out_meshes, placed)
}

/// A transform and its inverse, where it has one that 32 bits can hold.
fn there_and_back(to_world: &DAffine3) -> Option<ThereAndBack> {
    let to_object = to_world.inverse().as_affine3();
    let to_world = to_world.as_affine3();
    (to_world.is_finite() && to_object.is_finite() && to_object.matrix3.determinant() != 0.0)
        .then_some((to_world, to_object))
}

/// The box of an instance: of its eight corners, grown by what rounding in the mesh's space becomes in the world's.
fn world_bounds(mesh: &Mesh, to_world: &Affine3, to_object: &Affine3) -> Bounds {
    let local = mesh.bounds();
    if local.is_empty() {
        return local;
    }
    let corner = |i: u32| {
        let pick = |bit: u32, low: f32, high: f32| if i & bit == 0 { low } else { high };
        let (a, b) = (local.min, local.max);
        to_world.transform_point3(glam::Vec3::new(
            pick(1, a.x, b.x),
            pick(2, a.y, b.y),
            pick(4, a.z, b.z),
        ))
    };
    let bounds = Bounds::around((0..8).map(corner));
    // A ray's origin is rounded in the mesh's space; on the way back the error grows with the stretch of the transform.
    let stretch = largest_row_sum(to_world) * largest_row_sum(to_object);
    bounds.grown(64.0 * f32::EPSILON * stretch * bounds.extent())
}

/// The greatest sum of absolute values in a row: how much a matrix can lengthen, in the maximum norm.
fn largest_row_sum(a: &Affine3) -> f32 {
    let m = a.matrix3;
    (m.x_axis.abs() + m.y_axis.abs() + m.z_axis.abs()).max_element()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::layout::count_primitives;
    use glam::{DVec3, Vec3};

    fn mesh_of(triangles: usize) -> Mesh {
        let positions = vec![Vec3::ZERO, Vec3::X, Vec3::Y];
        Mesh {
            positions,
            triangles: vec![[0, 1, 2]; triangles],
            ..Mesh::default()
        }
    }

    fn instances(count: usize) -> Vec<Instance> {
        let at = |i: usize| DAffine3::from_translation(DVec3::X * i as f64);
        (0..count)
            .map(|i| Instance {
                name: String::new(),
                mesh: 0,
                material: 0,
                to_world: at(i),
            })
            .collect()
    }

    #[test]
    fn a_small_mesh_is_carried_into_the_world_for_each_instance() {
        let (meshes, placed) = place(vec![mesh_of(2)], instances(3), 5);
        assert_eq!(meshes.len(), 3);
        assert_eq!(
            placed.iter().map(|p| p.first_primitive).collect::<Vec<_>>(),
            [5, 7, 9]
        );
        assert!(placed.iter().all(|p| p.space.is_none()));
        assert_eq!(meshes[2].positions[0], Vec3::X * 2.0);
    }

    #[test]
    fn a_large_mesh_is_stored_once() {
        let (meshes, placed) = place(vec![mesh_of(30_000)], instances(3), 0);
        assert_eq!(meshes.len(), 1);
        assert!(placed.iter().all(|p| p.space.is_some()));
    }

    #[test]
    fn a_transform_that_cannot_be_undone_gets_a_mesh_of_its_own() {
        let mut flat = instances(3);
        flat[1].to_world = DAffine3::from_scale(DVec3::new(1.0, 0.0, 1.0));
        let (meshes, placed) = place(vec![mesh_of(30_000)], flat, 0);
        assert_eq!(
            placed.iter().map(|p| p.space.is_some()).collect::<Vec<_>>(),
            [true, false, true]
        );
        assert_eq!((placed[0].mesh, placed[2].mesh, meshes.len()), (0, 0, 2));
    }

    #[test]
    fn more_primitives_than_31_bits_number_are_refused() {
        let scene = |count| SceneDescription {
            meshes: vec![mesh_of(1 << 16)],
            instances: instances(count),
            ..SceneDescription::empty(crate::camera::Camera::looking_at(
                Vec3::Z,
                Vec3::ZERO,
                Vec3::Y,
                1.0,
            ))
        };
        assert!(count_primitives(&scene((1 << 15) - 1)).is_ok());
        assert!(count_primitives(&scene(1 << 15)).is_err());
    }

    #[test]
    fn two_instances_of_a_large_mesh_are_not_worth_a_second_level() {
        let (_, placed) = place(vec![mesh_of(100_000)], instances(2), 0);
        assert!(placed.iter().all(|p| p.space.is_none()));
    }
}
