//! The oracle: every primitive in order, too simple to be wrong. Everything else in `accel` must give the same bits.

use super::primitive::{self, MeshTriangle, Probe, WorldPrimitive, WorldShape};
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
    let [world, instances] = extents(scene);
    let probe = Probe::new(*ray, world);
    for (number, sphere) in (0..).zip(scene.spheres()) {
        let opaque = opaque(sphere.material);
        let item = WorldPrimitive {
            shape: WorldShape::Sphere(sphere.shape),
            number,
            opaque,
        };
        item.intersect(&probe)
            .into_iter()
            .for_each(|hit| found(hit, opaque));
    }
    for (number, plane) in (scene.spheres().len() as u32..).zip(scene.planes()) {
        let hit = primitive::plane(&plane.shape, ray, number);
        hit.into_iter()
            .for_each(|hit| found(hit, opaque(plane.material)));
    }
    let outer = Probe::new(*ray, instances);
    for instance in scene.instances() {
        let (mesh, first, opaque) = (
            scene.mesh(instance.mesh),
            instance.first_primitive,
            opaque(instance.material),
        );
        let local = match &instance.space {
            None => Some(probe),
            Some(space) => outer.in_space(space, mesh.bounds().extent()),
        };
        let Some(local) = local else { continue };
        for index in 0..mesh.triangles.len() as u32 {
            let item = MeshTriangle {
                triangle: mesh.triangle(index),
                index,
            };
            item.intersect(&local, first)
                .into_iter()
                .for_each(|hit| found(hit, opaque));
        }
    }
}

/// The extent of what is in world space, and that of the instances in spaces of their own.
fn extents(scene: &Scene) -> [f32; 2] {
    let mut boxes = [Bounds::EMPTY; 2];
    for sphere in scene.spheres() {
        boxes[0] = boxes[0].union(sphere.shape.bounds());
    }
    for instance in scene.instances() {
        match &instance.space {
            None => boxes[0] = boxes[0].union(scene.mesh(instance.mesh).bounds()),
            Some(space) => boxes[1] = boxes[1].union(space.bounds),
        }
    }
    boxes.map(|b| b.extent())
}
