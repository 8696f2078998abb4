//! What a search asks, and what it has found so far.

use crate::geometry::Hit;
use crate::ray::Ray;

/// The question: the nearest hit, or whether there is any opaque one.
pub(in crate::accel) trait Question {
    const ANY: bool;
}

pub(in crate::accel) struct Closest;
pub(in crate::accel) struct Any;

impl Question for Closest {
    const ANY: bool = false;
}

impl Question for Any {
    const ANY: bool = true;
}

/// The nearest hit so far, or none: then `t` is the end of the ray.
#[derive(Clone, Copy, Debug)]
pub(in crate::accel) struct Best {
    pub(in crate::accel) t: f32,
    /// [`Best::NONE`] as long as there is none.
    pub(in crate::accel) number: u32,
    pub(in crate::accel) barycentric: [f32; 2],
}

impl Best {
    pub(in crate::accel) const NONE: u32 = u32::MAX;

    /// What a ray has found at first.
    pub(in crate::accel) fn nothing(ray: &Ray) -> Best {
        Best {
            t: ray.t_max,
            number: Best::NONE,
            barycentric: [0.0; 2],
        }
    }

    pub(in crate::accel) fn hit(&self) -> Option<Hit> {
        (self.number != Best::NONE).then_some(Hit {
            t: self.t,
            primitive: self.number,
            barycentric: self.barycentric,
        })
    }

    /// Takes a hit that comes before.
    #[inline(always)]
    pub(in crate::accel) fn offer(&mut self, t: f32, number: u32, barycentric: [f32; 2]) {
        if t < self.t || (t == self.t && number < self.number) {
            *self = Best {
                t,
                number,
                barycentric,
            };
        }
    }
}
