//! Direct light: what lamps send to surfaces, with a shadow ray for each.

use super::batch::{Arrival, Arrivals, FROM_GROUND, FROM_LAMPS, FROM_SURFACES, Promised, ray_to};
use super::lanes::{Shone, WIDTH};
use super::parts::Did;
use super::{Rules, Sample, Tracer, since};
use crate::color::Rgb;
use crate::geometry::Hit;
use crate::light::{Illumination, Lamp};
use crate::ray::Ray;
use crate::scene::Place;
use crate::shade::{Reflectance, lambert};
use glam::Vec3;
use std::time::Instant;

impl Rules {
    /// What a light sends to the camera off a surface with this normal, seen from `v`, if nothing stands in its way.
    #[inline(always)]
    fn promise(
        &self,
        arrival: &Arrival,
        surface: &Reflectance,
        n: Vec3,
        v: Vec3,
        light: &Illumination,
    ) -> Promised {
        let (l, e) = (light.to_light, light.irradiance);
        let light = self.shading.reflected(surface, n, l, v, e);
        let gloss = if self.layers.parts() > 0 {
            light - lambert::reflected(surface, n, l, e)
        } else {
            Rgb::BLACK
        };
        Promised {
            sample: arrival.sample,
            light: arrival.weight * light,
            gloss: arrival.weight * gloss,
            path: arrival.path,
        }
    }
}

impl Tracer<'_> {
    /// Adds what one light sends to every surface that it stands before and reaches.
    pub(super) fn add_light(&mut self, lamp: &Lamp, arrivals: &Arrivals, samples: &mut [Sample]) {
        match (lamp.position(), lamp.parallel()) {
            (Some(position), _) => self.promise_from(lamp, position, arrivals),
            (None, Some(light)) => self.promise_along(&light, arrivals),
            (None, None) => {}
        }
        for (index, through) in &arrivals.from_behind {
            self.promise_behind(lamp, arrivals, *index, *through);
        }
        // Apart: rays that share their origin are searched faster among themselves.
        self.add_unless_occluded(FROM_LAMPS, samples);
        self.add_unless_occluded(FROM_SURFACES, samples);
    }

    /// The shadow rays of a light that shines from a point.
    #[inline(never)]
    fn promise_from(&mut self, lamp: &Lamp, position: Vec3, arrivals: &Arrivals) {
        let [from_light, from_surfaces, _] = &mut self.shadow_rays;
        let mut shone = Shone::default();
        for (eight, places) in arrivals.list.chunks(WIDTH).zip(&arrivals.places) {
            shone.set(places, lamp, position);
            for (lane, arrival) in eight.iter().enumerate() {
                let Some(light) = shone.arriving(lane) else {
                    continue;
                };
                let v = -self.paths.rays[arrival.path as usize].direction;
                let surface = &arrivals.reflectances[arrival.reflectance as usize];
                let n = places.normal(lane);
                let promised = self.rules.promise(arrival, surface, n, v, &light);
                match shone.ray_from(position, lane) {
                    Some(ray) => from_light.push(ray, promised),
                    None => from_surfaces.push(ray_to(&light, &places.get(lane).point), promised),
                }
            }
        }
    }

    /// The shadow rays of a light whose rays are parallel.
    #[inline(never)]
    fn promise_along(&mut self, light: &Illumination, arrivals: &Arrivals) {
        for (index, arrival) in arrivals.list.iter().enumerate() {
            let (
                Place {
                    point, normal: n, ..
                },
                l,
            ) = (arrivals.place(index), light.to_light);
            if n.dot(l) > 0.0 && point.normal.dot(l) > 0.0 {
                let v = -self.paths.rays[arrival.path as usize].direction;
                let surface = &arrivals.reflectances[arrival.reflectance as usize];
                let promised = self.rules.promise(arrival, surface, n, v, light);
                self.shadow_rays[FROM_SURFACES].push(ray_to(light, &point), promised);
            }
        }
    }

    /// The shadow ray of a light that stands behind a surface which lets diffuse light `through`.
    fn promise_behind(&mut self, lamp: &Lamp, arrivals: &Arrivals, index: usize, through: Rgb) {
        let (arrival, place) = (&arrivals.list[index], arrivals.place(index));
        let Some(light) = lamp.illuminate(place.point.position) else {
            return;
        };
        let (n, l) = (-place.normal, light.to_light);
        if n.dot(l) > 0.0 && -place.point.normal.dot(l) > 0.0 {
            let surface = Reflectance {
                diffuse: through,
                ..Reflectance::BLACK
            };
            let promised = Promised {
                sample: arrival.sample,
                light: arrival.weight * lambert::reflected(&surface, n, l, light.irradiance),
                gloss: Rgb::BLACK,
                path: arrival.path,
            };
            self.shadow_rays[FROM_SURFACES].push(ray_to(&light, &place.point), promised);
        }
    }

    /// Adds what shadow rays promise where nothing stands in their way.
    #[inline(never)]
    pub(super) fn add_unless_occluded(&mut self, kind: usize, samples: &mut [Sample]) {
        if self.shadow_rays[kind].rays.is_empty() {
            return;
        }
        self.count_shadow_rays(kind);
        let shadow_rays = &mut self.shadow_rays[kind];
        let start = self.watched.then(Instant::now);
        self.accel
            .occluded_all(&shadow_rays.rays, &mut self.occluded);
        self.statistics.search += since(start);
        self.statistics.shadow_rays += shadow_rays.rays.len() as u64;
        if self.accel.has_transparent() {
            self.add_through_layers(kind, samples);
            return;
        }
        let promises = std::mem::take(shadow_rays);
        let occluded = std::mem::take(&mut self.occluded);
        for (promised, &occluded) in promises.light.iter().zip(&occluded) {
            if !occluded {
                self.keep(kind, promised, Rgb::WHITE, samples);
            }
        }
        self.occluded = occluded;
        self.shadow_rays[kind] = promises;
        self.shadow_rays[kind].clear();
    }

    /// Gives this share of what was promised: light to a sample, or to the ground.
    #[inline(always)]
    fn keep(&mut self, kind: usize, promised: &Promised, share: Rgb, samples: &mut [Sample]) {
        let light = promised.light * share;
        if kind == FROM_GROUND {
            self.grounded[promised.sample as usize].lost -= light;
        } else {
            samples[promised.sample as usize].color += light;
            if let Some(parts) = &mut self.parts {
                let path = &self.paths.paths[promised.path as usize];
                let gloss = promised.gloss * share;
                parts.add(path, Did::Scatter, self.source, light - gloss);
                parts.add(path, Did::Gloss, self.source, gloss);
            }
        }
    }

    /// Adds what transparent things leave of the light of shadow rays that nothing opaque stops.
    #[inline(never)]
    fn add_through_layers(&mut self, kind: usize, samples: &mut [Sample]) {
        let (accel, watched) = (self.accel, self.watched);
        let (shadow_rays, layers) = (&mut self.shadow_rays[kind], &mut self.through_layers);
        let statistics = &mut self.statistics;
        let search = |rays: &[Ray], hits: &mut Vec<Option<Hit>>| {
            let start = watched.then(Instant::now);
            accel.intersect_all(rays, hits);
            statistics.search += since(start);
        };
        let lost = layers.follow(self.scene, accel, search, &shadow_rays.rays, &self.occluded);
        statistics.lost_in_layers += lost;
        let promises = std::mem::take(&mut self.shadow_rays[kind]);
        let shares = std::mem::take(&mut self.through_layers.shares);
        for (promised, &share) in promises.light.iter().zip(&shares) {
            if share != Rgb::BLACK {
                self.keep(kind, promised, share, samples);
            }
        }
        self.through_layers.shares = shares;
        self.shadow_rays[kind] = promises;
        self.shadow_rays[kind].clear();
    }
}
