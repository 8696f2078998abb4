//! The oracle: every primitive in order, too simple to be wrong. Everything else in `accel` must give the same bits.

use super::primitive::{self, Probe};
use crate::geometry::{Bounds, Hit};
use crate::ray::Ray;
use crate::scene::Scene;

/// The nearest primitive on the ray; of several at the same `t` the one with the lowest number.
pub fn intersect(scene: &Scene, ray: &Ray) -> Option<Hit> {
    let mut best = None;
    every_hit(scene, ray, |hit, _| {
        if best.is_none_or(|best| hit.precedes(&best)) {
            best = Some(hit);
        }
    });
    best
}

/// Whether the ray meets any opaque primitive.
pub fn occluded(scene: &Scene, ray: &Ray) -> bool {
    let mut occluded = false;
    every_hit(scene, ray, |_, opaque| occluded |= opaque);
    occluded
}

/// Calls `found` with the nearest hit of every primitive the ray meets, and whether the primitive is opaque.
fn every_hit(scene: &Scene, ray: &Ray, mut found: impl FnMut(Hit, bool)) {
    let opaque = |material: u32| scene.material(material).is_opaque();
    let probe = Probe::new(*ray, extent(scene));
    for (number, sphere) in (0..).zip(scene.spheres()) {
        primitive::sphere(&sphere.shape, &probe, number)
            .into_iter()
            .for_each(|hit| found(hit, opaque(sphere.material)));
    }
    for (number, plane) in (scene.spheres().len() as u32..).zip(scene.planes()) {
        primitive::plane(&plane.shape, ray, number)
            .into_iter()
            .for_each(|hit| found(hit, opaque(plane.material)));
    }
    for instance in scene.instances() {
        let mesh = scene.mesh(instance.mesh);
        let local = match &instance.space {
            None => Some(probe),
            Some(space) => probe.in_space(space, mesh.bounds().extent()),
        };
        let Some(local) = local else { continue };
        for index in 0..mesh.triangles.len() as u32 {
            let number = instance.first_primitive + index;
            primitive::triangle(&mesh.triangle(index), &local, number)
                .into_iter()
                .for_each(|hit| found(hit, opaque(instance.material)));
        }
    }
}

/// The greatest absolute coordinate of anything that has a box in the world.
fn extent(scene: &Scene) -> f32 {
    let spheres = scene.spheres().iter().map(|sphere| sphere.shape.bounds());
    let instances = scene
        .instances()
        .iter()
        .map(|instance| match &instance.space {
            None => scene.mesh(instance.mesh).bounds(),
            Some(space) => space.bounds,
        });
    spheres
        .chain(instances)
        .fold(Bounds::EMPTY, Bounds::union)
        .extent()
}
