//! A number, or several, that changes over time (glTF 2.0, section 3.11 and appendix C).

use glam::DQuat;
use std::sync::Arc;

/// Keys in time, and what holds at and between them. There is at least one key, times never fall, all numbers are
/// finite, and there are as many values as the keys need: whoever makes one sees to it.
#[derive(Clone, Debug)]
pub(in crate::load) struct Curve {
    /// Seconds.
    pub(in crate::load) times: Arc<[f32]>,
    /// `width` numbers a key; with cubic splines three times as many: the arriving tangent, the value, the leaving
    /// tangent, per second.
    pub(in crate::load) values: Arc<[f32]>,
    /// How many numbers a value has.
    pub(in crate::load) width: usize,
    /// What holds between two keys.
    pub(in crate::load) interpolation: Interpolation,
}

/// What holds between two keys.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::load) enum Interpolation {
    /// The earlier one.
    Step,
    /// A straight line; the shortest arc for rotations.
    Linear,
    /// A cubic Hermite spline.
    Cubic,
}

/// Where a moment lies between two keys.
struct Place {
    from: usize,
    to: usize,
    /// How far on the way, 0..1.
    share: f64,
    /// From key to key.
    seconds: f64,
}

impl Curve {
    /// How many numbers the values of `keys` keys have.
    pub(in crate::load) fn numbers(
        keys: usize,
        width: usize,
        interpolation: Interpolation,
    ) -> Option<usize> {
        let of_key = match interpolation {
            Interpolation::Step | Interpolation::Linear => width,
            Interpolation::Cubic => width.checked_mul(3)?,
        };
        keys.checked_mul(of_key)
    }

    /// The value at a time: the first key's before it, the last one's after it.
    pub(super) fn at(&self, time: f64) -> Vec<f64> {
        let place = self.place(time);
        (0..self.width).map(|i| self.number(&place, i)).collect()
    }

    /// The first number of the value at a time.
    pub(super) fn first_at(&self, time: f64) -> f64 {
        self.number(&self.place(time), 0)
    }

    /// The first three numbers of the value at a time.
    pub(super) fn three_at(&self, time: f64) -> [f64; 3] {
        let place = self.place(time);
        [0, 1, 2].map(|i| self.number(&place, i))
    }

    /// The value at a time as a rotation of unit length; `None` where it has no length.
    pub(super) fn rotation_at(&self, time: f64) -> Option<DQuat> {
        let place = self.place(time);
        let rotation = if self.interpolation == Interpolation::Linear {
            let key = |key| DQuat::from_array([0, 1, 2, 3].map(|i| self.value(key, 1, i)));
            slerp(unit(key(place.from))?, unit(key(place.to))?, place.share)
        } else {
            DQuat::from_array([0, 1, 2, 3].map(|i| self.number(&place, i)))
        };
        unit(rotation)
    }

    fn place(&self, time: f64) -> Place {
        let after = self.times.partition_point(|&key| f64::from(key) <= time);
        let last = self.times.len().saturating_sub(1);
        let from = after.saturating_sub(1);
        let to = after.min(last);
        if after == 0 || from == to {
            let (from, to) = (from, from);
            let (share, seconds) = (0.0, 0.0);
            return Place {
                from,
                to,
                share,
                seconds,
            };
        }
        let second = |key: usize| self.times.get(key).map_or(0.0, |&time| f64::from(time));
        let seconds = second(to) - second(from);
        let share = (time - second(from)) / seconds;
        Place {
            from,
            to,
            share,
            seconds,
        }
    }

    fn number(&self, place: &Place, i: usize) -> f64 {
        let &Place {
            from,
            to,
            share: t,
            seconds,
        } = place;
        let (start, end) = (self.value(from, 1, i), self.value(to, 1, i));
        if from == to {
            return start;
        }
        match self.interpolation {
            Interpolation::Step => start,
            Interpolation::Linear => start + (end - start) * t,
            Interpolation::Cubic => {
                let (leaving, arriving) = (self.value(from, 2, i), self.value(to, 0, i));
                let (t2, t3) = (t * t, t * t * t);
                (2.0 * t3 - 3.0 * t2 + 1.0) * start
                    + seconds * (t3 - 2.0 * t2 + t) * leaving
                    + (3.0 * t2 - 2.0 * t3) * end
                    + seconds * (t3 - t2) * arriving
            }
        }
    }

    /// Number `i` of a key: with cubic splines of its arriving tangent (0), its value (1) or its leaving tangent (2).
    fn value(&self, key: usize, part: usize, i: usize) -> f64 {
        let row = match self.interpolation {
            Interpolation::Step | Interpolation::Linear => key,
            Interpolation::Cubic => key * 3 + part,
        };
        self.values
            .get(row * self.width + i)
            .map_or(0.0, |&number| f64::from(number))
    }
}

fn unit(rotation: DQuat) -> Option<DQuat> {
    let length = rotation.length();
    (length > 0.0).then(|| rotation / length)
}

/// Spherical linear interpolation the shorter way round (glTF 2.0, appendix C.4). Not glam's, whose arc cosine is the
/// platform's.
fn slerp(from: DQuat, to: DQuat, share: f64) -> DQuat {
    /// Closer than this, the arc is straight and its sine too small to divide by.
    const STRAIGHT: f64 = 1e-6;
    let cosine = from.dot(to);
    let to = if cosine < 0.0 { -to } else { to };
    let angle = libm::acos(cosine.abs().min(1.0));
    if angle < STRAIGHT {
        return from * (1.0 - share) + to * share;
    }
    let weight = |share: f64| libm::sin(share * angle) / libm::sin(angle);
    from * weight(1.0 - share) + to * weight(share)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::{FRAC_PI_2, FRAC_PI_6, PI};

    fn curve(interpolation: Interpolation, width: usize, times: &[f32], values: &[f32]) -> Curve {
        assert_eq!(
            Curve::numbers(times.len(), width, interpolation),
            Some(values.len())
        );
        Curve {
            times: times.into(),
            values: values.into(),
            width,
            interpolation,
        }
    }

    #[test]
    fn a_step_holds_until_the_next_key() {
        let curve = curve(Interpolation::Step, 1, &[1.0, 2.0, 4.0], &[5.0, 6.0, 7.0]);
        let at = [0.0, 1.0, 1.999, 2.0, 3.9, 4.0, 9.0].map(|time| curve.first_at(time));
        assert_eq!(at, [5.0, 5.0, 5.0, 6.0, 6.0, 7.0, 7.0]);
    }

    #[test]
    fn a_line_runs_from_key_to_key_and_stands_still_outside() {
        let curve = curve(
            Interpolation::Linear,
            2,
            &[1.0, 3.0],
            &[0.0, 10.0, 4.0, 20.0],
        );
        assert_eq!(curve.at(1.5), [1.0, 12.5]);
        assert_eq!(curve.at(-1.0), [0.0, 10.0]);
        assert_eq!(curve.at(1e9), [4.0, 20.0]);
        assert_eq!(curve.at(f64::NAN), [0.0, 10.0]);
    }

    #[test]
    fn two_keys_at_one_time_jump_there() {
        let curve = curve(
            Interpolation::Linear,
            1,
            &[0.0, 1.0, 1.0, 2.0],
            &[0., 1., 5., 6.],
        );
        let at = [0.5, 1.0, 1.5].map(|time| curve.first_at(time));
        assert_eq!(at, [0.5, 5.0, 5.5]);
    }

    #[test]
    fn a_cubic_spline_scales_its_tangents_by_the_interval() {
        // p(t) = t^3 over two seconds: value 0 and slope 0 at 0, value 8 and slope 12 per second at 2.
        let values = [99.0, 0.0, 0.0, 12.0, 8.0, 99.0];
        let curve = curve(Interpolation::Cubic, 1, &[0.0, 2.0], &values);
        for time in [0.0, 0.25, 1.0, 1.5, 2.0] {
            assert!(
                (curve.first_at(time) - time * time * time).abs() < 1e-12,
                "{time}"
            );
        }
        assert_eq!([curve.first_at(-1.0), curve.first_at(3.0)], [0.0, 8.0]);
    }

    #[test]
    fn rotations_turn_evenly_and_the_shorter_way() {
        // A quarter turn about z; then, with its sign turned, the same rotation.
        let half = 0.5f32.sqrt();
        for sign in [1.0, -1.0] {
            let values = [0.0, 0.0, 0.0, 2.0, 0.0, 0.0, half * sign, half * sign];
            let curve = curve(Interpolation::Linear, 4, &[0.0, 3.0], &values);
            let turned = curve.rotation_at(1.0).expect("it has a length");
            let angle = 2.0 * libm::atan2(turned.z, turned.w);
            assert!((angle - FRAC_PI_6).abs() < 1e-7, "{angle}");
        }
        let values = [0.0, 0.0, 0.0, 1.0, 0.0, 0.0, 0.0, 0.0];
        let nowhere = curve(Interpolation::Linear, 4, &[0.0, 3.0], &values);
        assert_eq!(nowhere.rotation_at(1.0), None);
    }

    #[test]
    fn opposite_and_equal_rotations_have_something_between() {
        let x = DQuat::from_xyzw(libm::sin(PI / 4.0), 0.0, 0.0, libm::cos(PI / 4.0));
        assert!((slerp(x, x, 0.3).dot(x) - 1.0).abs() < 1e-12);
        let half_turn = DQuat::from_xyzw(1.0, 0.0, 0.0, 0.0);
        let between = slerp(DQuat::IDENTITY, half_turn, 0.5);
        assert!((2.0 * libm::atan2(between.x, between.w) - FRAC_PI_2).abs() < 1e-12);
    }
}
