//! What is looked at: the triangles of a scene, for framing and exposure.

use crate::framing::Face;
use crate::generate;
use crate::geometry::{Bounds, Triangle};
use crate::mesh::Mesh;
use crate::scene::SceneDescription;
use glam::Vec3;
use std::sync::Arc;

/// So many triangles are looked at one by one. Of more, a mesh that stands in several places is looked at as its box: a
/// small file can place one mesh a hundred thousand times.
const FEW: u64 = 1 << 21;

/// The triangles of a scene, in world space, and some on each sphere. Planes have no end, and count for nothing.
pub(super) fn faces(scene: &SceneDescription) -> impl Iterator<Item = Face> + Clone {
    let ball = Arc::new(generate::icosphere(2));
    let on_spheres = scene.spheres.iter().flat_map(move |sphere| {
        let (center, radius) = (sphere.shape.center, sphere.shape.radius);
        let ball = ball.clone();
        (0..ball.triangles.len() as u32).map(move |index| Face {
            triangle: Triangle(ball.triangle(index).0.map(|p| center + p * radius)),
            double_sided: false,
        })
    });
    let boxes = Arc::new(boxes(scene));
    let on_meshes = scene.instances.iter().flat_map(move |instance| {
        let boxes = boxes.clone();
        let index = instance.mesh as usize;
        let double_sided = scene.materials[instance.material as usize].double_sided;
        let to_world = instance.to_world.as_affine3();
        let mirrors = instance.to_world.matrix3.determinant() < 0.0;
        let stand_in = |boxes: &[Option<Mesh>]| boxes.get(index).is_some_and(Option::is_some);
        let count = if stand_in(&boxes) {
            BOX.len()
        } else {
            scene.meshes[index].triangles.len()
        };
        (0..count as u32).map(move |number| {
            let whole = &scene.meshes[index];
            let shown = boxes.get(index).and_then(Option::as_ref);
            let mut triangle = shown.unwrap_or(whole).triangle(number);
            triangle.0 = triangle.0.map(|p| to_world.transform_point3(p));
            if mirrors {
                // As the scene has it: fronts stay fronts.
                triangle.0.swap(1, 2);
            }
            Face {
                triangle,
                double_sided,
            }
        })
    });
    on_meshes.chain(on_spheres)
}

/// What [`faces`] take where they are kept, in bytes.
pub(in crate::load) fn bytes_of_faces(scene: &SceneDescription) -> u64 {
    let boxes = boxes(scene);
    let of_instances = scene.instances.iter().map(|instance| {
        let index = instance.mesh as usize;
        match boxes.get(index) {
            Some(Some(_)) => BOX.len() as u64,
            _ => scene.meshes[index].triangles.len() as u64,
        }
    });
    of_instances.sum::<u64>() * size_of::<Face>() as u64
}

/// The boxes of meshes that are not looked at triangle by triangle.
fn boxes(scene: &SceneDescription) -> Vec<Option<Mesh>> {
    let mut uses = vec![0u32; scene.meshes.len()];
    let mut triangles = 0;
    for instance in &scene.instances {
        let index = instance.mesh as usize;
        uses[index] += 1;
        triangles += scene.meshes[index].triangles.len() as u64;
    }
    if triangles <= FEW {
        return Vec::new();
    }
    let meshes = scene.meshes.iter().zip(uses);
    meshes
        .map(|(mesh, uses)| {
            let is_worth_it = uses > 1 && mesh.triangles.len() > BOX.len();
            is_worth_it.then(|| box_around(mesh.bounds()))
        })
        .collect()
}

/// Corners by their number: its bits say in x, y and z whether it is the greater one. Fronts are outside.
const BOX: [[u32; 3]; 12] = [
    [0, 4, 6],
    [0, 6, 2],
    [1, 3, 7],
    [1, 7, 5],
    [0, 1, 5],
    [0, 5, 4],
    [2, 6, 7],
    [2, 7, 3],
    [0, 2, 3],
    [0, 3, 1],
    [4, 5, 7],
    [4, 7, 6],
];

fn box_around(bounds: Bounds) -> Mesh {
    let pick = |greater: bool, axis: usize| {
        let corner = if greater { bounds.max } else { bounds.min };
        corner[axis]
    };
    let corner = |i: u32| {
        Vec3::new(
            pick(i & 1 != 0, 0),
            pick(i & 2 != 0, 1),
            pick(i & 4 != 0, 2),
        )
    };
    Mesh {
        positions: (0..8).map(corner).collect(),
        triangles: BOX.to_vec(),
        ..Mesh::default()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::camera::Camera;
    use crate::color::Rgb;
    use crate::material::Material;
    use crate::scene::Instance;
    use glam::{DAffine3, DVec3};

    fn balls(places: u32) -> SceneDescription {
        let camera = Camera::looking_at(Vec3::Z, Vec3::ZERO, Vec3::Y, 1.0);
        let instances = (0..places).map(|i| Instance {
            name: String::new(),
            mesh: 0,
            material: 0,
            to_world: DAffine3::from_translation(DVec3::X * f64::from(i)),
        });
        SceneDescription {
            meshes: vec![generate::icosphere(4)],
            materials: vec![Material::matt("", Rgb::WHITE)],
            instances: instances.collect(),
            ..SceneDescription::empty(camera)
        }
    }

    #[test]
    fn a_mesh_in_very_many_places_is_looked_at_as_a_box() {
        // 5,120 triangles each: 400 places have fewer than 2^21, 500 more.
        let (few, many) = (balls(400), balls(500));
        assert_eq!(faces(&few).count(), 400 * 5120);
        assert_eq!(faces(&many).count(), 500 * 12);
        let size = size_of::<Face>() as u64;
        assert_eq!(bytes_of_faces(&many), 500 * 12 * size);
        let around = |scene| Bounds::around(faces(scene).flat_map(|face| face.triangle.0));
        let bounds = around(&many);
        assert!((bounds.max.x - 500.0).abs() < 0.01 && (bounds.min.x + 1.0).abs() < 0.01);
        let is_outward = |face: Face| {
            let [a, b, c] = face.triangle.0;
            (b - a).cross(c - a).dot((a + b + c) / 3.0) > 0.0
        };
        assert!(faces(&many).take(12).all(is_outward));
    }
}
