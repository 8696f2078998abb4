//! What transparent surfaces, and the bodies between them, leave of shadow rays' light.

use super::MAX_LAYERS;
use crate::accel::Accel;
use crate::color::Rgb;
use crate::geometry::Hit;
use crate::material::Volume;
use crate::ray::Ray;
use crate::scene::Scene;

/// Shadow rays that nothing opaque stops, on their way from layer to layer, in memory that is kept.
///
/// Light toward a surface does not bend here, since it is followed from one end to the other: a Whitted renderer has
/// tinted shadows, no caustics. A ray that comes out of a body that it did not enter was in it from the beginning; one that
/// meets no way out stays in it to its end, if it has one.
#[derive(Debug, Default)]
pub(super) struct ThroughLayers<'a> {
    rays: Vec<Ray>,
    /// Of each of `rays`.
    under_way: Vec<UnderWay<'a>>,
    hits: Vec<Option<Hit>>,
    /// What is left of the light of each shadow ray.
    pub(super) shares: Vec<Rgb>,
}

/// What is known of a ray on its way.
#[derive(Clone, Copy, Debug)]
struct UnderWay<'a> {
    /// Which of the shadow rays.
    index: usize,
    /// Where that begins.
    start: f32,
    /// The body that it is in, and since when.
    inside: Option<(&'a Volume, f32)>,
}

impl<'a> ThroughLayers<'a> {
    /// Finds the share of each shadow ray's light that transparent surfaces and bodies let through, none for rays that
    /// are `occluded`. `search` finds what rays meet first. Returns how many rays met too many layers.
    #[inline(never)]
    pub(super) fn follow(
        &mut self,
        scene: &'a Scene,
        accel: &Accel,
        mut search: impl FnMut(&[Ray], &mut Vec<Option<Hit>>),
        shadow_rays: &[Ray],
        occluded: &[bool],
    ) -> u64 {
        self.start(accel, shadow_rays, occluded);
        let mut lost = 0;
        for layer in 0..=MAX_LAYERS {
            if self.rays.is_empty() {
                break;
            }
            search(&self.rays, &mut self.hits);
            if layer == MAX_LAYERS {
                lost = self.hits.iter().flatten().count() as u64;
                break;
            }
            let mut kept = 0;
            for at in 0..self.rays.len() {
                let (ray, mut way) = (self.rays[at], self.under_way[at]);
                let share = &mut self.shares[way.index];
                let Some(hit) = self.hits[at] else {
                    if let Some((volume, from)) = way.inside.filter(|_| ray.t_max < f32::INFINITY) {
                        *share = *share * volume.transmittance(ray.t_max - from);
                    }
                    continue;
                };
                *share = *share * way.cross(scene, &ray, &hit);
                if *share != Rgb::BLACK {
                    self.rays[kept] = ray.beyond(hit.t, hit.primitive);
                    self.under_way[kept] = way;
                    kept += 1;
                }
            }
            self.rays.truncate(kept);
            self.under_way.truncate(kept);
        }
        lost
    }

    fn start(&mut self, accel: &Accel, shadow_rays: &[Ray], occluded: &[bool]) {
        self.rays.clear();
        self.under_way.clear();
        self.shares.clear();
        for (index, (ray, &occluded)) in shadow_rays.iter().zip(occluded).enumerate() {
            if occluded {
                self.shares.push(Rgb::BLACK);
                continue;
            }
            self.shares.push(Rgb::WHITE);
            if !accel.may_meet_transparent(ray) {
                continue;
            }
            self.rays.push(*ray);
            self.under_way.push(UnderWay {
                index,
                start: ray.t_min,
                inside: None,
            });
        }
    }
}

impl<'a> UnderWay<'a> {
    /// What the surface at `hit`, and the body that ends there, leave.
    fn cross(&mut self, scene: &'a Scene, ray: &Ray, hit: &Hit) -> Rgb {
        let filter = scene.filter(ray, hit);
        match filter.volume {
            Some(volume) if filter.enters => {
                self.inside = Some((volume, hit.t));
                filter.share
            }
            Some(volume) => {
                let (_, from) = self.inside.take().unwrap_or((volume, self.start));
                filter.share * volume.transmittance(hit.t - from)
            }
            None => filter.share,
        }
    }
}
