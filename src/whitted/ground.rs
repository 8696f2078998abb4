//! The ground that catches shadows: what lies behind it is seen by the share of light that reaches it.

use super::batch::{FROM_GROUND, Path, Promised, ray_to};
use super::environment::{before, off, over};
use super::{Sample, Tracer};
use crate::color::Rgb;
use crate::geometry::SurfacePoint;
use crate::light::{Illumination, Lamp};
use crate::ray::Ray;
use crate::scene::{Ground, Shown};
use crate::shade::{Shading, mirror};
use glam::Vec3;

/// A path that came to the ground.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grounded {
    /// Which of the paths.
    path: u32,
    /// Where along its ray.
    t: f32,
    point: SurfacePoint,
    /// One over all the light that there would be without shadows.
    over_all: Rgb,
    /// What of the path's energy shadows can take.
    energy: Rgb,
}

impl Tracer<'_> {
    /// Whether path number `index`, which meets something at `t_max`, comes to the ground before; then it ends there.
    pub(super) fn meets_ground(&mut self, index: u32, ray: &Ray, path: &Path, t_max: f32) -> bool {
        let met = self.scene.ground().and_then(|ground| {
            let t = ground.meets(ray, t_max)?;
            let point = ray.point_at(t);
            Some((ground, t, point))
        });
        let Some((ground, t, point)) = met else {
            return false;
        };
        self.grounded.push(Grounded {
            path: index,
            t,
            point: SurfacePoint {
                position: point,
                normal: Vec3::Y,
                error: ground.error(point),
            },
            over_all: Rgb::BLACK,
            energy: path.energy,
        });
        true
    }

    /// Follows every path that came to the ground to what lies behind it, but for what is in shadow.
    #[inline(never)]
    pub(super) fn pass_ground(&mut self, number: u32, samples: &mut [Sample]) {
        let (scene, rules) = (self.scene, self.rules);
        let Some(ground) = scene.ground().filter(|_| !self.grounded.is_empty()) else {
            return;
        };
        let mut grounded = std::mem::take(&mut self.grounded);
        let environment = scene.environment();
        let lights = environment.map_or(&[][..], |e| e.lights(number, rules.rounds()));
        // As everywhere, the environment's light is known; its lights say only which share of it arrives.
        let whole = environment.map_or(Rgb::BLACK, |e| e.irradiance(Vec3::Y));
        let all = lights.iter().map(|light| before(light, Vec3::Y));
        let scale = over(whole, all.fold(Rgb::BLACK, |sum, light| sum + light));
        for at in &mut grounded {
            let path = self.paths.paths[at.path as usize];
            self.mirror_on_ground(ground, at, path);
            let lamps = scene.lamps().iter();
            let of_lamps = lamps.filter_map(|lamp| falling(lamp, at.point.position));
            let all = of_lamps.fold(whole, |sum, light| sum + light.irradiance);
            let shaded = match rules.shading {
                Shading::Flat => Rgb::BLACK,
                _ => Rgb::grey(ground.presence(at.point.position)),
            };
            at.over_all = over(Rgb::WHITE, all);
            let can_be_shaded = shaded * all.map(|channel| f32::from(u8::from(channel > 0.0)));
            self.see_past(
                at.path,
                at.energy * can_be_shaded.map(|share| 1.0 - share),
                samples,
            );
            at.energy = at.energy * can_be_shaded;
        }
        for light in lights {
            let share = before(light, Vec3::Y) * scale;
            if light.to_light.y > 0.0 {
                for at in &grounded {
                    let ray = along(light.to_light, &at.point);
                    self.promise_past(at, ray, share);
                }
            }
            self.add_unless_occluded(FROM_GROUND, samples);
        }
        for lamp in scene.lamps() {
            for at in &grounded {
                if let Some(light) = falling(lamp, at.point.position) {
                    let ray = ray_to(&light, &at.point);
                    self.promise_past(at, ray, light.irradiance);
                }
            }
            self.add_unless_occluded(FROM_GROUND, samples);
        }
        grounded.clear();
        self.grounded = grounded;
    }

    /// What lies behind the ground is seen by this share, if nothing stands in the way of `ray`.
    fn promise_past(&mut self, at: &Grounded, ray: Ray, arriving: Rgb) {
        let promised = Promised {
            sample: at.path,
            light: at.energy * arriving * at.over_all,
        };
        self.shadow_rays[FROM_GROUND].push(ray, promised);
    }

    /// Sends on what the ground mirrors. Where that meets nothing one sees what lies behind the ground, as elsewhere.
    fn mirror_on_ground(&mut self, ground: &Ground, at: &mut Grounded, path: Path) {
        let presence = ground.presence(at.point.position);
        let energy = at.energy * (ground.reflectivity * presence);
        let most = self.rules.max_depth.min(u16::MAX.into());
        if !mirror::matters(energy) || u32::from(path.bounces) >= most {
            return;
        }
        let d = self.paths.rays[at.path as usize].direction;
        let ray = along(mirror::direction(d, Vec3::Y), &at.point);
        let bounces = path.bounces + 1;
        self.further.push(
            ray,
            Path {
                energy,
                bounces,
                cone: path.cone.mirrored(at.t, 0.0, 0.0),
                ..path
            },
        );
        self.statistics.mirror_rays += 1;
        at.energy = at.energy + energy * -1.0;
    }

    /// Adds what path number `index` sees where it meets nothing more, with this energy.
    ///
    /// What the camera sees past everything is the film's affair, unless the background is part of the picture.
    pub(super) fn see_past(&self, index: u32, energy: Rgb, samples: &mut [Sample]) {
        let (scene, index) = (self.scene, index as usize);
        let (path, ray) = (&self.paths.paths[index], &self.paths.rays[index]);
        let sample = &mut samples[path.sample as usize];
        let background = scene.background();
        match (background.shown, scene.environment()) {
            // There is one alpha for all colours: of tinted sheets it has the middle.
            (Shown::OnDisplay | Shown::Never, _) if path.direct => {
                let Rgb { r, g, b } = energy;
                sample.alpha -= 0.5 * (r.max(g).max(b) + r.min(g).min(b));
            }
            (Shown::Always, _) if path.direct => sample.color += energy * background.color,
            (_, Some(environment)) => {
                sample.color += energy * environment.radiance(ray.direction, path.roughness);
            }
            (_, None) => sample.color += energy * background.color,
        }
    }
}

/// A ray that leaves the ground upward.
fn along(direction: Vec3, point: &SurfacePoint) -> Ray {
    Ray::new(off(point), direction, f32::MIN_POSITIVE, f32::INFINITY)
}

/// The light of a lamp that falls on a point of the ground, if any does, less what its slope takes.
fn falling(lamp: &Lamp, point: Vec3) -> Option<Illumination> {
    let light = lamp.illuminate(point)?;
    let cosine = light.to_light.y;
    (cosine > 0.0).then(|| Illumination {
        irradiance: light.irradiance * cosine,
        ..light
    })
}
