//! A camera for what has none: from where, and how far away.

use crate::camera::Camera;
use crate::geometry::{Bounds, Triangle};
use glam::DVec3;
use rayon::iter::ParallelIterator;
use rayon::slice::ParallelSlice;

/// The vertical field of view of a framed picture, in radians (35 degrees): as far from a fish eye as from a telescope.
pub const FOV_Y: f64 = 0.610_865_238_198_015_3;
/// The share of the picture's width or height, whichever is tighter, that the model fills.
const FILL: f64 = 0.8;
/// A view from which less than this share of the most visible area is seen is edge-on.
const BROAD_ENOUGH: f64 = 0.5;

/// A direction to look from, in degrees: azimuth from +Z toward +X, and elevation above the horizon.
type Direction = (f64, f64);

/// Three-quarter views first, slightly from above; then ever less usual ones.
const DIRECTIONS: [Direction; 14] = [
    (35.0, 22.0),
    (-35.0, 22.0),
    (35.0, 60.0),
    (145.0, 22.0),
    (-145.0, 22.0),
    (0.0, 15.0),
    (90.0, 15.0),
    (-90.0, 15.0),
    (180.0, 15.0),
    (35.0, -25.0),
    (145.0, -25.0),
    (-145.0, -25.0),
    (-35.0, -25.0),
    (35.0, -60.0),
];

/// A triangle of what is to be framed.
#[derive(Clone, Copy, Debug)]
pub struct Face {
    /// World space.
    pub triangle: Triangle,
    /// Whether it is seen from behind as well.
    pub double_sided: bool,
}

/// A camera that sees all of `faces`, from three quarters and slightly above, or from where their broad side is seen
/// if that view is edge-on. Their projection fills 80 % of the width or the height of a picture of this `aspect`
/// (width / height), and is in its middle; `fov_y` is in radians. Without faces it looks at the origin.
pub fn frame(faces: impl Iterator<Item = Face>, aspect: f64, fov_y: f64) -> Camera {
    let faces: Vec<Face> = faces.collect();
    let azimuth_and_elevation = broadest(&faces);
    let towards_viewer = unit(azimuth_and_elevation);
    let bounds = pieces(&faces, |piece| {
        Bounds::around(piece.iter().flat_map(|face| face.triangle.0))
    })
    .into_iter()
    .fold(Bounds::EMPTY, Bounds::union);
    let (center, radius) = if bounds.is_empty() {
        (DVec3::ZERO, 1.0)
    } else {
        let (min, max) = (bounds.min.as_dvec3(), bounds.max.as_dvec3());
        let reach = max.abs().max(min.abs()).max_element();
        // A single point is framed as if it were a little larger.
        (
            (min + max) * 0.5,
            ((max - min).length() * 0.5).max(1e-4 * reach).max(1e-30),
        )
    };
    let looking = Camera::looking_at(towards_viewer, DVec3::ZERO, DVec3::Y, 1.0);
    let position = fitted_position(&faces, looking.basis(), (center, radius), (aspect, fov_y));
    // The target is the point of the axis nearest to the middle of the model.
    let axis = -towards_viewer;
    let target = position + axis * (center - position).dot(axis).max(radius * 0.01);
    Camera::looking_at(position, target, DVec3::Y, fov_y)
}

/// What `of` says of each piece of the faces, in their order. The pieces are the same on every machine.
fn pieces<T: Send>(faces: &[Face], of: impl Fn(&[Face]) -> T + Send + Sync) -> Vec<T> {
    const PIECE: usize = 1 << 14;
    faces.par_chunks(PIECE).map(of).collect()
}

/// The nearest position from which all points lie inside the middle `FILL` of the picture.
///
/// With (`x`, `y`, `z`) a point along the camera's axes and (`p`, `q`, `r`) the camera, `|x - p| <= k (z - r)` for each
/// point is `p - k r >= max(x - k z)` and `p + k r <= min(x + k z)`: the greatest `r` is half the difference over `k`,
/// and `p` is the mean. Likewise for `y`; the smaller `r` holds for both.
fn fitted_position(
    faces: &[Face],
    [u, v, w]: [DVec3; 3],
    (center, radius): (DVec3, f64),
    (aspect, fov_y): (f64, f64),
) -> DVec3 {
    let tan_y = libm::tan(fov_y / 2.0);
    let (k_x, k_y) = (FILL * tan_y * aspect, FILL * tan_y);
    let start = (Fit::new(k_x), Fit::new(k_y), f64::INFINITY);
    let of_piece = |piece: &[Face]| {
        let (mut fit_x, mut fit_y, mut nearest) = start;
        for point in piece.iter().flat_map(|face| face.triangle.0) {
            // Relative to the middle and in units of the radius, so that neither place nor size costs digits.
            let d = (point.as_dvec3() - center) / radius;
            let (x, y, z) = (d.dot(u), d.dot(v), d.dot(w));
            fit_x.include(x, z);
            fit_y.include(y, z);
            nearest = nearest.min(z);
        }
        (fit_x, fit_y, nearest)
    };
    let (fit_x, fit_y, nearest) = pieces(faces, of_piece)
        .into_iter()
        .fold(start, |a, b| (a.0.and(b.0), a.1.and(b.1), a.2.min(b.2)));
    if nearest == f64::INFINITY {
        return center - w * (radius * 4.0);
    }
    // Never inside what is to be seen.
    let r = fit_x.depth().min(fit_y.depth()).min(nearest - 0.05);
    center + (u * fit_x.middle() + v * fit_y.middle() + w * r) * radius
}

/// One axis of the picture: what the points ask of the camera.
#[derive(Clone, Copy)]
struct Fit {
    k: f64,
    low: f64,
    high: f64,
}

impl Fit {
    fn new(k: f64) -> Fit {
        Fit {
            k,
            low: f64::NEG_INFINITY,
            high: f64::INFINITY,
        }
    }

    fn include(&mut self, x: f64, z: f64) {
        self.low = self.low.max(x - self.k * z);
        self.high = self.high.min(x + self.k * z);
    }

    /// What the points of both ask.
    fn and(self, other: Fit) -> Fit {
        Fit {
            k: self.k,
            low: self.low.max(other.low),
            high: self.high.min(other.high),
        }
    }

    fn depth(&self) -> f64 {
        (self.high - self.low) / (2.0 * self.k)
    }

    fn middle(&self) -> f64 {
        (self.high + self.low) / 2.0
    }
}

/// The first direction that shows at least `BROAD_ENOUGH` of the area that the best one shows.
fn broadest(faces: &[Face]) -> Direction {
    let directions = DIRECTIONS.map(unit);
    let of_piece = |piece: &[Face]| {
        let mut seen = [0.0; DIRECTIONS.len()];
        for face in piece {
            let [a, b, c] = face.triangle.0.map(|p| p.as_dvec3());
            let area_normal = (b - a).cross(c - a);
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
    let mut seen = [0.0; DIRECTIONS.len()];
    for of_piece in pieces(faces, of_piece) {
        seen.iter_mut()
            .zip(of_piece)
            .for_each(|(seen, more)| *seen += more);
    }
    let most = seen.iter().copied().fold(0.0, f64::max);
    let broad = DIRECTIONS
        .iter()
        .zip(seen)
        .find(|(_, seen)| *seen >= BROAD_ENOUGH * most);
    broad.map_or(DIRECTIONS[0], |(direction, _)| *direction)
}

/// The unit vector toward a viewer in this direction.
fn unit((azimuth, elevation): Direction) -> DVec3 {
    let (azimuth, elevation) = (azimuth.to_radians(), elevation.to_radians());
    let level = libm::cos(elevation);
    DVec3::new(
        libm::sin(azimuth) * level,
        libm::sin(elevation),
        libm::cos(azimuth) * level,
    )
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;

    fn square(corners: [Vec3; 4]) -> Vec<Face> {
        let [a, b, c, d] = corners;
        let face = |t| Face {
            triangle: Triangle(t),
            double_sided: false,
        };
        vec![face([a, b, c]), face([a, c, d])]
    }

    fn box_faces(size: Vec3) -> Vec<Face> {
        let corner = |i: u32| {
            let pick = |bit: u32, s: f32| if i & bit == 0 { -s } else { s };
            Vec3::new(pick(1, size.x), pick(2, size.y), pick(4, size.z))
        };
        let quads = [
            [0, 4, 6, 2],
            [1, 3, 7, 5],
            [0, 1, 5, 4],
            [2, 6, 7, 3],
            [0, 2, 3, 1],
            [4, 5, 7, 6],
        ];
        quads
            .iter()
            .flat_map(|quad| square(quad.map(corner)))
            .collect()
    }

    /// The least and the greatest picture position of the faces' vertices, 0..1 in both directions.
    fn projected(camera: &Camera, faces: &[Face], aspect: f64) -> (DVec3, DVec3) {
        let [u, v, w] = camera.basis();
        let tan = libm::tan(FOV_Y / 2.0);
        let position = |p: Vec3| {
            let d = p.as_dvec3() - camera.position;
            let z = d.dot(w);
            assert!(z > 0.0);
            DVec3::new(
                0.5 + d.dot(u) / z / tan / aspect / 2.0,
                0.5 + d.dot(v) / z / tan / 2.0,
                0.0,
            )
        };
        let all = faces.iter().flat_map(|f| f.triangle.0).map(position);
        all.fold((DVec3::INFINITY, DVec3::NEG_INFINITY), |(a, b), p| {
            (a.min(p), b.max(p))
        })
    }

    #[test]
    fn a_box_fills_four_fifths_of_the_tighter_side_and_is_centred() {
        for size in [
            Vec3::ONE,
            Vec3::new(10.0, 1.0, 1.0),
            Vec3::new(0.001, 0.004, 0.001),
            Vec3::splat(1e4),
        ] {
            for aspect in [16.0 / 9.0, 0.5] {
                let faces = box_faces(size);
                let camera = frame(faces.iter().copied(), aspect, FOV_Y);
                let (min, max) = projected(&camera, &faces, aspect);
                let (filled, middle) = (max - min, (max + min) / 2.0);
                assert!(
                    (filled.x.max(filled.y) - 0.8).abs() < 0.01,
                    "{size} {aspect}: {filled}"
                );
                assert!(
                    (middle.x - 0.5).abs() < 0.1 && (middle.y - 0.5).abs() < 0.1,
                    "{middle}"
                );
            }
        }
    }

    #[test]
    fn a_solid_is_seen_from_three_quarters_and_above() {
        let camera = frame(box_faces(Vec3::ONE).into_iter(), 1.5, FOV_Y);
        assert!(camera.position.x > 0.0 && camera.position.y > 0.0 && camera.position.z > 0.0);
    }

    #[test]
    fn nothing_flat_is_seen_edge_on_or_from_behind() {
        for normal in [
            Vec3::X,
            Vec3::Y,
            Vec3::Z,
            Vec3::NEG_X,
            Vec3::NEG_Y,
            Vec3::NEG_Z,
            Vec3::new(1.0, 0.0, -1.0),
        ] {
            let (e1, e2) = normal.normalize().any_orthonormal_pair();
            let faces = square([-e1 - e2, e1 - e2, e1 + e2, e2 - e1]);
            let camera = frame(faces.iter().copied(), 1.5, FOV_Y);
            let toward = (camera.position - camera.look_at).normalize();
            assert!(
                faces[0].triangle.normal().as_dvec3().dot(toward) > 0.3,
                "{normal}"
            );
        }
    }

    #[test]
    fn nothing_and_a_point_still_get_a_camera() {
        let point = Face {
            triangle: Triangle([Vec3::ONE; 3]),
            double_sided: true,
        };
        for faces in [vec![], vec![point]] {
            let camera = frame(faces.into_iter(), 1.0, FOV_Y);
            assert!(camera.position.is_finite() && camera.position != camera.look_at);
        }
    }
}
