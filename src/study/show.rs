//! Short ways to a report's parts, shared by the studies.

use super::estimate::Estimate;
use super::plot::{Axis, Point, Scale};
use super::report::{Cell, Column};

/// A time as people say it.
pub(super) fn in_words(seconds: f64) -> String {
    match seconds {
        s if s < 1e-3 => format!("{:.0} µs", s * 1e6),
        s if s < 0.1 => format!("{:.1} ms", s * 1e3),
        s if s < 1.0 => format!("{:.0} ms", s * 1e3),
        s if s < 10.0 => format!("{s:.2} s"),
        s if s < 90.0 => format!("{s:.0} s"),
        s if s < 5400.0 => format!("{:.0} min", s / 60.0),
        s if s < 129_600.0 => format!("{:.1} h", s / 3600.0),
        s => format!("{:.0} days", s / 86_400.0),
    }
}

pub(super) fn column(name: &str, unit: &str) -> Column {
    Column {
        name: name.into(),
        unit: unit.into(),
    }
}

pub(super) fn text(text: impl Into<String>) -> Cell {
    Cell::Text(text.into())
}

/// A number, or a dash where there is none.
pub(super) fn number(value: Option<f64>, digits: usize) -> Cell {
    Cell::Number(value.unwrap_or(f64::NAN), digits)
}

pub(super) fn axis(label: &str, unit: &str, scale: Scale) -> Axis {
    Axis {
        label: label.into(),
        unit: unit.into(),
        scale,
    }
}

/// An estimate over `x`.
pub(super) fn point(x: f64, y: Estimate, label: String) -> Point {
    Point {
        x,
        y: y.median,
        low: y.low,
        high: y.high,
        label,
        marked: false,
    }
}
