//! A binary tree with one item a leaf: its root first, the two children of a node side by side.

use glam::{Vec3A, Vec4};

/// A leaf with one item, or an inner node: 32 bytes.
#[derive(Clone, Copy)]
pub(in crate::accel) struct Node {
    /// The least corner, and the bits of the item or of the first child's index.
    low: Vec4,
    /// The greatest corner, and 1 for a leaf or 0.
    high: Vec4,
}

impl Node {
    pub(super) fn leaf(min: Vec3A, max: Vec3A, item: u32) -> Node {
        Node {
            low: min.extend(f32::from_bits(item)),
            high: max.extend(1.0),
        }
    }

    /// The parent of the node with the index `first_child` and the next one.
    pub(super) fn inner(min: Vec3A, max: Vec3A, first_child: u32) -> Node {
        Node {
            low: min.extend(f32::from_bits(first_child)),
            high: max.extend(0.0),
        }
    }

    pub(super) fn min(&self) -> Vec3A {
        Vec3A::from_vec4(self.low)
    }

    pub(super) fn max(&self) -> Vec3A {
        Vec3A::from_vec4(self.high)
    }

    pub(in crate::accel) fn is_leaf(&self) -> bool {
        self.high.w != 0.0
    }

    /// The item of a leaf.
    pub(in crate::accel) fn item(&self) -> Option<u32> {
        self.is_leaf().then_some(self.low.w.to_bits())
    }

    /// The left child of an inner node; the right one is the next.
    pub(in crate::accel) fn first_child(&self) -> u32 {
        self.low.w.to_bits()
    }

    pub(super) fn half_area(&self) -> f32 {
        half_area(self.min(), self.max())
    }

    /// Half the area of the box around both.
    pub(super) fn joint_area(&self, other: &Node) -> f32 {
        half_area(self.min().min(other.min()), self.max().max(other.max()))
    }

    /// The parent of both, when they lie at `first_child` and after it.
    pub(super) fn joined(&self, other: &Node, first_child: u32) -> Node {
        Node::inner(
            self.min().min(other.min()),
            self.max().max(other.max()),
            first_child,
        )
    }
}

/// Half the area of a box.
pub(super) fn half_area(min: Vec3A, max: Vec3A) -> f32 {
    let d = max - min;
    (d.x + d.y) * d.z + d.x * d.y
}
