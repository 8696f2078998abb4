//! What is looked at: the triangles of a scene, for framing and exposure.

use crate::framing::Face;
use crate::generate;
use crate::geometry::{Bounds, Triangle};
use crate::material::{Alpha, AlphaMode, Material};
use crate::mesh::Mesh;
use crate::scene::SceneDescription;
use glam::Vec3;
use std::sync::Arc;

/// So many triangles are looked at one by one. Of more, a mesh that stands in several places is looked at as its box: a
/// small file can place one mesh a hundred thousand times.
const FEW: u64 = 1 << 21;

/// The triangles of a scene, in world space, and some on each sphere. Planes have no end, and count for nothing, and
/// neither does what is fully transparent, unless there is nothing else.
///
/// The objects are the scene's instances by their index, and then its spheres.
pub(super) fn faces(scene: &SceneDescription) -> impl Iterator<Item = Face> + Clone {
    let of_instances = scene.instances.iter().map(|instance| instance.material);
    let of_spheres = scene.spheres.iter().map(|sphere| sphere.material);
    let mut used = of_instances.chain(of_spheres);
    let any_is_there = used.any(|material| is_there(&scene.materials[material as usize]));
    let counts =
        move |material: u32| !any_is_there || is_there(&scene.materials[material as usize]);
    let ball = Arc::new(generate::icosphere(2));
    let after_instances = scene.instances.len() as u32;
    let spheres = (after_instances..).zip(&scene.spheres);
    let spheres = spheres.filter(move |(_, sphere)| counts(sphere.material));
    let on_spheres = spheres.flat_map(move |(object, sphere)| {
        let (center, radius) = (sphere.shape.center, sphere.shape.radius);
        let is_clear = is_clear(&scene.materials[sphere.material as usize]);
        let ball = ball.clone();
        (0..ball.triangles.len() as u32).map(move |index| Face {
            triangle: Triangle(ball.triangle(index).0.map(|p| center + p * radius)),
            double_sided: false,
            is_clear,
            object,
        })
    });
    let boxes = Arc::new(boxes(scene));
    let instances = (0..).zip(&scene.instances);
    let instances = instances.filter(move |(_, instance)| counts(instance.material));
    let on_meshes = instances.flat_map(move |(object, instance)| {
        let boxes = boxes.clone();
        let index = instance.mesh as usize;
        let material = &scene.materials[instance.material as usize];
        let (double_sided, is_clear) = (material.double_sided, is_clear(material));
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
                is_clear,
                object,
            }
        })
    });
    on_meshes.chain(on_spheres)
}

/// Whether any of it is seen, as far as that does not depend on a texture.
fn is_there(material: &Material) -> bool {
    let Alpha { mode, coverage, .. } = &material.alpha;
    match mode {
        AlphaMode::Opaque => true,
        AlphaMode::Mask { cutoff } => coverage.factor >= *cutoff,
        AlphaMode::Blend => coverage.factor > 0.0,
    }
}

/// Whether what lies behind it is seen through it.
fn is_clear(material: &Material) -> bool {
    let through = material.transmission.as_ref();
    matches!(material.alpha.mode, AlphaMode::Blend)
        || through.is_some_and(|through| through.share.factor > 0.5)
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
