//! Floors, seas and skies: what is so much larger than the rest that it would make the rest a dot.

use super::{Face, LeftOut, bounds, diagonal};
use crate::geometry::Bounds;
use glam::DVec3;
use std::f64::consts::PI;

/// What surrounds has a box at least so many times as large as all the rest's, from corner to corner.
const FAR_LARGER: f64 = 5.0;
/// What is flat is thinner than this share of its box's diagonal.
const THIN: f64 = 0.05;
/// On a floor, the rest is at least as high as this share of its box's diagonal: writing on a board is part of it.
const STANDS_OUT: f64 = 0.1;
/// A sky covers at least so much of the sphere around the rest, in steradians: a dome without a floor has 2 pi.
const SKY: f64 = 1.5 * PI;
/// In every direction it reaches over so many of the rest's diagonals: a floor does not, though it covers as much.
const HIGH: f64 = 1.5;
/// A sky of more triangles than this has no more than the rest: what is made with care is what the file is about.
const PLAIN: usize = 5000;
/// So many of the largest things are asked whether they surround the rest.
const MOST: usize = 64;

/// A thing, by its box.
struct Thing<'a> {
    faces: &'a [Face],
    bounds: Bounds,
    diagonal: f64,
}

impl Thing<'_> {
    fn object(&self) -> u32 {
        self.faces.first().map_or(0, |face| face.object)
    }
}

/// The objects that surround the others, and the boxes of those that are skies.
pub(super) fn left_out(faces: &[Face]) -> (Vec<LeftOut>, Vec<Bounds>) {
    let of_object = |faces| {
        let bounds = bounds(faces);
        Thing {
            faces,
            bounds,
            diagonal: diagonal(&bounds),
        }
    };
    let mut things: Vec<Thing> = faces
        .chunk_by(|a, b| a.object == b.object)
        .map(of_object)
        .collect();
    // Stable: of two alike, the earlier one stays first.
    things.sort_by(|a, b| b.diagonal.total_cmp(&a.diagonal));
    let (mut left_out, mut skies) = (Vec::new(), Vec::new());
    let mut rest = things.as_slice();
    while let Some((count, is_sky)) = surrounding(rest) {
        let (around, within) = rest.split_at(count);
        let size = diagonal(&box_around(within));
        left_out.extend(around.iter().map(|thing| LeftOut {
            object: thing.object(),
            times_as_large: thing.diagonal / size,
        }));
        let of_skies = around.iter().zip(is_sky).filter(|(_, is_sky)| *is_sky);
        skies.extend(of_skies.map(|(thing, _)| thing.bounds));
        rest = within;
    }
    (left_out, skies)
}

/// The fewest of the largest things that surround all others, and which of them are skies.
fn surrounding(things: &[Thing]) -> Option<(usize, Vec<bool>)> {
    let most = things.len().saturating_sub(1).min(MOST);
    // The box of all things from a number on, found from the last to the first.
    let mut beyond = box_around(things.get(most..)?);
    let mut rests = Vec::with_capacity(most);
    for thing in things.iter().take(most).rev() {
        rests.push(beyond);
        beyond = beyond.union(thing.bounds);
    }
    rests.reverse();
    let mut count_of_rest: usize = things.iter().map(|thing| thing.faces.len()).sum();
    for (count, (smallest, rest)) in (1..).zip(things.iter().zip(rests)) {
        count_of_rest -= smallest.faces.len();
        let size = diagonal(&rest);
        if size == 0.0 || smallest.diagonal < FAR_LARGER * size {
            continue;
        }
        let around = things.iter().take(count);
        let kinds: Option<Vec<bool>> = around
            .map(|thing| {
                let is_sky = is_sky(thing, &rest, count_of_rest);
                (is_sky || is_floor(thing, &rest)).then_some(is_sky)
            })
            .collect();
        if let Some(is_sky) = kinds {
            return Some((count, is_sky));
        }
    }
    None
}

fn box_around(things: &[Thing]) -> Bounds {
    let boxes = things.iter().map(|thing| thing.bounds);
    boxes.fold(Bounds::EMPTY, Bounds::union)
}

/// Whether a thing is flat, in any direction, and the rest stands out from it.
fn is_floor(thing: &Thing, rest: &Bounds) -> bool {
    let largest = thing.faces.iter().map(Face::area_normal);
    let largest = largest.fold(DVec3::ZERO, |a, b| {
        if b.length_squared() > a.length_squared() {
            b
        } else {
            a
        }
    });
    let facing = |normal: DVec3| {
        if normal.dot(largest) < 0.0 {
            -normal
        } else {
            normal
        }
    };
    let sum: DVec3 = thing
        .faces
        .iter()
        .map(|face| facing(face.area_normal()))
        .sum();
    let normal = sum.normalize_or_zero();
    let along = thing
        .faces
        .iter()
        .flat_map(Face::points)
        .map(|p| p.dot(normal));
    let (low, high) = along.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), x| {
        (low.min(x), high.max(x))
    });
    let thickness = high - low;
    let height = (rest.max.as_dvec3() - rest.min.as_dvec3()).dot(normal.abs());
    thickness < THIN * thing.diagonal && thickness < height && height > STANDS_OUT * diagonal(rest)
}

/// Whether a thing is a shell around the rest that shows its inside.
fn is_sky(thing: &Thing, rest: &Bounds, count_of_rest: usize) -> bool {
    if thing.faces.len() > PLAIN.max(count_of_rest) || thing.faces.iter().any(|face| face.is_clear)
    {
        return false;
    }
    let reach = (thing.bounds.max - thing.bounds.min).min_element();
    if f64::from(reach) < HIGH * diagonal(rest) {
        return false;
    }
    let middle = (rest.min.as_dvec3() + rest.max.as_dvec3()) * 0.5;
    let angles = thing.faces.iter().map(|face| solid_angle(face, middle));
    let (sum, all) = angles.fold((0.0, 0.0), |(sum, all), angle| {
        (sum + angle, all + angle.abs())
    });
    let is_double_sided = thing.faces.iter().all(|face| face.double_sided);
    // Seen once in every direction, all from the same side.
    let shows = if is_double_sided { f64::abs(sum) } else { sum };
    all > SKY && shows > 0.9 * all
}

/// The part of the sphere around `eye` that a face covers, in steradians; negative from behind (van Oosterom and Strackee
/// 1983, "The Solid Angle of a Plane Triangle").
fn solid_angle(face: &Face, eye: DVec3) -> f64 {
    let [a, b, c] = face.points().map(|p| (p - eye).normalize_or_zero());
    let volume = a.dot(b.cross(c));
    -2.0 * libm::atan2(volume, 1.0 + a.dot(b) + b.dot(c) + c.dot(a))
}
