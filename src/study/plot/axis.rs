//! What part of an axis is seen, and where its ticks stand.

use super::number::{decade, engineering, power_of_ten};
use super::{Axis, Scale};

/// The part of an axis that is seen.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Range {
    low: f64,
    high: f64,
    scale: Scale,
}

/// A place on an axis with what stands there; nothing stands at minor ones.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Tick {
    pub(super) value: f64,
    pub(super) label: String,
}

/// Of the span, on each side.
const MARGIN: f64 = 0.06;

/// A span smaller than this part of the values is noise of their last bits.
const NO_SPAN: f64 = 1e-9;

impl Range {
    /// What to show so that all `values` are seen with some room around them. They must have a place on `scale`.
    pub(super) fn of(values: impl Iterator<Item = f64>, scale: Scale) -> Range {
        let (low, high) = values.fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), value| {
            (low.min(value), high.max(value))
        });
        let (low, high) = match scale {
            Scale::Linear => linear(low, high),
            Scale::Log => log(low, high),
        };
        Range { low, high, scale }
    }

    /// Where `value` stands: 0 at the lower end, 1 at the upper one.
    pub(super) fn place(&self, value: f64) -> f64 {
        match self.scale {
            Scale::Linear => (value - self.low) / (self.high - self.low),
            Scale::Log => {
                let low = libm::log10(self.low);
                (libm::log10(value) - low) / (libm::log10(self.high) - low)
            }
        }
    }

    fn holds(&self, value: f64) -> bool {
        let slack = 1e-9;
        (-slack..=1.0 + slack).contains(&self.place(value))
    }

    /// The labelled ticks, about `wanted` of them, and the small ones between.
    pub(super) fn ticks(&self, axis: &Axis, wanted: usize) -> (Vec<Tick>, Vec<f64>) {
        match self.scale {
            Scale::Linear => (self.even(axis, wanted), Vec::new()),
            Scale::Log => self.decades(axis, wanted),
        }
    }

    /// At multiples of 1, 2 or 5 times a power of ten.
    fn even(&self, axis: &Axis, wanted: usize) -> Vec<Tick> {
        let rough = (self.high - self.low) / wanted.max(1) as f64;
        let power = power_of_ten(decade(rough, 9));
        let step = [1.0, 2.0, 5.0, 10.0]
            .map(|factor| factor * power)
            .into_iter()
            .find(|step| *step >= rough * 0.999)
            .unwrap_or(rough);
        let first = (self.low / step).ceil();
        let digits = (decade(self.low.abs().max(self.high.abs()), 9) - decade(step, 9) + 1).max(1);
        (0..4 * wanted.max(1))
            .map(|i| (first + i as f64) * step)
            .take_while(|value| self.holds(*value))
            .map(|value| Tick::new(value, axis, digits))
            .collect()
    }

    /// At powers of ten; where few are in sight, at 2 and 5 times them too, and within less than one, evenly.
    fn decades(&self, axis: &Axis, wanted: usize) -> (Vec<Tick>, Vec<f64>) {
        let (first, last) = (decade(self.low, 9) - 1, decade(self.high, 9) + 1);
        let times = |factor: f64| {
            (first..=last)
                .map(move |exponent| factor * power_of_ten(exponent))
                .filter(|value| self.holds(*value))
        };
        let powers: Vec<f64> = times(1.0).collect();
        let every = powers.len().div_ceil(wanted.max(2) + 2).max(1);
        let mut values: Vec<f64> = powers.iter().copied().step_by(every).collect();
        if powers.len() <= 2 {
            values.extend([2.0, 5.0].into_iter().flat_map(times));
            values.sort_by(f64::total_cmp);
        }
        if values.len() < 3 {
            return (self.even(axis, wanted), Vec::new());
        }
        let minor = if every > 1 {
            powers
        } else {
            (2..10)
                .flat_map(|factor| times(f64::from(factor)))
                .collect()
        };
        let ticks = values.into_iter().map(|value| Tick::new(value, axis, 3));
        (ticks.collect(), minor)
    }
}

impl Tick {
    fn new(value: f64, axis: &Axis, digits: i32) -> Tick {
        let label = engineering(value, &axis.unit, digits);
        Tick { value, label }
    }
}

/// Nothing below zero is shown where nothing is there, and zero is shown where it is not far.
fn linear(low: f64, high: f64) -> (f64, f64) {
    if low > high {
        return (0.0, 1.0);
    }
    if high - low <= NO_SPAN * low.abs().max(high.abs()) {
        return match low {
            0.0 => (0.0, 1.0),
            _ if low > 0.0 => (0.0, 2.0 * low),
            _ => (2.0 * low, 0.0),
        };
    }
    let from_zero = low >= 0.0 && low <= 0.5 * high;
    let low_end = if from_zero { 0.0 } else { low };
    let margin = MARGIN * (high - low_end);
    let lower = if from_zero { 0.0 } else { low - margin };
    let lower = if low >= 0.0 { lower.max(0.0) } else { lower };
    (lower, high + margin)
}

/// At least a decade where all values are one.
fn log(low: f64, high: f64) -> (f64, f64) {
    if low > high {
        return (1.0, 10.0);
    }
    if high / low <= 1.0 + NO_SPAN {
        let half_a_decade = power_of_ten(1).sqrt();
        return (low / half_a_decade, low * half_a_decade);
    }
    let margin = libm::pow(high / low, MARGIN);
    (low / margin, high * margin)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn labels(values: &[f64], scale: Scale, unit: &str) -> Vec<String> {
        let axis = Axis {
            label: "t".into(),
            unit: unit.into(),
            scale,
        };
        let range = Range::of(values.iter().copied(), scale);
        let (ticks, _) = range.ticks(&axis, 6);
        ticks
            .into_iter()
            .map(|tick| tick.label.replace('\u{a0}', " "))
            .collect()
    }

    #[test]
    fn linear_ticks_are_round_and_start_at_a_near_zero() {
        assert_eq!(
            labels(&[1.0, 95.0], Scale::Linear, ""),
            ["0", "20", "40", "60", "80", "100"]
        );
        assert_eq!(
            labels(&[0.002, 0.01], Scale::Linear, "s"),
            ["0 s", "2 ms", "4 ms", "6 ms", "8 ms", "10 ms"]
        );
        assert_eq!(
            labels(&[-3.0, 3.0], Scale::Linear, ""),
            ["\u{2212}2", "0", "2"]
        );
    }

    #[test]
    fn neighbouring_ticks_far_from_zero_differ() {
        let labels = labels(&[1_000_000.0, 1_000_004.0], Scale::Linear, "");
        assert!(labels.len() >= 3, "{labels:?}");
        assert!(
            labels.windows(2).all(|pair| pair[0] != pair[1]),
            "{labels:?}"
        );
    }

    #[test]
    fn log_ticks_are_decades_and_get_company_where_few() {
        assert_eq!(
            labels(&[10.0, 1e7], Scale::Log, ""),
            ["10", "100", "1 k", "10 k", "100 k", "1 M", "10 M"]
        );
        assert_eq!(
            labels(&[0.01, 0.5], Scale::Log, "s"),
            ["10 ms", "20 ms", "50 ms", "100 ms", "200 ms", "500 ms"]
        );
        assert!(labels(&[31.0, 33.0], Scale::Log, "").len() >= 3);
        assert!(labels(&[1e-90, 1e90], Scale::Log, "").len() <= 8);
    }

    #[test]
    fn every_value_is_inside_its_range_whatever_it_is() {
        for values in [
            &[][..],
            &[0.0],
            &[5.0],
            &[-5.0],
            &[7.0, 7.0],
            &[1e100, -1e100],
            &[1e-100, 2e-100],
            &[3.0, 3.0 + 1e-14],
        ] {
            for scale in [Scale::Linear, Scale::Log] {
                let shown = || values.iter().copied().filter(|value| scale.shows(*value));
                let range = Range::of(shown(), scale);
                assert!(range.low < range.high, "{values:?} {range:?}");
                assert!(
                    shown().all(|value| range.holds(value)),
                    "{values:?} {range:?}"
                );
                let (ticks, minor) = range.ticks(
                    &Axis {
                        scale,
                        ..Axis::default()
                    },
                    6,
                );
                assert!((2..=24).contains(&ticks.len()), "{values:?} {ticks:?}");
                assert!(
                    ticks
                        .iter()
                        .map(|tick| tick.value)
                        .chain(minor)
                        .all(|value| range.holds(value))
                );
            }
        }
    }

    #[test]
    fn one_value_stands_in_the_middle() {
        assert_eq!(Range::of([4.0].into_iter(), Scale::Linear).place(4.0), 0.5);
        assert!((Range::of([4.0].into_iter(), Scale::Log).place(4.0) - 0.5).abs() < 1e-12);
    }
}
