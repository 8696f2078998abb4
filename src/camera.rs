//! The camera: from a continuous picture position to a primary ray.

use crate::cone::Cone;
use crate::ray::Ray;
use glam::DVec3;

/// A pinhole or a parallel camera, before it knows the picture's size.
///
/// Place and angles are in `f64`: near the horizon, the last bit of a 32-bit angle moves what a ray meets by a square of
/// the paper's checkerboard.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Camera {
    /// `C`, the centre of projection; world space.
    pub position: DVec3,
    /// `F`, a point the camera looks at; differs from `position`.
    pub look_at: DVec3,
    /// Up in the picture; need not be perpendicular to the view, nor of unit length.
    pub up: DVec3,
    /// How wide the camera sees.
    pub projection: Projection,
    /// The least accepted distance.
    pub near: f32,
    /// The greatest accepted distance; infinity where there is none.
    pub far: f32,
    /// Along what `near` and `far` are measured.
    pub clip: Clip,
}

/// How wide a camera sees.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Projection {
    /// Fields of view in radians, each in (0, π). The one that is missing follows from the other and the picture's
    /// shape, by `tan(fov_x/2) = tan(fov_y/2) * width / height`.
    Perspective {
        /// Horizontal and vertical.
        fov: Fov,
    },
    /// Parallel rays over a rectangle of these half extents, in the scene's unit. The picture's shape stretches
    /// the horizontal one where they disagree: `half_width` is used only where it is given.
    Orthographic {
        /// Half of what is seen from left to right; follows from the picture's shape where it is `None`.
        half_width: Option<f32>,
        /// Half of what is seen from bottom to top.
        half_height: f32,
    },
}

/// One field of view or both, in radians.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fov {
    /// The whole horizontal angle.
    X(f64),
    /// The whole vertical angle.
    Y(f64),
    /// Both: pixels need not be square.
    Both(f64, f64),
}

/// Along what the near and far distances are measured.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Clip {
    /// Along each ray: `near` and `far` limit `t` (the paper's).
    Ray,
    /// Along the camera's axis: planes (glTF's).
    Axis,
}

impl Camera {
    /// A perspective camera without clipping: `fov_y` in radians.
    pub fn looking_at(
        position: impl Into<DVec3>,
        look_at: impl Into<DVec3>,
        up: impl Into<DVec3>,
        fov_y: f64,
    ) -> Camera {
        Camera {
            position: position.into(),
            look_at: look_at.into(),
            up: up.into(),
            projection: Projection::Perspective { fov: Fov::Y(fov_y) },
            near: 0.0,
            far: f32::INFINITY,
            clip: Clip::Ray,
        }
    }

    /// The same camera, carried around the vertical axis through `pivot` by an `angle` in radians, from +Z toward +X. By
    /// none it is the same to the last bit.
    pub fn carried_around(self, pivot: DVec3, angle: f64) -> Camera {
        if angle == 0.0 {
            return self;
        }
        let (sin, cos) = (libm::sin(angle), libm::cos(angle));
        let turned = |v: DVec3| DVec3::new(v.x * cos + v.z * sin, v.y, v.z * cos - v.x * sin);
        Camera {
            position: pivot + turned(self.position - pivot),
            look_at: pivot + turned(self.look_at - pivot),
            up: turned(self.up),
            ..self
        }
    }

    /// The unit vectors `u` (right), `v` (up) and `w` (into the picture) of the camera (paper, eq. 1 and 2).
    ///
    /// Where `up` is parallel to `w`, the world axis least along `w` takes its place (the earlier one of two alike).
    pub fn basis(&self) -> [DVec3; 3] {
        let w = (self.look_at - self.position).normalize_or(DVec3::NEG_Z);
        let up = self.up.normalize_or(DVec3::Y);
        let sideways = w.cross(up);
        // The sine of the angle between them: below this, input that was once 32 bits cannot say which way is up.
        let sideways = if sideways.length() < 1e-6 {
            w.cross(least_along(w))
        } else {
            sideways
        };
        let u = sideways.normalize();
        [u, u.cross(w), w]
    }

    /// Half of what a picture `aspect` times as wide as high shows from left to right, and from bottom to top: at distance 1
    /// where rays meet in a point, in the scene's unit.
    pub fn half_extents(&self, aspect: f64) -> [f64; 2] {
        let tan_half = |angle: f64| libm::tan(angle / 2.0);
        match self.projection {
            Projection::Perspective { fov: Fov::X(fov) } => [tan_half(fov), tan_half(fov) / aspect],
            Projection::Perspective { fov: Fov::Y(fov) } => [tan_half(fov) * aspect, tan_half(fov)],
            Projection::Perspective {
                fov: Fov::Both(x, y),
            } => [tan_half(x), tan_half(y)],
            Projection::Orthographic {
                half_width,
                half_height,
            } => {
                let half_height = f64::from(half_height);
                let half_width = half_width.map_or(half_height * aspect, f64::from);
                [half_width, half_height]
            }
        }
    }

    /// This camera for a picture of `width x height` pixels, both above zero.
    pub fn view(&self, width: u32, height: u32) -> View {
        let [u, v, w] = self.basis();
        let [x, y] = self.half_extents(f64::from(width) / f64::from(height));
        let half_size = [f64::from(width) / 2.0, f64::from(height) / 2.0];
        let pixel = (x / half_size[0] * (y / half_size[1])).sqrt() as f32;
        View {
            camera: *self,
            u: u * x,
            v: v * y,
            w,
            half_size,
            pixel,
        }
    }
}

/// The world axis least along `w`, the earlier one of two alike.
fn least_along(w: DVec3) -> DVec3 {
    let a = w.abs();
    if a.x <= a.y && a.x <= a.z {
        DVec3::X
    } else if a.y <= a.z {
        DVec3::Y
    } else {
        DVec3::Z
    }
}

/// A camera in front of a picture of known size.
#[derive(Clone, Copy, Debug)]
pub struct View {
    camera: Camera,
    /// `u` and `v`, as long as half the picture is wide and high at distance 1.
    u: DVec3,
    v: DVec3,
    w: DVec3,
    /// `n/2` and `m/2`.
    half_size: [f64; 2],
    /// The side of a square as large as a pixel, at distance 1.
    pixel: f32,
}

impl View {
    /// The camera ray through the continuous picture position (`x`, `y`), in pixels from the upper left corner
    /// (paper, eq. 3 to 6). Reckoned in `f64`, since neighbouring directions differ in their last bits.
    pub fn primary_ray(&self, x: f64, y: f64) -> Ray {
        self.ray_through(self.across(x) + self.down(y))
    }

    /// The camera rays through every crossing of the columns `xs` with the rows `ys`, row after row, behind what
    /// `rays` has: each is that of [`View::primary_ray`].
    pub fn primary_rays(&self, xs: &[f64], ys: &[f64], rays: &mut Vec<Ray>) {
        let columns: Vec<DVec3> = xs.iter().map(|&x| self.across(x)).collect();
        for &y in ys {
            let down = self.down(y);
            let through = |&across: &DVec3| self.ray_through(across + down);
            rays.extend(columns.iter().map(through));
        }
    }

    /// The camera rays through these picture positions, behind what `rays` has: each is that of [`View::primary_ray`].
    pub fn primary_rays_at(&self, positions: &[[f64; 2]], rays: &mut Vec<Ray>) {
        rays.extend(positions.iter().map(|&[x, y]| self.primary_ray(x, y)));
    }

    /// From the middle of the picture to a column.
    fn across(&self, x: f64) -> DVec3 {
        let [half_width, _] = self.half_size;
        self.u * ((x - half_width) / half_width)
    }

    /// From the middle of the picture to a row.
    fn down(&self, y: f64) -> DVec3 {
        let [_, half_height] = self.half_size;
        self.v * ((half_height - y) / half_height)
    }

    /// The ray through what lies at `offset` from the middle of the picture.
    #[inline]
    fn ray_through(&self, offset: DVec3) -> Ray {
        let position = self.camera.position;
        let (origin, d) = match self.camera.projection {
            Projection::Perspective { .. } => {
                let d = self.w + offset;
                (position, d * (1.0 / d.length_squared().sqrt()))
            }
            Projection::Orthographic { .. } => (position + offset, self.w),
        };
        // A clip plane at depth z is met at t = z / cos(angle to the axis).
        let per_depth = match self.camera.clip {
            Clip::Ray => 1.0,
            Clip::Axis => (1.0 / d.dot(self.w)) as f32,
        };
        Ray::new(
            origin.as_vec3(),
            d.as_vec3(),
            self.camera.near * per_depth,
            self.camera.far * per_depth,
        )
    }

    /// The cone of one of its rays that stands for this share of a pixel's width.
    #[inline]
    pub fn cone(&self, ray: &Ray, share: f32) -> Cone {
        let width = self.pixel * share;
        match self.camera.projection {
            // Away from the axis a pixel is farther away than along it.
            Projection::Perspective { .. } => Cone {
                width: 0.0,
                spread: width * self.w.as_vec3().dot(ray.direction),
            },
            Projection::Orthographic { .. } => Cone { width, spread: 0.0 },
        }
    }

    /// The distance of the point `ray(t)` along the camera's axis: what an EXR's `Z` holds.
    #[inline]
    pub fn depth(&self, ray: &Ray, t: f32) -> f32 {
        let start = (ray.origin.as_dvec3() - self.camera.position).dot(self.w);
        (start + f64::from(t) * ray.direction.as_dvec3().dot(self.w)) as f32
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use glam::Vec3;
    use std::f64::consts::FRAC_PI_2;

    fn close(a: Vec3, b: Vec3) -> bool {
        (a - b).length() < 1e-6
    }

    #[test]
    fn the_centre_of_the_picture_looks_along_w() {
        let camera = Camera::looking_at(Vec3::new(1.0, 2.0, 3.0), Vec3::ZERO, Vec3::Y, 1.0);
        let ray = camera.view(640, 480).primary_ray(320.0, 240.0);
        assert!(close(ray.direction, -camera.position.normalize().as_vec3()));
    }

    #[test]
    fn the_edges_lie_at_half_the_field_of_view() {
        let camera = Camera::looking_at(Vec3::ZERO, Vec3::NEG_Z, Vec3::Y, FRAC_PI_2);
        let view = camera.view(200, 100);
        let diagonal = 0.5f32.sqrt();
        assert!(close(
            view.primary_ray(100.0, 0.0).direction,
            Vec3::new(0.0, diagonal, -diagonal)
        ));
        // tan(fov_x/2) = tan(45°) * 2
        assert!(close(
            view.primary_ray(200.0, 50.0).direction,
            Vec3::new(2.0, 0.0, -1.0).normalize()
        ));
        let wide = Camera {
            projection: Projection::Perspective {
                fov: Fov::X(FRAC_PI_2),
            },
            ..camera
        };
        let right = wide.view(200, 100).primary_ray(200.0, 50.0).direction;
        assert!(close(right, Vec3::new(diagonal, 0.0, -diagonal)));
    }

    #[test]
    fn a_camera_that_looks_along_up_gets_the_axis_least_along_its_view() {
        let [u, v, w] = Camera::looking_at(Vec3::Y * 5.0, Vec3::ZERO, Vec3::Y, 1.0).basis();
        assert_eq!(w, DVec3::NEG_Y);
        assert_eq!(u, DVec3::NEG_Y.cross(DVec3::X).normalize());
        assert!(u.is_finite() && v.is_finite() && (v.length() - 1.0).abs() < 1e-12);
    }

    #[test]
    fn looking_down_steeply_does_not_stretch_the_picture() {
        let camera = Camera::looking_at(Vec3::new(0.0, 10.0, 1.0), Vec3::ZERO, Vec3::Y, 1.0);
        for axis in camera.basis() {
            assert!((axis.length() - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn parallel_rays_start_on_the_picture_rectangle() {
        let projection = Projection::Orthographic {
            half_width: None,
            half_height: 2.0,
        };
        let camera = Camera {
            projection,
            ..Camera::looking_at(Vec3::ZERO, Vec3::NEG_Z, Vec3::Y, 1.0)
        };
        let ray = camera.view(200, 100).primary_ray(200.0, 0.0);
        assert!(close(ray.origin, Vec3::new(4.0, 2.0, 0.0)) && close(ray.direction, Vec3::NEG_Z));
    }

    #[test]
    fn clip_planes_are_further_along_slanted_rays_than_clip_distances() {
        let camera = Camera {
            far: 1.0,
            ..Camera::looking_at(Vec3::ZERO, Vec3::NEG_Z, Vec3::Y, FRAC_PI_2)
        };
        let planes = Camera {
            clip: Clip::Axis,
            ..camera
        };
        assert_eq!(camera.view(100, 100).primary_ray(50.0, 0.0).t_max, 1.0);
        assert!((planes.view(100, 100).primary_ray(50.0, 0.0).t_max - 2f32.sqrt()).abs() < 1e-6);
    }
}
