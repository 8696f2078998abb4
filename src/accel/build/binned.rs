//! A binary tree from the top down: each node is cut where the surface-area heuristic is least, looking at bins of
//! centers along all three axes (Wald 2007, "On fast Construction of SAH-based Bounding Volume Hierarchies").

use super::binary::Node;
use glam::Vec3A;
use rayon::prelude::*;

/// Below this level items are halved, so that no input makes a deep tree or takes long.
const DEEP: u32 = 64;

/// Of more items than this the halves are left to other threads.
const SERIAL: usize = 4096;

/// More items than this are looked at by many threads, in pieces of as many.
const PIECE: usize = 1 << 17;

/// The nodes over `items`, the root first and siblings side by side.
pub(super) fn split(items: &mut [Node]) -> Vec<Node> {
    let Some(&first) = items.first() else {
        return Vec::new();
    };
    let mut nodes = vec![first; 2 * items.len() - 1];
    if let Some((root, below)) = nodes.split_first_mut() {
        let range = Range {
            node: root,
            below,
            first_below: 1,
            items,
            level: 0,
        };
        rayon::scope(|scope| range.split(scope));
    }
    nodes
}

/// Items of a subtree, and where it goes.
struct Range<'a> {
    node: &'a mut Node,
    /// Room for all nodes below `node`.
    below: &'a mut [Node],
    /// The index of the first of these.
    first_below: u32,
    items: &'a mut [Node],
    level: u32,
}

impl<'a> Range<'a> {
    /// Fills the subtree, with an own stack.
    fn split(self, scope: &rayon::Scope<'a>) {
        let mut open = vec![self];
        while let Some(range) = open.pop() {
            if let [item] = range.items {
                *range.node = *item;
                continue;
            }
            for half in range.halves() {
                if half.items.len() > SERIAL {
                    scope.spawn(|scope| half.split(scope));
                } else {
                    open.push(half);
                }
            }
        }
    }

    /// Makes the node and sorts its items into two ranges.
    fn halves(self) -> [Range<'a>; 2] {
        let extent = Extent::of(self.items);
        *self.node = Node::inner(extent.min, extent.max, self.first_below);
        let middle = middle(self.items, &extent, self.level);
        let (left_items, right_items) = self.items.split_at_mut(middle);
        let (pair, below) = self.below.split_at_mut(2);
        let (left_node, right_node) = pair.split_at_mut(1);
        let below_left = 2 * middle - 2;
        let (left_below, right_below) = below.split_at_mut(below_left);
        let level = self.level + 1;
        let first_below = self.first_below + 2;
        [
            Range {
                node: &mut right_node[0],
                below: right_below,
                first_below: first_below + below_left as u32,
                items: right_items,
                level,
            },
            Range {
                node: &mut left_node[0],
                below: left_below,
                first_below,
                items: left_items,
                level,
            },
        ]
    }
}

/// The box around items, and the one around their centers, the latter twice as large.
#[derive(Clone, Copy)]
struct Extent {
    min: Vec3A,
    max: Vec3A,
    least: Vec3A,
    most: Vec3A,
}

impl Extent {
    const EMPTY: Extent = Extent {
        min: Vec3A::INFINITY,
        max: Vec3A::NEG_INFINITY,
        least: Vec3A::INFINITY,
        most: Vec3A::NEG_INFINITY,
    };

    fn of(items: &[Node]) -> Extent {
        if items.len() > PIECE {
            let pieces = items.par_chunks(PIECE).map(Extent::of);
            return pieces.reduce(|| Extent::EMPTY, Extent::union);
        }
        items.iter().fold(Extent::EMPTY, |extent, item| {
            let (min, max) = (item.min(), item.max());
            let center = min + max;
            extent.union(Extent {
                min,
                max,
                least: center,
                most: center,
            })
        })
    }

    fn union(self, other: Extent) -> Extent {
        Extent {
            min: self.min.min(other.min),
            max: self.max.max(other.max),
            least: self.least.min(other.least),
            most: self.most.max(other.most),
        }
    }
}

/// Moves the items of the left child to the front; returns how many they are, at least one and not all.
fn middle(items: &mut [Node], extent: &Extent, level: u32) -> usize {
    // Whole leaves of eight on the left.
    let half = match items.len() / 2 {
        few @ 0..8 => few,
        many => many & !7,
    };
    let size = extent.most - extent.least;
    if items.len() == 2 || size.max_element() <= 0.0 {
        return half;
    }
    if level >= DEEP {
        let axis = (0..3).fold(0, |a, b| if size[b] > size[a] { b } else { a });
        let center = |item: &Node| item.min()[axis] + item.max()[axis];
        items.select_nth_unstable_by(half, |a, b| center(a).total_cmp(&center(b)));
        return half;
    }
    // Few items need few bins, and most nodes have few items.
    let middle = match items.len() {
        ..8 => cut::<8>(items, extent),
        8..64 => cut::<16>(items, extent),
        _ => cut::<32>(items, extent),
    };
    // Never so: the first and the last bin have an item each. But never is a long time.
    if middle == 0 || middle == items.len() {
        half
    } else {
        middle
    }
}

/// Moves the items left of the best cut between `N` bins to the front; returns how many they are.
fn cut<const N: usize>(items: &mut [Node], extent: &Extent) -> usize {
    let grid = Grid::<N>::new(extent);
    let (axis, bin) = Bins::of(items, &grid).best_cut();
    partition(items, |item| grid.bins(item)[axis] < bin as u32)
}

/// Which bins a box falls into.
struct Grid<const N: usize> {
    origin: Vec3A,
    scale: Vec3A,
}

impl<const N: usize> Grid<N> {
    fn new(extent: &Extent) -> Grid<N> {
        let size = extent.most - extent.least;
        let scale = size.to_array().map(|size| {
            if size > 0.0 {
                // Finite, or the first center's bin would be no number.
                (N as f32 / size).min(f32::MAX)
            } else {
                0.0
            }
        });
        Grid {
            origin: extent.least,
            scale: scale.into(),
        }
    }

    fn bins(&self, item: &Node) -> [u32; 3] {
        // From here on up the numbers of 32 bits are whole: their last bits are the number.
        const WHOLE: f32 = (1 << 23) as f32;
        let along = (item.min() + item.max() - self.origin) * self.scale - 0.5;
        let bin = along.max(Vec3A::ZERO).min(Vec3A::splat((N - 1) as f32)) + WHOLE;
        bin.to_array().map(|bin| bin.to_bits() & (N as u32 - 1))
    }
}

/// What fell into each bin of each axis.
struct Bins<const N: usize>([[Bin; N]; 3]);

#[derive(Clone, Copy)]
struct Bin {
    min: Vec3A,
    max: Vec3A,
    items: u32,
}

impl Bin {
    const EMPTY: Bin = Bin {
        min: Vec3A::INFINITY,
        max: Vec3A::NEG_INFINITY,
        items: 0,
    };

    fn union(&self, other: &Bin) -> Bin {
        Bin {
            min: self.min.min(other.min),
            max: self.max.max(other.max),
            items: self.items + other.items,
        }
    }

    /// Half area times items.
    fn cost(&self) -> f32 {
        let d = self.max - self.min;
        ((d.x + d.y) * d.z + d.x * d.y) * self.items as f32
    }
}

impl<const N: usize> Bins<N> {
    fn of(items: &[Node], grid: &Grid<N>) -> Bins<N> {
        if items.len() > PIECE {
            let pieces = items.par_chunks(PIECE).map(|piece| Bins::of(piece, grid));
            return pieces.reduce(|| Bins([[Bin::EMPTY; N]; 3]), Bins::union);
        }
        let mut bins = Bins([[Bin::EMPTY; N]; 3]);
        for item in items {
            let (min, max) = (item.min(), item.max());
            for (axis, bin) in grid.bins(item).into_iter().enumerate() {
                let bin = &mut bins.0[axis][bin as usize];
                bin.min = bin.min.min(min);
                bin.max = bin.max.max(max);
                bin.items += 1;
            }
        }
        bins
    }

    fn union(mut self, other: Bins<N>) -> Bins<N> {
        for (ours, theirs) in self
            .0
            .as_flattened_mut()
            .iter_mut()
            .zip(other.0.as_flattened())
        {
            *ours = ours.union(theirs);
        }
        self
    }

    /// The axis and the first bin of the right child that cost least.
    fn best_cut(&self) -> (usize, usize) {
        let (mut best, mut cut) = (f32::INFINITY, (0, 1));
        for (axis, bins) in self.0.iter().enumerate() {
            let mut costs = [0.0; N];
            let mut right = Bin::EMPTY;
            for bin in (1..N).rev() {
                right = right.union(&bins[bin]);
                costs[bin] = if right.items > 0 {
                    right.cost()
                } else {
                    f32::INFINITY
                };
            }
            let mut left = Bin::EMPTY;
            for bin in 1..N {
                left = left.union(&bins[bin - 1]);
                if left.items == 0 {
                    continue;
                }
                let cost = left.cost() + costs[bin];
                if cost < best {
                    (best, cut) = (cost, (axis, bin));
                }
            }
        }
        cut
    }
}

/// Moves the items that are `left` to the front; returns how many they are.
fn partition(items: &mut [Node], left: impl Fn(&Node) -> bool) -> usize {
    let (mut front, mut back) = (0, items.len());
    loop {
        while front < back && left(&items[front]) {
            front += 1;
        }
        while front < back && !left(&items[back - 1]) {
            back -= 1;
        }
        if front >= back {
            return front;
        }
        items.swap(front, back - 1);
        front += 1;
        back -= 1;
    }
}
