//! The paper's checkerboard.

use crate::color::Rgb;
use crate::geometry::Plane;
use glam::{DVec3, Vec3};

/// The paper's pattern on a plane: squares in two colours.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Checker {
    /// The diffuse colour of every second square; the material's own is on the others.
    pub color: Rgb,
    /// The side of a square, above zero, in the scene's unit.
    pub size: f32,
}

impl Checker {
    /// Whether `position` lies on a square of the checker's colour: `floor(a/size) + floor(b/size)` is odd, where `a`
    /// and `b` are the position's coordinates from the plane's point along two axes in the plane: the world axes least
    /// aligned with the normal (the earlier of equals), in x, y, z order, projected onto the plane.
    pub fn covers(&self, plane: &Plane, position: DVec3) -> bool {
        let [e1, e2] = in_plane_axes(plane.normal);
        let p = position - plane.point.as_dvec3();
        let cell = |axis: DVec3| libm::floor(p.dot(axis) / f64::from(self.size));
        (cell(e1) + cell(e2)).rem_euclid(2.0) == 1.0
    }

    /// The share of an ellipse around `position` on squares of the checker's colour: `long` and `short` are its diameters,
    /// square to each other, in the plane. Without a size it is its middle, all or nothing.
    ///
    /// The board's two axes are integrated by themselves, in closed form (Quilez, "Box-filtering checkerboards"), over boxes
    /// that vary as much as the ellipse does: several, one after the other, where it is long.
    pub fn share(&self, plane: &Plane, position: DVec3, [long, short]: [Vec3; 2]) -> f32 {
        let size = f64::from(self.size);
        let [long, short] = [long, short].map(|axis| axis.as_dvec3() / size);
        let (length, width) = (long.length(), short.length());
        // Written to be true for NaN.
        if !(length > 0.0 && length.is_finite()) {
            return f32::from(u8::from(self.covers(plane, position)));
        }
        let [e1, e2] = in_plane_axes(plane.normal);
        let count = (length / width).clamp(1.0, MOST_BOXES).ceil();
        let (long, middle) = (long / count, (count - 1.0) / 2.0);
        let p = (position - plane.point.as_dvec3()) / size;
        let extent = |axis: DVec3| libm::hypot(long.dot(axis), short.dot(axis));
        let (extent1, extent2) = (extent(e1), extent(e2));
        let mut sum = 0.0;
        for at in 0..count as u32 {
            let p = p + long * (f64::from(at) - middle);
            sum += mean_wave(p.dot(e1), extent1) * mean_wave(p.dot(e2), extent2);
        }
        (0.5 - 0.5 * sum / count) as f32
    }
}

/// The most boxes for one ellipse: those of a longer one are longer.
const MOST_BOXES: f64 = 16.0;

/// The mean, over `width` around `x`, of the wave that is 1 from 0 to 1, -1 from 1 to 2, and so on.
fn mean_wave(x: f64, width: f64) -> f64 {
    // Below this the difference of integrals has no digits left.
    if width < 1e-9 {
        let is_even = libm::floor(x).rem_euclid(2.0) == 0.0;
        return if is_even { 1.0 } else { -1.0 };
    }
    let integral = |x: f64| {
        let within = x.rem_euclid(2.0);
        within.min(2.0 - within)
    };
    let mean = (integral(x + width / 2.0) - integral(x - width / 2.0)) / width;
    mean.clamp(-1.0, 1.0)
}

fn in_plane_axes(n: Vec3) -> [DVec3; 2] {
    let n = n.as_dvec3();
    let mut axes = [DVec3::X, DVec3::Y, DVec3::Z];
    // Stable: of equals the earlier axis counts as less aligned.
    axes.sort_by(|p, q| n.dot(*p).abs().total_cmp(&n.dot(*q).abs()));
    let [least, second, _] = axes;
    let ordered = if least.dot(DVec3::new(0.0, 1.0, 2.0)) < second.dot(DVec3::new(0.0, 1.0, 2.0)) {
        [least, second]
    } else {
        [second, least]
    };
    ordered.map(|axis| (axis - n * n.dot(axis)).normalize_or_zero())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_checker_alternates_along_both_axes() {
        let checker = Checker {
            color: Rgb::BLACK,
            size: 2.0,
        };
        let floor = Plane {
            point: Vec3::new(0.0, -1.0, 0.0),
            normal: Vec3::Y,
        };
        let at = |x, z| checker.covers(&floor, DVec3::new(x, -1.0, z));
        assert_eq!(
            [at(0.5, 0.5), at(2.5, 0.5), at(2.5, 2.5), at(-0.5, 0.5)],
            [false, true, false, true]
        );
    }

    #[test]
    fn the_share_of_a_footprint_is_what_many_points_of_it_find() {
        let checker = Checker {
            color: Rgb::BLACK,
            size: 0.5,
        };
        let floor = Plane {
            point: Vec3::new(0.3, 0.0, 0.1),
            normal: Vec3::Y,
        };
        // Along an axis of the board, so that the box is the footprint.
        for (x, length, width) in [(0.4, 0.2, 0.1), (1.3, 0.9, 0.3), (-2.0, 3.3, 0.7)] {
            let [long, short] = [Vec3::X * length, Vec3::Z * width];
            let share = checker.share(&floor, DVec3::new(x, 0.0, 0.2), [long, short]);
            let point = |i: i32, j: i32| {
                let part = |k: i32| (k as f32 + 0.5) / 200.0 - 0.5;
                let offset = long * part(i) + short * part(j);
                checker.covers(&floor, DVec3::new(x, 0.0, 0.2) + offset.as_dvec3())
            };
            let hits = (0..40_000).filter(|at| point(at % 200, at / 200)).count();
            assert!(
                (share - hits as f32 / 40_000.0).abs() < 0.01,
                "{x}: {share}"
            );
        }
    }

    #[test]
    fn a_footprint_without_a_size_is_a_point_and_an_endless_one_too() {
        let checker = Checker {
            color: Rgb::BLACK,
            size: 1.0,
        };
        let floor = Plane {
            point: Vec3::ZERO,
            normal: Vec3::Y,
        };
        for axis in [Vec3::ZERO, Vec3::X * f32::INFINITY, Vec3::NAN] {
            let at = |x| checker.share(&floor, DVec3::new(x, 0.0, 0.5), [axis, Vec3::Z]);
            assert_eq!([at(0.5), at(1.5)], [0.0, 1.0]);
        }
    }

    #[test]
    fn far_away_a_checker_is_grey() {
        let checker = Checker {
            color: Rgb::BLACK,
            size: 1.0,
        };
        let floor = Plane {
            point: Vec3::ZERO,
            normal: Vec3::Y,
        };
        let axes = [Vec3::new(3e6, 0.0, 2e6), Vec3::new(-200.0, 0.0, 300.0)];
        let share = checker.share(&floor, DVec3::new(1e9, 0.0, 3.0), axes);
        assert!((share - 0.5).abs() < 1e-3, "{share}");
    }

    #[test]
    fn axes_of_a_plane_keep_the_order_x_y_z() {
        assert_eq!(in_plane_axes(Vec3::Y), [DVec3::X, DVec3::Z]);
        assert_eq!(in_plane_axes(Vec3::Z), [DVec3::X, DVec3::Y]);
        assert_eq!(in_plane_axes(Vec3::X), [DVec3::Y, DVec3::Z]);
        // All equally aligned: x and y are the less aligned ones.
        let [e1, e2] = in_plane_axes(Vec3::ONE.normalize());
        assert!(e1.x > 0.5 && e2.y > 0.5);
    }
}
