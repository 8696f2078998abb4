//! Which of several costly things is worth its price.

use std::cmp::Ordering;

/// The positions of the points than which no other is better: at most as large in both numbers and smaller in one
/// (the Pareto front of two costs), from the smallest first number to the largest. A point that
/// is not a number is on no front.
pub fn front(points: &[(f64, f64)]) -> Vec<usize> {
    let numbered = points.iter().enumerate();
    let mut order: Vec<(usize, (f64, f64))> = numbered
        .map(|(position, &point)| (position, point))
        .filter(|(_, (x, y))| !x.is_nan() && !y.is_nan())
        .collect();
    // Stable: of equal points, the one that is given first comes first.
    order.sort_by(|(_, a), (_, b)| a.partial_cmp(b).unwrap_or(Ordering::Equal));
    let mut front: Vec<usize> = Vec::new();
    let mut last: Option<(f64, f64)> = None;
    for (position, point) in order {
        if last.is_none_or(|last| point.1 < last.1 || point == last) {
            front.push(position);
            last = Some(point);
        }
    }
    front
}

/// The number of frames after which a slower build with quicker frames has taken as long as a quicker build, all in one
/// unit of time: 0 where it is behind in neither.
///
/// `None` where it never catches up, and where a time is not finite.
pub fn break_even(
    slow_build: f64,
    slow_frame: f64,
    quick_build: f64,
    quick_frame: f64,
) -> Option<f64> {
    let extra = slow_build - quick_build;
    let saved = quick_frame - slow_frame;
    if !extra.is_finite() || !saved.is_finite() || saved < 0.0 {
        return None;
    }
    if extra <= 0.0 {
        return Some(0.0);
    }
    let frames = extra / saved;
    frames.is_finite().then_some(frames)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_front_has_what_nothing_beats() {
        let points = [
            (3.0, 1.0),
            (1.0, 3.0),
            (2.0, 2.0),
            (2.0, 2.5), // as far as the one before, and dearer
            (4.0, 1.0), // farther, and no cheaper
            (2.5, 2.5),
        ];
        assert_eq!(front(&points), [1, 2, 0]);
    }

    #[test]
    fn of_equal_points_all_are_on_the_front() {
        assert_eq!(front(&[(1.0, 1.0), (2.0, 2.0), (1.0, 1.0)]), [0, 2]);
        assert_eq!(front(&[(0.0, 1.0), (-0.0, 1.0)]), [0, 1]);
    }

    #[test]
    fn what_is_not_a_number_is_on_no_front() {
        assert_eq!(front(&[(f64::NAN, 0.0), (1.0, 1.0), (0.0, f64::NAN)]), [1]);
        assert!(front(&[]).is_empty());
    }

    #[test]
    fn a_build_pays_off_when_its_frames_have_saved_what_it_cost() {
        // 8 s more, 0.5 s less a frame.
        assert_eq!(break_even(10.0, 1.5, 2.0, 2.0), Some(16.0));
        assert_eq!(break_even(2.0, 1.0, 2.0, 2.0), Some(0.0));
        assert_eq!(break_even(2.0, 1.0, 2.0, 1.0), Some(0.0));
    }

    #[test]
    fn frames_that_save_nothing_never_pay_off() {
        assert_eq!(break_even(10.0, 2.0, 2.0, 2.0), None);
        assert_eq!(break_even(10.0, 3.0, 2.0, 2.0), None);
        assert_eq!(break_even(1.0, 3.0, 2.0, 2.0), None);
        assert_eq!(break_even(f64::NAN, 1.0, 2.0, 2.0), None);
    }
}
