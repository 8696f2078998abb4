//! How far away: near enough that the picture is filled, far enough that nothing is cut off.

use super::{Face, pieces};
use crate::camera::Camera;
use crate::geometry::Bounds;
use glam::DVec3;

/// The share of the picture's width or height, whichever is tighter, that the model fills.
const FILL: f64 = 0.8;

/// A camera in a direction from faces, which fill `FILL` of the width or the height.
pub(super) fn camera(
    faces: &[Face],
    bounds: &Bounds,
    towards_viewer: DVec3,
    aspect: f64,
    fov_y: f64,
) -> Camera {
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
    let position = fitted_position(faces, looking.basis(), (center, radius), (aspect, fov_y));
    // The target is the point of the axis nearest to the middle of the model.
    let axis = -towards_viewer;
    let target = position + axis * (center - position).dot(axis).max(radius * 0.01);
    Camera::looking_at(position, target, DVec3::Y, fov_y)
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
