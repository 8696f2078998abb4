//! The light of a photographer's studio, made by reckoning: a grey room, a bright floor and soft boxes.

use super::Equirect;
use crate::color::Rgb;
use glam::{Vec2, Vec3};

const WIDTH: u32 = 1024;
/// The angle of a pixel, radians.
const PIXEL: f32 = std::f32::consts::TAU / WIDTH as f32;

/// How wide the edge of a box is, radians: a narrower one has steps in a mirror.
const EDGE: f32 = 3.0 * PIXEL;

/// A box with a bright, soft front, as one sees it from the middle of the room.
struct SoftBox {
    /// From +Z toward +X, degrees: a framed model is seen from 35.
    azimuth: f32,
    /// Above the horizon, degrees.
    elevation: f32,
    /// Half its width and half its height, at distance 1.
    half_size: [f32; 2],
    /// Of its rounded corners.
    corner: f32,
    /// In its middle.
    radiance: f32,
}

const BOXES: [SoftBox; 3] = [
    // The key light, from the viewer's upper left.
    SoftBox {
        azimuth: -22.0,
        elevation: 46.0,
        half_size: [0.42, 0.33],
        corner: 0.07,
        radiance: 6.0,
    },
    // The fill light, on the right.
    SoftBox {
        azimuth: 108.0,
        elevation: 20.0,
        half_size: [0.20, 0.48],
        corner: 0.05,
        radiance: 3.5,
    },
    // The rim light, a strip behind.
    SoftBox {
        azimuth: 228.0,
        elevation: 34.0,
        half_size: [0.75, 0.10],
        corner: 0.05,
        radiance: 5.0,
    },
];

/// A photographer's studio: dark grey walls, a bright floor, a key light where a framed model's viewer has the upper left, a
/// fill light on the right and a strip behind. Without any colour.
pub fn studio() -> Equirect {
    let boxes = BOXES.each_ref().map(Front::of);
    Equirect::of(WIDTH, WIDTH / 2, |d| {
        let mut radiance = room(d);
        for front in &boxes {
            let (coverage, own) = front.seen(d);
            radiance += (own - radiance) * coverage;
        }
        Rgb::grey(radiance)
    })
}

/// What the room itself sends: a floor that the lights fall on, walls that they hardly reach, a dark ceiling. The floor
/// bends up into the wall, without an edge.
fn room(d: Vec3) -> f32 {
    let toward_key = d.dot(Vec3::new(-0.3, 0.0, 0.95));
    let (floor, ceiling) = (0.43 + 0.10 * toward_key, 0.05);
    let walls = 0.17 + 0.07 * toward_key;
    let floor_share = smooth(0.06, -0.40, d.y);
    let ceiling_share = smooth(0.15, 0.85, d.y);
    walls + (floor - walls) * floor_share + (ceiling - walls) * ceiling_share
}

/// 0 at `from`, 1 at `to` and beyond, without a bend (Hermite's cubic).
fn smooth(from: f32, to: f32, value: f32) -> f32 {
    let t = ((value - from) / (to - from)).clamp(0.0, 1.0);
    t * t * (3.0 - 2.0 * t)
}

/// A soft box made ready to be looked at.
struct Front<'a> {
    shape: &'a SoftBox,
    toward: Vec3,
    /// How far its corners are, and a pixel more.
    reach: f32,
    right: Vec3,
    up: Vec3,
}

impl Front<'_> {
    fn of(shape: &SoftBox) -> Front<'_> {
        let [azimuth, elevation] = [shape.azimuth, shape.elevation].map(f32::to_radians);
        let [sin_azimuth, cos_azimuth] = [libm::sinf(azimuth), libm::cosf(azimuth)];
        let [sin, cos] = [libm::sinf(elevation), libm::cosf(elevation)];
        let half_diagonal = Vec2::from(shape.half_size).length() + 4.0 * PIXEL;
        Front {
            shape,
            reach: (1.0 + half_diagonal * half_diagonal).sqrt(),
            toward: Vec3::new(sin_azimuth * cos, sin, cos_azimuth * cos),
            right: Vec3::new(cos_azimuth, 0.0, -sin_azimuth),
            up: Vec3::new(-sin_azimuth * sin, cos, -cos_azimuth * sin),
        }
    }

    /// How much of a pixel in direction `d` is the box, and its radiance there: a lamp behind the cloth makes the middle
    /// brighter than the edge.
    fn seen(&self, d: Vec3) -> (f32, f32) {
        let distance = 1.0 / d.dot(self.toward);
        if !(0.0..self.reach).contains(&distance) {
            return (0.0, 0.0);
        }
        let place = Vec2::new(d.dot(self.right), d.dot(self.up)) * distance;
        let half_size = Vec2::from(self.shape.half_size);
        let beyond = place.abs() - half_size + self.shape.corner;
        let outside = beyond.max(Vec2::ZERO).length() - self.shape.corner;
        let from_edge = outside + beyond.max_element().min(0.0);
        // A pixel is larger on the box where that is seen at a slant.
        let inside = (0.5 - from_edge / (EDGE * distance * distance)).clamp(0.0, 1.0);
        // A sixth of the box is white on a display already: the edge rises slowly while it is seen.
        let coverage = inside * inside * inside;
        let from_middle = (place / half_size).length_squared().min(2.0);
        (coverage, self.shape.radiance * (1.0 - 0.2 * from_middle))
    }
}
