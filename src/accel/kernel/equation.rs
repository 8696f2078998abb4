//! The two tests, over any number of lanes: a ray against boxes, and against triangles.
//!
//! The same operations in the same order as [`crate::accel::slab`] and [`crate::geometry::Triangle::intersect`], which
//! say what they compute and why. What is spread over the lanes, boxes or rays, is the caller's affair.

use super::float::Float;

/// From where to where each lane's ray is inside each lane's box, given how far the near and far corners lie from the
/// (padded) origin along each axis.
#[inline(always)]
pub(super) fn interval<F: Float<N>, const N: usize>(
    near: [F; 3],
    far: [F; 3],
    inverse: [F; 3],
) -> (F, F) {
    let enter = [
        near[0] * inverse[0],
        near[1] * inverse[1],
        near[2] * inverse[2],
    ];
    let leave = [
        far[0] * inverse[0],
        far[1] * inverse[1],
        far[2] * inverse[2],
    ];
    (
        enter[0].max(enter[1]).max(enter[2]),
        leave[0].min(leave[1]).min(leave[2]),
    )
}

/// Of the two corners of a box the coordinates on the near side, or on the far one, given which corner is near on each axis.
#[inline(always)]
pub(super) fn pick<T: Copy>(corners: &[[T; 3]; 2], [x, y, z]: [usize; 3]) -> [T; 3] {
    [corners[x & 1][0], corners[y & 1][1], corners[z & 1][2]]
}

/// `a - b`, axis by axis.
#[inline(always)]
pub(super) fn minus<F: std::ops::Sub<Output = F> + Copy>(a: [F; 3], b: [F; 3]) -> [F; 3] {
    [a[0] - b[0], a[1] - b[1], a[2] - b[2]]
}

/// Each coordinate in all lanes.
#[inline(always)]
pub(super) fn spread<F: Float<N>, const N: usize>([x, y, z]: [f32; 3]) -> [F; 3] {
    [F::splat(x), F::splat(y), F::splat(z)]
}

/// The rows of three axes.
#[inline(always)]
pub(super) fn rows<F: Float<N>, const N: usize>([x, y, z]: &[[f32; N]; 3]) -> [F; 3] {
    [F::load(x), F::load(y), F::load(z)]
}

/// Lanes in which a line crosses a triangle, before it is known where.
#[derive(Clone, Copy)]
pub(super) struct Crossing<F> {
    pub(super) inside: u32,
    weights: [F; 3],
    sum: F,
    z: [F; 3],
}

/// Where the lanes of a [`Crossing`] are.
#[derive(Clone, Copy)]
pub(super) struct Place<F> {
    pub(super) t: F,
    pub(super) barycentric: [F; 2],
}

/// Vertices relative to the ray's origin, its longest axis last; `slope` as in [`crate::geometry::RaySpace`].
#[inline(always)]
pub(super) fn cross<F: Float<N>, const N: usize>(
    [a, b, c]: [[F; 3]; 3],
    slope: [F; 2],
) -> Crossing<F> {
    let (ax, ay) = (a[0] - slope[0] * a[2], a[1] - slope[1] * a[2]);
    let (bx, by) = (b[0] - slope[0] * b[2], b[1] - slope[1] * b[2]);
    let (cx, cy) = (c[0] - slope[0] * c[2], c[1] - slope[1] * c[2]);
    let weight_a = bx * cy - by * cx;
    let weight_b = cx * ay - cy * ax;
    let weight_c = ax * by - ay * bx;
    let sum = weight_a + weight_b + weight_c;
    let zero = F::splat(0.0);
    let least = weight_a.min(weight_b).min(weight_c);
    let greatest = weight_a.max(weight_b).max(weight_c);
    let inside = (zero.le(least) | greatest.le(zero)) & !sum.eq(zero);
    Crossing {
        inside,
        weights: [weight_a, weight_b, weight_c],
        sum,
        z: [a[2], b[2], c[2]],
    }
}

impl<F> Crossing<F> {
    /// `t` and the weights of the second and third vertex; `per_unit` as in [`crate::geometry::RaySpace`].
    #[inline(always)]
    pub(super) fn place<const N: usize>(&self, per_unit: F) -> Place<F>
    where
        F: Float<N>,
    {
        let one = F::splat(1.0);
        let reciprocal = one / self.sum;
        let (v, w) = (self.weights[1] * reciprocal, self.weights[2] * reciprocal);
        let [a, b, c] = self.z;
        let z = (one - v - w) * a + v * b + w * c;
        Place {
            t: z * per_unit,
            barycentric: [v, w],
        }
    }
}

/// The corners of a triangle's box.
#[inline(always)]
pub(super) fn box_of<F: Float<N>, const N: usize>([a, b, c]: [[F; 3]; 3]) -> [[F; 3]; 2] {
    let low = [
        a[0].min(b[0]).min(c[0]),
        a[1].min(b[1]).min(c[1]),
        a[2].min(b[2]).min(c[2]),
    ];
    let high = [
        a[0].max(b[0]).max(c[0]),
        a[1].max(b[1]).max(c[1]),
        a[2].max(b[2]).max(c[2]),
    ];
    [low, high]
}
