//! What of a scene stands in trees, and in which.

use super::SharedInstance;
use super::tree::{Item, Number};
use super::wide::Kind;
use crate::geometry::Bounds;
use crate::mesh::Mesh;
use crate::scene::Scene;
use rayon::prelude::*;

/// The items of one tree, numbered from 0.
pub(super) trait Items: Sync {
    fn bounds(&self) -> &[Bounds];
    fn kind(&self, index: u32) -> Kind;
    fn item(&self, index: u32) -> Item;
    /// The greatest absolute coordinate of them all.
    fn extent(&self) -> f32;
}

/// For each mesh that instances share what `build` makes of it, and nothing for the others.
pub(super) fn of_shared<T: Default>(
    scene: &Scene,
    mut build: impl FnMut(&ItemsOfMesh) -> T,
) -> Vec<T> {
    let mut shared = vec![false; scene.meshes().len()];
    for instance in scene.instances().iter().filter(|i| i.space.is_some()) {
        shared[instance.mesh as usize] = true;
    }
    let meshes = scene.meshes().iter().zip(shared);
    meshes
        .map(|(mesh, shared)| match shared {
            true => build(&ItemsOfMesh::new(mesh)),
            false => T::default(),
        })
        .collect()
}

/// The triangles of a shared mesh.
pub(super) struct ItemsOfMesh<'a> {
    mesh: &'a Mesh,
    bounds: Vec<Bounds>,
}

impl<'a> ItemsOfMesh<'a> {
    fn new(mesh: &'a Mesh) -> ItemsOfMesh<'a> {
        ItemsOfMesh {
            mesh,
            bounds: triangle_bounds(mesh).collect(),
        }
    }
}

fn triangle_bounds(mesh: &Mesh) -> impl IndexedParallelIterator<Item = Bounds> {
    (0..mesh.triangles.len() as u32)
        .into_par_iter()
        .map(|index| mesh.triangle(index).bounds())
}

impl Items for ItemsOfMesh<'_> {
    fn bounds(&self) -> &[Bounds] {
        &self.bounds
    }

    fn kind(&self, _: u32) -> Kind {
        Kind::Triangles
    }

    fn item(&self, index: u32) -> Item {
        Item::Triangle(self.mesh.triangle(index), Number::new(index, true))
    }

    fn extent(&self) -> f32 {
        self.mesh.bounds().extent()
    }
}

/// Everything in the world that has bounds: spheres, then each instance's triangles or the instance itself.
pub(super) struct ItemsOfWorld<'a> {
    scene: &'a Scene,
    spheres: u32,
    /// The first item of each instance.
    first_items: Vec<u32>,
    bounds: Vec<Bounds>,
}

impl<'a> ItemsOfWorld<'a> {
    pub(super) fn new(scene: &'a Scene) -> ItemsOfWorld<'a> {
        let mut first_items = Vec::with_capacity(scene.instances().len());
        let mut bounds: Vec<Bounds> = scene.spheres().iter().map(|s| s.shape.bounds()).collect();
        for instance in scene.instances() {
            first_items.push(bounds.len() as u32);
            match &instance.space {
                Some(space) => bounds.push(space.bounds),
                None => bounds.par_extend(triangle_bounds(scene.mesh(instance.mesh))),
            }
        }
        ItemsOfWorld {
            scene,
            spheres: scene.spheres().len() as u32,
            first_items,
            bounds,
        }
    }

    fn instance_of(&self, index: u32) -> usize {
        self.first_items.partition_point(|&first| first <= index) - 1
    }

    fn is_opaque(&self, material: u32) -> bool {
        self.scene.material(material).is_opaque()
    }
}

impl Items for ItemsOfWorld<'_> {
    fn bounds(&self) -> &[Bounds] {
        &self.bounds
    }

    fn kind(&self, index: u32) -> Kind {
        if index < self.spheres {
            return Kind::Spheres;
        }
        let instance = &self.scene.instances()[self.instance_of(index)];
        match instance.space {
            Some(_) => Kind::Instances,
            None => Kind::Triangles,
        }
    }

    fn item(&self, index: u32) -> Item {
        if index < self.spheres {
            let sphere = &self.scene.spheres()[index as usize];
            let opaque = self.is_opaque(sphere.material);
            return Item::Sphere(sphere.shape, Number::new(index, opaque));
        }
        let number = self.instance_of(index);
        let instance = &self.scene.instances()[number];
        let opaque = self.is_opaque(instance.material);
        match instance.space {
            Some(space) => Item::Instance(SharedInstance {
                space,
                mesh: instance.mesh,
                first_primitive: instance.first_primitive,
                opaque,
            }),
            None => {
                let triangle = index - self.first_items[number];
                Item::Triangle(
                    self.scene.mesh(instance.mesh).triangle(triangle),
                    Number::new(instance.first_primitive + triangle, opaque),
                )
            }
        }
    }

    fn extent(&self) -> f32 {
        let all = self.bounds.iter().copied();
        all.fold(Bounds::EMPTY, Bounds::union).extent()
    }
}
