//! What a search asks, and what it has found so far.

use crate::geometry::Hit;

/// The question: the nearest hit, or whether there is any opaque one.
pub(super) trait Question {
    const ANY: bool;
}

pub(super) struct Closest;
pub(super) struct Any;

impl Question for Closest {
    const ANY: bool = false;
}

impl Question for Any {
    const ANY: bool = true;
}

/// The nearest hit so far, or none: then `t` is the end of the ray.
#[derive(Clone, Copy, Debug)]
pub(super) struct Best {
    pub(super) t: f32,
    /// [`Best::NONE`] as long as there is none.
    pub(super) number: u32,
    pub(super) barycentric: [f32; 2],
}

impl Best {
    pub(super) const NONE: u32 = u32::MAX;

    pub(super) fn hit(&self) -> Option<Hit> {
        (self.number != Best::NONE).then_some(Hit {
            t: self.t,
            primitive: self.number,
            barycentric: self.barycentric,
        })
    }

    /// Takes a hit that comes before.
    #[inline(always)]
    pub(super) fn offer(&mut self, t: f32, number: u32, barycentric: [f32; 2]) {
        if t < self.t || (t == self.t && number < self.number) {
            *self = Best {
                t,
                number,
                barycentric,
            };
        }
    }
}
