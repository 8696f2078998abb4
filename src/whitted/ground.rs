//! The ground that catches shadows: what lies behind it is seen by the share of light that reaches it.

use super::batch::{FROM_GROUND, Path, Promised};
use super::environment::{before, over};
use super::parts::{By, Did};
use super::seen::middle;
use super::{Sample, Tracer};
use crate::accel::Shadow;
use crate::color::Rgb;
use crate::environment::DistantLight;
use crate::film::Source;
use crate::light::{Illumination, Lamp};
use crate::ray::{AT_LIGHT, Ray};
use crate::scene::{Ground, Shown};
use crate::shade::{Shading, mirror};
use glam::Vec3;
use std::mem::take;

/// A path that came to the ground.
#[derive(Clone, Copy, Debug)]
pub(super) struct Grounded {
    /// Which of the paths.
    pub(super) path: u32,
    /// Where along its ray.
    t: f32,
    position: Vec3,
    /// Where its shadow rays begin.
    origin: Vec3,
    /// How much of the path's energy light decides about.
    energy: Rgb,
    /// What shadow takes of all the light that there would be without, which is `all`.
    pub(super) lost: Rgb,
    all: Rgb,
}

impl Tracer<'_> {
    /// Whether path number `index`, which meets something at `t_max`, comes to the ground before; then it ends there.
    pub(super) fn meets_ground(&mut self, index: u32, ray: &Ray, path: &Path, t_max: f32) -> bool {
        let Some(ground) = self.scene.ground() else {
            return false;
        };
        let Some(t) = ground.meets(ray, t_max) else {
            return false;
        };
        let position = ray.point_at(t);
        self.grounded.push(Grounded {
            path: index,
            t,
            position,
            origin: position.with_y(ground.center.y + 2.0 * ground.error(position)),
            energy: path.energy,
            lost: Rgb::BLACK,
            all: Rgb::BLACK,
        });
        true
    }

    /// Follows every path that came to the ground to what lies behind it, but for what is in shadow.
    #[inline(never)]
    pub(super) fn pass_ground(&mut self, number: u32, samples: &mut [Sample]) {
        let Some(ground) = self.scene.ground().filter(|_| !self.grounded.is_empty()) else {
            return;
        };
        for index in 0..self.grounded.len() {
            self.mirror_on_ground(ground, index);
        }
        if self.rules.shading != Shading::Flat {
            self.light_ground(ground, number);
        }
        for index in 0..self.grounded.len() {
            let at = self.grounded[index];
            let presence = ground.presence(at.position);
            let seen = over(at.lost, at.all).map(|shadow| 1.0 - presence * shadow.max(0.0));
            self.share_with_ground(at.path, at.energy, at.energy * seen);
            self.see_past(at.path, at.energy * seen, samples);
        }
        self.grounded.clear();
    }

    /// Finds how much of all light does not arrive on the ground.
    fn light_ground(&mut self, ground: &Ground, number: u32) {
        if let Some(environment) = self.scene.environment() {
            let lights = environment.lights(number, self.rules.rounds());
            self.light_ground_from_afar(ground, lights, environment.irradiance(Vec3::Y));
        }
        for lamp in self.scene.lamps() {
            for index in 0..self.grounded.len() {
                let at = &mut self.grounded[index];
                let Some(light) = falling(lamp, at.position) else {
                    continue;
                };
                at.all += light.irradiance;
                let most = light.distance * (1.0 - AT_LIGHT);
                let ray = Ray::new(at.origin, light.to_light, f32::MIN_POSITIVE, most);
                if self.accel.may_meet(&ray) {
                    self.promise_to_ground(index, ray, light.irradiance);
                }
            }
            self.add_unless_occluded(FROM_GROUND, &mut []);
        }
    }

    /// The same of the environment's light, which is `whole`. As everywhere, its lights say only which share of it arrives.
    fn light_ground_from_afar(&mut self, ground: &Ground, lights: &[DistantLight], whole: Rgb) {
        let above = || lights.iter().filter(|light| light.to_light.y > 0.0);
        let all = above().fold(Rgb::BLACK, |sum, light| sum + before(light, Vec3::Y));
        let scale = over(whole, all);
        let shadow = |light: &DistantLight| self.accel.shadow(ground.center.y, light.to_light);
        // Most of the ground lies aside of every shadow.
        let anywhere = above().map(shadow).reduce(Shadow::union);
        let anywhere = anywhere.unwrap_or(Shadow::NOWHERE);
        let mut shaded = take(&mut self.shaded);
        shaded.clear();
        for (index, at) in self.grounded.iter_mut().enumerate() {
            at.all += whole;
            if anywhere.may_hold(at.position) {
                shaded.push(index);
            }
        }
        for light in above() {
            let shadow = self.accel.shadow(ground.center.y, light.to_light);
            let arriving = before(light, Vec3::Y) * scale;
            for &index in &shaded {
                let Grounded {
                    position, origin, ..
                } = self.grounded[index];
                if shadow.may_hold(position) {
                    let ray = Ray::new(origin, light.to_light, f32::MIN_POSITIVE, f32::INFINITY);
                    self.promise_to_ground(index, ray, arriving);
                }
            }
            self.add_unless_occluded(FROM_GROUND, &mut []);
        }
        self.shaded = shaded;
    }

    /// Light that is lost unless nothing stands in the way of `ray`.
    fn promise_to_ground(&mut self, index: usize, ray: Ray, arriving: Rgb) {
        self.grounded[index].lost += arriving;
        let promised = Promised {
            sample: index as u32,
            light: arriving,
            gloss: Rgb::BLACK,
            path: self.grounded[index].path,
        };
        self.shadow_rays[FROM_GROUND].push(ray, promised);
    }

    /// Sends on what the ground mirrors. Where that meets nothing one sees what lies behind the ground, as elsewhere.
    fn mirror_on_ground(&mut self, ground: &Ground, index: usize) {
        let at = self.grounded[index];
        let path = self.paths.paths[at.path as usize];
        let presence = ground.presence(at.position);
        let energy = at.energy * (ground.reflectivity * presence);
        let most = self.rules.max_depth.min(u16::MAX.into());
        if !mirror::matters(energy) || u32::from(path.bounces) >= most {
            return;
        }
        let d = self.paths.rays[at.path as usize].direction;
        let r = mirror::direction(d, Vec3::Y);
        let ray = Ray::new(at.origin, r, f32::MIN_POSITIVE, f32::INFINITY);
        let bounces = path.bounces + 1;
        self.further.push(
            ray,
            Path {
                energy,
                bounces,
                by: path.by.then(By::Mirror),
                cone: path.cone.mirrored(at.t, 0.0, 0.0),
                ..path
            },
        );
        self.statistics.mirror_rays += 1;
        self.grounded[index].energy -= energy;
    }

    /// Adds what path number `index` sees where it meets nothing more, with this energy.
    ///
    /// What the camera sees past everything is the film's affair, unless the background is part of the picture.
    pub(super) fn see_past(&mut self, index: u32, energy: Rgb, samples: &mut [Sample]) {
        let (scene, index) = (self.scene, index as usize);
        let (path, ray) = (&self.paths.paths[index], &self.paths.rays[index]);
        let sample = &mut samples[path.sample as usize];
        let background = scene.background();
        let (light, source) = match (background.shown, scene.environment()) {
            // There is one alpha for all colours: of tinted sheets it has the middle.
            (Shown::OnDisplay | Shown::Never, _) if path.direct => {
                sample.alpha -= middle(energy);
                return;
            }
            (Shown::Always, _) if path.direct => (background.color, Source::Background),
            (_, Some(environment)) => {
                let radiance = environment.radiance(ray.direction, path.roughness);
                (radiance, Source::Environment)
            }
            (_, None) => (background.color, Source::Background),
        };
        sample.color += energy * light;
        if let Some(parts) = &mut self.parts {
            parts.add(path, Did::Emit, source, energy * light);
        }
    }
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
