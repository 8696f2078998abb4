//! Radiance along rays: local light, shadow rays, mirror rays, refracted rays (Whitted 1980, "An Improved Illumination
//! Model for Shaded Display").
//!
//! Rays travel in batches, step by step: hits, the light of the surfaces themselves, shadow rays to each light, and
//! then all that goes on, off mirrors, through transparent surfaces and into bodies. What a sample gets does not depend
//! on what else is in its batch.

mod batch;
mod count;
mod direct;
mod environment;
mod ground;
mod lanes;
mod onward;
mod parts;
mod refract;
mod seen;
mod transparent;

pub use count::Counts;
pub use parts::Parts;
pub use seen::{First, Share};

use crate::accel::Accel;
use crate::camera::View;
use crate::color::Rgb;
use crate::environment::MAX_ROUNDS;
use crate::film::{FAR_AWAY, Layers, Source, Statistics};
use crate::geometry::Hit;
use crate::ray::Ray;
use crate::scene::{Recent, Scene};
use crate::shade::{Shading, flat, mirror};
use crate::texture::TextureFilter;
use batch::{Arrivals, Paths, ShadowRays};
use environment::Lit;
use glam::Vec3;
use ground::Grounded;
use lanes::WIDTH;
use parts::Did;
use std::mem::{swap, take};
use std::time::{Duration, Instant};
use transparent::ThroughLayers;

/// The most transparent layers a ray goes through. So many boundaries of bodies, too, total reflections inside included:
/// of those no ray splits. Mirror bounces are counted by themselves ([`Rules::max_depth`]): few of them are enough, while
/// what lies behind glass in glass must not be black.
///
/// Where a ray splits in two, their shares add to 1 at most, and one below [`mirror::LEAST_ENERGY`] in every colour is not
/// followed: a camera ray has at most 3 x 4096 rays under way, however often they split.
pub const MAX_LAYERS: u32 = 64;

/// In an environment, where glass shows light from everywhere, a path that went through some is not followed below this
/// share of its light: rays split at each boundary, and 8 bits of a display tell no more apart.
const LEAST_IN_GLASS: f32 = 1.0 / 256.0;

/// What a camera ray brings back.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Sample {
    /// Linear, premultiplied by `alpha`.
    pub color: Rgb,
    /// The share of the ray that ended at something.
    pub alpha: f32,
    /// The distance along the camera's axis of what was met first, or [`FAR_AWAY`].
    pub depth: f32,
    /// Of what was met first, [`Scene::object_of`], or [`NO_OBJECT`].
    pub object: u32,
    /// The surface's own unit normal there, which no texture bends; zero where there is none.
    pub normal: Vec3,
}

/// The object of a ray that meets none.
pub const NO_OBJECT: u32 = u32::MAX;

/// How light is followed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Rules {
    /// How surfaces answer light.
    pub shading: Shading,
    /// The most mirror bounces.
    pub max_depth: u32,
    /// Which part of a texture a ray shows.
    pub texture_filter: TextureFilter,
    /// How many samples a pixel has, or may have: up to the fourth, each sees as much less of it.
    pub samples: u32,
    /// Which parts of its light somebody wants to know.
    pub layers: Layers,
}

impl Rules {
    /// The share of a pixel's width that one sample stands for: half of it from four samples on, so that the base samples of
    /// an adaptive picture and its further ones see alike.
    fn share_of_pixel(&self) -> f32 {
        match self.texture_filter {
            TextureFilter::Point => 0.0,
            TextureFilter::Footprint => 1.0 / (self.samples.clamp(1, 4) as f32).sqrt(),
        }
    }

    /// Into so many rounds the environment's lights are divided: one for each sample of a pixel, and then again.
    fn rounds(&self) -> u32 {
        self.samples.clamp(1, MAX_ROUNDS)
    }
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
    /// What the rays of each sample of a batch were tested against, batches added, if somebody wants to know.
    pub counts: Option<Vec<Counts>>,
    /// What the light of each sample of a batch is made of, if somebody wants to know.
    pub parts: Option<Parts>,
    /// What each sample of a batch met first, if somebody wants to know.
    pub firsts: Option<Vec<First>>,
    /// Which shares of the samples of a batch objects have, if somebody wants to know: along each sample, the nearest
    /// first.
    pub shares: Option<Vec<Share>>,
    paths: Paths,
    /// What goes on from where `paths` end.
    further: Paths,
    hits: Vec<Option<Hit>>,
    arrivals: Arrivals,
    /// From lamps, from surfaces, and from the ground, to whose places those of the last promise.
    shadow_rays: [ShadowRays; 3],
    occluded: Vec<bool>,
    through_layers: ThroughLayers<'a>,
    lit: Vec<Lit>,
    grounded: Vec<Grounded>,
    /// Which of these may lie in shadow.
    shaded: Vec<usize>,
    recent: Recent,
    /// Where the light comes from that shadow rays decide about.
    source: Source,
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
            counts: None,
            parts: Parts::of(rules.layers),
            firsts: rules.layers.of_surfaces().then(Vec::new),
            shares: rules.layers.mattes.then(Vec::new),
            paths: Paths::default(),
            further: Paths::default(),
            hits: Vec::new(),
            arrivals: Arrivals::new(scene),
            shadow_rays: Default::default(),
            occluded: Vec::new(),
            through_layers: ThroughLayers::default(),
            lit: Vec::new(),
            grounded: Vec::new(),
            shaded: Vec::new(),
            recent: Recent::default(),
            source: Source::Environment,
        }
    }

    /// The light along each camera ray of `view`, into `samples`, which is cleared first. The rays are those of sample
    /// `number` of their pixels.
    pub fn trace(
        &mut self,
        view: &View,
        number: u32,
        camera_rays: &[Ray],
        samples: &mut Vec<Sample>,
    ) {
        let nothing = Sample {
            color: Rgb::BLACK,
            alpha: 1.0,
            depth: FAR_AWAY,
            object: NO_OBJECT,
            normal: Vec3::ZERO,
        };
        samples.clear();
        samples.resize(camera_rays.len(), nothing);
        if let Some(parts) = &mut self.parts {
            parts.start(camera_rays.len());
        }
        self.start_seeing(camera_rays.len());
        self.statistics.camera_rays += camera_rays.len() as u64;
        self.paths
            .start(view, self.rules.share_of_pixel(), camera_rays);
        while !self.paths.rays.is_empty() {
            self.arrive(samples);
            self.pass_ground(number, samples);
            self.look();
            self.add_own_light(view, samples);
            self.share_samples();
            let arrivals = take(&mut self.arrivals);
            if self.rules.shading != Shading::Flat {
                for (number, lamp) in (0..).zip(self.scene.lamps()) {
                    self.source = Source::Lamp(number);
                    self.add_light(lamp, &arrivals, samples);
                }
                self.source = Source::Environment;
                self.add_environment(number, &arrivals, samples);
            }
            for &index in &arrivals.onward {
                self.reflect(&arrivals, index);
                self.pass_through(&arrivals.list[index]);
            }
            for &(index, coat) in &arrivals.coats {
                let energy = arrivals.list[index].weight * coat.mirrored;
                self.mirror_about(&arrivals, index, coat.normal, energy);
            }
            for (index, through) in &arrivals.through {
                self.refract(&arrivals, *index, through);
            }
            self.arrivals = arrivals;
            self.paths.clear();
            swap(&mut self.paths, &mut self.further);
        }
    }

    /// Follows every path to the surface it meets; what meets none sees the background.
    #[inline(never)]
    fn arrive(&mut self, samples: &mut [Sample]) {
        let start = self.watched.then(Instant::now);
        self.accel.intersect_all(&self.paths.rays, &mut self.hits);
        self.statistics.search += since(start);
        self.count_paths();
        if self.scene.has_volumes() {
            self.attenuate();
        }
        self.arrivals.clear();
        for index in 0..self.paths.rays.len() {
            let (ray, path) = (self.paths.rays[index], self.paths.paths[index]);
            let (number, hit) = (index as u32, self.hits[index]);
            let t_max = hit.map_or(f32::INFINITY, |hit| hit.t);
            if self.meets_ground(number, &ray, &path, t_max) {
                continue;
            }
            match hit {
                Some(hit) => {
                    let path = (number, &ray, &path);
                    self.arrivals.push(self.scene, path, &hit, &mut self.recent);
                }
                None => self.see_past(number, path.energy, samples),
            }
        }
        self.arrivals.settle();
    }

    /// Looks up what surfaces are like, where that is not the same everywhere.
    #[inline(never)]
    fn look(&mut self) {
        for unknown in 0..self.arrivals.unknown.len() {
            let index = self.arrivals.unknown[unknown];
            let path = self.arrivals.list[index].path as usize;
            if let Some(hit) = &self.hits[path] {
                let (ray, place) = (&self.paths.rays[path], self.arrivals.place(index));
                let width = self.paths.paths[path].cone.width_at(hit.t);
                let surface = self.scene.look(ray, hit, place, width, &mut self.recent);
                let whole = self.rules.shading != Shading::Flat;
                self.arrivals.know(index, &surface, whole);
            }
        }
    }

    /// Adds the light of the surfaces' own, and notes what they are.
    #[inline(never)]
    fn add_own_light(&mut self, view: &View, samples: &mut [Sample]) {
        let Arrivals {
            list,
            places,
            onward,
            reflectances,
            ..
        } = &mut self.arrivals;
        for (index, arrival) in list.iter().enumerate() {
            let sample = &mut samples[arrival.sample as usize];
            let surface = &reflectances[arrival.reflectance as usize];
            let [own, ambient] = match self.rules.shading {
                Shading::Flat => [flat::color(surface), Rgb::BLACK],
                _ => [surface.emission, surface.ambient * self.scene.ambient()],
            };
            sample.color += arrival.weight * (own + ambient);
            if let Some(parts) = &mut self.parts {
                let path = &self.paths.paths[arrival.path as usize];
                parts.add(path, Did::Emit, Source::Emission, arrival.weight * own);
                let ambient = arrival.weight * ambient;
                parts.add(path, Did::Ambient, Source::Ambient, ambient);
            }
            if arrival.coverage < 1.0 || mirror::matters(arrival.weight * surface.reflectivity) {
                onward.push(index);
            }
            // What a camera ray meets is the first surface that is there at all.
            if sample.depth == FAR_AWAY && arrival.coverage > 0.0 {
                let path = arrival.path as usize;
                if let (0, Some(hit)) = (self.paths.paths[path].bounces, &self.hits[path]) {
                    sample.depth = view.depth(&self.paths.rays[path], hit.t);
                    sample.object = self.scene.object_of(hit.primitive, &mut self.recent);
                    sample.normal = places[index / WIDTH].true_normal(index % WIDTH);
                    let firsts = self.firsts.as_mut();
                    let first = firsts.and_then(|all| all.get_mut(arrival.sample as usize));
                    if let Some(first) = first {
                        let place = places[index / WIDTH].get(index % WIDTH);
                        let ray = &self.paths.rays[path];
                        let met = (ray, hit, &place);
                        *first = First::of(self.scene, met, surface, &mut self.recent);
                    }
                }
            }
        }
    }
}

fn since(start: Option<Instant>) -> Duration {
    start.map_or(Duration::ZERO, |start| start.elapsed())
}
