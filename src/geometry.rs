//! Shapes: one equation a file.

mod plane;
mod sphere;
mod triangle;

pub use plane::Plane;
pub use sphere::Sphere;
pub use triangle::{RaySpace, Triangle, TriangleHit};

use glam::Vec3;

/// Where a ray meets a primitive.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hit {
    /// The ray's parameter: with a unit direction, the distance.
    pub t: f32,
    /// The number of the primitive in its scene.
    pub primitive: u32,
    /// The weights of a triangle's second and third vertex; zero on other shapes.
    pub barycentric: [f32; 2],
}

impl Hit {
    /// Whether this hit comes before `other` along a ray: nearer, or as near with the lower primitive.
    pub fn precedes(&self, other: &Hit) -> bool {
        self.t < other.t || (self.t == other.t && self.primitive < other.primitive)
    }
}

/// An axis-aligned box, both corners included. `min > max` where it is empty.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bounds {
    /// The corner with the least coordinates.
    pub min: Vec3,
    /// The corner with the greatest.
    pub max: Vec3,
}

impl Bounds {
    /// The box around nothing.
    pub const EMPTY: Bounds = Bounds {
        min: Vec3::INFINITY,
        max: Vec3::NEG_INFINITY,
    };

    /// The smallest box around some points.
    pub fn around(points: impl IntoIterator<Item = Vec3>) -> Bounds {
        points.into_iter().fold(Bounds::EMPTY, |b, p| Bounds {
            min: b.min.min(p),
            max: b.max.max(p),
        })
    }

    /// The smallest box around both.
    pub fn union(self, other: Bounds) -> Bounds {
        Bounds {
            min: self.min.min(other.min),
            max: self.max.max(other.max),
        }
    }

    /// This box with every face moved out by `margin`.
    pub fn grown(self, margin: f32) -> Bounds {
        Bounds {
            min: self.min - margin,
            max: self.max + margin,
        }
    }

    /// Whether nothing is inside.
    pub fn is_empty(&self) -> bool {
        !(self.min.x <= self.max.x && self.min.y <= self.max.y && self.min.z <= self.max.z)
    }

    /// The midpoint.
    pub fn center(&self) -> Vec3 {
        (self.min + self.max) * 0.5
    }

    /// The greatest absolute coordinate; 0 for the empty box.
    pub fn extent(&self) -> f32 {
        if self.is_empty() {
            0.0
        } else {
            self.min.abs().max(self.max.abs()).max_element()
        }
    }
}

/// What a shape says about the point where a ray met it; world space.
#[derive(Clone, Copy, Debug)]
pub struct SurfacePoint {
    /// The point, put back onto the surface.
    pub position: Vec3,
    /// A bound on how far `position` may lie from the true surface, for [`crate::ray::Ray::leaving`].
    pub error: f32,
    /// The shape's own unit normal, on the side of its front.
    pub normal: Vec3,
}

/// A bound on the distance from its surface of a point that was found in `f64` and then rounded: `sqrt(3) / 2` of the
/// distance between neighbouring numbers as great as `magnitude`, its greatest coordinate.
fn rounding_of(magnitude: f32) -> f32 {
    f32::EPSILON * magnitude
}
