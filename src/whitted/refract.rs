//! What becomes of light at surfaces that it goes through: into a body, out of one, or straight through a sheet.

use super::batch::{Arrivals, NO_BODY, Path};
use super::parts::By;
use super::{MAX_LAYERS, Tracer};
use crate::color::Rgb;
use crate::ray::Ray;
use crate::scene::{Place, Through, Way};
use crate::shade::{mirror, refraction};
use glam::Vec3;

/// From so many boundaries on, light that is reflected totally leaves its body, straight on. Facets send some round and
/// round, at last nearly for ever: without this a ball of 1280 triangles has pixels of 0.21 in an evenly white world,
/// where nothing is darker than the world.
const LONGEST_WAY_OUT: u32 = MAX_LAYERS / 2;

impl Tracer<'_> {
    /// Takes from the paths that travel in bodies what they lose on their way there.
    ///
    /// A path that meets nothing loses nothing: whatever it was in has no other side.
    #[inline(never)]
    pub(super) fn attenuate(&mut self) {
        let paths = self.paths.paths.iter_mut().zip(&self.paths.rays);
        for ((path, ray), hit) in paths.zip(&self.hits) {
            if let (true, Some(hit)) = (path.body != NO_BODY, hit)
                && let Some(volume) = self.scene.material(path.body).volume()
            {
                // Up to `t_min` a ray has been followed before, to a transparent layer.
                path.energy = path.energy * volume.transmittance(hit.t - ray.t_min);
            }
        }
    }

    /// Sends on what a surface mirrors and what it lets through, as long as it still matters.
    pub(super) fn refract(&mut self, arrivals: &Arrivals, index: usize, through: &Through) {
        let arrival = &arrivals.list[index];
        let passed = arrival.weight * through.passed;
        let mirrored = arrival.weight * through.mirrored;
        // What is reflected totally is still in the body, and does not split: it is light on its way out of it.
        let out = matches!(through.way, Way::Out { .. });
        if out && passed == Rgb::BLACK {
            let path = self.paths.paths[arrival.path as usize];
            if u32::from(path.layers) >= LONGEST_WAY_OUT {
                let body = NO_BODY;
                let direct = false;
                self.go_straight(
                    arrival.path as usize,
                    Path {
                        body,
                        direct,
                        energy: mirrored,
                        ..path
                    },
                );
                return;
            }
            let Place { normal, .. } = arrivals.place(index);
            let (ray, energy) = (self.mirror_ray(arrivals, index, normal), mirrored);
            let cone = self.mirrored_cone(arrivals, index);
            self.go_on(
                ray,
                Path {
                    energy,
                    cone,
                    ..path
                },
            );
            return;
        }
        self.mirror(arrivals, index, mirrored);
        match through.way {
            Way::Straight => {
                let index = arrival.path as usize;
                let path = self.paths.paths[index];
                self.go_straight(
                    index,
                    Path {
                        energy: passed,
                        by: path.by.then(By::Glass),
                        ..path
                    },
                );
            }
            Way::In { material, indices } => self.bend(arrivals, index, passed, indices, material),
            Way::Out { indices } => self.bend(arrivals, index, passed, indices, NO_BODY),
        }
    }

    /// Sends on what comes along path number `index` as `path`, which bends nowhere.
    fn go_straight(&mut self, index: usize, path: Path) {
        if let Some(hit) = self.hits[index] {
            let ray = self.paths.rays[index].beyond(hit.t, hit.primitive);
            self.go_on(ray, path);
        }
    }

    /// Sends light into what lies behind a boundary: one ray, or one for each colour where they part.
    fn bend(&mut self, arrivals: &Arrivals, index: usize, energy: Rgb, indices: Rgb, body: u32) {
        let path = arrivals.list[index].path as usize;
        let place = arrivals.place(index);
        let (cone, t, curvature) = self.cone_at(arrivals, index);
        let d = self.paths.rays[path].direction;
        let path = self.paths.paths[path];
        let path = Path {
            direct: false,
            by: path.by.then(By::Glass),
            body,
            ..path
        };
        let Rgb { r, g, b } = energy;
        let apart = [
            (Rgb::new(r, 0.0, 0.0), indices.r),
            (Rgb::new(0.0, g, 0.0), indices.g),
            (Rgb::new(0.0, 0.0, b), indices.b),
        ];
        let together = [(energy, indices.g)];
        let parts = if indices.r == indices.b {
            &together[..]
        } else {
            &apart
        };
        for &(energy, m) in parts {
            if mirror::matters(energy) {
                let ray = bent_ray(&place, d, m);
                let cone = cone.refracted(t, curvature, m);
                self.go_on(
                    ray,
                    Path {
                        energy,
                        cone,
                        ..path
                    },
                );
            }
        }
    }

    /// Sends on a ray, as long as it matters and has not crossed too much.
    fn go_on(&mut self, ray: Ray, path: Path) {
        if !self.matters(path.energy, path.layers) {
            return;
        }
        if u32::from(path.layers) == MAX_LAYERS {
            self.statistics.lost_in_layers += 1;
            return;
        }
        let layers = path.layers + 1;
        self.further.push(ray, Path { layers, ..path });
        self.statistics.refracted_rays += 1;
    }
}

/// The ray behind a boundary.
fn bent_ray(place: &Place, d: Vec3, m: f32) -> Ray {
    let point = &place.point;
    let behind = |t: &Vec3| t.dot(point.normal) < 0.0;
    // A bent normal can keep the ray before the surface: then the surface's own normal says how it goes on.
    let t = refraction::direction(d, place.normal, m)
        .filter(behind)
        .or_else(|| refraction::direction(d, point.normal, m).filter(behind))
        .unwrap_or(d);
    Ray::leaving(point.position, point.normal, point.error, t, f32::INFINITY)
}
