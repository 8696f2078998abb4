//! The tree that rays walk: nodes of eight children, leaves of a few primitives of one kind.

use crate::geometry::Bounds;

/// The boxes of eight children and what they are. A node with fewer has [`Reference::NONE`] and empty boxes last.
///
/// 256 bytes: four lines of cache. (Wald, Benthin and Boulos 2008, "Getting Rid of Packets".)
#[derive(Clone, Copy, Debug)]
#[repr(C, align(64))]
pub(super) struct Node {
    /// The least coordinates, then the greatest: of each axis, those of the eight children.
    pub(super) corners: [[[f32; 8]; 3]; 2],
    pub(super) children: [Reference; 8],
}

/// What a child is, and where: two bits for the kind, 30 for the index.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Reference(u32);

/// What a reference leads to. A leaf has primitives of one kind.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Kind {
    Node,
    Triangles,
    Spheres,
    Instances,
}

/// A leaf: a range of [`Topology::order`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) struct Leaf {
    pub(super) first: u32,
    pub(super) count: u32,
}

/// A finished tree over some boxes, before the primitives are laid into it. Empty where there are no boxes.
#[derive(Clone, Debug, Default)]
pub(super) struct Topology {
    /// The root first, every child after its parent. References to leaves are indices into `leaves`.
    pub(super) nodes: Vec<Node>,
    /// In the order in which a walk meets them.
    pub(super) leaves: Vec<Leaf>,
    /// Every item once, in the order of the leaves.
    pub(super) order: Vec<u32>,
    /// The most nodes on a way from the root to a leaf.
    pub(super) depth: usize,
    /// The surface-area cost, see [`super::Statistics::sah_cost`].
    pub(super) sah_cost: f32,
}

impl Reference {
    /// The first node.
    pub(super) const ROOT: Reference = Reference(0);
    /// No child. Its box is empty, so that no ray ever follows it.
    pub(super) const NONE: Reference = Reference(0);

    /// A reference to the thing with this index, below 2^30.
    pub(super) fn new(kind: Kind, index: u32) -> Reference {
        Reference((kind as u32) << 30 | index)
    }

    pub(super) fn kind(self) -> Kind {
        match self.0 >> 30 {
            0 => Kind::Node,
            1 => Kind::Triangles,
            2 => Kind::Spheres,
            _ => Kind::Instances,
        }
    }

    pub(super) fn index(self) -> usize {
        (self.0 & 0x3fff_ffff) as usize
    }
}

impl Node {
    /// A node without children.
    pub(super) const EMPTY: Node = Node {
        corners: [[[f32::INFINITY; 8]; 3], [[f32::NEG_INFINITY; 8]; 3]],
        children: [Reference::NONE; 8],
    };

    /// Makes `reference`, with these bounds, the child in `slot`, below 8.
    pub(super) fn set(&mut self, slot: usize, bounds: &Bounds, reference: Reference) {
        for axis in 0..3 {
            self.corners[0][axis][slot] = bounds.min[axis];
            self.corners[1][axis][slot] = bounds.max[axis];
        }
        self.children[slot] = reference;
    }
}
