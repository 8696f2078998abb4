//! From a polygon to triangles; crate `earcut` is named here alone.

use earcut::Earcut;
use glam::DVec3;

/// Polygons up to this size are always clipped where they are concave, and fans where they are not.
const FREE_CORNERS: usize = 64;

/// So many greater ones are clipped, by the sum of their corners' squares: ear clipping can take time that grows with it
/// (a zigzag of 100,001 corners took 28 s in earcut 0.4.12, a harmless comb as great 0.06 s). The others are cut as if they were convex.
const MOST_WORK: u64 = 1 << 32;

/// Cuts polygons; keeps its memory from one to the next.
pub(super) struct Triangulator {
    earcut: Earcut<f64>,
    flat: Vec<[f64; 2]>,
    indices: Vec<u32>,
    triangles: Vec<[u32; 3]>,
    work_left: u64,
    uncut: usize,
}

impl Triangulator {
    pub(super) fn new() -> Triangulator {
        Triangulator {
            earcut: Earcut::new(),
            flat: Vec::new(),
            indices: Vec::new(),
            triangles: Vec::new(),
            work_left: MOST_WORK,
            uncut: 0,
        }
    }

    /// How many polygons were too great to be cut rightly.
    pub(super) fn uncut(&self) -> usize {
        self.uncut
    }

    /// Triangles of indices into `corners`, three or more of them, that turn as the polygon does.
    pub(super) fn cut(&mut self, corners: &[DVec3]) -> &[[u32; 3]] {
        self.triangles.clear();
        let normal = newell_normal(corners);
        let faces_front = |&[a, b, c]: &[u32; 3]| {
            let [a, b, c] = [a, b, c].map(|i| corners.get(i as usize).copied().unwrap_or_default());
            (b - a).cross(c - a).dot(normal) > 0.0
        };
        let last = (corners.len() as u32).saturating_sub(1);
        let fan = (1..last).map(|i| [0, i, i + 1]);
        let is_plain = fan.clone().all(|triangle| faces_front(&triangle));
        let other_diagonal = [[1, 2, 3], [1, 3, 0]];
        let is_small = corners.len() <= FREE_CORNERS;
        if (is_plain || normal == DVec3::ZERO) && is_small {
            self.triangles.extend(fan);
        } else if is_plain || normal == DVec3::ZERO {
            self.halve(corners.len() as u32);
        } else if corners.len() == 4 && other_diagonal.iter().all(faces_front) {
            self.triangles.extend(other_diagonal);
        } else if !self.takes_on(corners.len()) {
            self.uncut += 1;
            self.halve(corners.len() as u32);
        } else {
            self.clip(corners, normal);
            if self.triangles.is_empty() || self.has_lost_a_side(corners, normal) {
                self.triangles.clear();
                self.triangles.extend(fan);
            }
        }
        &self.triangles
    }

    /// Whether corners of a polygon that is not flat fell on one line, and with them a triangle that stands upright. All
    /// triangles of a cut have the area vector of the polygon together; what is missing in its own direction overlaps.
    fn has_lost_a_side(&self, corners: &[DVec3], normal: DVec3) -> bool {
        const SMALL_SHARE: f64 = 1e-3;
        let at = |i: u32| corners.get(i as usize).copied().unwrap_or_default();
        let sum = self.triangles.iter().fold(DVec3::ZERO, |sum, &[a, b, c]| {
            sum + (at(b) - at(a)).cross(at(c) - at(a))
        });
        let along = normal.normalize_or_zero();
        let upright = (normal - sum).reject_from_normalized(along);
        upright.length() > SMALL_SHARE * normal.length()
    }

    fn takes_on(&mut self, corners: usize) -> bool {
        let work = (corners as u64).saturating_pow(2);
        let left = self.work_left.checked_sub(work);
        if corners > FREE_CORNERS {
            self.work_left = left.unwrap_or(self.work_left);
        }
        corners <= FREE_CORNERS || left.is_some()
    }

    /// Cuts off every second corner until two are left. In the fan of a great polygon every triangle is as long as the
    /// polygon and meets all others in one corner: a tree over that of 100,000 corners took 72 s to build (obvhs 0.4.0,
    /// its medium preset), over these triangles 0.1 s.
    fn halve(&mut self, corners: u32) {
        let mut ring: Vec<u32> = (0..corners).collect();
        while ring.len() > 2 {
            let next = ring.iter().skip(2).step_by(2).chain(ring.first());
            let pairs = ring.as_chunks().0.iter().zip(next);
            self.triangles.extend(pairs.map(|(&[a, b], &c)| [a, b, c]));
            ring = ring.into_iter().step_by(2).collect();
        }
    }

    fn clip(&mut self, corners: &[DVec3], normal: DVec3) {
        // Onto the plane that it lies in most nearly. Dropping an axis instead can put the corners of one that is not flat
        // on one line, and lose them.
        let Some((across, up)) = normal.try_normalize().map(|n| n.any_orthonormal_pair()) else {
            return;
        };
        let first = corners.first().copied().unwrap_or_default();
        let flatten = |&p: &DVec3| [(p - first).dot(across), (p - first).dot(up)];
        self.flat.clear();
        self.flat.extend(corners.iter().map(flatten));
        self.earcut.earcut_slice(&self.flat, &[], &mut self.indices);
        for &[a, b, c] in self.indices.as_chunks::<3>().0 {
            let [p, q, r] =
                [a, b, c].map(|i| self.flat.get(i as usize).copied().unwrap_or_default());
            let area = (q[0] - p[0]) * (r[1] - p[1]) - (q[1] - p[1]) * (r[0] - p[0]);
            let turned = area < 0.0;
            self.triangles
                .push(if turned { [a, c, b] } else { [a, b, c] });
        }
    }
}

/// Twice the area vector of a polygon, planar or not; zero where it has no area (Newell's method: Sutherland, Sproull
/// and Schumacker 1974, "A Characterization of Ten Hidden-Surface Algorithms").
pub(super) fn newell_normal(corners: &[DVec3]) -> DVec3 {
    // From the first corner, so that a polygon far from the origin loses no digits.
    let first = corners.first().copied().unwrap_or_default();
    corners
        .iter()
        .zip(corners.iter().skip(1))
        .fold(DVec3::ZERO, |sum, (&a, &b)| {
            sum + (a - first).cross(b - first)
        })
}

#[cfg(test)]
mod tests {
    use super::*;

    fn area_vector(corners: &[DVec3], triangles: &[[u32; 3]]) -> DVec3 {
        triangles.iter().fold(DVec3::ZERO, |sum, triangle| {
            let [a, b, c] = triangle.map(|i| corners[i as usize]);
            sum + (b - a).cross(c - a)
        })
    }

    fn area(corners: &[DVec3], triangles: &[[u32; 3]]) -> f64 {
        let one = |triangle: &[u32; 3]| area_vector(corners, &[*triangle]).length() / 2.0;
        triangles.iter().map(one).sum()
    }

    fn flat(corners: &[[f64; 2]]) -> Vec<DVec3> {
        corners
            .iter()
            .map(|&[x, y]| DVec3::new(x, y, 0.0))
            .collect()
    }

    #[test]
    fn a_concave_polygon_is_covered_once_from_every_side() {
        // An L of three unit squares.
        let shape = [[0., 0.], [2., 0.], [2., 1.], [1., 1.], [1., 2.], [0., 2.]];
        let turns = [
            |p: DVec3| p,
            |p: DVec3| DVec3::new(p.z, p.x, p.y),
            |p: DVec3| DVec3::new(p.y, p.z, p.x),
            |p: DVec3| DVec3::new(p.y, p.x, p.z),
            |p: DVec3| DVec3::new(p.x, p.y, p.x - p.y + 3.0),
        ];
        for (turn, stretch) in turns.into_iter().zip([1., 1., 1., 1., 3f64.sqrt()]) {
            for rotation in 0..shape.len() {
                let mut corners: Vec<DVec3> = flat(&shape).into_iter().map(turn).collect();
                corners.rotate_left(rotation);
                let mut triangulator = Triangulator::new();
                let triangles = triangulator.cut(&corners).to_vec();
                assert_eq!(triangles.len(), 4);
                assert!((area(&corners, &triangles) - 3.0 * stretch).abs() < 1e-12);
                let same_side = area_vector(&corners, &triangles).dot(newell_normal(&corners));
                assert!((same_side - 36.0 * stretch * stretch).abs() < 1e-9);
            }
        }
    }

    #[test]
    fn a_polygon_that_is_not_flat_keeps_every_corner() {
        // A square and a gable on its edge, which lies on one line with it as the whole is seen.
        let roof = [
            [-1., 0., 1.],
            [1., 0., 1.],
            [1., 0., -1.],
            [-1., 0., -1.],
            [0., 1., -1.],
        ];
        let corners = roof.map(DVec3::from_array);
        let mut triangulator = Triangulator::new();
        let triangles = triangulator.cut(&corners);
        assert_eq!(triangles.len(), 3);
        assert!(triangles.iter().any(|corners| corners.contains(&4)));
    }

    #[test]
    fn a_polygon_around_a_hole_leaves_the_hole() {
        // Blender and others write a square with a square hole as one outline that runs in and out by the same way.
        let outer = [[0., 0.], [4., 0.], [4., 4.], [0., 4.]];
        let inner = [[1., 1.], [1., 3.], [3., 3.], [3., 1.]];
        let mut outline = outer.to_vec();
        outline.push(outer[0]);
        outline.extend(inner);
        outline.push(inner[0]);
        let corners = flat(&outline);
        let mut triangulator = Triangulator::new();
        let triangles = triangulator.cut(&corners).to_vec();
        assert!((area(&corners, &triangles) - 12.0).abs() < 1e-12);
        assert!((area_vector(&corners, &triangles).z - 24.0).abs() < 1e-12);
    }

    #[test]
    fn an_arrowhead_is_cut_at_its_notch() {
        let arrow = flat(&[[0., 0.], [2., 1.], [0., 2.], [1., 1.]]);
        for rotation in 0..4 {
            let mut corners = arrow.clone();
            corners.rotate_left(rotation);
            let mut triangulator = Triangulator::new();
            let triangles = triangulator.cut(&corners);
            assert_eq!(triangles.len(), 2);
            assert!((area(&corners, triangles) - 1.0).abs() < 1e-12);
        }
    }

    #[test]
    fn a_convex_polygon_is_a_fan() {
        let corners = flat(&[[0., 0.], [2., 0.], [3., 1.], [2., 2.], [0., 2.]]);
        let fan = [[0, 1, 2], [0, 2, 3], [0, 3, 4]];
        assert_eq!(Triangulator::new().cut(&corners), fan);
    }

    #[test]
    fn no_corner_of_a_great_convex_polygon_has_many_triangles() {
        for count in 65..80 {
            let corner = |i: usize| {
                let angle = i as f64 / count as f64 * std::f64::consts::TAU;
                DVec3::new(libm::cos(angle), libm::sin(angle), 0.0)
            };
            let corners: Vec<DVec3> = (0..count).map(corner).collect();
            let mut triangulator = Triangulator::new();
            let triangles = triangulator.cut(&corners);
            assert_eq!(triangles.len(), count - 2);
            let expected = newell_normal(&corners).length() / 2.0;
            assert!((area(&corners, triangles) - expected).abs() < 1e-12);
            let at_first = triangles.iter().filter(|corners| corners.contains(&0));
            assert!(at_first.count() <= 14);
        }
    }

    #[test]
    fn a_polygon_without_area_still_has_triangles() {
        let line = flat(&[[0., 0.], [1., 0.], [2., 0.], [3., 0.]]);
        assert_eq!(Triangulator::new().cut(&line).len(), 2);
        assert_eq!(Triangulator::new().cut(&[DVec3::ONE; 5]).len(), 3);
    }

    #[test]
    fn a_polygon_too_great_to_clip_is_cut_somehow_and_told() {
        let mut triangulator = Triangulator::new();
        triangulator.work_left = 100 * 100;
        let teeth = (0..100).map(|i| [f64::from(i), f64::from(i % 2) + 1.0]);
        let corners = flat(&teeth.chain([[99.0, 0.0], [0.0, 0.0]]).collect::<Vec<_>>());
        assert_eq!(triangulator.cut(&corners).len(), 100);
        assert_eq!(triangulator.uncut(), 1);
        let arrow = flat(&[[0., 0.], [2., 1.], [0., 2.], [1., 1.], [0.9, 0.9]]);
        assert!((area(&arrow, triangulator.cut(&arrow)) - 1.0).abs() < 0.2);
        assert_eq!(triangulator.uncut(), 1);
    }

    #[test]
    fn a_comb_of_thousands_of_teeth_is_cut_in_time() {
        let teeth = 20_000;
        let tops = (0..teeth).map(|i| [f64::from(i), f64::from(i % 2) * 10.0 + 1.0]);
        let ends = [[f64::from(teeth - 1), 0.0], [0.0, 0.0]];
        let corners = flat(&tops.chain(ends).collect::<Vec<_>>());
        let mut triangulator = Triangulator::new();
        let triangles = triangulator.cut(&corners);
        let expected = newell_normal(&corners).length() / 2.0;
        assert!((area(&corners, triangles) - expected).abs() < 1e-6 * expected);
    }
}
