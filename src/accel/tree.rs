//! A tree with its primitives laid into it.

use super::SharedInstance;
use super::wide::{Kind, Node, Reference, Topology};
use crate::geometry::{Sphere, Triangle};

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

    pub(super) fn get(self) -> u32 {
        self.0 & !TRANSPARENT
    }

    pub(super) fn is_opaque(self) -> bool {
        self.0 & TRANSPARENT == 0
    }
}

/// Up to eight triangles, vertex by vertex and axis by axis: 320 bytes.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(super) struct TriangleBlock {
    /// Not numbers in lanes without a triangle, so that no ray meets them.
    pub(super) vertices: [[[f32; 8]; 3]; 3],
    pub(super) numbers: [Number; 8],
}

/// Up to eight spheres.
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(super) struct SphereBlock {
    /// Not numbers in lanes without a sphere, so that no ray meets them.
    pub(super) center: [[f32; 8]; 3],
    pub(super) radius: [f32; 8],
    pub(super) numbers: [Number; 8],
}

impl TriangleBlock {
    const EMPTY: TriangleBlock = TriangleBlock {
        vertices: [[[f32::NAN; 8]; 3]; 3],
        numbers: [Number::NONE; 8],
    };

    pub(super) fn triangle(&self, lane: usize) -> Triangle {
        Triangle(
            self.vertices
                .map(|rows| glam::Vec3::from_array(rows.map(|row| row[lane]))),
        )
    }
}

impl SphereBlock {
    const EMPTY: SphereBlock = SphereBlock {
        center: [[f32::NAN; 8]; 3],
        radius: [f32::NAN; 8],
        numbers: [Number::NONE; 8],
    };

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
    pub(super) nodes: Vec<Node>,
    pub(super) triangles: Vec<TriangleBlock>,
    pub(super) spheres: Vec<SphereBlock>,
    pub(super) instances: Vec<SharedInstance>,
    /// The greatest absolute coordinate of anything in it.
    pub(super) extent: f32,
    pub(super) leaves: usize,
    pub(super) depth: usize,
    pub(super) sah_cost: f32,
}

/// The blocks that a leaf's reference stands for.
#[inline(always)]
pub(super) fn blocks(reference: Reference) -> std::ops::Range<usize> {
    let first = reference.index() >> 2;
    first..first + (reference.index() & 3) + 1
}

impl Tree {
    /// Lays the items, in the order of the leaves, into blocks. `extent` is the greatest absolute coordinate.
    pub(super) fn new(topology: Topology, extent: f32, item: impl Fn(u32) -> Item) -> Tree {
        let mut tree = Tree {
            extent,
            leaves: topology.leaves.len(),
            depth: topology.depth,
            sah_cost: topology.sah_cost,
            nodes: topology.nodes,
            ..Tree::default()
        };
        let mut nodes = std::mem::take(&mut tree.nodes);
        for child in nodes.iter_mut().flat_map(|node| &mut node.children) {
            let kind = child.kind();
            if kind == Kind::Node {
                continue;
            }
            let leaf = topology.leaves[child.index()];
            let items = &topology.order[leaf.first as usize..(leaf.first + leaf.count) as usize];
            let first = tree.blocks_of(kind);
            for items in items.chunks(8) {
                tree.push(kind, items.iter().map(|&index| item(index)));
            }
            let others = tree.blocks_of(kind) - first - 1;
            *child = Reference::new(kind, (first << 2 | others) as u32);
        }
        tree.nodes = nodes;
        tree
    }

    fn blocks_of(&self, kind: Kind) -> usize {
        match kind {
            Kind::Node => self.nodes.len(),
            Kind::Triangles => self.triangles.len(),
            Kind::Spheres => self.spheres.len(),
            Kind::Instances => self.instances.len(),
        }
    }

    fn push(&mut self, kind: Kind, items: impl Iterator<Item = Item>) {
        let (mut triangles, mut spheres) = (TriangleBlock::EMPTY, SphereBlock::EMPTY);
        for (lane, item) in items.enumerate() {
            match item {
                Item::Triangle(Triangle(corners), number) => {
                    for (rows, corner) in triangles.vertices.iter_mut().zip(corners) {
                        rows.iter_mut()
                            .zip(corner.to_array())
                            .for_each(|(row, x)| row[lane] = x);
                    }
                    triangles.numbers[lane] = number;
                }
                Item::Sphere(sphere, number) => {
                    let rows = spheres.center.iter_mut();
                    rows.zip(sphere.center.to_array())
                        .for_each(|(row, x)| row[lane] = x);
                    spheres.radius[lane] = sphere.radius;
                    spheres.numbers[lane] = number;
                }
                Item::Instance(instance) => self.instances.push(instance),
            }
        }
        match kind {
            Kind::Triangles => self.triangles.push(triangles),
            Kind::Spheres => self.spheres.push(spheres),
            Kind::Node | Kind::Instances => {}
        }
    }

    /// Whether nothing is in it.
    pub(super) fn is_empty(&self) -> bool {
        self.nodes.is_empty()
    }

    /// The most entries that a walk down this tree leaves on its stack.
    pub(super) fn stack_size(&self) -> usize {
        7 * self.depth + 8
    }

    /// Nodes and blocks, in bytes.
    pub(super) fn bytes(&self) -> usize {
        size_of_val(self.nodes.as_slice())
            + size_of_val(self.triangles.as_slice())
            + size_of_val(self.spheres.as_slice())
            + size_of_val(self.instances.as_slice())
    }
}
