//! Rays to measure search with: four kinds, in the order in which a renderer asks for them, tile after tile of 8 x 8
//! pixels.

use crate::accel::Accel;
use crate::camera::View;
use crate::generate::Random;
use crate::geometry::Hit;
use crate::light::LightKind;
use crate::ray::Ray;
use crate::scene::{Primitive, Scene};
use glam::{DVec3, Vec3};
use rayon::prelude::*;
use serde::{Deserialize, Serialize};
use std::hint::black_box;

/// The side of a tile, in pixels.
const TILE: u32 = 8;

/// What the rays of a set are for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Kind {
    /// From the camera.
    Primary,
    /// From a point light to what the camera sees.
    Shadow,
    /// From what the camera sees, mirrored.
    Mirror,
    /// From what the camera sees, to anywhere, as matt surfaces scatter light.
    Incoherent,
}

impl Kind {
    /// Every kind.
    pub const ALL: [Kind; 4] = [Kind::Primary, Kind::Shadow, Kind::Mirror, Kind::Incoherent];

    /// One word.
    pub fn name(self) -> &'static str {
        match self {
            Kind::Primary => "primary",
            Kind::Shadow => "shadow",
            Kind::Mirror => "mirror",
            Kind::Incoherent => "incoherent",
        }
    }

    /// Whether the question is "is anything hit" and not "what is hit first".
    pub fn is_any_hit(self) -> bool {
        self == Kind::Shadow
    }
}

/// Rays in batches of at most 64, one for each tile that has any.
#[derive(Clone, Debug, Default)]
pub struct RaySet {
    /// Batch after batch.
    pub rays: Vec<Ray>,
    /// Where each batch ends.
    ends: Vec<usize>,
}

impl RaySet {
    fn of(batches: impl Iterator<Item = Vec<Ray>>) -> RaySet {
        let mut set = RaySet::default();
        for batch in batches.filter(|batch| !batch.is_empty()) {
            set.rays.extend(batch);
            set.ends.push(set.rays.len());
        }
        set
    }

    /// These rays, in batches of 64.
    pub fn in_batches(rays: &[Ray]) -> RaySet {
        RaySet::of(rays.chunks(64).map(<[Ray]>::to_vec))
    }

    /// The batches, in order.
    pub fn batches(&self) -> Vec<&[Ray]> {
        let starts = std::iter::once(0).chain(self.ends.iter().copied());
        starts
            .zip(&self.ends)
            .map(|(start, &end)| &self.rays[start..end])
            .collect()
    }
}

/// Traces every batch as the kind asks. Never inlined, so that a profiler can be told to count nothing else.
#[inline(never)]
pub fn trace(accel: &Accel, kind: Kind, batches: &[&[Ray]]) {
    let (mut hits, mut occluded) = (Vec::new(), Vec::new());
    for batch in batches {
        if kind.is_any_hit() {
            accel.occluded_all(batch, &mut occluded);
            black_box(&occluded);
        } else {
            accel.intersect_all(batch, &mut hits);
            black_box(&hits);
        }
    }
}

/// The point light whose shadows are asked for: the scene's first with a place, or else one above and beside the camera.
pub fn light(scene: &Scene) -> Vec3 {
    let placed = scene.lights().iter().find_map(|light| match light.kind {
        LightKind::Point { position } | LightKind::Spot { position, .. } => Some(position),
        LightKind::Directional { .. } => None,
    });
    placed.unwrap_or_else(|| {
        let camera = scene.camera();
        let distance = (camera.look_at - camera.position).length();
        let beside = DVec3::new(0.3, 0.7, 0.2) * distance;
        (camera.position + beside).as_vec3()
    })
}

/// The four sets of a scene for a picture of `width x height`.
pub fn make(scene: &Scene, accel: &Accel, light: Vec3, [width, height]: [u32; 2]) -> [RaySet; 4] {
    let view = scene.camera().view(width, height);
    let corners: Vec<(u32, u32)> = (0..height)
        .step_by(TILE as usize)
        .flat_map(|top| {
            (0..width)
                .step_by(TILE as usize)
                .map(move |left| (left, top))
        })
        .collect();
    let tiles: Vec<[Vec<Ray>; 4]> = corners
        .par_iter()
        .enumerate()
        .map(|(number, &(left, top))| {
            let primary = tile(&view, [left, top], [width, height]);
            let mut hits = Vec::new();
            accel.intersect_all(&primary, &mut hits);
            let seen: Vec<Seen> = primary
                .iter()
                .zip(&hits)
                .filter_map(|(ray, hit)| Some(Seen::new(scene, ray, hit.as_ref()?)))
                .collect();
            let mut random = Random::new(number as u64);
            [
                seen.iter()
                    .filter_map(|seen| seen.lit_from(light))
                    .collect(),
                seen.iter().map(Seen::mirrored).collect(),
                seen.iter()
                    .map(|seen| seen.scattered(&mut random))
                    .collect(),
                primary,
            ]
        })
        .collect();
    let set = |kind: usize| RaySet::of(tiles.iter().map(|tile| tile[kind].clone()));
    [set(3), set(0), set(1), set(2)]
}

/// The rays through the middles of a tile's pixels, square after square: 16 that follow one another are 4 x 4 pixels.
fn tile(view: &View, [left, top]: [u32; 2], [width, height]: [u32; 2]) -> Vec<Ray> {
    let pixels = (0..TILE * TILE).map(|n| {
        let (square, within) = (n / 16, n % 16);
        let across = TILE / 4;
        (
            left + square % across * 4 + within % 4,
            top + square / across * 4 + within / 4,
        )
    });
    pixels
        .filter(|&(i, j)| i < width && j < height)
        .map(|(i, j)| view.primary_ray(f64::from(i) + 0.5, f64::from(j) + 0.5))
        .collect()
}

/// A point that the camera sees.
struct Seen {
    position: Vec3,
    /// How far `position` may be off the surface.
    error: f32,
    /// Of the geometry, toward the camera.
    normal: Vec3,
    /// From the camera.
    direction: Vec3,
}

impl Seen {
    fn new(scene: &Scene, ray: &Ray, hit: &Hit) -> Seen {
        let point = ray.point_at(hit.t);
        let (position, normal, error) = match scene.primitive(hit.primitive) {
            Primitive::Triangle { instance, triangle } => {
                let mut corners = scene.triangle(instance, triangle);
                if let Some(space) = &scene.instances()[instance].space {
                    corners.0 = corners.0.map(|p| space.to_world.transform_point3(p));
                }
                let on_it = corners.surface_point(hit.barycentric);
                (on_it.position, on_it.normal, on_it.error)
            }
            Primitive::Sphere(sphere) => {
                let center = scene.spheres()[sphere].shape.center;
                (
                    point,
                    (point - center).normalize(),
                    1e-5 * point.abs().max_element(),
                )
            }
            Primitive::Plane(plane) => (
                point,
                scene.planes()[plane].shape.normal,
                1e-5 * point.abs().max_element(),
            ),
        };
        let away = normal.dot(ray.direction) > 0.0;
        Seen {
            position,
            error,
            normal: if away { -normal } else { normal },
            direction: ray.direction,
        }
    }

    /// The ray from `light` that ends a little before this point; `None` where the light stands on it.
    fn lit_from(&self, light: Vec3) -> Option<Ray> {
        let way = self.position - light;
        let distance = way.length();
        let direction = way.try_normalize()?;
        Some(Ray::new(light, direction, 0.0, distance * (1.0 - 1e-4)))
    }

    fn mirrored(&self) -> Ray {
        let direction = self.direction - self.normal * (2.0 * self.normal.dot(self.direction));
        self.leaving(direction.normalize())
    }

    /// Cosine-distributed: a point of the unit sphere that touches the surface.
    fn scattered(&self, random: &mut Random) -> Ray {
        let direction = (self.normal + random.direction()).normalize_or(self.normal);
        self.leaving(direction)
    }

    fn leaving(&self, direction: Vec3) -> Ray {
        Ray::leaving(
            self.position,
            self.normal,
            self.error,
            direction,
            f32::INFINITY,
        )
    }
}
