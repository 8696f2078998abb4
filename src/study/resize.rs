//! One model with more or fewer triangles: what `luch study scaling` makes of a file.

mod gather;
mod subdivide;
mod weld;

pub use subdivide::subdivided;

use crate::mesh::Mesh;
use crate::scene::Scene;
use gather::Gather;

/// The most triangles a mesh made here has.
pub const MOST_TRIANGLES: usize = 64_000_000;

/// Every triangle of every instance, in world space: positions and triangles only. Spheres and planes are left out; of
/// more than [`MOST_TRIANGLES`], an even share is taken, since many instances may share a large mesh.
pub fn triangles_of(scene: &Scene) -> Mesh {
    let of_instance = |instance: usize| {
        let placed = scene.instances().get(instance);
        placed.map_or(0, |placed| scene.mesh(placed.mesh).triangles.len())
    };
    let total = (0..scene.instances().len()).map(of_instance).sum();
    let mut chosen = even_share(total, MOST_TRIANGLES).peekable();
    let mut gather = Gather::with_room_for(total.min(MOST_TRIANGLES));
    let mut first = 0;
    for (number, placed) in scene.instances().iter().enumerate() {
        let (mesh, end) = (scene.mesh(placed.mesh), first + of_instance(number));
        let to_world = placed.space.as_ref().map(|space| &space.to_world);
        let here = std::iter::from_fn(|| chosen.next_if(|&triangle| triangle < end));
        gather.add(mesh, here.map(|triangle| triangle - first), to_world);
        first = end;
    }
    gather.mesh
}

/// An even share of exactly `count` triangles, or all where there are no more; vertices that none of them uses are
/// dropped, and so is whatever vertices have besides their positions.
pub fn thinned(mesh: &Mesh, count: usize) -> Mesh {
    let total = mesh.triangles.len();
    let mut gather = Gather::with_room_for(total.min(count));
    gather.add(mesh, even_share(total, count), None);
    gather.mesh
}

/// The mesh with about `count` triangles: [`thinned`] or [`subdivided`].
pub fn resized(mesh: &Mesh, count: usize) -> Mesh {
    if count <= mesh.triangles.len() {
        thinned(mesh, count)
    } else {
        subdivided(mesh, count)
    }
}

/// `count` of the numbers below `total`, or all: every `(total / count)`-th.
fn even_share(total: usize, count: usize) -> impl Iterator<Item = usize> {
    let count = count.min(total);
    (0..count).map(move |i| (i as u128 * total as u128 / count as u128) as usize)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::Camera;
    use crate::generate::{self, icosphere};
    use crate::scene::Instance;
    use glam::{DAffine3, DVec3, Vec3};

    fn camera() -> Camera {
        Camera::looking_at(Vec3::Z * 5.0, Vec3::ZERO, Vec3::Y, 0.6)
    }

    #[test]
    fn a_thinned_mesh_has_exactly_the_triangles_asked_for_and_no_idle_vertex() {
        let sphere = icosphere(2);
        for count in [0, 1, 7, 319, 320, 1000] {
            let few = thinned(&sphere, count);
            assert_eq!(few.triangles.len(), count.min(320));
            for vertex in 0..few.positions.len() as u32 {
                assert!(few.triangles.iter().flatten().any(|&i| i == vertex));
            }
        }
    }

    #[test]
    fn a_share_is_even() {
        assert_eq!(even_share(10, 3).collect::<Vec<_>>(), [0, 3, 6]);
        assert_eq!(even_share(3, 10).collect::<Vec<_>>(), [0, 1, 2]);
        assert_eq!(even_share(0, 10).next(), None);
    }

    #[test]
    fn a_thinned_mesh_keeps_the_shapes_of_its_triangles() {
        let (sphere, few) = (icosphere(1), thinned(&icosphere(1), 8));
        for triangle in 0..8 {
            assert_eq!(few.triangle(triangle), sphere.triangle(triangle * 10));
        }
    }

    #[test]
    fn nothing_stays_nothing() {
        let empty = Mesh::default();
        assert_eq!(resized(&empty, 0), empty);
        assert_eq!(resized(&empty, 1000), empty);
    }

    #[test]
    fn a_corner_that_names_no_vertex_is_at_the_origin() {
        let broken = Mesh {
            positions: vec![Vec3::X, Vec3::Y],
            triangles: vec![[0, 1, 9], [9, u32::MAX, 0]],
            ..Mesh::default()
        };
        assert_eq!(thinned(&broken, 2).triangle(0), broken.triangle(0));
        assert_eq!(resized(&broken, 8).triangles.len(), 8);
    }

    #[test]
    fn every_instance_is_gathered_in_its_place_with_its_front_in_front() -> Result<(), String> {
        let mut scene = generate::mesh_scene(icosphere(1), camera());
        let place = |x: f64, mirror: f64| Instance {
            to_world: DAffine3::from_translation(DVec3::X * x)
                * DAffine3::from_scale(DVec3::new(mirror, 1.0, 1.0)),
            ..scene.instances[0].clone()
        };
        // Enough to be shared: 1000 x 80 triangles are more than the 65,536 that are always carried to the world.
        scene.instances = (0..1000)
            .map(|i| place(f64::from(i) * 3.0, if i % 2 == 0 { 1.0 } else { -1.0 }))
            .collect();
        let scene = Scene::new(scene).map_err(|error| error.to_string())?;
        assert!(scene.instances()[1].space.is_some());

        let all = triangles_of(&scene);
        assert_eq!(all.triangles.len(), 80_000);
        assert_eq!(all.positions.len(), 42_000);
        for triangle in 0..80_000 {
            let center = Vec3::X * ((triangle / 80) as f32 * 3.0);
            let corners = all.triangle(triangle);
            assert!(
                corners
                    .0
                    .iter()
                    .all(|p| ((*p - center).length() - 1.0).abs() < 1e-3)
            );
            assert!(corners.normal().dot(corners.0[0] - center) > 0.0);
        }
        Ok(())
    }

    #[test]
    fn a_scene_without_triangles_gives_an_empty_mesh() -> Result<(), String> {
        let spheres = generate::sphere_scene(generate::grid(2), camera());
        let scene = Scene::new(spheres).map_err(|error| error.to_string())?;
        assert_eq!(triangles_of(&scene), Mesh::default());
        Ok(())
    }
}
