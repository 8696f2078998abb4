//! Procedural shapes and scenes: for assets, tests, benches and studies. The same on every machine and run.

mod grid;
mod hair;
mod icosphere;
mod interior;
mod knot;
mod random;
mod scattered;
mod sphereflake;
mod terrain;

pub use grid::grid;
pub use hair::{hair, hair_of_width};
pub use icosphere::icosphere;
pub use interior::{Decoration, interior};
pub use knot::knot;
pub use random::Random;
pub use scattered::{scattered_spheres, scattered_triangles};
pub use sphereflake::{sphereflake, sphereflake_of};
pub use terrain::terrain;

use crate::camera::Camera;
use crate::color::Rgb;
use crate::geometry::Sphere;
use crate::light::{Falloff, Light, LightKind};
use crate::material::Material;
use crate::mesh::Mesh;
use crate::scene::{Instance, Object, SceneDescription};
use glam::{DAffine3, DVec3};

/// A scene of one matt mesh and one point light above the camera.
pub fn mesh_scene(mesh: Mesh, camera: Camera) -> SceneDescription {
    let instance = Instance {
        name: String::new(),
        mesh: 0,
        material: 0,
        to_world: DAffine3::IDENTITY,
    };
    SceneDescription {
        meshes: vec![mesh],
        instances: vec![instance],
        ..lit(camera)
    }
}

/// A scene of matt spheres and one point light above the camera.
pub fn sphere_scene(spheres: Vec<Sphere>, camera: Camera) -> SceneDescription {
    let object = |shape| Object {
        name: String::new(),
        shape,
        material: 0,
    };
    SceneDescription {
        spheres: spheres.into_iter().map(object).collect(),
        ..lit(camera)
    }
}

fn lit(camera: Camera) -> SceneDescription {
    let distance = (camera.look_at - camera.position).length();
    let kind = LightKind::Point {
        position: (camera.position + DVec3::Y * distance).as_vec3(),
    };
    let light = Light {
        name: String::new(),
        kind,
        color: Rgb::WHITE,
        intensity: 1.0,
        falloff: Falloff::None,
        range: None,
    };
    SceneDescription {
        materials: vec![Material::matt("matt", Rgb::grey(0.8))],
        lights: vec![light],
        ..SceneDescription::empty(camera)
    }
}

/// Two triangles for each cell of a `columns x rows` grid of vertices, row after row.
fn grid_triangles(columns: u32, rows: u32) -> Vec<[u32; 3]> {
    let cells = (1..rows).flat_map(|j| (1..columns).map(move |i| (i - 1, j - 1)));
    cells
        .flat_map(|(i, j)| {
            let corner = j * columns + i;
            let (right, below) = (corner + 1, corner + columns);
            [[corner, below, right], [right, below, below + 1]]
        })
        .collect()
}
