//! Shapes of a model without triangles: spheres and planes.

use crate::generate;
use crate::geometry::{Plane, Sphere};
use crate::mesh::{Mesh, normal_matrix};
use crate::scene::{Instance, Object, SceneDescription};
use glam::{DAffine3, DVec3, Vec3};

/// A shape in the space of its node.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Analytic {
    /// Which shape.
    pub kind: AnalyticKind,
    /// Whether it is seen from behind, whatever its material says.
    pub double_sided: bool,
    /// An index into the model's materials.
    pub material: u32,
}

/// The shapes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum AnalyticKind {
    /// Around the origin.
    Sphere {
        /// Above zero.
        radius: f32,
    },
    /// All points with y = 0; its front looks along +Y.
    Plane,
    /// A part of that plane around the origin.
    Rectangle {
        /// Along x and z, above zero.
        sides: [f32; 2],
    },
}

/// Axes whose lengths differ by a greater share make an ellipsoid of a sphere.
const ROUND: f64 = 1e-4;
/// What stands for an ellipsoid has 20 * 4^5 triangles.
const SUBDIVISIONS: u32 = 5;

impl Analytic {
    /// Adds the shape where `to_world` puts it, of this material of the scene.
    pub(super) fn add_to(
        &self,
        scene: &mut SceneDescription,
        name: &str,
        material: u32,
        to_world: DAffine3,
    ) {
        let material = self.sided(scene, material);
        let name = name.to_owned();
        let (x, y, z) = (
            to_world.matrix3.x_axis,
            to_world.matrix3.y_axis,
            to_world.matrix3.z_axis,
        );
        match self.kind {
            AnalyticKind::Sphere { radius } if is_turn_and_scale(x, y, z) => {
                scene.spheres.push(Object {
                    name,
                    shape: Sphere {
                        center: to_world.translation.as_vec3(),
                        radius: (f64::from(radius) * x.length()) as f32,
                    },
                    material,
                });
            }
            AnalyticKind::Plane => {
                let normal = normal_matrix(&to_world.matrix3) * DVec3::Y;
                scene.planes.push(Object {
                    name,
                    shape: Plane {
                        point: to_world.translation.as_vec3(),
                        normal: normal.normalize_or(DVec3::Y).as_vec3(),
                    },
                    material,
                });
            }
            AnalyticKind::Sphere { radius } => {
                let mut mesh = generate::icosphere(SUBDIVISIONS);
                mesh.normals.clone_from(&mesh.positions);
                mesh.positions.iter_mut().for_each(|p| *p *= radius);
                push_mesh(scene, name, mesh, material, to_world);
            }
            AnalyticKind::Rectangle { sides: [a, b] } => {
                let corner = |u: f32, v: f32| Vec3::new(a * u, 0.0, b * v);
                let mesh = Mesh {
                    positions: vec![
                        corner(-0.5, -0.5),
                        corner(-0.5, 0.5),
                        corner(0.5, 0.5),
                        corner(0.5, -0.5),
                    ],
                    triangles: vec![[0, 1, 2], [0, 2, 3]],
                    ..Mesh::default()
                };
                push_mesh(scene, name, mesh, material, to_world);
            }
        }
    }

    /// The material, or one that differs from it in being double-sided.
    fn sided(&self, scene: &mut SceneDescription, material: u32) -> u32 {
        match scene.materials.get(material as usize) {
            Some(given) if self.double_sided && !given.double_sided => {
                let given = given.clone();
                scene.materials.push(crate::material::Material {
                    double_sided: true,
                    ..given
                });
                scene.materials.len() as u32 - 1
            }
            _ => material,
        }
    }
}

fn push_mesh(
    scene: &mut SceneDescription,
    name: String,
    mesh: Mesh,
    material: u32,
    to_world: DAffine3,
) {
    scene.instances.push(Instance {
        name,
        mesh: scene.meshes.len() as u32,
        material,
        to_world,
    });
    scene.meshes.push(mesh);
}

/// Whether these axes are square to each other and of one length.
fn is_turn_and_scale(x: DVec3, y: DVec3, z: DVec3) -> bool {
    let scale = x.length_squared();
    let near = |product: f64, expected: f64| (product - expected).abs() <= ROUND * scale;
    near(y.length_squared(), scale)
        && near(z.length_squared(), scale)
        && near(x.dot(y), 0.0)
        && near(y.dot(z), 0.0)
        && near(z.dot(x), 0.0)
}
