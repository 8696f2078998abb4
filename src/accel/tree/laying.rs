//! Leaves laid into blocks, on all threads and in place.

use super::{Item, SphereBlock, Triangles};
use crate::accel::kernel::Pages;
use rayon::prelude::*;

/// A block of a leaf.
pub(super) trait Block: Copy + Send + Sync {
    /// Puts an item of the block's kind into a lane that it has.
    fn put(&mut self, lane: usize, item: Item);
}

impl<const N: usize> Block for Triangles<N> {
    fn put(&mut self, lane: usize, item: Item) {
        if let Item::Triangle(triangle, number) = item {
            self.set(lane, triangle, number);
        }
    }
}

impl Block for SphereBlock {
    fn put(&mut self, lane: usize, item: Item) {
        if let Item::Sphere(sphere, number) = item {
            self.set(lane, sphere, number);
        }
    }
}

/// The leaves of one kind, before they are laid into blocks.
pub(super) struct Laying<'a> {
    /// The items of each leaf.
    leaves: Vec<&'a [u32]>,
    /// Items in a block.
    size: usize,
    /// Of all leaves.
    blocks: usize,
}

/// Leaves that a thread takes at a time.
const TASK: usize = 512;

impl<'a> Laying<'a> {
    pub(super) fn new(size: usize) -> Laying<'a> {
        Laying {
            leaves: Vec::new(),
            size,
            blocks: 0,
        }
    }

    /// The leaf's first block, and how many follow it.
    pub(super) fn add(&mut self, items: &'a [u32]) -> (usize, usize) {
        let (first, count) = (self.blocks, items.len().div_ceil(self.size));
        self.leaves.push(items);
        self.blocks += count;
        (first, count - 1)
    }

    /// The blocks of all leaves.
    pub(super) fn laid<B: Block>(
        &self,
        empty: B,
        item: &(impl Fn(u32) -> Item + Sync),
    ) -> Pages<B> {
        let mut blocks = Pages::filled(empty, self.blocks);
        let mut rest = &mut *blocks;
        let mut tasks = Vec::new();
        for leaves in self.leaves.chunks(TASK) {
            let count = leaves
                .iter()
                .map(|items| items.len().div_ceil(self.size))
                .sum();
            let (own, others) = rest.split_at_mut(count);
            tasks.push((leaves, own));
            rest = others;
        }
        tasks.into_par_iter().for_each(|(leaves, blocks)| {
            let chunks = leaves.iter().flat_map(|items| items.chunks(self.size));
            for (block, items) in blocks.iter_mut().zip(chunks) {
                for (lane, &index) in items.iter().enumerate() {
                    block.put(lane, item(index));
                }
            }
        });
        blocks
    }
}
