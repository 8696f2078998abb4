//! Radiance along rays: local light, shadow rays, mirror rays (Whitted 1980, "An Improved Illumination Model for
//! Shaded Display").
//!
//! Rays travel in batches, step by step: hits, the light of the surfaces themselves, shadow rays to each light, and
//! then all that goes on, off mirrors and through transparent surfaces. What a sample gets does not depend on what else
//! is in its batch.

mod batch;

use crate::accel::Accel;
use crate::camera::View;
use crate::color::Rgb;
use crate::film::{FAR_AWAY, Statistics};
use crate::geometry::Hit;
use crate::light::Lamp;
use crate::ray::Ray;
use crate::scene::{Recent, Scene, Shown, Surface};
use crate::shade::{Shading, flat, mirror};
use batch::{Arrival, Path, Paths, Promised, ShadowRays};
use std::mem::{swap, take};
use std::time::{Duration, Instant};

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
    /// Whether the time that search takes is measured.
    pub watched: bool,
    paths: Paths,
    /// What goes on from where `paths` end.
    further: Paths,
    hits: Vec<Option<Hit>>,
    arrivals: Vec<Arrival<'a>>,
    shadow_rays: [ShadowRays; 2],
    occluded: Vec<bool>,
    recent: Recent,
}

impl<'a> Tracer<'a> {
    /// A tracer without anything under way.
    pub fn new(scene: &'a Scene, accel: &'a Accel, rules: Rules) -> Tracer<'a> {
        Tracer {
            scene,
            accel,
            rules,
            statistics: Statistics::default(),
            watched: false,
            paths: Paths::default(),
            further: Paths::default(),
            hits: Vec::new(),
            arrivals: Vec::new(),
            shadow_rays: Default::default(),
            occluded: Vec::new(),
            recent: Recent::default(),
        }
    }

    /// The light along each camera ray of `view`, into `samples`, which is cleared first.
    pub fn trace(&mut self, view: &View, camera_rays: &[Ray], samples: &mut Vec<Sample>) {
        let nothing = Sample {
            color: Rgb::BLACK,
            alpha: 1.0,
            depth: FAR_AWAY,
        };
        samples.clear();
        samples.resize(camera_rays.len(), nothing);
        self.statistics.camera_rays += camera_rays.len() as u64;
        self.paths.start(camera_rays);
        while !self.paths.rays.is_empty() {
            self.arrive(samples);
            let arrivals = take(&mut self.arrivals);
            for arrival in &arrivals {
                self.note_depth(view, arrival, samples);
                samples[arrival.sample as usize].color += self.own_light(arrival);
            }
            if self.rules.shading != Shading::Flat {
                for lamp in self.scene.lamps() {
                    self.add_light(lamp, &arrivals, samples);
                }
            }
            for arrival in &arrivals {
                self.reflect(arrival);
                self.pass_through(arrival);
            }
            self.arrivals = arrivals;
            self.paths.clear();
            swap(&mut self.paths, &mut self.further);
        }
    }

    /// Follows every path to the surface it meets; what meets none sees the background.
    fn arrive(&mut self, samples: &mut [Sample]) {
        let start = self.watched.then(Instant::now);
        self.accel.intersect_all(&self.paths.rays, &mut self.hits);
        self.statistics.search += since(start);
        let background = self.scene.background();
        self.arrivals.clear();
        let paths = self.paths.rays.iter().zip(&self.paths.paths);
        for (index, ((ray, path), hit)) in (0..).zip(paths.zip(&self.hits)) {
            let sample = &mut samples[path.sample as usize];
            match hit {
                Some(hit) => {
                    let surface = self.scene.surface_near(ray, hit, &mut self.recent);
                    self.arrivals.push(Arrival {
                        path: index,
                        sample: path.sample,
                        weight: path.energy * surface.coverage,
                        v: -ray.direction,
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
    }

    /// The depth of a camera ray is that of the first surface that is there at all.
    fn note_depth(&self, view: &View, arrival: &Arrival, samples: &mut [Sample]) {
        let sample = &mut samples[arrival.sample as usize];
        if sample.depth != FAR_AWAY || arrival.surface.coverage == 0.0 {
            return;
        }
        let index = arrival.path as usize;
        if let (0, Some(hit)) = (self.paths.paths[index].bounces, &self.hits[index]) {
            sample.depth = view.depth(&self.paths.rays[index], hit.t);
        }
    }

    /// Emission and ambient light, or the flat colour.
    fn own_light(&self, arrival: &Arrival) -> Rgb {
        let surface = &*arrival.surface.reflectance;
        let light = match self.rules.shading {
            Shading::Flat => flat::color(surface),
            _ => surface.emission + surface.ambient * self.scene.ambient(),
        };
        arrival.weight * light
    }

    /// Adds what one light sends to every surface that it reaches.
    fn add_light(&mut self, lamp: &Lamp, arrivals: &[Arrival], samples: &mut [Sample]) {
        let [from_light, from_surfaces] = &mut self.shadow_rays;
        for arrival in arrivals {
            let Some(light) = arrival.faces(lamp) else {
                continue;
            };
            let surface = &arrival.surface;
            let reflected = self.rules.shading.reflected(
                &surface.reflectance,
                surface.normal,
                light.to_light,
                arrival.v,
                light.irradiance,
            );
            let promised = Promised {
                sample: arrival.sample,
                light: arrival.weight * reflected,
            };
            match arrival.ray_from(lamp) {
                Some(ray) => from_light.push(ray, promised),
                None => from_surfaces.push(arrival.ray_to(&light), promised),
            }
        }
        // Apart: rays that share their origin are searched faster among themselves.
        self.add_unless_occluded(0, samples);
        self.add_unless_occluded(1, samples);
    }

    /// Adds what shadow rays promise where nothing stands in their way.
    fn add_unless_occluded(&mut self, kind: usize, samples: &mut [Sample]) {
        let shadow_rays = &mut self.shadow_rays[kind];
        let start = self.watched.then(Instant::now);
        self.accel
            .occluded_all(&shadow_rays.rays, &mut self.occluded);
        self.statistics.search += since(start);
        self.statistics.shadow_rays += shadow_rays.rays.len() as u64;
        let transparent = self.accel.has_transparent();
        for ((promised, ray), &occluded) in shadow_rays
            .light
            .iter()
            .zip(&shadow_rays.rays)
            .zip(&self.occluded)
        {
            if occluded {
                continue;
            }
            let mut light = promised.light;
            if transparent {
                let (share, lost) = transmitted(self.scene, self.accel, ray);
                self.statistics.lost_in_layers += u64::from(lost);
                light *= share;
            }
            samples[promised.sample as usize].color += light;
        }
        shadow_rays.clear();
    }

    /// Sends on the mirror ray, as long as it still matters.
    fn reflect(&mut self, arrival: &Arrival) {
        let energy = arrival.weight * arrival.surface.reflectance.reflectivity;
        if energy.max_component() < mirror::LEAST_ENERGY || self.rules.shading == Shading::Flat {
            return;
        }
        let path = self.paths.paths[arrival.path as usize];
        if path.bounces >= self.rules.max_depth {
            return;
        }
        let Surface { point, normal, .. } = &arrival.surface;
        let d = -arrival.v;
        let r = mirror::direction(d, *normal);
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
        let path = Path {
            energy,
            bounces: path.bounces + 1,
            ..path
        };
        self.further.push(ray, path);
        self.statistics.mirror_rays += 1;
    }

    /// Sends on what the surface lets through, in the direction it came.
    fn pass_through(&mut self, arrival: &Arrival) {
        if arrival.surface.coverage == 1.0 {
            return;
        }
        let index = arrival.path as usize;
        let (path, ray) = (self.paths.paths[index], &self.paths.rays[index]);
        let energy = path.energy * (1.0 - arrival.surface.coverage);
        let Some(hit) = &self.hits[index] else { return };
        if energy.max_component() < mirror::LEAST_ENERGY {
            return;
        }
        if path.layers == MAX_LAYERS {
            self.statistics.lost_in_layers += 1;
            return;
        }
        let path = Path {
            energy,
            layers: path.layers + 1,
            ..path
        };
        self.further.push(ray.beyond(hit.t, hit.primitive), path);
        self.statistics.transparent_rays += 1;
    }
}

fn since(start: Option<Instant>) -> Duration {
    start.map_or(Duration::ZERO, |start| start.elapsed())
}

/// The share of a shadow ray's light that transparent surfaces let through, nothing opaque being on the ray, and whether
/// there were too many of them.
fn transmitted(scene: &Scene, accel: &Accel, shadow_ray: &Ray) -> (f32, bool) {
    let mut share = 1.0;
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
