//! What goes on from a surface: rays off mirrors, and through what is transparent.

use super::batch::{Arrival, Arrivals, Path};
use super::{MAX_LAYERS, Tracer};
use crate::ray::Ray;
use crate::scene::Place;
use crate::shade::{Shading, mirror};

impl Tracer<'_> {
    /// Sends on the mirror ray, as long as it still matters.
    pub(super) fn reflect(&mut self, arrivals: &Arrivals, index: usize) {
        let arrival = &arrivals.list[index];
        let surface = &arrivals.reflectances[arrival.reflectance as usize];
        let energy = arrival.weight * surface.reflectivity;
        if !mirror::matters(energy) || self.rules.shading == Shading::Flat {
            return;
        }
        let path = self.paths.paths[arrival.path as usize];
        if path.bounces >= self.rules.max_depth {
            return;
        }
        let Place { point, normal, .. } = arrivals.place(index);
        let d = self.paths.rays[arrival.path as usize].direction;
        let r = mirror::direction(d, normal);
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
    pub(super) fn pass_through(&mut self, arrival: &Arrival) {
        if arrival.coverage == 1.0 {
            return;
        }
        let index = arrival.path as usize;
        let (path, ray) = (self.paths.paths[index], &self.paths.rays[index]);
        let energy = path.energy * (1.0 - arrival.coverage);
        let Some(hit) = &self.hits[index] else { return };
        if !mirror::matters(energy) {
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
