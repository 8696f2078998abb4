//! Environment light: what surfaces send back of light from everywhere, as far as nothing stands in its way.
//!
//! How much light there is without shadows is known exactly: the irradiance of a matt surface, the environment prefiltered
//! to the lobe of a glossy one. The environment's lights only say which share of it arrives: that of those which are seen,
//! weighted with irradiance, over that of all (a ratio estimator: Heitz, Hill and McGuire 2018, "Combining Analytic Direct
//! Illumination and Stochastic Shadows"). So nothing is grainy and nothing has a seam where no shadow is, however few
//! lights there are.

use super::batch::{Arrivals, FROM_SURFACES, Path, Promised};
use super::lanes::{Falling, WIDTH};
use super::parts::Did;
use super::{Sample, Tracer};
use crate::color::Rgb;
use crate::environment::{DistantLight, Surroundings};
use crate::geometry::SurfacePoint;
use crate::ray::Ray;
use crate::shade::{Reflectance, Shading, mirror};
use glam::Vec3;

/// Of surfaces that are seen in mirrors or through glass, one light of so many is asked: in the first of them, and in
/// glass in glass, of which there may be very many.
const INDIRECT_STRIDES: [u32; 2] = [2, 8];

/// A surface, ready to be lit by many lights that are infinitely far.
#[derive(Clone, Copy, Debug)]
pub(super) struct Lit {
    /// Of its round's lights, one of so many is asked: a power of two.
    stride: u32,
    /// Where its shadow rays begin: off the surface, on the viewer's side.
    origin: Vec3,
    /// What it would send back of all the environment's light, over what arrives from those lights.
    answer: Rgb,
    /// What of that is no diffuse light.
    gloss: Rgb,
}

impl Tracer<'_> {
    /// Adds what the environment sends to every surface. Sample number `number` of a pixel asks the lights of its round.
    #[inline(never)]
    pub(super) fn add_environment(
        &mut self,
        number: u32,
        arrivals: &Arrivals,
        samples: &mut [Sample],
    ) {
        let Some(environment) = self.scene.environment() else {
            return;
        };
        let lights = environment.lights(number, self.rules.rounds());
        self.prepare(environment, lights, arrivals, samples);
        for (number, light) in (0..).zip(lights) {
            self.promise_from_afar(number, light, arrivals);
            self.add_unless_occluded(FROM_SURFACES, samples);
        }
    }

    /// The shadow rays to light number `number` of a round.
    #[inline(never)]
    fn promise_from_afar(&mut self, number: u32, light: &DistantLight, arrivals: &Arrivals) {
        let eights = arrivals.list.chunks(WIDTH).zip(&arrivals.places);
        for ((arrivals, places), lit) in eights.zip(self.lit.chunks(WIDTH)) {
            let cosines = places.cosines(light.to_light);
            for ((arrival, lit), cosine) in arrivals.iter().zip(lit).zip(cosines) {
                if cosine > 0.0 && number & (lit.stride - 1) == 0 {
                    let arriving = light.irradiance * cosine;
                    let promised = Promised {
                        sample: arrival.sample,
                        light: lit.answer * arriving,
                        gloss: lit.gloss * arriving,
                        path: arrival.path,
                    };
                    let (from, to) = (lit.origin, light.to_light);
                    let ray = Ray::new(from, to, f32::MIN_POSITIVE, f32::INFINITY);
                    self.shadow_rays[FROM_SURFACES].push(ray, promised);
                }
            }
        }
    }

    /// Finds what every surface would send back without shadows.
    #[inline(never)]
    fn prepare(
        &mut self,
        environment: &Surroundings,
        lights: &[DistantLight],
        arrivals: &Arrivals,
        samples: &mut [Sample],
    ) {
        self.lit.clear();
        for (eight, places) in arrivals.list.chunks(WIDTH).zip(&arrivals.places) {
            let mut strides = [1; WIDTH];
            for (to, arrival) in strides.iter_mut().zip(eight) {
                *to = stride(&self.paths.paths[arrival.path as usize]);
            }
            let falling = Falling::on(places, lights, &strides);
            for (lane, arrival) in eight.iter().enumerate() {
                let (place, stride) = (places.get(lane), strides[lane]);
                let mut lit = Lit {
                    stride,
                    origin: place.point.position,
                    answer: Rgb::BLACK,
                    gloss: Rgb::BLACK,
                };
                // Where there is no normal light changes nothing.
                if place.normal != Vec3::ZERO {
                    let surface = &arrivals.reflectances[arrival.reflectance as usize];
                    let d = self.paths.rays[arrival.path as usize].direction;
                    let shading = self.rules.shading;
                    let both = unshadowed(shading, environment, surface, place.normal, d);
                    let [matt, gloss] = both.map(|light| arrival.weight * light);
                    let (whole, arriving) = (matt + gloss, falling.get(lane));
                    // Where none of the lights shines, there is only what lies between them.
                    samples[arrival.sample as usize].color += where_zero(arriving, whole);
                    if let Some(parts) = &mut self.parts {
                        let path = &self.paths.paths[arrival.path as usize];
                        for (did, light) in [(Did::Scatter, matt), (Did::Gloss, gloss)] {
                            let light = where_zero(arriving, light);
                            parts.add(path, did, self.source, light);
                        }
                    }
                    lit.origin = off(&place.point);
                    lit.answer = over(whole, arriving);
                    lit.gloss = over(gloss, arriving);
                }
                self.lit.push(lit);
            }
        }
    }
}

/// Of the lights of a round, a surface that this path comes to asks one of so many, a power of two.
fn stride(path: &Path) -> u32 {
    let [first, others] = INDIRECT_STRIDES;
    match u32::from(path.bounces) + u32::from(path.layers) {
        _ if path.direct => 1,
        0..=2 => first,
        _ => others,
    }
}

/// What a surface sends back to a viewer along `d` if nothing is in shadow: diffuse light, and the rest.
fn unshadowed(
    shading: Shading,
    environment: &Surroundings,
    surface: &Reflectance,
    n: Vec3,
    d: Vec3,
) -> [Rgb; 2] {
    let irradiance = environment.irradiance(n);
    if shading == Shading::Lambert {
        return [surface.diffuse * irradiance, Rgb::BLACK];
    }
    let matt = (surface.ambient - surface.gloss).map(|channel| channel.max(0.0));
    if surface.gloss == Rgb::BLACK {
        return [matt * irradiance, Rgb::BLACK];
    }
    let r = mirror::direction(d, n);
    let glossy = surface.gloss * environment.radiance(r, surface.roughness);
    [matt * irradiance, glossy]
}

/// What a light sends to a surface of this normal; nothing from behind.
pub(super) fn before(light: &DistantLight, n: Vec3) -> Rgb {
    light.irradiance * n.dot(light.to_light).max(0.0)
}

/// Where rays begin that leave a surface on the side of its normal.
pub(super) fn off(point: &SurfacePoint) -> Vec3 {
    let SurfacePoint {
        position,
        normal,
        error,
    } = *point;
    Ray::leaving(position, normal, error, normal, f32::INFINITY).origin
}

/// Channel by channel `a / b`, zero where there is no `b`.
pub(super) fn over(a: Rgb, b: Rgb) -> Rgb {
    a.by_channel(b, |a, b| if b > 0.0 { a / b } else { 0.0 })
}

/// The channels of `light` in which `sum` is nothing.
fn where_zero(sum: Rgb, light: Rgb) -> Rgb {
    sum.by_channel(light, |sum, light| if sum > 0.0 { 0.0 } else { light })
}
