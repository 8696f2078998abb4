//! What goes on from a surface: rays off mirrors, and through what is transparent.

use super::batch::{Arrival, Arrivals, Path};
use super::parts::By;
use super::{LEAST_IN_GLASS, MAX_LAYERS, Tracer};
use crate::color::Rgb;
use crate::cone::Cone;
use crate::ray::Ray;
use crate::scene::Place;
use crate::shade::{Shading, mirror};
use glam::Vec3;

impl Tracer<'_> {
    /// Sends on the mirror ray, as long as it still matters.
    pub(super) fn reflect(&mut self, arrivals: &Arrivals, index: usize) {
        let arrival = &arrivals.list[index];
        let surface = &arrivals.reflectances[arrival.reflectance as usize];
        if self.rules.shading != Shading::Flat {
            self.mirror(arrivals, index, arrival.weight * surface.reflectivity);
        }
    }

    /// Sends on a mirror ray of this energy, as long as it still matters.
    pub(super) fn mirror(&mut self, arrivals: &Arrivals, index: usize, energy: Rgb) {
        let Place { normal, .. } = arrivals.place(index);
        self.mirror_about(arrivals, index, normal, energy);
    }

    /// The same about a normal that is not the surface's own.
    pub(super) fn mirror_about(
        &mut self,
        arrivals: &Arrivals,
        index: usize,
        normal: Vec3,
        energy: Rgb,
    ) {
        let arrival = &arrivals.list[index];
        let path = self.paths.paths[arrival.path as usize];
        let most = self.rules.max_depth.min(u16::MAX.into());
        if !self.matters(energy, path.layers) || u32::from(path.bounces) >= most {
            return;
        }
        let surface = &arrivals.reflectances[arrival.reflectance as usize];
        let roughness = surface.mirror_roughness;
        let path = Path {
            energy,
            bounces: path.bounces + 1,
            direct: false,
            by: path.by.then(By::Mirror),
            cone: self.mirrored_cone(arrivals, index),
            roughness: path.roughness.max(roughness),
            ..path
        };
        let ray = self.mirror_ray(arrivals, index, normal);
        self.further.push(ray, path);
        self.statistics.mirror_rays += 1;
    }

    /// Whether a path of this energy is followed that went through so many layers.
    pub(super) fn matters(&self, energy: Rgb, layers: u8) -> bool {
        let least = match self.scene.environment() {
            Some(_) if layers > 0 => LEAST_IN_GLASS,
            _ => mirror::LEAST_ENERGY,
        };
        energy.max_component() >= least
    }

    /// The mirror ray of an arrival about a normal of its.
    pub(super) fn mirror_ray(&self, arrivals: &Arrivals, index: usize, normal: Vec3) -> Ray {
        let Place { point, .. } = arrivals.place(index);
        let path = arrivals.list[index].path as usize;
        let d = self.paths.rays[path].direction;
        let r = mirror::direction(d, normal);
        // A bent normal can send the ray into the surface: then the surface's own normal says where the mirror is.
        let r = if r.dot(point.normal) > 0.0 {
            r
        } else {
            mirror::direction(d, point.normal)
        };
        Ray::leaving(
            point.position,
            point.normal,
            point.error,
            r.normalize_or(r),
            f32::INFINITY,
        )
    }

    /// The cone of the mirror ray of an arrival.
    pub(super) fn mirrored_cone(&mut self, arrivals: &Arrivals, index: usize) -> Cone {
        let (cone, t, curvature) = self.cone_at(arrivals, index);
        let arrival = &arrivals.list[index];
        let roughness = arrivals.reflectances[arrival.reflectance as usize].mirror_roughness;
        cone.mirrored(t, curvature, roughness * roughness)
    }

    /// The cone that arrives, where along its ray, and how much the surface there bulges toward it. What a normal map does
    /// to cones is not followed.
    pub(super) fn cone_at(&mut self, arrivals: &Arrivals, index: usize) -> (Cone, f32, f32) {
        let path = arrivals.list[index].path as usize;
        let cone = self.paths.paths[path].cone;
        let (Some(hit), true) = (&self.hits[path], cone != Cone::POINT) else {
            return (Cone::POINT, 0.0, 0.0);
        };
        let curvature = self.scene.curvature(hit, &mut self.recent);
        let front = arrivals.place(index).front;
        (cone, hit.t, if front { curvature } else { -curvature })
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
        if u32::from(path.layers) == MAX_LAYERS {
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
