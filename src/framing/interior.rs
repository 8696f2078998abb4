//! Rooms: whether the faces are one, and where in it a viewer stands.

use super::direction::{Angles, View};
use super::voxels::{Met, Voxels};
use super::{FOV_Y, Face};
use crate::camera::Camera;
use crate::geometry::Bounds;
use glam::DVec3;

/// Each side of a room is closed at least so much, seen from a place within: there may be a door and windows.
const SIDE_CLOSED: f64 = 0.6;
/// All sides together are.
const CLOSED: f64 = 0.85;
/// So much of what is seen from within shows its front.
const FRONTS: f64 = 0.7;
/// So much of the walls shows nothing outside but backs.
const TURNED_IN: f64 = 0.55;
/// At least so much of what is seen from within stands in the room.
const FURNISHED: f64 = 0.05;
/// Something stands in the room where it and the wall behind it are this share of the way apart.
const APART: f64 = 0.15;
/// A wall is within this share of the way from the side of the box.
const WALL: f64 = 0.12;
/// So much of each side of the box has a wall: one that has none is open to a viewer outside, as in a doll's house.
const WALLS: f64 = 0.4;
/// At least this share of the faces is seen from nowhere outside, above or level.
const HIDDEN: f64 = 0.5;
/// Points on each side of the box, each way.
const TARGETS: u32 = 7;
/// Of the height, from the floor: as high as a person's eyes in a room as high as rooms are.
const EYE_HEIGHT: f64 = 0.55;
/// The horizontal field of view inside (70 degrees), and the vertical one that it may become in narrow pictures (75).
const FOV_X: f64 = 1.221_730_476_396_030_6;
const GREATEST_FOV_Y: f64 = 1.308_996_938_995_747_2;
/// The way inside, in degrees: slightly down.
const DOWN: f64 = 6.0;

/// Where a viewer stands in a room.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Room {
    eye: DVec3,
    /// From what is looked at toward the eye.
    towards_viewer: Angles,
    /// How far it is to what is looked at.
    distance: f64,
}

impl Room {
    pub(super) fn camera(&self, view: &View, aspect: f64, fov_y: Option<f64>) -> Camera {
        let of_width = 2.0 * libm::atan(libm::tan(FOV_X / 2.0) / aspect);
        let fov_y = fov_y.unwrap_or(of_width.clamp(FOV_Y, GREATEST_FOV_Y));
        let toward = view.around(self.towards_viewer).unit();
        let target = self.eye - toward * self.distance;
        view.zoomed(Camera::looking_at(self.eye, target, DVec3::Y, fov_y), fov_y)
    }
}

/// Where to stand in the room that the faces are; `None` where they are none.
pub(super) fn room(faces: &[Face], bounds: &Bounds) -> Option<Room> {
    let voxels = Voxels::of(faces, bounds)?;
    let places = places(&voxels);
    let surveys = places.filter_map(|place| Survey::from(&voxels, place));
    // The earlier one of two alike.
    let widest = surveys.fold(None, |best: Option<Survey>, survey| match best {
        Some(best) if best.free >= survey.free => Some(best),
        _ => Some(survey),
    })?;
    if !widest.is_of_a_room(&voxels) {
        return None;
    }
    best_view(&voxels, widest.place)
}

/// Some empty places, in plan and at two heights.
fn places(voxels: &Voxels) -> impl Iterator<Item = DVec3> {
    const SHARES: [f64; 5] = [0.5, 0.3, 0.7, 0.15, 0.85];
    let place =
        |x: f64, y: f64, z: f64| voxels.min + (voxels.max - voxels.min) * DVec3::new(x, y, z);
    let in_plan = SHARES.into_iter().flat_map(|x| SHARES.map(|z| (x, z)));
    in_plan
        .flat_map(move |(x, z)| [EYE_HEIGHT, 0.75].map(|y| place(x, y, z)))
        .filter(|&place| voxels.at(place).is_empty())
}

/// What there is all around a place.
struct Survey {
    place: DVec3,
    /// The mean distance of what is seen.
    free: f64,
    /// The share of what is seen that shows its front.
    fronts: f64,
    /// The share of what is seen that stands before a wall.
    furnished: f64,
    /// How much of the side of the box that has the fewest walls has one.
    walls: f64,
    /// How much of it shows its back outside.
    turned_in: f64,
}

/// A way from a place to the side of the box, on which something is seen.
struct Way {
    length: f64,
    seen: Met,
    /// What is met on the way back, if that is not too near to be told.
    wall: Option<Met>,
}

impl Survey {
    /// `None` where the place is not closed in.
    fn from(voxels: &Voxels, place: DVec3) -> Option<Survey> {
        let (mut ways, mut all, mut walls) = (Vec::new(), 0, 1.0);
        let wall_distance = |way: &Way| way.wall.map_or(way.length, |wall| wall.distance);
        let is_walled = |way: &&Way| wall_distance(way) < WALL * way.length + voxels.side;
        for side in 0..6 {
            let targets: Vec<DVec3> = targets(voxels, side).collect();
            let of_side: Vec<Way> = targets
                .iter()
                .filter_map(|target| Way::of(voxels, place, *target))
                .collect();
            if (of_side.len() as f64) < SIDE_CLOSED * targets.len() as f64 {
                return None;
            }
            let walled = of_side.iter().filter(is_walled).count() as f64;
            walls = f64::min(walls, walled / of_side.len() as f64);
            ways.extend(of_side);
            all += targets.len();
        }
        if (ways.len() as f64) < CLOSED * all as f64 {
            return None;
        }
        let share = |is: &dyn Fn(&Way) -> bool| {
            ways.iter().filter(|way| is(way)).count() as f64 / ways.len() as f64
        };
        let distances = ways.iter().map(|way| way.seen.distance);
        Some(Survey {
            place,
            free: distances.sum::<f64>() / ways.len() as f64,
            fronts: share(&|way| way.seen.is_front),
            furnished: share(&|way| {
                let between = way.length - way.seen.distance - wall_distance(way);
                between > APART * way.length + 2.0 * voxels.side
            }),
            walls,
            turned_in: share(&|way| way.wall.is_some_and(|wall| !wall.is_front)),
        })
    }

    fn is_of_a_room(&self, voxels: &Voxels) -> bool {
        if self.furnished < FURNISHED || self.walls < WALLS {
            return false;
        }
        if self.fronts >= FRONTS {
            self.turned_in >= TURNED_IN || hidden(voxels) >= HIDDEN
        } else {
            hidden(voxels) >= FRONTS
        }
    }
}

impl Way {
    fn of(voxels: &Voxels, place: DVec3, target: DVec3) -> Option<Way> {
        let way = target - place;
        let (length, direction) = (way.length(), way.normalize_or_zero());
        Some(Way {
            length,
            seen: voxels.meets(place, direction, length + voxels.side)?,
            // From the layer of empty cells.
            wall: voxels.bumps_into(target + direction * (0.5 * voxels.side), -direction),
        })
    }
}

/// Points all over a side of the box.
fn targets(voxels: &Voxels, side: usize) -> impl Iterator<Item = DVec3> {
    let (min, size) = (voxels.min, voxels.max - voxels.min);
    let axis = side / 2;
    let share = |number: u32| (f64::from(number) + 0.5) / f64::from(TARGETS);
    (0..TARGETS * TARGETS).map(move |number| {
        let mut at = DVec3::ZERO;
        at[axis] = (side % 2) as f64;
        at[(axis + 1) % 3] = share(number % TARGETS);
        at[(axis + 2) % 3] = share(number / TARGETS);
        min + size * at
    })
}

/// The share of the faces that no viewer outside sees, from above or level.
fn hidden(voxels: &Voxels) -> f64 {
    /// So many cells are looked at, or a few more.
    const ENOUGH: usize = 1000;
    let filled = voxels.filled();
    let every = (filled.clone().count() / ENOUGH).max(1);
    let (mut of_all, mut of_hidden) = (0, 0);
    for (middle, cell) in filled.step_by(every) {
        let faces = u64::from(cell.faces);
        of_all += faces;
        if !viewers().any(|viewer| voxels.is_seen_from(middle, viewer)) {
            of_hidden += faces;
        }
    }
    of_hidden as f64 / (of_all as f64).max(1.0)
}

/// Directions toward viewers all around: level, above and straight above.
fn viewers() -> impl Iterator<Item = DVec3> {
    let around = (0..8).flat_map(|eighth| {
        let azimuth = f64::from(eighth) * 45.0;
        [5.0, 45.0].map(|elevation| Angles(azimuth, elevation).unit())
    });
    around.chain([DVec3::Y])
}

/// Where in the room around a place the view is widest: among what is seen from there, at the height of eyes.
fn best_view(voxels: &Voxels, place: DVec3) -> Option<Room> {
    /// Places each way, and directions.
    const PLACES: u32 = 16;
    const DIRECTIONS: u32 = 32;
    let reach = |direction: DVec3| {
        let met = voxels.meets(place, direction, f64::INFINITY);
        met.map_or(0.0, |met| met.distance)
    };
    let (up, down) = (reach(DVec3::Y), reach(DVec3::NEG_Y));
    let height = place.y - down + (up + down) * EYE_HEIGHT;
    let share = |number: u32| (f64::from(number) + 0.5) / f64::from(PLACES);
    let size = voxels.max - voxels.min;
    let mut best: Option<(f64, Room)> = None;
    for number in 0..PLACES * PLACES {
        let (x, z) = (share(number % PLACES), share(number / PLACES));
        let eye = voxels.min + size * DVec3::new(x, 0.0, z);
        let eye = eye.with_y(height);
        if !is_in_the_open(voxels, place, eye) {
            continue;
        }
        let free: Vec<f64> = (0..DIRECTIONS)
            .map(|number| {
                free(
                    voxels,
                    eye,
                    f64::from(number) * 360.0 / f64::from(DIRECTIONS),
                )
            })
            .collect();
        for (number, score, distance) in within_view(&free) {
            let azimuth = f64::from(number) * 360.0 / f64::from(DIRECTIONS);
            if best.is_none_or(|(best, _)| score > best) {
                let room = Room {
                    eye,
                    towards_viewer: Angles(azimuth + 180.0, DOWN),
                    distance,
                };
                best = Some((score, room));
            }
        }
    }
    best.map(|(_, room)| room)
}

/// Whether an eye is in the same room as a place, and nothing touches it.
fn is_in_the_open(voxels: &Voxels, place: DVec3, eye: DVec3) -> bool {
    let way = eye - place;
    let is_near_something = (0..27).any(|number: i32| {
        let offset = [number % 3, number / 3 % 3, number / 9].map(|x| f64::from(x - 1));
        !voxels
            .at(eye + DVec3::from_array(offset) * voxels.side)
            .is_empty()
    });
    let seen = voxels.meets(place, way.normalize_or_zero(), way.length());
    !is_near_something && seen.is_none()
}

/// How far it is to anything from an eye toward an azimuth, the mean of level and slightly down. A way out counts half.
fn free(voxels: &Voxels, eye: DVec3, azimuth: f64) -> f64 {
    let ways = [0.0, -12.0, -25.0].map(|elevation| {
        let direction = Angles(azimuth, elevation).unit();
        let met = voxels.meets(eye, direction, f64::INFINITY);
        met.map_or_else(|| 0.5 * way_out(voxels, eye, direction), |met| met.distance)
    });
    (ways[0] + ways[1] + ways[2]) / 3.0
}

/// How far it is to the side of the box.
fn way_out(voxels: &Voxels, eye: DVec3, direction: DVec3) -> f64 {
    let sides = [voxels.min, voxels.max].map(|side| (side - eye) / direction);
    let ahead = sides[0].max(sides[1]).to_array();
    // An axis along which the way does not lead has no side ahead.
    ahead
        .into_iter()
        .filter(|t| t.is_finite())
        .fold(f64::INFINITY, f64::min)
}

/// Of each direction: its number, how good a view it is, and how far it is. A view is as good as the mean of what is free
/// across it, and worse with something close before the eye.
fn within_view(free: &[f64]) -> impl Iterator<Item = (u32, f64, f64)> {
    let count = free.len();
    let longest = free.iter().copied().fold(0.0, f64::max);
    (0..count).map(move |number| {
        // Thirty-four degrees to either side.
        let across = (0..7).map(|offset| free[(number + count + offset - 3) % count]);
        let (sum, least) = across.fold((0.0, f64::INFINITY), |(sum, least), free| {
            (sum + free, f64::min(least, free))
        });
        let score = sum / 7.0 + least.min(0.25 * longest);
        (number as u32, score, free[number])
    })
}
