//! What a tracer has under way: paths, the surfaces they arrive at, and shadow rays, in memory that is kept.

use crate::color::Rgb;
use crate::light::{Illumination, Lamp};
use crate::ray::{AT_LIGHT, Ray};
use crate::scene::Surface;
use glam::Vec3;

/// What a ray carries to its sample.
#[derive(Clone, Copy, Debug)]
pub(super) struct Path {
    /// Which sample of the batch.
    pub(super) sample: u32,
    /// Mirrors so far; 0 for what the camera sees directly.
    pub(super) bounces: u32,
    /// Transparent layers so far.
    pub(super) layers: u32,
    /// The share of its light that reaches the camera.
    pub(super) energy: Rgb,
}

/// Rays under way, and the path that each belongs to.
#[derive(Debug, Default)]
pub(super) struct Paths {
    pub(super) rays: Vec<Ray>,
    pub(super) paths: Vec<Path>,
}

impl Paths {
    /// One path for each sample, from the camera.
    pub(super) fn start(&mut self, camera_rays: &[Ray]) {
        self.clear();
        self.rays.extend_from_slice(camera_rays);
        let path = |sample| Path {
            sample,
            bounces: 0,
            layers: 0,
            energy: Rgb::WHITE,
        };
        self.paths.extend((0..camera_rays.len() as u32).map(path));
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
#[derive(Debug)]
pub(super) struct Arrival<'a> {
    /// Which of the paths.
    pub(super) path: u32,
    /// Which sample of the batch.
    pub(super) sample: u32,
    /// The share of what the surface sends back that reaches the camera.
    pub(super) weight: Rgb,
    /// Toward the viewer, unit.
    pub(super) v: Vec3,
    pub(super) surface: Surface<'a>,
}

impl Arrival<'_> {
    /// What a light sends here, if it stands before the surface: before the one that shading sees, and the true one.
    #[inline]
    pub(super) fn faces(&self, lamp: &Lamp) -> Option<Illumination> {
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
        let light = lamp.illuminate(point.position)?;
        let l = light.to_light;
        (normal.dot(l) > 0.0 && point.normal.dot(l) > 0.0).then_some(light)
    }

    /// The shadow ray from a light that shines from a point, where one can end close enough to the surface.
    #[inline]
    pub(super) fn ray_from(&self, lamp: &Lamp) -> Option<Ray> {
        let point = &self.surface.point;
        Ray::reaching(point.position, point.normal, point.error, lamp.position()?)
    }

    /// The shadow ray to a light. It ends a little before, so that a surface that holds the light does not hide it.
    pub(super) fn ray_to(&self, light: &Illumination) -> Ray {
        let point = &self.surface.point;
        Ray::leaving(
            point.position,
            point.normal,
            point.error,
            light.to_light,
            light.distance * (1.0 - AT_LIGHT),
        )
    }
}

/// Shadow rays, and what each decides about.
#[derive(Debug, Default)]
pub(super) struct ShadowRays {
    pub(super) rays: Vec<Ray>,
    pub(super) light: Vec<Promised>,
}

/// What a sample gets if nothing stands in the way of a shadow ray.
#[derive(Clone, Copy, Debug)]
pub(super) struct Promised {
    pub(super) sample: u32,
    pub(super) light: Rgb,
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
