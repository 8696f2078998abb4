//! A tree with its primitives laid into it.

mod laying;

use super::items::Items;
use super::kernel::Pages;
use super::wide::{Kind, Node, Reference, Topology};
use super::{Layout, Options, SharedInstance, Statistics, build};
use crate::geometry::{Sphere, Triangle};
use laying::Laying;
use std::time::Duration;

/// The bit of a primitive's number that says that light passes through it.
const TRANSPARENT: u32 = 1 << 31;

/// What a tree is made of.
pub(super) enum Item {
    Triangle(Triangle, Number),
    Sphere(Sphere, Number),
    Instance(SharedInstance),
}

/// The number of a primitive, below 2^31, and whether it is opaque.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Number(u32);

impl Number {
    /// Of the lanes of a block that have no primitive.
    const NONE: Number = Number(u32::MAX);

    pub(super) fn new(number: u32, opaque: bool) -> Number {
        Number(if opaque { number } else { number | TRANSPARENT })
    }

    /// How many lanes of a block have a primitive.
    pub(super) fn count(lanes: &[Number]) -> u32 {
        lanes
            .iter()
            .filter(|&&number| number != Number::NONE)
            .count() as u32
    }

    pub(super) fn get(self) -> u32 {
        self.0 & !TRANSPARENT
    }

    pub(super) fn is_opaque(self) -> bool {
        self.0 & TRANSPARENT == 0
    }
}

/// Up to `N` triangles, vertex by vertex and axis by axis: 320 bytes for eight, 160 for four.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(32))]
pub(super) struct Triangles<const N: usize> {
    /// Not numbers in lanes without a triangle, so that no ray meets them.
    pub(super) vertices: [[[f32; N]; 3]; 3],
    pub(super) numbers: [Number; N],
}

/// What a kernel tests at once.
pub(super) type TriangleBlock = Triangles<8>;

/// Up to eight spheres.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(super) struct SphereBlock {
    /// Not numbers in lanes without a sphere, so that no ray meets them.
    pub(super) center: [[f32; 8]; 3],
    pub(super) radius: [f32; 8],
    pub(super) numbers: [Number; 8],
}

impl<const N: usize> Triangles<N> {
    const EMPTY: Triangles<N> = Triangles {
        vertices: [[[f32::NAN; N]; 3]; 3],
        numbers: [Number::NONE; N],
    };

    /// Puts a triangle into a lane, below `N`.
    fn set(&mut self, lane: usize, Triangle(corners): Triangle, number: Number) {
        for (rows, corner) in self.vertices.iter_mut().zip(corners) {
            rows.iter_mut()
                .zip(corner.to_array())
                .for_each(|(row, x)| row[lane] = x);
        }
        self.numbers[lane] = number;
    }
}

impl TriangleBlock {
    /// Up to two blocks of four, side by side.
    #[inline(always)]
    fn of_fours(fours: &[Triangles<4>]) -> TriangleBlock {
        let mut eight = TriangleBlock::EMPTY;
        for (half, four) in fours.iter().take(2).enumerate() {
            let from = 4 * half;
            for vertex in 0..3 {
                for axis in 0..3 {
                    eight.vertices[vertex][axis][from..from + 4]
                        .copy_from_slice(&four.vertices[vertex][axis]);
                }
            }
            eight.numbers[from..from + 4].copy_from_slice(&four.numbers);
        }
        eight
    }
}

impl SphereBlock {
    const EMPTY: SphereBlock = SphereBlock {
        center: [[f32::NAN; 8]; 3],
        radius: [f32::NAN; 8],
        numbers: [Number::NONE; 8],
    };

    fn set(&mut self, lane: usize, sphere: Sphere, number: Number) {
        let rows = self.center.iter_mut();
        rows.zip(sphere.center.to_array())
            .for_each(|(row, x)| row[lane] = x);
        self.radius[lane] = sphere.radius;
        self.numbers[lane] = number;
    }

    pub(super) fn sphere(&self, lane: usize) -> Sphere {
        Sphere {
            center: glam::Vec3::from_array(self.center.map(|row| row[lane])),
            radius: self.radius[lane],
        }
    }
}

/// Nodes, and the blocks of their leaves. A leaf's reference is to its first block and says how many follow it, see
/// [`blocks`].
#[derive(Clone, Debug, Default)]
pub(super) struct Tree {
    pub(super) nodes: Pages<Node>,
    /// In blocks of eight, or of four.
    pub(super) triangles: Pages<TriangleBlock>,
    fours: Pages<Triangles<4>>,
    pub(super) spheres: Pages<SphereBlock>,
    pub(super) instances: Vec<SharedInstance>,
    /// The greatest absolute coordinate of anything in it.
    pub(super) extent: f32,
    pub(super) leaves: usize,
    pub(super) depth: usize,
    pub(super) sah_cost: f32,
}

/// Counts a leaf of so many primitives.
pub(super) fn add_leaf(sizes: &mut Vec<u64>, size: u32) {
    let Some(index) = (size as usize).checked_sub(1) else {
        return;
    };
    if sizes.len() <= index {
        sizes.resize(index + 1, 0);
    }
    sizes[index] += 1;
}

/// The blocks that a leaf's reference stands for.
#[inline(always)]
pub(super) fn blocks(reference: Reference) -> std::ops::Range<usize> {
    let first = reference.index() >> 2;
    first..first + (reference.index() & 3) + 1
}

/// The blocks of a leaf of triangles, eight at a time.
#[expect(
    clippy::large_enum_variant,
    reason = "it lives on the stack, for one leaf"
)]
pub(super) enum LeafBlocks<'a> {
    Eights(std::slice::Iter<'a, TriangleBlock>),
    Fours(std::slice::Chunks<'a, Triangles<4>>, TriangleBlock),
}

impl LeafBlocks<'_> {
    /// The next block, as long as there is one.
    #[inline(always)]
    pub(super) fn next(&mut self) -> Option<&TriangleBlock> {
        match self {
            LeafBlocks::Eights(blocks) => blocks.next(),
            LeafBlocks::Fours(blocks, eight) => {
                *eight = TriangleBlock::of_fours(blocks.next()?);
                Some(eight)
            }
        }
    }
}

impl Tree {
    /// The tree over all items.
    pub(super) fn of(items: &impl Items, options: &Options) -> Tree {
        let topology = build::build(items.bounds(), |index| items.kind(index), options);
        Tree::new(topology, items.extent(), options.layout, |index| {
            items.item(index)
        })
    }

    /// Lays the items, in the order of the leaves, into blocks. `extent` is the greatest absolute coordinate.
    fn new(
        topology: Topology,
        extent: f32,
        layout: Layout,
        item: impl Fn(u32) -> Item + Sync,
    ) -> Tree {
        let Topology {
            mut nodes,
            leaves,
            order,
            depth,
            sah_cost,
        } = topology;
        let of_fours = layout == Layout::Small;
        let (mut triangles, mut spheres) =
            (Laying::new(if of_fours { 4 } else { 8 }), Laying::new(8));
        let mut instances = Vec::new();
        for child in nodes.iter_mut().flat_map(|node| &mut node.children) {
            let kind = child.kind();
            if kind == Kind::Node {
                continue;
            }
            let leaf = leaves[child.index()];
            let items = &order[leaf.first as usize..(leaf.first + leaf.count) as usize];
            let (first, others) = match kind {
                Kind::Triangles => triangles.add(items),
                Kind::Spheres => spheres.add(items),
                Kind::Node | Kind::Instances => {
                    let first = instances.len();
                    instances.extend(items.iter().filter_map(|&index| match item(index) {
                        Item::Instance(instance) => Some(instance),
                        _ => None,
                    }));
                    (first, 0)
                }
            };
            *child = Reference::new(kind, (first << 2 | others) as u32);
        }
        let (mut eights, mut fours) = (Pages::default(), Pages::default());
        if of_fours {
            fours = triangles.laid(Triangles::EMPTY, &item);
        } else {
            eights = triangles.laid(Triangles::EMPTY, &item);
        }
        Tree {
            nodes: Pages::of(&nodes),
            triangles: eights,
            fours,
            spheres: spheres.laid(SphereBlock::EMPTY, &item),
            instances,
            extent,
            leaves: leaves.len(),
            depth,
            sah_cost,
        }
    }

    /// The blocks of a leaf of triangles.
    #[inline(always)]
    pub(super) fn leaf(&self, reference: Reference) -> LeafBlocks<'_> {
        let blocks = blocks(reference);
        if self.fours.is_empty() {
            LeafBlocks::Eights(self.triangles[blocks].iter())
        } else {
            LeafBlocks::Fours(self.fours[blocks].chunks(2), TriangleBlock::EMPTY)
        }
    }

    /// Adds how many leaves hold one primitive or instance, two, and so on.
    pub(super) fn add_leaf_sizes(&self, sizes: &mut Vec<u64>) {
        let children = self.nodes.iter().flat_map(|node| node.children);
        for child in children.filter(|&child| child != Reference::NONE) {
            let size = match child.kind() {
                Kind::Node => continue,
                Kind::Triangles => {
                    let (mut leaf, mut size) = (self.leaf(child), 0);
                    while let Some(block) = leaf.next() {
                        size += Number::count(&block.numbers);
                    }
                    size
                }
                Kind::Spheres => {
                    let blocks = self.spheres[blocks(child)].iter();
                    blocks.map(|block| Number::count(&block.numbers)).sum()
                }
                Kind::Instances => 1,
            };
            add_leaf(sizes, size);
        }
    }

    /// The most entries that a walk down this tree leaves on its stack.
    pub(super) fn stack_size(&self) -> usize {
        7 * self.depth + 8
    }

    /// Of this tree alone.
    pub(super) fn statistics(&self) -> Statistics {
        Statistics {
            nodes: self.nodes.len(),
            leaves: self.leaves,
            depth: self.depth,
            bytes: self.bytes(),
            sah_cost: self.sah_cost,
            build_time: Duration::ZERO,
        }
    }

    /// Nodes and blocks, in bytes.
    fn bytes(&self) -> usize {
        size_of_val(&*self.nodes)
            + size_of_val(&*self.triangles)
            + size_of_val(&*self.fours)
            + size_of_val(&*self.spheres)
            + size_of_val(self.instances.as_slice())
    }
}
