//! From a hit to the surface there: point, normals, and every texture looked up.

use super::{PlacedInstance, Primitive, Scene};
use crate::color::Rgb;
use crate::geometry::{Hit, SurfacePoint};
use crate::material::{
    Alpha, AlphaChannel, AlphaMode, Material, Model, NormalMap, Phong, Textured,
};
use crate::mesh::{Mesh, normal_matrix};
use crate::ray::Ray;
use crate::shade::{Reflectance, metallic_roughness};
use crate::texture::TextureUse;
use glam::{Vec2, Vec3, Vec4};

/// A surface where a ray met it.
#[derive(Clone, Copy, Debug)]
pub struct Surface {
    /// The point itself.
    pub point: SurfacePoint,
    /// The unit normal that shading uses, turned toward the viewer.
    pub normal: Vec3,
    /// Whether light changes it: false for KHR_materials_unlit, whose colour is in `reflectance.emission`.
    pub lit: bool,
    /// How it answers light.
    pub reflectance: Reflectance,
    /// The share of the ray that ends here; 0 where the surface is not there for this ray.
    pub coverage: f32,
}

/// What interpolation over a primitive gives; neutral where the mesh says nothing.
struct Vertex {
    normal: Vec3,
    tangent: Vec4,
    uvs: [Vec2; 2],
    color: [f32; 4],
}

impl Scene {
    /// The surface that `ray` met at `hit`, as a viewer along the ray sees it.
    pub fn surface(&self, ray: &Ray, hit: &Hit) -> Surface {
        let primitive = self.primitive(hit.primitive);
        let material = self.material(self.material_of(hit.primitive));
        let (point, vertex) = match primitive {
            Primitive::Sphere(sphere) => {
                plain(self.spheres[sphere].shape.surface_point(ray, hit.t))
            }
            Primitive::Plane(plane) => plain(self.planes[plane].shape.surface_point(ray)),
            Primitive::Triangle { instance, triangle } => {
                let instance = &self.instances[instance];
                corner_mix(
                    instance,
                    self.mesh(instance.mesh),
                    triangle,
                    hit.barycentric,
                )
            }
        };
        let front = point.normal.dot(ray.direction) <= 0.0;
        let toward_viewer = if front { point.normal } else { -point.normal };
        let bent = self.mapped_normal(material.normal_map.as_ref(), &vertex);
        // Interpolated and mapped normals belong to the front; whatever they say, shading sees the viewer's side.
        let normal = if front { bent } else { -bent };
        let normal = if normal.dot(ray.direction) > 0.0 {
            turned_toward(normal, ray.direction)
        } else {
            normal
        };
        let visible = front || material.double_sided;
        let coverage = if visible {
            self.coverage(&material.alpha, &vertex)
        } else {
            0.0
        };
        let mut reflectance =
            self.reflectance(material, &vertex, normal.dot(-ray.direction).max(0.0));
        if let (
            Model::Phong(Phong {
                checker: Some(checker),
                ..
            }),
            Primitive::Plane(plane),
        ) = (&material.model, primitive)
            && checker.covers(
                &self.planes[plane].shape,
                self.planes[plane].shape.double_position(ray),
            )
        {
            (reflectance.diffuse, reflectance.ambient) = (checker.color, checker.color);
        }
        let lit = !matches!(material.model, Model::Unlit { .. });
        Surface {
            point: SurfacePoint {
                normal: toward_viewer,
                ..point
            },
            normal,
            lit,
            reflectance,
            coverage,
        }
    }

    /// The share of a shadow ray that ends at `hit`: both sides of a surface keep light away.
    pub fn shadow_coverage(&self, hit: &Hit) -> f32 {
        let material = self.material(self.material_of(hit.primitive));
        let Primitive::Triangle { instance, triangle } = self.primitive(hit.primitive) else {
            return self.coverage(&material.alpha, &neutral(Vec3::Y));
        };
        let mesh = self.mesh(self.instances[instance].mesh);
        self.coverage(
            &material.alpha,
            &interpolated(mesh, triangle, hit.barycentric, Vec3::Y),
        )
    }

    fn look_up(&self, used: &TextureUse, vertex: &Vertex) -> [f32; 4] {
        let uv = vertex.uvs[usize::from(used.uv_set != 0)];
        let uv = used
            .transform
            .map_or(uv, |transform| transform.transform_point2(uv));
        self.textures
            .get(used.texture as usize)
            .map_or([1.0; 4], |texture| texture.sample(uv))
    }

    fn color(&self, textured: &Textured<Rgb>, vertex: &Vertex) -> Rgb {
        textured.texture.as_ref().map_or(textured.factor, |used| {
            let [r, g, b, _] = self.look_up(used, vertex);
            textured.factor * Rgb::new(r, g, b)
        })
    }

    fn coverage(&self, alpha: &Alpha, vertex: &Vertex) -> f32 {
        if alpha.mode == AlphaMode::Opaque {
            return 1.0;
        }
        let texel = alpha.coverage.texture.as_ref().map_or(1.0, |used| {
            let [red, _, _, a] = self.look_up(used, vertex);
            match alpha.channel {
                AlphaChannel::Alpha => a,
                AlphaChannel::Red => red,
            }
        });
        let coverage = (alpha.coverage.factor * texel * vertex.color[3]).clamp(0.0, 1.0);
        match alpha.mode {
            AlphaMode::Mask { cutoff } => f32::from(u8::from(coverage >= cutoff)),
            _ => coverage,
        }
    }

    fn reflectance(&self, material: &Material, vertex: &Vertex, cos_view: f32) -> Reflectance {
        let [r, g, b, _] = vertex.color;
        let tint = Rgb::new(r, g, b);
        let emission = self.color(&material.emission, vertex);
        match &material.model {
            Model::Phong(phong) => {
                let diffuse = self.color(&phong.diffuse, vertex) * tint;
                Reflectance {
                    diffuse,
                    specular: self.color(&phong.specular, vertex),
                    shininess: phong.shininess,
                    reflectivity: phong.reflectivity,
                    ambient: diffuse,
                    emission,
                }
            }
            Model::MetallicRoughness(m) => {
                let [_, roughness, metallic, _] = m
                    .metallic_roughness
                    .as_ref()
                    .map_or([1.0; 4], |used| self.look_up(used, vertex));
                let occluded = m
                    .occlusion
                    .texture
                    .as_ref()
                    .map_or(0.0, |used| 1.0 - self.look_up(used, vertex)[0]);
                let parameters = metallic_roughness::Parameters {
                    base_color: self.color(&m.base_color, vertex) * tint,
                    metallic: m.metallic * metallic,
                    roughness: m.roughness * roughness,
                    ambient_access: 1.0 - m.occlusion.factor * occluded,
                };
                metallic_roughness::reflectance(parameters, cos_view, emission)
            }
            Model::Unlit { color } => {
                let color = self.color(color, vertex) * tint;
                let dark = Rgb::BLACK;
                let (specular, reflectivity, ambient) = (dark, dark, dark);
                Reflectance {
                    diffuse: color,
                    specular,
                    shininess: 0.0,
                    reflectivity,
                    ambient,
                    emission: color,
                }
            }
        }
    }

    /// The shading normal of the front, bent by a normal map where there is one and the mesh says which way is right.
    fn mapped_normal(&self, map: Option<&NormalMap>, vertex: &Vertex) -> Vec3 {
        let n = vertex.normal;
        let t = vertex.tangent.truncate();
        let Some(map) = map.filter(|_| t != Vec3::ZERO) else {
            return n;
        };
        let [x, y, z, _] = self.look_up(&map.texture, vertex);
        let b = n.cross(t) * vertex.tangent.w;
        let (x, y, z) = (
            (x * 2.0 - 1.0) * map.scale,
            (y * 2.0 - 1.0) * map.scale,
            z * 2.0 - 1.0,
        );
        (t * x + b * y + n * z).normalize_or(n)
    }
}

/// A normal that points away from the viewer, tilted until the viewer sees its surface edge-on.
fn turned_toward(n: Vec3, d: Vec3) -> Vec3 {
    (n - d * (n.dot(d) / d.dot(d))).normalize_or(-d)
}

fn neutral(normal: Vec3) -> Vertex {
    Vertex {
        normal,
        tangent: Vec4::ZERO,
        uvs: [Vec2::ZERO; 2],
        color: [1.0; 4],
    }
}

fn plain(point: SurfacePoint) -> (SurfacePoint, Vertex) {
    (point, neutral(point.normal))
}

/// The point and the vertex data of a triangle, in world space.
fn corner_mix(
    instance: &PlacedInstance,
    mesh: &Mesh,
    triangle: u32,
    barycentric: [f32; 2],
) -> (SurfacePoint, Vertex) {
    let point = mesh.triangle(triangle).surface_point(barycentric);
    let vertex = interpolated(mesh, triangle, barycentric, point.normal);
    let Some(space) = &instance.space else {
        return (point, vertex);
    };
    let turn = normal_matrix(&space.to_world.matrix3.as_dmat3());
    let carried = |n: Vec3| (turn * n.as_dvec3()).normalize_or_zero().as_vec3();
    let tangent = (space.to_world.matrix3 * vertex.tangent.truncate()).normalize_or_zero();
    let mirrors = space.to_world.matrix3.determinant() < 0.0;
    let sign = if mirrors {
        -vertex.tangent.w
    } else {
        vertex.tangent.w
    };
    let world_point = SurfacePoint {
        position: space.to_world.transform_point3(point.position),
        error: space.error_in_world(point.error),
        normal: carried(point.normal),
    };
    (
        world_point,
        Vertex {
            normal: carried(vertex.normal),
            tangent: tangent.extend(sign),
            ..vertex
        },
    )
}

/// What belongs to a triangle's vertices, at a point of it, in the space of its mesh.
fn interpolated(mesh: &Mesh, triangle: u32, [v, w]: [f32; 2], face_normal: Vec3) -> Vertex {
    let weights = [1.0 - v - w, v, w];
    let corners = mesh
        .triangles
        .get(triangle as usize)
        .copied()
        .unwrap_or_default();
    let mut vertex = neutral(Vec3::ZERO);
    let mut colors = [0.0; 4];
    for (&corner, weight) in corners.iter().zip(weights) {
        let corner = corner as usize;
        vertex.normal += mesh.normals.get(corner).copied().unwrap_or(face_normal) * weight;
        vertex.tangent += mesh.tangents.get(corner).copied().unwrap_or(Vec4::ZERO) * weight;
        for (mixed, set) in vertex.uvs.iter_mut().zip(&mesh.uvs) {
            *mixed += set.get(corner).copied().unwrap_or_default() * weight;
        }
        let color = mesh.colors.get(corner).copied().unwrap_or([1.0; 4]);
        colors = std::array::from_fn(|channel| colors[channel] + color[channel] * weight);
    }
    let normal = vertex.normal.normalize_or(face_normal);
    // Square to the normal again, and a whole sign: interpolation keeps neither.
    let t = vertex.tangent.truncate();
    let t = (t - normal * normal.dot(t)).normalize_or_zero();
    Vertex {
        normal,
        tangent: t.extend(1f32.copysign(vertex.tangent.w)),
        color: colors,
        ..vertex
    }
}
