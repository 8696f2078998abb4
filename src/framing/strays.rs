//! Stray faces: few, small, and far from all the rest.

use super::{Face, bounds, diagonal};
use crate::geometry::Bounds;

/// What is astray is at least this many diagonals of the main part away from it.
const FAR: f64 = 2.0;
/// It has at most this share of the main part's area.
const SMALL: f64 = 0.01;
/// It has at most this share of the main part's faces, or `A_HANDFUL`.
const FEW: f64 = 0.05;
const A_HANDFUL: usize = 8;
/// Each axis is looked at in so many slices.
const SLICES: usize = 1024;
/// What is astray may hide how small the main part is, but hardly more often than this.
const ROUNDS: usize = 8;

/// Takes stray faces away; how many they were.
pub(super) fn remove(faces: &mut Vec<Face>) -> usize {
    let before = faces.len();
    for _ in 0..ROUNDS {
        let at_first = faces.len();
        for axis in 0..3 {
            remove_along(faces, axis);
        }
        if faces.len() == at_first {
            break;
        }
    }
    before - faces.len()
}

/// Neighbouring slices without a gap between.
#[derive(Clone, Copy)]
struct Run {
    low: f64,
    high: f64,
    area: f64,
    faces: usize,
}

impl Run {
    const EMPTY: Run = Run {
        low: f64::INFINITY,
        high: f64::NEG_INFINITY,
        area: 0.0,
        faces: 0,
    };

    fn and(self, other: Run) -> Run {
        Run {
            low: self.low.min(other.low),
            high: self.high.max(other.high),
            area: self.area + other.area,
            faces: self.faces + other.faces,
        }
    }

    fn is_far_from(&self, main: &Run, size: f64) -> bool {
        (main.low - self.high).max(self.low - main.high) > FAR * size
    }

    fn is_little_beside(&self, main: &Run) -> bool {
        let few = ((FEW * main.faces as f64) as usize).max(A_HANDFUL);
        self.area < SMALL * main.area && self.faces <= few.min(main.faces)
    }
}

fn remove_along(faces: &mut Vec<Face>, axis: usize) {
    let runs = runs(faces, axis);
    let larger = |a: Run, b: &Run| if b.area > a.area { *b } else { a };
    let main = runs.iter().fold(Run::EMPTY, larger);
    if runs.len() < 2 {
        return;
    }
    let is_in = |face: &Face, run: &Run| {
        let (low, high) = extent(face, axis);
        run.low <= low && high <= run.high
    };
    let of_main = faces.iter().filter(|face| is_in(face, &main));
    let size = diagonal(&Bounds::around(of_main.flat_map(|face| face.triangle.0)));
    let is_astray = |run: &&Run| run.is_far_from(&main, size) && run.is_little_beside(&main);
    let astray: Vec<Run> = runs.iter().filter(is_astray).copied().collect();
    if !astray.is_empty() {
        faces.retain(|face| astray.iter().all(|run| !is_in(face, run)));
    }
}

/// From where to where a face reaches.
fn extent(face: &Face, axis: usize) -> (f64, f64) {
    let [a, b, c] = face.points().map(|p| p[axis]);
    (a.min(b).min(c), a.max(b).max(c))
}

/// What lies along an axis, parted where nothing is.
fn runs(faces: &[Face], axis: usize) -> Vec<Run> {
    let around = bounds(faces);
    if around.is_empty() {
        return Vec::new();
    }
    let (low, high) = (f64::from(around.min[axis]), f64::from(around.max[axis]));
    let slices_per_length = SLICES as f64 / (high - low);
    if !slices_per_length.is_finite() {
        return Vec::new();
    }
    let slice = |x: f64| (((x - low) * slices_per_length) as usize).min(SLICES - 1);
    let mut starts = vec![Run::EMPTY; SLICES];
    // How many more faces reach over a slice's beginning than over the one's before.
    let mut reaching = vec![0i64; SLICES + 1];
    for face in faces {
        let (low, high) = extent(face, axis);
        let first = slice(low);
        let own = Run {
            low,
            high,
            area: face.area_normal().length(),
            faces: 1,
        };
        starts[first] = starts[first].and(own);
        reaching[first] += 1;
        reaching[slice(high) + 1] -= 1;
    }
    let mut runs: Vec<Run> = Vec::new();
    let (mut depth, mut is_within) = (0, false);
    for (start, more) in starts.into_iter().zip(reaching) {
        depth += more;
        match runs.last_mut() {
            Some(run) if depth > 0 && is_within => *run = run.and(start),
            _ if depth > 0 => runs.push(start),
            _ => {}
        }
        is_within = depth > 0;
    }
    runs
}
