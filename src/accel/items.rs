//! What of a scene stands in trees, and in which.

use super::build;
use super::tree::{Item, Number, Tree};
use super::wide::Kind;
use super::{Options, SharedInstance};
use crate::geometry::Bounds;
use crate::scene::Scene;
use rayon::prelude::*;

/// The tree over the triangles of a shared mesh, numbered from 0.
pub(super) fn mesh_tree(scene: &Scene, mesh: u32, options: &Options) -> Tree {
    let mesh = scene.mesh(mesh);
    let triangles = 0..mesh.triangles.len() as u32;
    let bounds: Vec<Bounds> = triangles
        .into_par_iter()
        .map(|index| mesh.triangle(index).bounds())
        .collect();
    let topology = build::build(&bounds, |_| Kind::Triangles, options);
    Tree::new(topology, mesh.bounds().extent(), options.layout, |index| {
        Item::Triangle(mesh.triangle(index), Number::new(index, true))
    })
}

/// The tree over everything in the world that has bounds: spheres, then each instance's triangles or the instance itself.
pub(super) fn world_tree(scene: &Scene, options: &Options) -> Tree {
    let spheres = scene.spheres().len() as u32;
    let opaque = |material: u32| scene.material(material).is_opaque();
    // The first item of each instance.
    let mut first_items = Vec::with_capacity(scene.instances().len());
    let mut bounds: Vec<Bounds> = scene.spheres().iter().map(|s| s.shape.bounds()).collect();
    for instance in scene.instances() {
        first_items.push(bounds.len() as u32);
        match &instance.space {
            Some(space) => bounds.push(space.bounds),
            None => {
                let mesh = scene.mesh(instance.mesh);
                bounds.par_extend(
                    (0..mesh.triangles.len() as u32)
                        .into_par_iter()
                        .map(|index| mesh.triangle(index).bounds()),
                );
            }
        }
    }
    let instance_of = |item: u32| first_items.partition_point(|&first| first <= item) - 1;
    let kind = |item: u32| {
        if item < spheres {
            Kind::Spheres
        } else if scene.instances()[instance_of(item)].space.is_some() {
            Kind::Instances
        } else {
            Kind::Triangles
        }
    };
    let extent = bounds
        .iter()
        .copied()
        .fold(Bounds::EMPTY, Bounds::union)
        .extent();
    let topology = build::build(&bounds, kind, options);
    Tree::new(topology, extent, options.layout, |item| {
        if item < spheres {
            let sphere = &scene.spheres()[item as usize];
            return Item::Sphere(sphere.shape, Number::new(item, opaque(sphere.material)));
        }
        let index = instance_of(item);
        let instance = &scene.instances()[index];
        let opaque = opaque(instance.material);
        match instance.space {
            Some(space) => Item::Instance(SharedInstance {
                space,
                mesh: instance.mesh,
                first_primitive: instance.first_primitive,
                opaque,
            }),
            None => {
                let triangle = item - first_items[index];
                Item::Triangle(
                    scene.mesh(instance.mesh).triangle(triangle),
                    Number::new(instance.first_primitive + triangle, opaque),
                )
            }
        }
    })
}
