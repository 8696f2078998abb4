//! What can be chosen about search; no answer depends on it.

use super::Isa;
use std::num::NonZeroU8;

/// How a tree is built.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Options {
    /// How much time the build takes for how good a tree.
    pub preset: Preset,
    /// The most primitives a leaf may have, at most 16; 8 where it is `None`.
    pub leaf_size: Option<NonZeroU8>,
    /// Who builds it.
    pub builder: Builder,
    /// How leaves lie in memory.
    pub layout: Layout,
    /// The kernels that search.
    pub isa: Isa,
    /// Whether rays of a batch that go the same way are searched for together.
    pub packets: bool,
}

impl Default for Options {
    fn default() -> Options {
        Options {
            preset: Preset::default(),
            leaf_size: None,
            builder: Builder::default(),
            layout: Layout::default(),
            isa: Isa::detect(),
            packets: true,
        }
    }
}

/// How much time the build takes for how good a tree.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Preset {
    /// Stretches of a curve, at once: where the build counts and rays do not.
    Fastest,
    /// Between its neighbours.
    VeryFast,
    /// Between its neighbours.
    Fast,
    /// The best total for one picture.
    #[default]
    Medium,
    /// Between its neighbours.
    Slow,
    /// For many pictures of one scene.
    VerySlow,
}

/// Who builds the tree.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Builder {
    /// By preset: stretches of a curve, a tree of joined neighbours, one split from the top, or the better of both.
    #[default]
    Own,
    /// The neighbours that obvhs joins, to compare.
    Obvhs,
}

/// How leaves lie in memory.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Layout {
    /// Triangles in blocks of eight, each tested at once.
    #[default]
    Wide,
    /// Triangles in blocks of four: less room that is not used, and a little slower.
    Small,
    /// obvhs's binary tree, walked as obvhs walks it but with boxes that lose no hit, to compare: one ray and one
    /// primitive at a time. Nodes of 48 bytes.
    Bvh2,
    /// obvhs's compressed tree with eight children a node, and its traversal, to compare: one ray and one primitive at
    /// a time. Nodes of 80 bytes.
    ///
    /// By itself obvhs misses hits nearer than 1e-4, hits of rays with a `-0.0`, and hits where its stack of 32 is not
    /// enough; here all hits are found. What stays: a leaf has at most 3 primitives; boxes are grown by half a
    /// ten-thousandth of the scene's extent, so that rounding loses nothing; rays from farther than 8 extents away, and
    /// all rays through scenes of an extent outside 1e-12..1e16, have boxes tested one at a time; a tree that is deeper
    /// than 500 before it is compressed stays [`Layout::Bvh2`].
    CwBvh,
    /// No tree: every primitive in turn, to compare.
    List,
}
