//! From a hit to the surface there.

use super::cone::on_surface;
use super::microfacets::Facing;
use super::mix::{Mix, Vertex};
use super::{InstanceSpace, Primitive, Recent, Scene, Through};
use crate::color::Rgb;
use crate::geometry::{Hit, SurfacePoint, Triangle};
use crate::material::{Model, NormalMap, Phong};
use crate::mesh::normal_matrix;
use crate::ray::Ray;
use crate::shade::Reflectance;
use crate::texture::Footprint;
use glam::{Vec2, Vec3};

/// A surface where a ray met it.
#[derive(Clone, Copy, Debug)]
pub struct Surface {
    /// Where it is.
    pub place: Place,
    /// The unit normal that shading uses, turned toward the viewer.
    pub normal: Vec3,
    /// Whether light changes it: false for KHR_materials_unlit, whose colour is in `reflectance.emission`.
    pub lit: bool,
    /// How it answers light, if none went through.
    pub reflectance: Reflectance,
    /// What goes through, where something does.
    pub through: Option<Through>,
    /// The share of diffuse light that comes through from behind.
    pub from_behind: Rgb,
    /// The share of the ray that ends here; 0 where the surface is not there for this ray.
    pub coverage: f32,
}

/// Where a ray met a surface, seen from the ray.
#[derive(Clone, Copy, Debug)]
pub struct Place {
    /// The point itself, its normal turned toward the viewer.
    pub point: SurfacePoint,
    /// The interpolated unit normal, turned toward the viewer.
    pub normal: Vec3,
    /// Whether the ray came from the front.
    pub front: bool,
}

/// A triangle that a ray met, in world space, before any arithmetic.
#[derive(Clone, Copy, Debug)]
pub struct Met {
    /// The triangle.
    pub triangle: Triangle,
    /// The normals at its vertices; `None` where it is flat.
    pub normals: Option<[Vec3; 3]>,
    /// Its material, where [`Scene::plain`] says how that answers light.
    pub plain: Option<u32>,
}

impl Place {
    /// A point as a viewer along `d` sees it; its normal and the interpolated one are those of the front. Without a
    /// branch, so that a loop over places becomes one over registers.
    #[inline(always)]
    pub fn seen(point: SurfacePoint, normal: Vec3, d: Vec3) -> Place {
        let front = point.normal.dot(d) <= 0.0;
        let side = if front { 1.0 } else { -1.0 };
        let point = SurfacePoint {
            normal: point.normal * side,
            ..point
        };
        Place {
            point,
            normal: turned_toward(normal * side, d),
            front,
        }
    }

    /// A point of a triangle in world space. `normals` are those at the triangle's vertices, or zero.
    #[inline(always)]
    pub fn on_surface(
        point: SurfacePoint,
        [a, b, c]: [Vec3; 3],
        [v, w]: [f32; 2],
        d: Vec3,
    ) -> Place {
        let mixed = a * (1.0 - v - w) + b * v + c * w;
        Place::seen(point, unit_or(mixed, point.normal), d)
    }
}

impl Scene {
    /// The surface that `ray` met at `hit`, as a viewer along the ray sees it, at the very point.
    pub fn surface(&self, ray: &Ray, hit: &Hit) -> Surface {
        let mut recent = Recent::default();
        self.look(
            ray,
            hit,
            self.place(ray, hit, &mut recent),
            0.0,
            &mut recent,
        )
    }

    /// The triangle that a ray met at `hit`; `None` for another shape, and for one that is in a space of its own.
    #[inline(always)]
    pub fn met(&self, hit: &Hit, recent: &mut Recent) -> Option<Met> {
        let Primitive::Triangle { instance, triangle } = self.primitive_near(hit.primitive, recent)
        else {
            return None;
        };
        let instance = &self.instances[instance];
        if instance.space.is_some() {
            return None;
        }
        let mesh = self.mesh(instance.mesh);
        let mix = Mix::new(mesh, triangle, hit.barycentric);
        let plain = self.plain(instance.material).is_some() && mesh.colors.is_empty();
        let smooth = !mesh.normals.is_empty();
        Some(Met {
            triangle: mix.triangle(),
            normals: smooth.then(|| mix.corners(&mesh.normals, Vec3::ZERO)),
            plain: plain.then_some(instance.material),
        })
    }

    /// How a material answers light, where that is the same everywhere and from both sides, but for vertex colours and a
    /// checkerboard.
    #[inline(always)]
    pub fn plain(&self, material: u32) -> Option<&Reflectance> {
        self.plain[material as usize].as_ref()
    }

    /// Where `ray` met something, whatever it is. `recent` remembers the instance from hit to hit.
    #[inline(never)]
    pub fn place(&self, ray: &Ray, hit: &Hit, recent: &mut Recent) -> Place {
        let (point, normal) = match self.primitive_near(hit.primitive, recent) {
            Primitive::Sphere(sphere) => {
                let point = self.spheres[sphere].shape.surface_point(ray, hit.t);
                (point, point.normal)
            }
            Primitive::Plane(plane) => {
                let point = self.planes[plane].shape.surface_point(ray);
                (point, point.normal)
            }
            Primitive::Triangle { instance, triangle } => {
                let instance = &self.instances[instance];
                let mix = Mix::new(self.mesh(instance.mesh), triangle, hit.barycentric);
                let point = mix.triangle().surface_point(hit.barycentric);
                let normal = mix.normal(point.normal);
                match &instance.space {
                    None => (point, normal),
                    Some(space) => in_world(space, point, normal),
                }
            }
        };
        Place::seen(point, normal, ray.direction)
    }

    /// What `ray` sees at `place`, where it is so wide in the scene's unit, every texture looked up.
    #[inline(never)]
    pub fn look(
        &self,
        ray: &Ray,
        hit: &Hit,
        place: Place,
        width: f32,
        recent: &mut Recent,
    ) -> Surface {
        let primitive = self.primitive_near(hit.primitive, recent);
        let (index, on) = match primitive {
            Primitive::Sphere(sphere) => (self.spheres[sphere].material, None),
            Primitive::Plane(plane) => (self.planes[plane].material, None),
            Primitive::Triangle { instance, triangle } => {
                let instance = &self.instances[instance];
                let mix = Mix::new(self.mesh(instance.mesh), triangle, hit.barycentric);
                (instance.material, Some((instance, mix)))
            }
        };
        let material = self.material(index);
        let mut vertex = on
            .as_ref()
            .map_or_else(Vertex::neutral, |(_, mix)| mix.vertex());
        let seen = (width > 0.0).then(|| on_surface(ray.direction, place.point.normal, width));
        if let (Some(seen), Some((instance, mix))) = (seen, &on) {
            let seen = match &instance.space {
                None => seen,
                Some(space) => seen.map(|axis| space.to_object.matrix3 * axis),
            };
            vertex.footprints = mix.in_texture(seen).map(|axes| Footprint { axes });
        }
        let bent = |map: &Option<NormalMap>| {
            let (Some(map), Some((instance, mix))) = (map, &on) else {
                return place.normal;
            };
            let side = if place.front { 1.0 } else { -1.0 };
            let of_front = match &instance.space {
                None => mix.normal(place.point.normal * side),
                Some(_) => place.normal * side,
            };
            let tangent = mix.tangent(of_front, instance);
            let bent = self.mapped_normal(map, of_front, tangent, &vertex);
            turned_toward(bent * side, ray.direction)
        };
        let cosine = |normal: Vec3| normal.dot(-ray.direction).max(0.0);
        let normal = bent(&material.normal_map);
        let coat = material.clearcoat().map(|coat| bent(&coat.normal_map));
        let coat = coat.filter(|&coat| coat != normal).map(|normal| Facing {
            normal,
            cos_view: cosine(normal),
        });
        // A ray in a body has to find the way out.
        let is_there = place.front || material.double_sided || material.volume().is_some();
        let coverage = if is_there {
            self.coverage(&material.alpha, &vertex)
        } else {
            0.0
        };
        let cos_view = cosine(normal);
        let mut reflectance = self.reflectance(material, &vertex, cos_view, coat);
        if let (
            Model::Phong(Phong {
                checker: Some(checker),
                ..
            }),
            Primitive::Plane(plane),
        ) = (&material.model, primitive)
        {
            let plane = &self.planes[plane].shape;
            let seen = seen.unwrap_or([Vec3::ZERO; 2]);
            let share = checker.share(plane, plane.double_position(ray), seen);
            if share > 0.0 {
                reflectance.diffuse = reflectance.diffuse.mix(checker.color, share);
                reflectance.color = reflectance.color.mix(checker.color, share);
                reflectance.ambient = reflectance.ambient.mix(checker.color, share);
            }
        }
        let through = self.through(
            (index, material),
            &vertex,
            &reflectance,
            place.front,
            [cos_view, cosine(place.point.normal)],
        );
        Surface {
            place,
            normal,
            lit: !matches!(material.model, Model::Unlit { .. }),
            reflectance,
            through,
            from_behind: self.diffuse_from_behind(&material.model, &vertex),
            coverage,
        }
    }

    /// The first set of texture coordinates at `hit`: (0, 0) is the upper left of a texture. Zero where there is none.
    pub fn uv(&self, hit: &Hit, recent: &mut Recent) -> Vec2 {
        match self.primitive_near(hit.primitive, recent) {
            Primitive::Sphere(_) | Primitive::Plane(_) => Vec2::ZERO,
            Primitive::Triangle { instance, triangle } => {
                let mesh = self.mesh(self.instances[instance].mesh);
                Mix::new(mesh, triangle, hit.barycentric).uv()
            }
        }
    }

    /// The share of a shadow ray that ends at `hit`: both sides of a surface keep light away.
    pub fn shadow_coverage(&self, hit: &Hit) -> f32 {
        let material = self.material(self.material_of(hit.primitive));
        if material.is_opaque() {
            return 1.0;
        }
        self.coverage(&material.alpha, &self.vertex(hit))
    }
}

/// A normal of the viewer's side, whatever it says: one that points away from a viewer along `d` is tilted until the
/// viewer sees its surface edge-on.
#[inline(always)]
fn turned_toward(n: Vec3, d: Vec3) -> Vec3 {
    let along = n.dot(d);
    let tilted = unit_or(n - d * (along / d.dot(d)), -d);
    if along > 0.0 { tilted } else { n }
}

/// `v` at unit length, `other` where that is nothing. Without a branch.
#[inline(always)]
fn unit_or(v: Vec3, other: Vec3) -> Vec3 {
    let scale = 1.0 / v.length_squared().sqrt();
    let has_length = (scale > 0.0) & (scale < f32::INFINITY);
    if has_length { v * scale } else { other }
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
