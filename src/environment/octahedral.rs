//! A picture of all directions that is looked up without an angle: the faces of an octahedron about the sphere, unfolded to
//! a square (Engelhardt and Dachsbacher 2008, "Octahedron Environment Maps").
//!
//! The upper four faces are the square's inner diamond, +Y its middle; the lower ones are its corners. Each edge of the
//! square is folded onto itself at its middle.

use crate::color::Rgb;
use glam::{Vec2, Vec3};
use rayon::prelude::*;

/// Light from all directions that changes little from pixel to pixel.
#[derive(Clone, Debug)]
pub(super) struct Octahedral {
    /// Pixels across, without the margin.
    side: u32,
    /// `(side + 2)²` of them, row by row: about the square lies a margin of what is beside it on the sphere.
    pixels: Vec<Rgb>,
}

impl Octahedral {
    /// A picture of so many pixels across of what `radiance` says of each pixel's middle, a unit vector.
    pub(super) fn of(side: u32, radiance: impl Fn(Vec3) -> Rgb + Sync) -> Octahedral {
        let row = |j: u32| -> Vec<Rgb> {
            let middle = |i: u32| direction(place(beside([i, j], side), side));
            (0..side + 2).map(|i| radiance(middle(i))).collect()
        };
        let rows: Vec<Vec<Rgb>> = (0..side + 2).into_par_iter().map(row).collect();
        Octahedral {
            side,
            pixels: rows.concat(),
        }
    }

    /// The radiance from a direction of any length but zero: a blend of the nearest four pixels.
    pub(super) fn at(&self, d: Vec3) -> Rgb {
        // In pixels from the middle of the margin's first.
        let place = (position(d) + 1.0) * (0.5 * self.side as f32) + 0.5;
        let (i, j) = (place.x as u32, place.y as u32);
        let (across, down) = (place.x - i as f32, place.y - j as f32);
        let width = self.side as usize + 2;
        let first = j as usize * width + i as usize;
        let pair = |at: usize| match self.pixels.get(at..at + 2) {
            Some(&[left, right]) => left.mix(right, across),
            _ => Rgb::BLACK,
        };
        pair(first).mix(pair(first + width), down)
    }
}

/// The pixel of the square that a pixel, counted with the margin, shows.
fn beside([i, j]: [u32; 2], side: u32) -> [u32; 2] {
    let last = side - 1;
    // Over an edge one comes back over the same edge, as far from its middle on the other side.
    let (across, down) = (i == 0 || i > side, j == 0 || j > side);
    let [x, y] = [i, j].map(|at| at.clamp(1, side) - 1);
    [
        if down { last - x } else { x },
        if across { last - y } else { y },
    ]
}

/// The middle of a pixel in the square from -1 to 1.
fn place([x, y]: [u32; 2], side: u32) -> Vec2 {
    (Vec2::new(x as f32, y as f32) + 0.5) * (2.0 / side as f32) - 1.0
}

/// Where a direction lies in the square from -1 to 1; its middle for no direction.
fn position(d: Vec3) -> Vec2 {
    let on_faces = d / (d.x.abs() + d.y.abs() + d.z.abs());
    let (x, z) = (on_faces.x, on_faces.z);
    let folded = |a: f32, b: f32| (1.0 - b.abs()).copysign(a);
    let at = if d.y < 0.0 {
        Vec2::new(folded(x, z), folded(z, x))
    } else {
        Vec2::new(x, z)
    };
    // What is no number becomes the middle here.
    if at.is_finite() { at } else { Vec2::ZERO }
}

/// The unit direction at a place of the square.
fn direction(at: Vec2) -> Vec3 {
    let y = 1.0 - at.x.abs() - at.y.abs();
    let folded = |a: f32, b: f32| (1.0 - b.abs()).copysign(a);
    let d = if y < 0.0 {
        Vec3::new(folded(at.x, at.y), y, folded(at.y, at.x))
    } else {
        Vec3::new(at.x, y, at.y)
    };
    d.normalize_or(Vec3::Y)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn directions() -> impl Iterator<Item = Vec3> {
        (0..2000u16).map(|n| {
            let (turn, y) = (f32::from(n) * 2.4, f32::from(n) / 1000.0 - 1.0);
            let r = (1.0 - y * y).sqrt();
            Vec3::new(r * libm::cosf(turn), y, r * libm::sinf(turn))
        })
    }

    #[test]
    fn every_direction_has_its_place() {
        for d in directions() {
            let back = direction(position(d));
            assert!((back - d).length() < 1e-6, "{d} {back}");
        }
    }

    #[test]
    fn what_changes_slowly_is_found_again_over_every_edge() {
        let light = |d: Vec3| Rgb::new(1.0 + d.x, 1.0 + d.y, 1.0 + d.z);
        let picture = Octahedral::of(64, light);
        for d in directions() {
            let (found, right) = (picture.at(d), light(d));
            // Where faces meet the light has a crease, which is cut by up to half a pixel: 1/64 here.
            let off = [found.r - right.r, found.g - right.g, found.b - right.b];
            assert!(off.iter().all(|off| off.abs() < 0.02), "{d} {off:?}");
        }
    }

    #[test]
    fn it_has_no_seam() {
        // As rough as a picture can be: every pixel by itself.
        let rough = |d: Vec3| Rgb::grey((d.x * 1e4).rem_euclid(1.0));
        let picture = Octahedral::of(16, rough);
        for d in directions().filter(|d| d.y < 0.0) {
            // On both sides of where faces meet below.
            for d in [d.with_x(0.0), d.with_z(0.0)] {
                let (a, b) = (
                    picture.at(d + Vec3::splat(1e-6)),
                    picture.at(d - Vec3::splat(1e-6)),
                );
                assert!((a.g - b.g).abs() < 1e-3, "{d}: {a:?} {b:?}");
            }
        }
    }

    #[test]
    fn no_direction_at_all_shows_something() {
        let picture = Octahedral::of(4, |_| Rgb::WHITE);
        for d in [Vec3::ZERO, Vec3::NAN, Vec3::INFINITY, Vec3::splat(3e38)] {
            assert_eq!(picture.at(d), Rgb::WHITE);
        }
    }
}
