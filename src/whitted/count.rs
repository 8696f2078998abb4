//! What the rays of samples were tested against, for who wants to know: the rays of a batch are searched for again, one by
//! one, so that who does not want to know pays nothing.

use super::Tracer;
use super::batch::FROM_GROUND;
use super::transparent::ThroughLayers;
use crate::accel::Tests;
use crate::geometry::Hit;
use crate::ray::Ray;
use std::slice::from_ref;

/// What all rays of some samples were tested against.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Counts {
    /// See [`Tests::nodes`].
    pub nodes: u64,
    /// See [`Tests::primitives`].
    pub primitives: u64,
}

impl Counts {
    fn add(&mut self, tests: Tests) {
        self.nodes += u64::from(tests.nodes);
        self.primitives += u64::from(tests.primitives);
    }
}

impl Tracer<'_> {
    /// Adds what it takes to find where the paths arrive.
    pub(super) fn count_paths(&mut self) {
        let Some(counts) = &mut self.counts else {
            return;
        };
        for (ray, path) in self.paths.rays.iter().zip(&self.paths.paths) {
            if let Some(count) = counts.get_mut(path.sample as usize) {
                count.add(self.accel.intersect_counted(ray).1);
            }
        }
    }

    /// Adds what it takes to find whether shadow rays arrive, and through what.
    pub(super) fn count_shadow_rays(&mut self, kind: usize) {
        let Some(counts) = &mut self.counts else {
            return;
        };
        let (scene, accel) = (self.scene, self.accel);
        let shadow_rays = &self.shadow_rays[kind];
        let mut layers = ThroughLayers::default();
        for (ray, promised) in shadow_rays.rays.iter().zip(&shadow_rays.light) {
            let sample = match kind {
                FROM_GROUND => {
                    let path = self.grounded[promised.sample as usize].path;
                    self.paths.paths[path as usize].sample
                }
                _ => promised.sample,
            };
            let Some(count) = counts.get_mut(sample as usize) else {
                continue;
            };
            let (occluded, tests) = accel.occluded_counted(ray);
            count.add(tests);
            if !occluded && accel.has_transparent() {
                let search = |rays: &[Ray], hits: &mut Vec<Option<Hit>>| {
                    hits.clear();
                    hits.extend(rays.iter().map(|ray| {
                        let (hit, tests) = accel.intersect_counted(ray);
                        count.add(tests);
                        hit
                    }));
                };
                layers.follow(scene, accel, search, from_ref(ray), &[false]);
            }
        }
    }
}
