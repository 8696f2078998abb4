//! What samples see: the surface that each meets first, and which share of it objects have, one behind the other.

use super::Tracer;
use crate::color::Rgb;
use crate::geometry::Hit;
use crate::ray::Ray;
use crate::scene::{Place, Recent, Scene, Way};
use crate::shade::Reflectance;
use glam::{Vec2, Vec3};

/// What a sample met first; all zero where it met nothing.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct First {
    /// The unit normal that shading sees, toward the viewer, world space.
    pub normal: Vec3,
    /// World space.
    pub position: Vec3,
    /// Of the first set of texture coordinates.
    pub uv: Vec2,
    /// The surface's own colour, linear.
    pub albedo: Rgb,
}

impl First {
    /// Where `ray` met something.
    pub(super) fn of(
        scene: &Scene,
        (ray, hit, place): (&Ray, &Hit, &Place),
        surface: &Reflectance,
        recent: &mut Recent,
    ) -> First {
        // What no light changes has lost its normal on the way here.
        let normal = if place.normal == Vec3::ZERO {
            scene.place(ray, hit, recent).normal
        } else {
            place.normal
        };
        First {
            normal,
            position: place.point.position,
            uv: scene.uv(hit, recent),
            albedo: surface.color,
        }
    }
}

/// The share that an object has of a sample: what it takes of the light from behind it, on the straight line from the
/// camera. All of a sample add up to its alpha, unless the background is part of the picture.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Share {
    /// Which sample of the batch.
    pub sample: u32,
    /// [`Scene::object_of`], or [`Scene::ground_object`].
    pub object: u32,
    /// 0..1.
    pub share: f32,
}

/// One number for all colours of what is left of a ray: of what tinted sheets leave it is the middle.
pub(super) fn middle(Rgb { r, g, b }: Rgb) -> f32 {
    0.5 * (r.max(g).max(b) + r.min(g).min(b))
}

impl Tracer<'_> {
    /// Forgets what was seen, for so many samples.
    pub(super) fn start_seeing(&mut self, samples: usize) {
        if let Some(firsts) = &mut self.firsts {
            firsts.clear();
            firsts.resize(samples, First::default());
        }
        if let Some(shares) = &mut self.shares {
            shares.clear();
        }
    }

    /// Takes note of what each arrival hides of what lies behind it.
    pub(super) fn share_samples(&mut self) {
        let Some(shares) = &mut self.shares else {
            return;
        };
        let mut through = self.arrivals.through.iter().peekable();
        for (index, arrival) in self.arrivals.list.iter().enumerate() {
            let through = through.next_if(|(of, _)| *of == index);
            let number = arrival.path as usize;
            let path = &self.paths.paths[number];
            let (true, Some(hit)) = (path.direct, &self.hits[number]) else {
                continue;
            };
            let mut share = middle(path.energy) * arrival.coverage;
            if let Some((_, through)) = through
                && matches!(through.way, Way::Straight)
            {
                share -= middle(arrival.weight * through.passed);
            }
            // What the ground mirrors is a part of it.
            let object = match path.bounces {
                0 => self.scene.object_of(hit.primitive, &mut self.recent),
                _ => self.scene.ground_object(),
            };
            if share > 0.0 {
                let sample = arrival.sample;
                shares.push(Share {
                    sample,
                    object,
                    share,
                });
            }
        }
    }

    /// Takes note of what the ground hides of path number `index`: of this energy so much is `left`.
    pub(super) fn share_with_ground(&mut self, index: u32, energy: Rgb, left: Rgb) {
        let path = &self.paths.paths[index as usize];
        let Some(shares) = self.shares.as_mut().filter(|_| path.direct) else {
            return;
        };
        let share = middle(energy) - middle(left);
        if share > 0.0 {
            shares.push(Share {
                sample: path.sample,
                object: self.scene.ground_object(),
                share,
            });
        }
    }
}
