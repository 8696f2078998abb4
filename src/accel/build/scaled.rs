//! Boxes moved and scaled into -1..1, where no area overflows or underflows without need.

use super::binary::Node;
use crate::geometry::Bounds;
use glam::{DVec3, Vec3A};
use rayon::prelude::*;

/// A leaf for each box, in order.
pub(super) fn leaves(bounds: &[Bounds]) -> Vec<Node> {
    let all = bounds
        .par_iter()
        .copied()
        .reduce(|| Bounds::EMPTY, Bounds::union);
    let (min, max) = (all.min.as_dvec3(), all.max.as_dvec3());
    let center = (min + max) * 0.5;
    let scale = 2.0 / (max - min).max_element().max(f64::MIN_POSITIVE);
    let moved = |p: glam::Vec3| -> Vec3A {
        ((p.as_dvec3() - center) * scale)
            .clamp(DVec3::NEG_ONE, DVec3::ONE)
            .as_vec3a()
    };
    bounds
        .par_iter()
        .enumerate()
        .map(|(item, b)| Node::leaf(moved(b.min), moved(b.max), item as u32))
        .collect()
}
