//! Other layouts, to compare: no tree at all, and the two of obvhs. One ray and one primitive at a time, by the tests of
//! [`super::primitive`], so that the answers are the same bits.

mod binary;
mod bvh2;
mod cwbvh;

use super::cost::{Tally, Uncounted};
use super::items::Items;
use super::kernel::{Any, Best, Closest, Question};
use super::primitive::{self, Probe};
use super::tree::{Item, Number, add_leaf};
use super::{Accel, Layout, Options, SharedInstance, Statistics};
use crate::geometry::{Hit, Sphere, Triangle};
use crate::ray::Ray;
use binary::Binary;
use bvh2::Bvh2;
use cwbvh::CwBvh;
use rayon::prelude::*;
use std::marker::PhantomData;
use std::time::Duration;

/// What stands in the place of the trees of an [`Accel`]: both levels in the same layout.
#[derive(Clone, Debug)]
pub(super) struct Others {
    pub(super) world: Other,
    pub(super) meshes: Vec<Other>,
}

/// Some items in one of these layouts.
#[derive(Clone, Debug, Default)]
pub(super) struct Other {
    shape: Shape,
    /// In the order of the leaves.
    items: Vec<Laid>,
    instances: Vec<SharedInstance>,
    /// The greatest absolute coordinate of anything in it.
    extent: f32,
}

/// How the items are found.
#[derive(Clone, Debug, Default)]
enum Shape {
    /// In turn.
    #[default]
    List,
    Bvh2(Bvh2),
    CwBvh(CwBvh),
}

/// An item as it lies in memory.
#[derive(Clone, Copy, Debug)]
enum Laid {
    Triangle(Triangle, Number),
    Sphere(Sphere, Number),
    /// An index into [`Other::instances`].
    Instance(u32),
}

impl Others {
    /// [`Accel::intersect`].
    pub(super) fn intersect(&self, accel: &Accel, ray: &Ray) -> Option<Hit> {
        let mut best = Best::nothing(ray);
        accel.offer_planes(ray, &mut best);
        self.follow::<Closest, _>(ray, &mut best, &mut Uncounted);
        best.hit()
    }

    /// [`Accel::occluded`].
    pub(super) fn occluded(&self, accel: &Accel, ray: &Ray) -> bool {
        let mut best = Best::nothing(ray);
        accel.meets_opaque_plane(ray) || self.follow::<Any, _>(ray, &mut best, &mut Uncounted)
    }

    /// Follows a ray through both levels; true at once where any hit will do and one is opaque.
    pub(super) fn follow<Q: Question, T: Tally>(
        &self,
        ray: &Ray,
        best: &mut Best,
        tally: &mut T,
    ) -> bool {
        let search = Search::<Q, T> {
            level: &self.world,
            meshes: &self.meshes,
            first_number: 0,
            probe: &Probe::new(*ray, self.world.extent),
            best,
            tally,
            question: PhantomData,
        };
        search.run()
    }

    pub(super) fn all(&self) -> impl Iterator<Item = &Other> {
        self.meshes.iter().chain([&self.world])
    }
}

impl Other {
    /// All items in the layout that the options ask for.
    pub(super) fn of(items: &impl Items, options: &Options) -> Other {
        let extent = items.extent();
        let tree = || Binary::new(items, options);
        let (shape, order) = match options.layout {
            Layout::Bvh2 => bvh2::of(&tree()),
            Layout::CwBvh => cwbvh::of(&tree(), extent),
            _ => (Shape::List, (0..items.bounds().len() as u32).collect()),
        };
        let mut other = Other {
            shape,
            extent,
            ..Other::default()
        };
        let laid: Vec<(Laid, Option<SharedInstance>)> = order
            .par_iter()
            .map(|&index| match items.item(index) {
                Item::Triangle(triangle, number) => (Laid::Triangle(triangle, number), None),
                Item::Sphere(sphere, number) => (Laid::Sphere(sphere, number), None),
                Item::Instance(instance) => (Laid::Instance(0), Some(instance)),
            })
            .collect();
        other.items.reserve_exact(laid.len());
        for (item, instance) in laid {
            let Some(instance) = instance else {
                other.items.push(item);
                continue;
            };
            other
                .items
                .push(Laid::Instance(other.instances.len() as u32));
            other.instances.push(instance);
        }
        other
    }

    /// Of this one alone.
    pub(super) fn statistics(&self) -> Statistics {
        let of_shape = match &self.shape {
            Shape::List => Statistics {
                sah_cost: self.items.len() as f32,
                ..Statistics::default()
            },
            Shape::Bvh2(tree) => tree.statistics,
            Shape::CwBvh(tree) => tree.statistics,
        };
        Statistics {
            bytes: of_shape.bytes
                + size_of_val(self.items.as_slice())
                + size_of_val(self.instances.as_slice()),
            build_time: Duration::ZERO,
            ..of_shape
        }
    }

    /// Adds how many leaves hold one item, two, and so on; a list has no leaves.
    pub(super) fn add_leaf_sizes(&self, sizes: &mut Vec<u64>) {
        match &self.shape {
            Shape::List => {}
            Shape::Bvh2(tree) => tree.leaf_sizes().for_each(|size| add_leaf(sizes, size)),
            Shape::CwBvh(tree) => tree.leaf_sizes().for_each(|size| add_leaf(sizes, size)),
        }
    }
}

/// A ray on its way through one level.
struct Search<'a, Q, T> {
    level: &'a Other,
    meshes: &'a [Other],
    /// What the numbers of the level's primitives start from.
    first_number: u32,
    /// The ray, in the level's space.
    probe: &'a Probe,
    best: &'a mut Best,
    tally: &'a mut T,
    question: PhantomData<Q>,
}

impl<Q: Question, T: Tally> Search<'_, Q, T> {
    fn run(mut self) -> bool {
        let level = self.level;
        match &level.shape {
            Shape::List => self.test(0..level.items.len()),
            Shape::Bvh2(tree) => tree.walk(&mut self),
            Shape::CwBvh(tree) => tree.walk(&mut self),
        }
    }

    /// Offers the hits of some items; true where any hit will do and there is an opaque one.
    fn test(&mut self, items: std::ops::Range<usize>) -> bool {
        let level = self.level;
        let Some(items) = level.items.get(items) else {
            return false;
        };
        for item in items {
            let number = |number: Number| self.first_number + number.get();
            let (hit, opaque) = match item {
                Laid::Triangle(triangle, n) => (
                    primitive::triangle(triangle, self.probe, number(*n)),
                    n.is_opaque(),
                ),
                Laid::Sphere(sphere, n) => (
                    primitive::sphere(sphere, self.probe, number(*n)),
                    n.is_opaque(),
                ),
                Laid::Instance(index) => {
                    if self.enter(&level.instances[*index as usize]) {
                        return true;
                    }
                    continue;
                }
            };
            self.tally.primitive();
            let Some(hit) = hit else { continue };
            if !Q::ANY {
                self.best.offer(hit.t, hit.primitive, hit.barycentric);
            } else if opaque {
                return true;
            }
        }
        false
    }

    /// Follows the ray through an instance's own mesh.
    fn enter(&mut self, instance: &SharedInstance) -> bool {
        if Q::ANY && !instance.opaque {
            return false;
        }
        let Some(mesh) = self.meshes.get(instance.mesh as usize) else {
            return false;
        };
        let Some(local) = self.probe.in_space(&instance.space, mesh.extent) else {
            return false;
        };
        let search = Search::<Q, T> {
            level: mesh,
            meshes: &[],
            first_number: instance.first_primitive,
            probe: &local,
            best: self.best,
            tally: self.tally,
            question: PhantomData,
        };
        local.ray.t_min <= search.best.t && search.run()
    }
}
