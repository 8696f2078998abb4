//! Small scenes with everything that has ever been hard, and rays to match.

use glam::{DAffine3, DVec3, Vec3};
use luch::camera::Camera;
use luch::color::Rgb;
use luch::generate::{self, Random};
use luch::geometry::{Bounds, Plane, Sphere};
use luch::material::{Alpha, AlphaChannel, AlphaMode, Material, Textured};
use luch::mesh::Mesh;
use luch::ray::Ray;
use luch::scene::{Instance, Object, Scene, SceneDescription, SceneError};

/// A scene and what to call it.
pub(crate) struct Named {
    pub(crate) name: &'static str,
    pub(crate) scene: Result<Scene, SceneError>,
}

/// Every scene the oracle is asked about.
pub(crate) fn all() -> Vec<Named> {
    let named = |name, scene| Named { name, scene };
    vec![
        named("empty", empty()),
        named("one triangle", soup_scene(one_triangle())),
        named(
            "one sphere",
            sphere_scene(vec![Sphere {
                center: Vec3::ZERO,
                radius: 1.0,
            }]),
        ),
        named("icosphere", icosphere_scene(2, DAffine3::IDENTITY)),
        named("terrain", mesh_scene(generate::terrain(24, 1))),
        named("hair", mesh_scene(generate::hair(40, 6, 2))),
        named("sphereflake", sphere_scene(generate::sphereflake(2))),
        named("grid of spheres", sphere_scene(generate::grid(5))),
        named("soup", soup_scene(soup(400, 5))),
        named("zero-area triangles", soup_scene(zero_area())),
        named("coincident triangles", coincident_triangles(30)),
        named("nested boxes", soup_scene(nested(60))),
        named("large and small spheres", sphere_scene(large_and_small())),
        named(
            "scaled by 1e-4",
            icosphere_scene(2, DAffine3::from_scale(DVec3::splat(1e-4))),
        ),
        named(
            "scaled by 1e4",
            icosphere_scene(2, DAffine3::from_scale(DVec3::splat(1e4))),
        ),
        named(
            "moved by 1e4",
            icosphere_scene(2, DAffine3::from_translation(DVec3::splat(1e4))),
        ),
        named("planes, spheres and triangles, some transparent", mixed()),
        named("copies", instanced_icospheres(2, &places())),
        named("instances", instanced_icospheres(5, &places())),
    ]
}

/// Rays at a scene: at and along its corners, from its surfaces, parallel to the axes, with zeros of both signs.
pub(crate) fn nasty_rays(scene: &Scene, count: usize) -> Vec<Ray> {
    let mut random = Random::new(11);
    let bounds = if scene.bounds().is_empty() {
        Bounds {
            min: -Vec3::ONE,
            max: Vec3::ONE,
        }
    } else {
        scene.bounds()
    };
    let (center, size) = (bounds.center(), (bounds.max - bounds.min).max_element());
    let axes = [
        Vec3::X,
        Vec3::Y,
        Vec3::Z,
        Vec3::NEG_X,
        Vec3::NEG_Y,
        Vec3::NEG_Z,
    ];
    let vertices: Vec<Vec3> = scene
        .meshes()
        .iter()
        .flat_map(|m| m.positions.iter().copied())
        .take(500)
        .collect();
    let ray = |index: usize| {
        let anywhere = center + random.in_cube() * size;
        let vertex = if vertices.is_empty() {
            anywhere
        } else {
            vertices[index * 7 % vertices.len()]
        };
        let axis = axes[index % 6];
        let (origin, direction) = match index % 8 {
            0 => (anywhere, random.direction()),
            // At a vertex, exactly and along an axis.
            1 => (anywhere, (vertex - anywhere).normalize_or(Vec3::X)),
            2 => (vertex - axis * size, axis),
            // From a vertex, so that t is 0 on several triangles.
            3 => (vertex, random.direction()),
            4 => (vertex, axis),
            // In the faces of the bounding box.
            5 => (bounds.min - axis.abs() * size, axis.abs()),
            // Nearly parallel to an axis.
            6 => (anywhere, (axis + random.in_cube() * 1e-7).normalize()),
            _ => (
                center + random.direction() * (size * 1000.0),
                random.direction(),
            ),
        };
        let limits = match index % 5 {
            0 => (0.0, size),
            1 => (size * 0.5, f32::INFINITY),
            _ => (0.0, f32::INFINITY),
        };
        Ray::new(origin, direction, limits.0, limits.1)
    };
    (0..count).map(ray).collect()
}

fn camera() -> Camera {
    Camera::looking_at(Vec3::new(0.0, 1.0, 4.0), Vec3::ZERO, Vec3::Y, 0.8)
}

pub(crate) fn empty() -> Result<Scene, SceneError> {
    Scene::new(SceneDescription::empty(camera()))
}

pub(crate) fn mesh_scene(mesh: Mesh) -> Result<Scene, SceneError> {
    Scene::new(generate::mesh_scene(mesh, camera()))
}

pub(crate) fn sphere_scene(spheres: Vec<Sphere>) -> Result<Scene, SceneError> {
    Scene::new(generate::sphere_scene(spheres, camera()))
}

/// Triangles that share no vertex.
pub(crate) fn soup_scene(corners: Vec<[Vec3; 3]>) -> Result<Scene, SceneError> {
    let triangles = (0..corners.len() as u32)
        .map(|i| [3 * i, 3 * i + 1, 3 * i + 2])
        .collect();
    mesh_scene(Mesh {
        positions: corners.into_iter().flatten().collect(),
        triangles,
        ..Mesh::default()
    })
}

pub(crate) fn icosphere_scene(subdivisions: u32, to_world: DAffine3) -> Result<Scene, SceneError> {
    mesh_scene(generate::icosphere(subdivisions).transformed(&to_world))
}

pub(crate) fn one_triangle() -> Vec<[Vec3; 3]> {
    vec![[Vec3::ZERO, Vec3::X, Vec3::Y]]
}

pub(crate) fn coincident_triangles(count: usize) -> Result<Scene, SceneError> {
    soup_scene(vec![[Vec3::ZERO, Vec3::X, Vec3::Y]; count])
}

fn soup(count: usize, seed: u64) -> Vec<[Vec3; 3]> {
    let mut random = Random::new(seed);
    (0..count)
        .map(|_| {
            let middle = random.in_cube();
            std::array::from_fn(|_| middle + random.in_cube() * 0.2)
        })
        .collect()
}

fn zero_area() -> Vec<[Vec3; 3]> {
    let mut triangles = soup(50, 9);
    triangles.extend(
        soup(50, 10)
            .into_iter()
            .map(|[a, b, _]| [a, b, (a + b) * 0.5]),
    );
    triangles.extend(soup(50, 12).into_iter().map(|[a, _, _]| [a, a, a]));
    triangles
}

fn nested(count: u32) -> Vec<[Vec3; 3]> {
    (1..=count)
        .map(|i| {
            [
                Vec3::new(-1.0, -1.0, 0.0),
                Vec3::X,
                Vec3::new(0.0, 1.0, 1.0),
            ]
            .map(|p| p * i as f32)
        })
        .collect()
}

fn large_and_small() -> Vec<Sphere> {
    let mut random = Random::new(4);
    let small = (0..50).map(|_| Sphere {
        center: random.in_cube(),
        radius: 1e-6,
    });
    let mut spheres: Vec<Sphere> = small.collect();
    spheres.push(Sphere {
        center: Vec3::new(0.0, -1e6 - 1.0, 0.0),
        radius: 1e6,
    });
    spheres
}

/// A material that lets half of the light through.
pub(crate) fn half_transparent() -> Material {
    let alpha = Alpha {
        mode: AlphaMode::Blend,
        coverage: Textured::uniform(0.5),
        channel: AlphaChannel::Alpha,
    };
    Material {
        alpha,
        ..Material::matt("half", Rgb::grey(0.5))
    }
}

fn mixed() -> Result<Scene, SceneError> {
    let mut scene = generate::mesh_scene(generate::terrain(8, 3), camera());
    scene.materials.push(half_transparent());
    let object = |index: usize, shape| Object {
        name: String::new(),
        shape,
        material: (index % 2) as u32,
    };
    scene.spheres = generate::sphereflake(1)
        .into_iter()
        .enumerate()
        .map(|(i, s)| object(i, s))
        .collect();
    let planes = [
        Plane {
            point: Vec3::new(0.0, -1.0, 0.0),
            normal: Vec3::Y,
        },
        Plane {
            point: Vec3::new(0.0, 0.0, -3.0),
            normal: Vec3::new(0.1, 0.0, 1.0),
        },
        Plane {
            point: Vec3::new(0.0, -1.0, 0.0),
            normal: Vec3::NEG_Y,
        },
    ];
    let plane = |(index, shape)| Object {
        name: String::new(),
        shape,
        material: (index % 2) as u32,
    };
    scene.planes = planes.into_iter().enumerate().map(plane).collect();
    Scene::new(scene)
}

/// Some mirror, and the last makes a mesh flat.
fn places() -> Vec<DAffine3> {
    let place = |i: f64| {
        let scale = DVec3::new(1.0 + i, -0.5, 2.0);
        let turn = glam::DQuat::from_rotation_z(i);
        DAffine3::from_scale_rotation_translation(scale, turn, DVec3::new(i, i * 0.3, 0.0))
    };
    let flat = DAffine3::from_scale(DVec3::new(2.0, 0.0, 2.0));
    let mut places = [0.0, 1.0, 2.0, 3.0].map(place).to_vec();
    places.push(flat);
    places
}

/// A mesh in several places.
pub(crate) fn instanced(mesh: Mesh, places: &[DAffine3]) -> SceneDescription {
    let mut scene = generate::mesh_scene(mesh, camera());
    let instance = |&to_world| Instance {
        name: String::new(),
        mesh: 0,
        material: 0,
        to_world,
    };
    scene.instances = places.iter().map(instance).collect();
    scene
}

/// Instances that share their mesh, as long as that has at least 20,480 triangles (5 subdivisions) and 4 places.
pub(crate) fn instanced_icospheres(
    subdivisions: u32,
    places: &[DAffine3],
) -> Result<Scene, SceneError> {
    Scene::new(instanced(generate::icosphere(subdivisions), places))
}
