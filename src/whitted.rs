//! Radiance along rays: local light, shadow rays, mirror rays (Whitted 1980, "An Improved Illumination Model for
//! Shaded Display").
//!
//! Rays travel in batches, step by step: hits, the light of the surfaces themselves, shadow rays to each light, and
//! then all that goes on, off mirrors and through transparent surfaces. What a sample gets does not depend on what else
//! is in its batch.

use crate::accel::Accel;
use crate::camera::View;
use crate::color::Rgb;
use crate::film::{FAR_AWAY, Statistics};
use crate::geometry::Hit;
use crate::light::{Illumination, Light};
use crate::ray::Ray;
use crate::scene::{Scene, Shown, Surface};
use crate::shade::{Shading, flat, mirror};

/// The most transparent layers a ray goes through.
pub const MAX_LAYERS: u32 = 64;

/// What a camera ray brings back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Linear, premultiplied by `alpha`.
    pub color: Rgb,
    /// The share of the ray that ended at something.
    pub alpha: f32,
    /// The distance along the camera's axis of what was met first, or [`FAR_AWAY`].
    pub depth: f32,
}

/// How light is followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rules {
    /// How surfaces answer light.
    pub shading: Shading,
    /// The most mirror bounces.
    pub max_depth: u32,
}

/// Follows batches of rays through one scene; keeps its memory from batch to batch.
#[derive(Debug)]
pub struct Tracer<'a> {
    scene: &'a Scene,
    accel: &'a Accel,
    rules: Rules,
    /// Rays by kind, since the beginning.
    pub statistics: Statistics,
    paths: Vec<Path>,
    rays: Vec<Ray>,
    hits: Vec<Option<Hit>>,
    occluded: Vec<bool>,
}

/// A ray under way, and what it carries to its sample.
#[derive(Clone, Copy, Debug)]
struct Path {
    ray: Ray,
    /// Which sample of the batch.
    sample: usize,
    /// The share of its light that reaches the camera.
    energy: Rgb,
    /// Mirrors so far; 0 for what the camera sees directly.
    bounces: u32,
    /// Transparent layers so far.
    layers: u32,
}

/// A path at a surface.
struct Arrival {
    path: Path,
    hit: Hit,
    surface: Surface,
}

/// A shadow ray's purpose.
struct Lit {
    arrival: usize,
    light: Illumination,
}

impl<'a> Tracer<'a> {
    /// A tracer without anything under way.
    pub fn new(scene: &'a Scene, accel: &'a Accel, rules: Rules) -> Tracer<'a> {
        let (paths, rays, hits, occluded) = (Vec::new(), Vec::new(), Vec::new(), Vec::new());
        Tracer {
            scene,
            accel,
            rules,
            statistics: Statistics::default(),
            paths,
            rays,
            hits,
            occluded,
        }
    }

    /// The light along each camera ray of `view`, into `samples`, which is cleared first.
    pub fn trace(&mut self, view: &View, camera_rays: &[Ray], samples: &mut Vec<Sample>) {
        samples.clear();
        samples.resize(
            camera_rays.len(),
            Sample {
                color: Rgb::BLACK,
                alpha: 1.0,
                depth: FAR_AWAY,
            },
        );
        self.statistics.camera_rays += camera_rays.len() as u64;
        let from_camera = |(sample, &ray)| Path {
            ray,
            sample,
            energy: Rgb::WHITE,
            bounces: 0,
            layers: 0,
        };
        self.paths
            .extend(camera_rays.iter().enumerate().map(from_camera));
        while !self.paths.is_empty() {
            let arrivals = self.arrive(samples);
            for arrival in &arrivals {
                note_depth(view, arrival, samples);
                samples[arrival.path.sample].color += self.own_light(arrival);
            }
            if self.rules.shading != Shading::Flat {
                for light in self.scene.lights() {
                    self.add_light(light, &arrivals, samples);
                }
            }
            for arrival in &arrivals {
                self.reflect(arrival);
                self.pass_through(arrival);
            }
        }
    }

    /// Follows every path to the surface it meets; what meets none sees the background.
    fn arrive(&mut self, samples: &mut [Sample]) -> Vec<Arrival> {
        self.rays.clear();
        self.rays.extend(self.paths.iter().map(|path| path.ray));
        self.accel.intersect_all(&self.rays, &mut self.hits);
        let background = self.scene.background();
        let mut arrivals = Vec::with_capacity(self.paths.len());
        for (path, hit) in self.paths.drain(..).zip(&self.hits) {
            let sample = &mut samples[path.sample];
            match hit {
                Some(hit) => {
                    let surface = self.scene.surface(&path.ray, hit);
                    arrivals.push(Arrival {
                        path,
                        hit: *hit,
                        surface,
                    });
                }
                // What the camera sees past everything is the film's affair, unless the background is part of the
                // picture; the energy of such a path is what transparent surfaces left, alike in every channel.
                None if path.bounces == 0 && background.shown != Shown::Always => {
                    sample.alpha = 1.0 - path.energy.r
                }
                None => sample.color += path.energy * background.color,
            }
        }
        arrivals
    }

    /// Emission and ambient light, or the flat colour.
    fn own_light(&self, arrival: &Arrival) -> Rgb {
        let surface = &arrival.surface.reflectance;
        let light = match self.rules.shading {
            Shading::Flat => flat::color(surface),
            _ => surface.emission + surface.ambient * self.scene.ambient(),
        };
        arrival.weight() * light
    }

    /// Adds what one light sends to every surface that it reaches.
    fn add_light(&mut self, light: &Light, arrivals: &[Arrival], samples: &mut [Sample]) {
        self.rays.clear();
        let mut lit = Vec::with_capacity(arrivals.len());
        for (index, arrival) in arrivals.iter().enumerate() {
            let Some(illumination) = arrival.faces(light) else {
                continue;
            };
            self.rays.push(arrival.shadow_ray(&illumination));
            lit.push(Lit {
                arrival: index,
                light: illumination,
            });
        }
        self.statistics.shadow_rays += self.rays.len() as u64;
        self.accel.occluded_all(&self.rays, &mut self.occluded);
        for ((lit, ray), &occluded) in lit.iter().zip(&self.rays).zip(&self.occluded) {
            if occluded {
                continue;
            }
            let Arrival { path, surface, .. } = &arrivals[lit.arrival];
            let Illumination {
                to_light: l,
                irradiance,
                ..
            } = lit.light;
            let v = -path.ray.direction;
            let (share, lost) = transmitted(self.scene, self.accel, ray);
            self.statistics.lost_in_layers += u64::from(lost);
            let e = irradiance * share;
            let reflected =
                self.rules
                    .shading
                    .reflected(&surface.reflectance, surface.normal, l, v, e);
            samples[path.sample].color += arrivals[lit.arrival].weight() * reflected;
        }
    }

    /// Sends on the mirror ray, as long as it still matters.
    fn reflect(&mut self, arrival: &Arrival) {
        let Arrival { path, surface, .. } = arrival;
        let energy = arrival.weight() * surface.reflectance.reflectivity;
        let goes_on = path.bounces < self.rules.max_depth && self.rules.shading != Shading::Flat;
        if !goes_on || energy.max_component() < mirror::LEAST_ENERGY {
            return;
        }
        let (d, point) = (path.ray.direction, surface.point);
        let r = mirror::direction(d, surface.normal);
        // A bent normal can send the ray into the surface: then the surface's own normal says where the mirror is.
        let r = if r.dot(point.normal) > 0.0 {
            r
        } else {
            mirror::direction(d, point.normal)
        };
        let ray = Ray::leaving(
            point.position,
            point.normal,
            point.error,
            r.normalize_or(r),
            f32::INFINITY,
        );
        self.paths.push(Path {
            ray,
            energy,
            bounces: path.bounces + 1,
            ..*path
        });
        self.statistics.mirror_rays += 1;
    }

    /// Sends on what the surface lets through, in the direction it came.
    fn pass_through(&mut self, arrival: &Arrival) {
        let Arrival { path, hit, surface } = arrival;
        let energy = path.energy * (1.0 - surface.coverage);
        if energy.max_component() < mirror::LEAST_ENERGY {
            return;
        }
        if path.layers == MAX_LAYERS {
            self.statistics.lost_in_layers += 1;
            return;
        }
        let ray = path.ray.beyond(hit.t, hit.primitive);
        self.paths.push(Path {
            ray,
            energy,
            layers: path.layers + 1,
            ..*path
        });
        self.statistics.transparent_rays += 1;
    }
}

impl Arrival {
    /// The share of what the surface sends back that reaches the camera.
    fn weight(&self) -> Rgb {
        self.path.energy * self.surface.coverage
    }

    /// What a light sends here, if it stands before the surface: before the one that shading sees, and the true one.
    fn faces(&self, light: &Light) -> Option<Illumination> {
        let Surface {
            point,
            normal,
            lit,
            coverage,
            ..
        } = &self.surface;
        if !lit || *coverage == 0.0 {
            return None;
        }
        light
            .illuminate(point.position)
            .filter(|i| normal.dot(i.to_light) > 0.0 && point.normal.dot(i.to_light) > 0.0)
    }

    /// The ray to a light. It ends a little before, so that a surface that holds the light does not hide it.
    fn shadow_ray(&self, light: &Illumination) -> Ray {
        let point = self.surface.point;
        Ray::leaving(
            point.position,
            point.normal,
            point.error,
            light.to_light,
            light.distance * (1.0 - 1e-6),
        )
    }
}

/// The share of a shadow ray's light that transparent surfaces let through, nothing opaque being on the ray, and whether
/// there were too many of them.
fn transmitted(scene: &Scene, accel: &Accel, shadow_ray: &Ray) -> (f32, bool) {
    let mut share = 1.0;
    if !accel.has_transparent() {
        return (share, false);
    }
    let mut ray = *shadow_ray;
    for _ in 0..MAX_LAYERS {
        let Some(hit) = accel.intersect(&ray) else {
            return (share, false);
        };
        share *= 1.0 - scene.shadow_coverage(&hit);
        if share == 0.0 {
            return (share, false);
        }
        ray = ray.beyond(hit.t, hit.primitive);
    }
    (share, accel.intersect(&ray).is_some())
}

/// The depth of a camera ray is that of the first surface that is there at all.
fn note_depth(view: &View, arrival: &Arrival, samples: &mut [Sample]) {
    let Arrival { path, hit, surface } = arrival;
    let sample = &mut samples[path.sample];
    if path.bounces == 0 && surface.coverage > 0.0 && sample.depth == FAR_AWAY {
        sample.depth = view.depth(&path.ray, hit.t);
    }
}
