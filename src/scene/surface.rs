//! From a hit to the surface there: point, normals, and every texture looked up.

use super::{InstanceSpace, Object, PlacedInstance, Primitive, Recent, Scene};
use crate::color::Rgb;
use crate::geometry::{Hit, SurfacePoint, Triangle};
use crate::material::{
    Alpha, AlphaChannel, AlphaMode, Material, Model, NormalMap, Phong, Textured,
};
use crate::mesh::{Mesh, normal_matrix};
use crate::ray::Ray;
use crate::shade::{Reflectance, metallic_roughness};
use crate::texture::TextureUse;
use glam::{Vec2, Vec3, Vec4};
use std::ops::{Add, Deref, Mul};

/// A surface where a ray met it.
#[derive(Clone, Copy, Debug)]
pub struct Surface<'a> {
    /// The point itself, its normal turned toward the viewer.
    pub point: SurfacePoint,
    /// The unit normal that shading uses, turned toward the viewer.
    pub normal: Vec3,
    /// How it answers light.
    pub reflectance: Answer<'a>,
    /// Whether light changes it: false for KHR_materials_unlit, whose colour is in `reflectance.emission`.
    pub lit: bool,
    /// The share of the ray that ends here; 0 where the surface is not there for this ray.
    pub coverage: f32,
}

/// How a surface answers light at one point.
#[derive(Clone, Copy, Debug)]
pub enum Answer<'a> {
    /// As it does everywhere: most materials have no texture, and are reckoned once.
    Same(&'a Reflectance),
    /// Reckoned for this point.
    Here(Reflectance),
}

impl Deref for Answer<'_> {
    type Target = Reflectance;
    #[inline]
    fn deref(&self) -> &Reflectance {
        match self {
            Answer::Same(reflectance) => reflectance,
            Answer::Here(reflectance) => reflectance,
        }
    }
}

/// What a material gives its textures: what is interpolated over a primitive, neutral where the mesh says nothing.
struct Vertex {
    uvs: [Vec2; 2],
    color: [f32; 4],
}

const NEUTRAL: Vertex = Vertex {
    uvs: [Vec2::ZERO; 2],
    color: [1.0; 4],
};

/// A point of a triangle, by the weights of its corners.
struct Mix<'a> {
    mesh: &'a Mesh,
    corners: [u32; 3],
    weights: [f32; 3],
}

impl Scene {
    /// The surface that `ray` met at `hit`, as a viewer along the ray sees it.
    pub fn surface(&self, ray: &Ray, hit: &Hit) -> Surface<'_> {
        self.surface_near(ray, hit, &mut Recent::default())
    }

    /// [`Scene::surface`], sooner where the instance is the one that `recent` remembers.
    #[inline]
    pub fn surface_near(&self, ray: &Ray, hit: &Hit, recent: &mut Recent) -> Surface<'_> {
        match self.primitive_near(hit.primitive, recent) {
            Primitive::Sphere(sphere) => {
                let Object {
                    shape, material, ..
                } = &self.spheres[sphere];
                let point = shape.surface_point(ray, hit.t);
                self.seen(ray, *material, point, point.normal, None)
            }
            Primitive::Plane(plane) => {
                let Object {
                    shape, material, ..
                } = &self.planes[plane];
                let point = shape.surface_point(ray);
                let mut surface = self.seen(ray, *material, point, point.normal, None);
                if let Model::Phong(Phong {
                    checker: Some(checker),
                    ..
                }) = &self.material(*material).model
                    && checker.covers(shape, shape.double_position(ray))
                {
                    surface.reflectance = Answer::Here(Reflectance {
                        diffuse: checker.color,
                        ambient: checker.color,
                        ..*surface.reflectance
                    });
                }
                surface
            }
            Primitive::Triangle { instance, triangle } => {
                let instance = &self.instances[instance];
                let mesh = self.mesh(instance.mesh);
                let mix = Mix::new(mesh, triangle, hit.barycentric);
                let point = mix.triangle().surface_point(hit.barycentric);
                let normal = mix.normal(point.normal);
                let (point, normal) = match &instance.space {
                    None => (point, normal),
                    Some(space) => in_world(space, point, normal),
                };
                self.seen(ray, instance.material, point, normal, Some((instance, mix)))
            }
        }
    }

    /// A surface of some material from the viewer's side; `normal` is the interpolated one of the front.
    #[inline]
    fn seen(
        &self,
        ray: &Ray,
        material: u32,
        point: SurfacePoint,
        normal: Vec3,
        on: Option<(&PlacedInstance, Mix)>,
    ) -> Surface<'_> {
        let front = point.normal.dot(ray.direction) <= 0.0;
        let point = SurfacePoint {
            normal: if front { point.normal } else { -point.normal },
            ..point
        };
        let colored = on.as_ref().is_some_and(|(_, mix)| mix.has_colors());
        match &self.plain[material as usize] {
            Some(reflectance) if !colored => Surface {
                point,
                normal: turned_toward(normal, front, ray.direction),
                reflectance: Answer::Same(reflectance),
                lit: true,
                coverage: 1.0,
            },
            _ => self.looked_up(ray, material, front, point, normal, on),
        }
    }

    /// A surface whose material differs from place to place.
    fn looked_up(
        &self,
        ray: &Ray,
        material: u32,
        front: bool,
        point: SurfacePoint,
        normal: Vec3,
        on: Option<(&PlacedInstance, Mix)>,
    ) -> Surface<'_> {
        let material = self.material(material);
        let vertex = on.as_ref().map_or(NEUTRAL, |(_, mix)| mix.vertex());
        let normal = match (&material.normal_map, &on) {
            (Some(map), Some((instance, mix))) => {
                let tangent = mix.tangent(normal, instance);
                self.mapped_normal(map, normal, tangent, &vertex)
            }
            _ => normal,
        };
        let normal = turned_toward(normal, front, ray.direction);
        let coverage = if front || material.double_sided {
            self.coverage(&material.alpha, &vertex)
        } else {
            0.0
        };
        let cos_view = normal.dot(-ray.direction).max(0.0);
        Surface {
            point,
            normal,
            reflectance: Answer::Here(self.reflectance(material, &vertex, cos_view)),
            lit: !matches!(material.model, Model::Unlit { .. }),
            coverage,
        }
    }

    /// The share of a shadow ray that ends at `hit`: both sides of a surface keep light away.
    pub fn shadow_coverage(&self, hit: &Hit) -> f32 {
        let material = self.material(self.material_of(hit.primitive));
        if material.is_opaque() {
            return 1.0;
        }
        let Primitive::Triangle { instance, triangle } = self.primitive(hit.primitive) else {
            return self.coverage(&material.alpha, &NEUTRAL);
        };
        let mesh = self.mesh(self.instances[instance].mesh);
        let vertex = Mix::new(mesh, triangle, hit.barycentric).vertex();
        self.coverage(&material.alpha, &vertex)
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

    /// The shading normal of the front, bent by a normal map where the mesh says which way is right.
    fn mapped_normal(&self, map: &NormalMap, n: Vec3, tangent: Vec4, vertex: &Vertex) -> Vec3 {
        let t = tangent.truncate();
        if t == Vec3::ZERO {
            return n;
        }
        let [x, y, z, _] = self.look_up(&map.texture, vertex);
        let b = n.cross(t) * tangent.w;
        let (x, y, z) = (
            (x * 2.0 - 1.0) * map.scale,
            (y * 2.0 - 1.0) * map.scale,
            z * 2.0 - 1.0,
        );
        (t * x + b * y + n * z).normalize_or(n)
    }
}

/// How a material answers light wherever it is seen, from whatever side; `None` where that depends on the place.
pub(super) fn plain(material: &Material) -> Option<Reflectance> {
    let Model::Phong(phong) = &material.model else {
        return None;
    };
    let same =
        material.double_sided && material.is_opaque() && material.textures().next().is_none();
    same.then_some(Reflectance {
        diffuse: phong.diffuse.factor,
        specular: phong.specular.factor,
        shininess: phong.shininess,
        reflectivity: phong.reflectivity,
        ambient: phong.diffuse.factor,
        emission: material.emission.factor,
    })
}

/// The shading normal on the viewer's side. Interpolated and mapped normals belong to the front; one that points away
/// from a viewer along `d` is tilted until the viewer sees its surface edge-on.
#[inline]
fn turned_toward(of_front: Vec3, front: bool, d: Vec3) -> Vec3 {
    let n = if front { of_front } else { -of_front };
    let along = n.dot(d);
    if along > 0.0 {
        (n - d * (along / d.dot(d))).normalize_or(-d)
    } else {
        n
    }
}

/// A point and its interpolated normal, from the space of a shared mesh to the world's.
fn in_world(space: &InstanceSpace, point: SurfacePoint, normal: Vec3) -> (SurfacePoint, Vec3) {
    let turn = normal_matrix(&space.to_world.matrix3.as_dmat3());
    let carried = |n: Vec3| (turn * n.as_dvec3()).normalize_or_zero().as_vec3();
    let world_point = SurfacePoint {
        position: space.to_world.transform_point3(point.position),
        error: space.error_in_world(point.error),
        normal: carried(point.normal),
    };
    (world_point, carried(normal))
}

impl<'a> Mix<'a> {
    #[inline]
    fn new(mesh: &'a Mesh, triangle: u32, [v, w]: [f32; 2]) -> Mix<'a> {
        let corners = mesh.triangles.get(triangle as usize).copied();
        Mix {
            mesh,
            corners: corners.unwrap_or_default(),
            weights: [1.0 - v - w, v, w],
        }
    }

    /// What belongs to the three corners; `missing` where the mesh does not say.
    #[inline]
    fn corners<T: Copy>(&self, values: &[T], missing: T) -> [T; 3] {
        let [a, b, c] = self.corners;
        let of = |corner: u32| values.get(corner as usize).copied().unwrap_or(missing);
        [of(a), of(b), of(c)]
    }

    /// The mean of what belongs to the corners.
    #[inline]
    fn mixed<T: Copy + Add<Output = T> + Mul<f32, Output = T>>(&self, values: &[T], zero: T) -> T {
        let ([a, b, c], [wa, wb, wc]) = (self.corners(values, zero), self.weights);
        a * wa + b * wb + c * wc
    }

    /// The interpolated normal, the triangle's own where the mesh has none; in the mesh's space.
    #[inline]
    fn normal(&self, of_triangle: Vec3) -> Vec3 {
        if self.mesh.normals.is_empty() {
            return of_triangle;
        }
        self.mixed(&self.mesh.normals, of_triangle)
            .normalize_or(of_triangle)
    }

    /// The tangent square to `normal`, both in world space, and a whole sign: interpolation keeps neither. Zero where
    /// the mesh has none.
    fn tangent(&self, normal: Vec3, instance: &PlacedInstance) -> Vec4 {
        let tangent = self.mixed(&self.mesh.tangents, Vec4::ZERO);
        let sign = 1f32.copysign(tangent.w);
        let t = tangent.truncate();
        let Some(space) = &instance.space else {
            return square_to(normal, t).extend(sign);
        };
        let matrix = space.to_world.matrix3;
        let sign = if matrix.determinant() < 0.0 {
            -sign
        } else {
            sign
        };
        square_to(normal, matrix * t).extend(sign)
    }

    #[inline]
    fn triangle(&self) -> Triangle {
        Triangle(self.corners(&self.mesh.positions, Vec3::ZERO))
    }

    #[inline]
    fn has_colors(&self) -> bool {
        !self.mesh.colors.is_empty()
    }

    /// What textures are looked up with.
    fn vertex(&self) -> Vertex {
        let [first, second] = &self.mesh.uvs;
        let mut vertex = NEUTRAL;
        vertex.uvs[0] = self.mixed(first, Vec2::ZERO);
        if !second.is_empty() {
            vertex.uvs[1] = self.mixed(second, Vec2::ZERO);
        }
        if self.has_colors() {
            let [a, b, c] = self.corners(&self.mesh.colors, [1.0; 4]).map(Vec4::from);
            let [wa, wb, wc] = self.weights;
            vertex.color = (a * wa + b * wb + c * wc).to_array();
        }
        vertex
    }
}

/// The part of `t` that is square to a unit normal, of unit length; zero where there is none.
fn square_to(normal: Vec3, t: Vec3) -> Vec3 {
    (t - normal * normal.dot(t)).normalize_or_zero()
}
