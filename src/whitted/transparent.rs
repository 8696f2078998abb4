//! What transparent surfaces leave of a shadow ray's light.

use super::MAX_LAYERS;
use crate::geometry::Hit;
use crate::ray::Ray;
use crate::scene::Scene;

/// The share of a shadow ray's light that transparent surfaces let through, nothing opaque being on the ray, and whether
/// there were too many of them. `search` finds what a ray meets first.
pub(super) fn transmitted(
    scene: &Scene,
    mut search: impl FnMut(&Ray) -> Option<Hit>,
    shadow_ray: &Ray,
) -> (f32, bool) {
    let mut share = 1.0;
    let mut ray = *shadow_ray;
    for _ in 0..MAX_LAYERS {
        let Some(hit) = search(&ray) else {
            return (share, false);
        };
        share *= 1.0 - scene.shadow_coverage(&hit);
        if share == 0.0 {
            return (share, false);
        }
        ray = ray.beyond(hit.t, hit.primitive);
    }
    (share, search(&ray).is_some())
}
