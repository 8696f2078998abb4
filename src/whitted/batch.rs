//! What a tracer has under way: paths, the surfaces they arrive at, and shadow rays, in memory that is kept.

use super::lanes::{Places, Triangles, WIDTH};
use super::parts::By;
use crate::camera::View;
use crate::color::Rgb;
use crate::cone::Cone;
use crate::geometry::{Hit, SurfacePoint, Triangle};
use crate::light::Illumination;
use crate::ray::{AT_LIGHT, Ray};
use crate::scene::{Place, Recent, Scene, Surface, Through};
use crate::shade::{Coat, Reflectance};
use glam::Vec3;

/// What a ray carries to its sample.
#[derive(Clone, Copy, Debug)]
pub(super) struct Path {
    /// Which sample of the batch.
    pub(super) sample: u32,
    /// Mirrors so far, at most [`super::Rules::max_depth`].
    pub(super) bounces: u16,
    /// Transparent layers and boundaries of bodies so far, at most [`super::MAX_LAYERS`].
    pub(super) layers: u8,
    /// Whether it is still on the straight line from the camera.
    pub(super) direct: bool,
    /// What happened to it first.
    pub(super) by: By,
    /// The material of the body that it travels in, or [`NO_BODY`].
    pub(super) body: u32,
    /// That of the roughest mirror on its way: what lies past everything is seen through a lobe of this width.
    pub(super) roughness: f32,
    /// The share of its light that reaches the camera.
    pub(super) energy: Rgb,
    /// How wide it is.
    pub(super) cone: Cone,
}

/// Where a path travels in no body.
pub(super) const NO_BODY: u32 = u32::MAX;

/// Rays under way, and the path that each belongs to.
#[derive(Debug, Default)]
pub(super) struct Paths {
    pub(super) rays: Vec<Ray>,
    pub(super) paths: Vec<Path>,
}

impl Paths {
    /// One path for each sample, from the camera of `view`, as wide as this share of a pixel.
    pub(super) fn start(&mut self, view: &View, share_of_pixel: f32, camera_rays: &[Ray]) {
        self.clear();
        self.rays.extend_from_slice(camera_rays);
        let path = |(sample, ray)| Path {
            sample,
            bounces: 0,
            layers: 0,
            direct: true,
            by: By::Sight,
            body: NO_BODY,
            roughness: 0.0,
            energy: Rgb::WHITE,
            cone: view.cone(ray, share_of_pixel),
        };
        self.paths.extend((0..).zip(camera_rays).map(path));
    }

    pub(super) fn push(&mut self, ray: Ray, path: Path) {
        self.rays.push(ray);
        self.paths.push(path);
    }

    pub(super) fn clear(&mut self) {
        self.rays.clear();
        self.paths.clear();
    }
}

/// A path at a surface.
#[derive(Clone, Copy, Debug)]
pub(super) struct Arrival {
    /// Which of the paths, and of their hits.
    pub(super) path: u32,
    /// Which sample of the batch.
    pub(super) sample: u32,
    /// How the surface answers light: an index into [`Arrivals::reflectances`].
    pub(super) reflectance: u32,
    /// The share of the ray that ends here.
    pub(super) coverage: f32,
    /// The share of what the surface sends back that reaches the camera.
    pub(super) weight: Rgb,
}

/// The paths of a batch that met something, in order.
#[derive(Debug, Default)]
pub(super) struct Arrivals {
    pub(super) list: Vec<Arrival>,
    /// Eight of the list at a time; behind it lies what an earlier batch left.
    triangles: Vec<Triangles>,
    pub(super) places: Vec<Places>,
    /// What is no triangle in world space.
    others: Vec<(usize, Place)>,
    /// Which arrivals have to be looked at, since their surface is not the same everywhere.
    pub(super) unknown: Vec<usize>,
    /// Which send on rays.
    pub(super) onward: Vec<usize>,
    /// Which let light through, and what becomes of it.
    pub(super) through: Vec<(usize, Through)>,
    /// Which have a clear coat that faces another way, and that coat.
    pub(super) coats: Vec<(usize, Coat)>,
    /// Which let diffuse light of lamps behind them through, and how much.
    pub(super) from_behind: Vec<(usize, Rgb)>,
    /// Of every material, where that is the same everywhere, and then what was looked up.
    pub(super) reflectances: Vec<Reflectance>,
    materials: usize,
}

impl Arrivals {
    pub(super) fn new(scene: &Scene) -> Arrivals {
        let plain = |material| scene.plain(material).copied().unwrap_or(Reflectance::BLACK);
        let materials = scene.materials().len();
        Arrivals {
            list: Vec::new(),
            triangles: Vec::new(),
            places: Vec::new(),
            others: Vec::new(),
            unknown: Vec::new(),
            onward: Vec::new(),
            through: Vec::new(),
            coats: Vec::new(),
            from_behind: Vec::new(),
            reflectances: (0..materials as u32).map(plain).collect(),
            materials,
        }
    }

    pub(super) fn clear(&mut self) {
        self.list.clear();
        self.others.clear();
        self.unknown.clear();
        self.onward.clear();
        self.through.clear();
        self.coats.clear();
        self.from_behind.clear();
        self.reflectances.truncate(self.materials);
    }

    /// Adds path number `index`, which met something at `hit`.
    #[inline(always)]
    pub(super) fn push(
        &mut self,
        scene: &Scene,
        (index, ray, path): (u32, &Ray, &Path),
        hit: &Hit,
        recent: &mut Recent,
    ) {
        let number = self.list.len();
        let lane = number % WIDTH;
        if number / WIDTH == self.triangles.len() {
            self.triangles.push(Triangles::default());
            self.places.push(Places::default());
        }
        let mut plain = None;
        match (
            scene.met(hit, recent),
            self.triangles.get_mut(number / WIDTH),
        ) {
            (Some(met), Some(triangles)) => {
                let (barycentric, d) = (hit.barycentric, ray.direction);
                triangles.set(lane, &met.triangle, met.normals, barycentric, d);
                plain = met.plain;
            }
            _ => self.push_other(scene.place(ray, hit, recent)),
        }
        if plain.is_none() {
            self.unknown.push(number);
        }
        self.list.push(Arrival {
            path: index,
            sample: path.sample,
            reflectance: plain.unwrap_or(0),
            coverage: 1.0,
            weight: path.energy,
        });
    }

    #[inline(never)]
    fn push_other(&mut self, place: Place) {
        let number = self.list.len();
        if let Some(triangles) = self.triangles.get_mut(number / WIDTH) {
            // Some triangle that is in nobody's way.
            let any = Triangle([Vec3::ZERO, Vec3::X, Vec3::Y]);
            triangles.set(number % WIDTH, &any, None, [0.0; 2], Vec3::Z);
        }
        self.others.push((number, place));
    }

    /// Finds the places of all that was pushed.
    pub(super) fn settle(&mut self) {
        let blocks = self.places.iter_mut().zip(&self.triangles);
        for ((places, triangles), arrivals) in blocks.zip(self.list.chunks(WIDTH)) {
            triangles.places(places);
            for lane in 0..arrivals.len() {
                if !places.is_sure(lane) {
                    places.set(lane, &triangles.place(lane));
                }
            }
        }
        for &(index, ref place) in &self.others {
            self.places[index / WIDTH].set(index % WIDTH, place);
        }
    }

    /// Takes note of what was seen at an arrival, and of what light does there beside its shading if `whole`.
    pub(super) fn know(&mut self, index: usize, surface: &Surface, whole: bool) {
        let arrival = &mut self.list[index];
        arrival.coverage = surface.coverage;
        arrival.weight *= surface.coverage;
        arrival.reflectance = self.reflectances.len() as u32;
        self.reflectances.push(match surface.through {
            Some(through) if whole => {
                self.through.push((index, through));
                through.rest
            }
            _ => surface.reflectance,
        });
        // No light stands before a surface without a normal.
        let lit = surface.lit && surface.coverage > 0.0;
        if whole && lit {
            let coat = surface.reflectance.layers.and_then(|layers| layers.coat());
            self.coats.extend(coat.map(|coat| (index, coat)));
            if surface.from_behind != Rgb::BLACK {
                self.from_behind.push((index, surface.from_behind));
            }
        }
        let normal = if lit { surface.normal } else { Vec3::ZERO };
        self.places[index / WIDTH].set_normal(index % WIDTH, normal);
    }

    /// Where an arrival is.
    pub(super) fn place(&self, index: usize) -> Place {
        self.places[index / WIDTH].get(index % WIDTH)
    }
}

/// The shadow ray to a light. It ends a little before, so that a surface that holds the light does not hide it.
pub(super) fn ray_to(light: &Illumination, point: &SurfacePoint) -> Ray {
    Ray::leaving(
        point.position,
        point.normal,
        point.error,
        light.to_light,
        light.distance * (1.0 - AT_LIGHT),
    )
}

/// The shadow rays that begin at a lamp.
pub(super) const FROM_LAMPS: usize = 0;
/// Those that begin at surfaces.
pub(super) const FROM_SURFACES: usize = 1;
/// Those that begin at the ground: what they decide about does not belong to samples yet.
pub(super) const FROM_GROUND: usize = 2;

/// Shadow rays, and what each decides about.
#[derive(Debug, Default)]
pub(super) struct ShadowRays {
    pub(super) rays: Vec<Ray>,
    pub(super) light: Vec<Promised>,
}

/// What a sample (or a place on the ground, by its number) gets if nothing stands in the way of a shadow ray.
#[derive(Clone, Copy, Debug)]
pub(super) struct Promised {
    pub(super) sample: u32,
    pub(super) light: Rgb,
    /// What of the light is no diffuse light, if somebody wants to know.
    pub(super) gloss: Rgb,
    /// Which of the paths.
    pub(super) path: u32,
}

impl ShadowRays {
    #[inline]
    pub(super) fn push(&mut self, ray: Ray, promised: Promised) {
        self.rays.push(ray);
        self.light.push(promised);
    }

    pub(super) fn clear(&mut self) {
        self.rays.clear();
        self.light.clear();
    }
}
