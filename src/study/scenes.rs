//! The generated scenes of `luch study scaling`: one shape, ever more finely.

use crate::camera::Camera;
use crate::framing::{Face, Subject, View};
use crate::generate;
use crate::geometry::Triangle;
use crate::mesh::Mesh;
use crate::scene::SceneDescription;
use glam::Vec3;

/// What can be generated.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Shape {
    /// Spheres on spheres, generation after generation.
    Sphereflake,
    /// Hills over a square.
    Terrain,
    /// A cube of spheres in rows.
    Grid,
    /// A ball of bent strips of triangles.
    Hair,
    /// A cube of triangles without order.
    RandomTriangles,
    /// A cube of spheres without order.
    RandomSpheres,
}

/// The fewest primitives of a scene.
pub const FEWEST: u32 = 10;
/// The most primitives of a scene.
pub const MOST: u32 = 10_000_000;
/// The picture that the cameras frame, width over height: narrower ones cut something off at the sides.
const ASPECT: f64 = 4.0 / 3.0;
/// The seed of whatever is random.
const SEED: u64 = 1;

impl Shape {
    /// All, in the order in which they are studied.
    pub const ALL: [Shape; 6] = [
        Shape::Sphereflake,
        Shape::Terrain,
        Shape::Grid,
        Shape::Hair,
        Shape::RandomTriangles,
        Shape::RandomSpheres,
    ];

    /// As on the command line.
    pub fn name(self) -> &'static str {
        match self {
            Shape::Sphereflake => "sphereflake",
            Shape::Terrain => "terrain",
            Shape::Grid => "grid",
            Shape::Hair => "hair",
            Shape::RandomTriangles => "random-triangles",
            Shape::RandomSpheres => "random-spheres",
        }
    }

    /// The shape of this name.
    pub fn named(name: &str) -> Option<Shape> {
        Shape::ALL.into_iter().find(|shape| shape.name() == name)
    }

    /// Whether it is made of triangles; of spheres otherwise.
    pub fn is_of_triangles(self) -> bool {
        matches!(self, Shape::Terrain | Shape::Hair | Shape::RandomTriangles)
    }
}

/// A scene of one shape in as near to `count` primitives as it can have, [`FEWEST`] to [`MOST`]. Its camera is the same
/// for every count and sees all of it, in pictures at least as wide as 4:3.
pub fn generated(shape: Shape, count: u32) -> SceneDescription {
    let count = count.clamp(FEWEST, MOST);
    let camera = camera(shape);
    let of_mesh = |mesh| generate::mesh_scene(mesh, camera);
    let of_spheres = |spheres| generate::sphere_scene(spheres, camera);
    match shape {
        Shape::Sphereflake => of_spheres(generate::sphereflake_of(count)),
        Shape::Terrain => of_mesh(generate::terrain(cells(count), SEED)),
        Shape::Grid => of_spheres(generate::grid(side(count))),
        Shape::Hair => of_mesh(hair(count)),
        Shape::RandomTriangles => of_mesh(generate::scattered_triangles(count, SEED)),
        Shape::RandomSpheres => of_spheres(generate::scattered_spheres(count, SEED)),
    }
}

/// The side of the square of cells, two triangles each, that has nearest to `count` triangles.
fn cells(count: u32) -> u32 {
    let cells = (count / 2).isqrt();
    nearest(count, [cells, cells + 1], |cells| 2 * cells * cells)
}

/// The side of the cube of spheres that has nearest to `count` of them.
fn side(count: u32) -> u32 {
    let side = libm::cbrt(f64::from(count)) as u32;
    nearest(count, [side, side + 1], |side| side * side * side)
}

/// Strips of ten segments; of fewer where there would be hardly any strips.
fn hair(count: u32) -> Mesh {
    let quads = count / 2;
    let segments = (quads.isqrt() / 2).clamp(1, 10);
    let strands = (quads + segments / 2) / segments;
    // As wide as there is room for at the roots: a bald ball at first, dense fur in the end.
    let width = 0.5 / (strands as f32).sqrt();
    generate::hair_of_width(strands, segments, width, SEED)
}

/// Which of two sizes makes a number nearer to `count`, the smaller one where both do.
fn nearest(count: u32, sizes: [u32; 2], made: impl Fn(u32) -> u32) -> u32 {
    let [smaller, larger] = sizes;
    if made(larger).abs_diff(count) < made(smaller).abs_diff(count) {
        larger
    } else {
        smaller
    }
}

/// A camera that sees what is around the shape at any count.
fn camera(shape: Shape) -> Camera {
    let around = match shape {
        Shape::Sphereflake => {
            let spheres = generate::sphereflake(2);
            // A sphere's descendants reach as far from it as its radius: here, those of the last generation have 1/9.
            let balls = spheres.iter().map(|s| ball(s.center, s.radius + 1.0 / 9.0));
            balls.flatten().collect()
        }
        Shape::Terrain => triangles(&generate::terrain(64, SEED)),
        Shape::Hair => ball(Vec3::ZERO, 1.0),
        Shape::Grid | Shape::RandomTriangles | Shape::RandomSpheres => cube(),
    };
    let faces = around.into_iter().map(|triangle| Face {
        triangle,
        double_sided: true,
        is_clear: false,
        object: 0,
    });
    Subject::whole(faces).camera(&View::default(), ASPECT, None)
}

fn ball(center: Vec3, radius: f32) -> Vec<Triangle> {
    let mut ball = generate::icosphere(1);
    for position in &mut ball.positions {
        *position = center + *position * radius;
    }
    triangles(&ball)
}

/// The cube -1..1, as four triangles that have all its corners.
fn cube() -> Vec<Triangle> {
    let side = |z: f32| {
        let corners = [(-1.0, -1.0), (1.0, -1.0), (-1.0, 1.0), (1.0, 1.0)];
        let [a, b, c, d] = corners.map(|(x, y)| Vec3::new(x, y, z));
        [Triangle([a, b, c]), Triangle([d, c, b])]
    };
    [side(-1.0), side(1.0)].concat()
}

fn triangles(mesh: &Mesh) -> Vec<Triangle> {
    let indices = 0..mesh.triangles.len() as u32;
    indices.map(|index| mesh.triangle(index)).collect()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::framing::FOV_Y;
    use crate::scene::Scene;

    fn counted(shape: Shape, count: u32) -> (u32, Scene) {
        let scene = Scene::new(generated(shape, count)).unwrap_or_else(|error| panic!("{error}"));
        (scene.primitive_count(), scene)
    }

    #[test]
    fn names_lead_back_to_shapes() {
        for shape in Shape::ALL {
            assert_eq!(Shape::named(shape.name()), Some(shape));
        }
        assert_eq!(Shape::named("teapot"), None);
    }

    #[test]
    fn every_shape_has_nearly_as_many_primitives_as_asked_for() {
        for shape in Shape::ALL {
            for (count, within) in [(10, 2), (100, 25), (1000, 32), (20_000, 317)] {
                let (made, scene) = counted(shape, count);
                assert!(
                    made.abs_diff(count) <= within,
                    "{shape:?} of {count}: {made}"
                );
                assert_eq!(scene.spheres().is_empty(), shape.is_of_triangles());
            }
        }
        assert_eq!((cells(MOST), side(MOST)), (2236, 215));
        assert_eq!((cells(FEWEST), side(FEWEST)), (2, 2));
    }

    /// How far from the middle of a 4:3 picture something of this radius reaches: 1 at its border.
    fn reach(camera: &Camera, point: Vec3, radius: f32) -> f64 {
        let [u, v, w] = camera.basis();
        let d = point.as_dvec3() - camera.position;
        // A little much near the border, where the picture stretches balls.
        let radius = f64::from(radius) * 1.1;
        let half_height = libm::tan(FOV_Y / 2.0) * d.dot(w);
        let x = (d.dot(u).abs() + radius) / (half_height * ASPECT);
        x.max((d.dot(v).abs() + radius) / half_height)
    }

    #[test]
    fn one_camera_sees_the_whole_of_a_shape_at_every_count_and_is_near_enough() {
        for shape in Shape::ALL {
            for count in [10, 300, 20_000] {
                let scene = generated(shape, count);
                assert_eq!(scene.camera, camera(shape));
                let spheres = scene
                    .spheres
                    .iter()
                    .map(|s| (s.shape.center, s.shape.radius));
                let vertices = scene.meshes.iter().flat_map(|mesh| &mesh.positions);
                let farthest = spheres
                    .chain(vertices.map(|&vertex| (vertex, 0.0)))
                    .map(|(point, radius)| reach(&scene.camera, point, radius))
                    .fold(0.0, f64::max);
                let enough = if count > 10 { 0.6..0.95 } else { 0.4..0.95 };
                assert!(
                    enough.contains(&farthest),
                    "{shape:?} of {count}: {farthest}"
                );
            }
        }
    }

    #[test]
    fn a_count_out_of_range_gives_the_nearest_one_in_it() {
        assert_eq!(counted(Shape::RandomTriangles, 0).0, FEWEST);
    }
}
