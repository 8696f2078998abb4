//! What transparent surfaces, and the bodies between them, leave of a shadow ray's light.

use super::MAX_LAYERS;
use crate::color::Rgb;
use crate::geometry::Hit;
use crate::material::Volume;
use crate::ray::Ray;
use crate::scene::Scene;

/// The share of a shadow ray's light that transparent surfaces and bodies let through, nothing opaque being on the ray,
/// and whether there were too many of them. `search` finds what a ray meets first.
///
/// Light toward a surface does not bend here, since it is followed from one end to the other: a Whitted renderer has
/// tinted shadows, no caustics. A ray that comes out of a body that it did not enter was in it from the beginning; one that
/// meets no way out stays in it to its end, if it has one.
pub(super) fn transmitted(
    scene: &Scene,
    mut search: impl FnMut(&Ray) -> Option<Hit>,
    shadow_ray: &Ray,
) -> (Rgb, bool) {
    let mut share = Rgb::WHITE;
    let mut ray = *shadow_ray;
    let mut inside: Option<(&Volume, f32)> = None;
    for _ in 0..MAX_LAYERS {
        let Some(hit) = search(&ray) else {
            if let Some((volume, from)) = inside.filter(|_| ray.t_max < f32::INFINITY) {
                share = share * volume.transmittance(ray.t_max - from);
            }
            return (share, false);
        };
        let filter = scene.filter(&ray, &hit);
        share = share * filter.share;
        if let Some(volume) = filter.volume {
            if filter.enters {
                inside = Some((volume, hit.t));
            } else {
                let (_, from) = inside.take().unwrap_or((volume, shadow_ray.t_min));
                share = share * volume.transmittance(hit.t - from);
            }
        }
        if share == Rgb::BLACK {
            return (share, false);
        }
        ray = ray.beyond(hit.t, hit.primitive);
    }
    (share, search(&ray).is_some())
}
