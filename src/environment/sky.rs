//! A clear sky and its sun.
//!
//! Preetham, Shirley and Smits 1999, "A Practical Analytic Model for Daylight": the sky's colour from its appendix A.2,
//! the sun's from A.1, without what ozone and water vapour take of it.

use super::Equirect;
use super::equirect::solid_angle;
use crate::color::Rgb;
use glam::{DVec3, Vec3};
use std::f64::consts::PI;

const WIDTH: u32 = 512;
const HEIGHT: u32 = WIDTH / 2;
/// Haze: 2 is a very clear day.
const TURBIDITY: f64 = 2.5;
/// So high is the sun at least, as a sine: below it the model has no sky.
const LOWEST_SUN: f64 = 0.01;
/// The sun's light above the atmosphere, kilolux.
const SOLAR_ILLUMINANCE: f64 = 133.0;
/// Its colour there, of luminance 1: CIE XYZ of a black body of 5900 K.
const SOLAR_COLOR: DVec3 = DVec3::new(0.973, 1.0, 1.030);
/// Micrometres that stand for red, green and blue.
const WAVELENGTHS: [f64; 3] = [0.61, 0.55, 0.465];
/// The share of light that the ground sends back: dry grass and sand.
const ALBEDO: f64 = 0.25;
/// The angle about the sun's middle in which its light is spread, radians: more than the 0.0047 it has, so that some pixel
/// lies inside wherever it is.
const SUN_RADIUS: f64 = 0.011;
/// From kilocandela a square metre to the paper's units, as a camera set to daylight sees it: a white level surface shows
/// 1 in each channel where the sun stands 45 degrees high.
const EXPOSURE: DVec3 = DVec3::new(1.0 / 30.69, 1.0 / 28.82, 1.0 / 30.96);

/// A clear sky whose sun stands in the unit direction `sun`, over a grey ground that they light. A sun below the horizon
/// counts as one that sets: dusk. As bright as light is: a white level surface shows 1 where the sun stands 45 degrees
/// high, and less with a lower one.
pub fn sky(sun: Vec3) -> Equirect {
    let sun = Sun::new(sun.as_dvec3());
    let dome = Dome::new(&sun);
    let above = Equirect::of(WIDTH, HEIGHT, |d| match d.y > 0.0 {
        true => to_rgb(dome.color(d.as_dvec3(), &sun) * EXPOSURE),
        false => Rgb::BLACK,
    });
    let mut picture = above;
    sun.shine(&mut picture);
    let ground = to_rgb(level_light(&picture) * ALBEDO);
    // The rows below the horizon.
    let below = picture
        .pixels
        .iter_mut()
        .skip((WIDTH * HEIGHT / 2) as usize);
    below.for_each(|pixel| *pixel = ground);
    picture
}

/// What a white surface that faces up shows of what is above it.
fn level_light(picture: &Equirect) -> DVec3 {
    let mut light = DVec3::ZERO;
    for (y, row) in (0..HEIGHT / 2).zip(picture.rows()) {
        let cos = libm::cos(PI * (f64::from(y) + 0.5) / f64::from(HEIGHT));
        let share = cos * solid_angle(y, WIDTH, HEIGHT) / PI;
        row.iter()
            .for_each(|pixel| light += from_rgb(*pixel) * share);
    }
    light
}

/// Where the sun is, and what of its light arrives.
struct Sun {
    direction: DVec3,
    /// From the zenith, radians.
    angle: f64,
    /// Kilolux, on a surface that faces it, in linear Rec. 709.
    illuminance: DVec3,
}

impl Sun {
    fn new(direction: DVec3) -> Sun {
        let level = DVec3::new(direction.x, 0.0, direction.z).normalize_or(DVec3::X);
        let sin = direction.normalize_or(DVec3::Y).y.clamp(LOWEST_SUN, 1.0);
        let direction = level * (1.0 - sin * sin).sqrt() + DVec3::Y * sin;
        let angle = libm::acos(sin);
        // Of air, by the amount above one's head.
        let mass = 1.0 / (sin + 0.15 * libm::pow(93.885 - angle.to_degrees(), -1.253));
        let through = WAVELENGTHS.map(|wavelength| {
            let rayleigh = 0.008735 * libm::pow(wavelength, -4.08);
            let haze = (0.04608 * TURBIDITY - 0.04586) * libm::pow(wavelength, -1.3);
            libm::exp(-(rayleigh + haze) * mass)
        });
        Sun {
            direction,
            angle,
            illuminance: DVec3::from(through) * xyz_to_rgb(SOLAR_COLOR) * SOLAR_ILLUMINANCE,
        }
    }

    /// Adds the sun's light to the pixels about its place: as much as there is, however large they are.
    fn shine(&self, picture: &mut Equirect) {
        let cos_edge = libm::cos(SUN_RADIUS);
        let near = Equirect::of(WIDTH, HEIGHT, |d| {
            let cos = d.as_dvec3().dot(self.direction);
            let inside = (cos - cos_edge) / (1.0 - cos_edge);
            Rgb::grey(if d.y > 0.0 {
                inside.max(0.0) as f32
            } else {
                0.0
            })
        });
        let rows = (0..HEIGHT).zip(near.rows());
        let of_row = |(y, row): (u32, &[Rgb])| -> f64 {
            let sum: f64 = row.iter().map(|pixel| f64::from(pixel.g)).sum();
            sum * solid_angle(y, WIDTH, HEIGHT)
        };
        let radiance = self.illuminance * EXPOSURE / rows.map(of_row).sum::<f64>();
        for (pixel, share) in picture.pixels.iter_mut().zip(&near.pixels) {
            *pixel += to_rgb(radiance * f64::from(share.g));
        }
    }
}

/// `A` to `E` of Perez's formula.
struct Perez([f64; 5]);

impl Perez {
    /// From a straight line through the turbidities each.
    fn of(lines: [[f64; 2]; 5]) -> Perez {
        Perez(lines.map(|[slope, offset]| slope * TURBIDITY + offset))
    }

    /// `F(θ, γ) = (1 + A e^(B / cos θ)) (1 + C e^(D γ) + E cos² γ)`, `θ` from the zenith and `γ` from the sun.
    fn at(&self, cos_theta: f64, gamma: f64) -> f64 {
        let Perez([a, b, c, d, e]) = *self;
        let cos_gamma = libm::cos(gamma);
        let about_sun = 1.0 + c * libm::exp(d * gamma) + e * cos_gamma * cos_gamma;
        (1.0 + a * libm::exp(b / cos_theta)) * about_sun
    }
}

/// The sky without its sun, in CIE xyY; luminance in kilocandela a square metre.
struct Dome {
    /// For x, y, Y: the distribution, and what multiplies it.
    channels: [(Perez, f64); 3],
}

impl Dome {
    fn new(sun: &Sun) -> Dome {
        let t = TURBIDITY;
        let polynomial = |rows: [[f64; 4]; 3]| {
            let [squared, linear, constant] =
                rows.map(|[a, b, c, d]| ((a * sun.angle + b) * sun.angle + c) * sun.angle + d);
            (squared * t + linear) * t + constant
        };
        let x = polynomial([
            [0.001_66, -0.003_75, 0.002_09, 0.0],
            [-0.029_03, 0.063_77, -0.032_02, 0.003_94],
            [0.116_93, -0.211_96, 0.060_52, 0.258_86],
        ]);
        let y = polynomial([
            [0.002_75, -0.006_10, 0.003_17, 0.0],
            [-0.042_14, 0.089_70, -0.041_53, 0.005_16],
            [0.153_46, -0.267_56, 0.066_70, 0.266_88],
        ]);
        let chi = (4.0 / 9.0 - t / 120.0) * (PI - 2.0 * sun.angle);
        let luminance = (4.0453 * t - 4.9710) * libm::tan(chi) - 0.2155 * t + 2.4192;
        let channel = |zenith: f64, lines| {
            let perez = Perez::of(lines);
            let at_zenith = perez.at(1.0, sun.angle);
            (perez, zenith / at_zenith)
        };
        Dome {
            channels: [
                channel(
                    x,
                    [
                        [-0.0193, -0.2592],
                        [-0.0665, 0.0008],
                        [-0.0004, 0.2125],
                        [-0.0641, -0.8989],
                        [-0.0033, 0.0452],
                    ],
                ),
                channel(
                    y,
                    [
                        [-0.0167, -0.2608],
                        [-0.0950, 0.0092],
                        [-0.0079, 0.2102],
                        [-0.0441, -1.6537],
                        [-0.0109, 0.0529],
                    ],
                ),
                channel(
                    luminance,
                    [
                        [0.1787, -1.4630],
                        [-0.3554, 0.4275],
                        [-0.0227, 5.3251],
                        [0.1206, -2.5771],
                        [-0.0670, 0.3703],
                    ],
                ),
            ],
        }
    }

    /// The linear colour in a direction above the horizon.
    fn color(&self, d: DVec3, sun: &Sun) -> DVec3 {
        // Nearly level, where the formula has its limit.
        let cos_theta = d.y.max(0.005);
        let gamma = libm::acos(d.dot(sun.direction).clamp(-1.0, 1.0));
        let [x, y, luminance] = self
            .channels
            .each_ref()
            .map(|(perez, factor)| factor * perez.at(cos_theta, gamma));
        xyz_to_rgb(DVec3::new(x / y, 1.0, (1.0 - x - y) / y) * luminance.max(0.0))
    }
}

/// CIE XYZ to linear Rec. 709 with its white D65 (IEC 61966-2-1); what it has no colour for is cut off.
fn xyz_to_rgb(xyz: DVec3) -> DVec3 {
    let channel = |x, y, z| DVec3::new(x, y, z).dot(xyz).max(0.0);
    DVec3::new(
        channel(3.2406, -1.5372, -0.4986),
        channel(-0.9689, 1.8758, 0.0415),
        channel(0.0557, -0.2040, 1.0570),
    )
}

fn to_rgb(color: DVec3) -> Rgb {
    Rgb::from(color.as_vec3().to_array())
}

fn from_rgb(Rgb { r, g, b }: Rgb) -> DVec3 {
    Vec3::new(r, g, b).as_dvec3()
}
