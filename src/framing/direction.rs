//! From where.

use super::{Face, pieces};
use crate::camera::{Camera, Fov, Projection};
use glam::DVec3;

/// A view from which less than this share of the most visible area is seen is edge-on.
const BROAD_ENOUGH: f64 = 0.5;
/// The steepest look up or down, in degrees: straight along the vertical, there is no telling which way is up.
const STEEPEST: f64 = 89.9;

/// A direction from which things are seen. Their front is toward +Z and their top toward +Y, as in glTF.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Direction {
    /// From three quarters and slightly above, or from where the broad side is seen if that view is edge-on.
    #[default]
    Broadest,
    /// From three quarters: 35 degrees to the viewer's right of the front, 22 degrees above.
    ThreeQuarter,
    /// From +Z, level.
    Front,
    /// From -Z, level.
    Back,
    /// From -X, which is left in the view from the front; level.
    Left,
    /// From +X, which is right in the view from the front; level.
    Right,
    /// From above, with the front at the picture's lower edge.
    Top,
}

/// A framed view.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct View {
    /// From where.
    pub direction: Direction,
    /// Degrees by which the eye then goes around what it looks at: to the viewer's right, and up. It comes no nearer to
    /// the vertical than a tenth of a degree. In a room, the eye stays and turns as much.
    pub orbit: [f64; 2],
    /// How many times as large everything is as in a fitted picture, above 0. As with a lens: the field of view changes,
    /// the eye stays where it is.
    pub zoom: f64,
}

impl Default for View {
    fn default() -> View {
        View {
            direction: Direction::Broadest,
            orbit: [0.0, 0.0],
            zoom: 1.0,
        }
    }
}

impl View {
    /// From where the view is toward these faces.
    pub(super) fn angles(&self, faces: &[Face]) -> Angles {
        let from = match self.direction {
            Direction::Broadest => broadest(faces),
            Direction::ThreeQuarter => ANGLES[0],
            Direction::Front => Angles(0.0, 0.0),
            Direction::Back => Angles(180.0, 0.0),
            Direction::Left => Angles(-90.0, 0.0),
            Direction::Right => Angles(90.0, 0.0),
            Direction::Top => Angles(0.0, 90.0),
        };
        self.around(from)
    }

    /// These angles after the orbit.
    pub(super) fn around(&self, Angles(azimuth, elevation): Angles) -> Angles {
        let [yaw, pitch] = self.orbit;
        Angles(
            azimuth + yaw,
            (elevation + pitch).clamp(-STEEPEST, STEEPEST),
        )
    }

    /// The camera with the field of view that makes everything as large as `zoom` says.
    pub(super) fn zoomed(&self, camera: Camera, fov_y: f64) -> Camera {
        if self.zoom == 1.0 {
            return camera;
        }
        let narrowed = 2.0 * libm::atan(libm::tan(fov_y / 2.0) / self.zoom);
        Camera {
            projection: Projection::Perspective {
                fov: Fov::Y(narrowed),
            },
            ..camera
        }
    }
}

/// A direction to look from, in degrees: azimuth from +Z toward +X, and elevation above the horizon.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Angles(pub(super) f64, pub(super) f64);

impl Angles {
    /// The unit vector toward a viewer there.
    pub(super) fn unit(self) -> DVec3 {
        let (azimuth, elevation) = (self.0.to_radians(), self.1.to_radians());
        let level = libm::cos(elevation);
        DVec3::new(
            libm::sin(azimuth) * level,
            libm::sin(elevation),
            libm::cos(azimuth) * level,
        )
    }
}

/// Three-quarter views first, slightly from above; then ever less usual ones.
const ANGLES: [Angles; 14] = [
    Angles(35.0, 22.0),
    Angles(-35.0, 22.0),
    Angles(35.0, 60.0),
    Angles(145.0, 22.0),
    Angles(-145.0, 22.0),
    Angles(0.0, 15.0),
    Angles(90.0, 15.0),
    Angles(-90.0, 15.0),
    Angles(180.0, 15.0),
    Angles(35.0, -25.0),
    Angles(145.0, -25.0),
    Angles(-145.0, -25.0),
    Angles(-35.0, -25.0),
    Angles(35.0, -60.0),
];

/// The first direction that shows at least `BROAD_ENOUGH` of the area that the best one shows.
fn broadest(faces: &[Face]) -> Angles {
    let directions = ANGLES.map(Angles::unit);
    let of_piece = |piece: &[Face]| {
        let mut seen = [0.0; ANGLES.len()];
        for face in piece {
            let area_normal = face.area_normal();
            for (seen, direction) in seen.iter_mut().zip(&directions) {
                let facing = area_normal.dot(*direction);
                *seen += if face.double_sided {
                    facing.abs()
                } else {
                    facing.max(0.0)
                };
            }
        }
        seen
    };
    let mut seen = [0.0; ANGLES.len()];
    for of_piece in pieces(faces, of_piece) {
        seen.iter_mut()
            .zip(of_piece)
            .for_each(|(seen, more)| *seen += more);
    }
    let most = seen.iter().copied().fold(0.0, f64::max);
    let broad = ANGLES
        .iter()
        .zip(seen)
        .find(|(_, seen)| *seen >= BROAD_ENOUGH * most);
    broad.map_or(ANGLES[0], |(angles, _)| *angles)
}
