//! Where everything of a plot stands, before anything is drawn.

use super::axis::{Range, Tick};
use super::canvas::text_width;
use super::number::{decade, power_of_ten, takes_prefixes};
use super::{Axis, Plot, Point};

/// What a plot is drawn for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Form {
    /// A file of its own, with its title, on paper.
    File,
    /// A column of a page that gives the title itself.
    Wide,
    /// The same on a phone: less wide, and letters as large.
    Narrow,
}

/// Everything's place, in units of which a wide plot has 800 from left to right.
#[derive(Debug)]
pub(super) struct Layout {
    pub(super) form: Form,
    pub(super) width: f64,
    pub(super) height: f64,
    /// Left of everything: a file has a margin, a page its own.
    pub(super) margin: f64,
    /// The plotted area.
    pub(super) left: f64,
    pub(super) right: f64,
    pub(super) top: f64,
    pub(super) bottom: f64,
    /// A letter's height.
    pub(super) em: f64,
    pub(super) x: Range,
    pub(super) y: Range,
    pub(super) x_ticks: (Vec<Tick>, Vec<f64>),
    pub(super) y_ticks: (Vec<Tick>, Vec<f64>),
    pub(super) x_label: String,
    pub(super) y_label: String,
    /// Left end and baseline of each series' entry, where there is a legend.
    pub(super) legend: Vec<(f64, f64)>,
}

/// The title's letters, larger than the others.
pub(super) const TITLE_EM: f64 = 17.0;

/// From a legend's entry to its text: room for the marker on its line.
pub(super) const SWATCH: f64 = 26.0;

/// A series' name in the legend is not longer.
const MAX_NAME: usize = 40;

impl Layout {
    pub(super) fn new(plot: &Plot, form: Form) -> Layout {
        let (width, plotted, em) = match form {
            Form::File | Form::Wide => (800.0, 350.0, 13.0),
            Form::Narrow => (360.0, 250.0, 12.0),
        };
        let x = Range::of(plot.shown().map(|(_, point)| point.x), plot.x.scale);
        let y = Range::of(
            plot.shown().flat_map(|(_, point)| extent(plot, point)),
            plot.y.scale,
        );
        let y_ticks = y.ticks(&plot.y, (plotted / 55.0) as usize);

        let (margin, title) = match form {
            Form::File => (16.0, 16.0 + TITLE_EM * 1.9),
            Form::Wide | Form::Narrow => (0.0, 0.0),
        };
        let labels = y_ticks.0.iter().map(|tick| text_width(&tick.label, em));
        let left = margin + labels.fold(20.0, f64::max) + 12.0;
        let right = width - 20.0;
        let (legend, legend_height) = legend(plot, (margin, title), right, em);
        let top = title + legend_height + em * 2.1;
        let bottom = top + plotted;
        let has_note = form == Form::File && !plot.left_out().is_empty();
        let note = if has_note { em * 1.8 } else { 0.0 };

        let wanted = ((right - left) / (em * 6.5)) as usize;
        let mut x_ticks = x.ticks(&plot.x, wanted);
        thin(&mut x_ticks.0, |tick| {
            let middle = left + x.place(tick.value) * (right - left);
            let half = text_width(&tick.label, em) / 2.0;
            (middle - half, middle + half)
        });
        Layout {
            form,
            width,
            height: bottom + em * 3.6 + note + margin,
            margin,
            left,
            right,
            top,
            bottom,
            em,
            x,
            y,
            x_ticks,
            y_ticks,
            x_label: axis_label(&plot.x),
            y_label: axis_label(&plot.y),
            legend,
        }
    }

    /// Where a point of the plot stands.
    pub(super) fn at(&self, x: f64, y: f64) -> (f64, f64) {
        (self.across(x), self.up(y))
    }

    pub(super) fn across(&self, x: f64) -> f64 {
        self.left + self.x.place(x) * (self.right - self.left)
    }

    pub(super) fn up(&self, y: f64) -> f64 {
        self.bottom - self.y.place(y) * (self.bottom - self.top)
    }
}

/// The ends of a point's error bar as far as they have a place, and the point itself.
pub(super) fn extent(plot: &Plot, point: &Point) -> [f64; 3] {
    let or_value = |end: f64| {
        if plot.y.scale.shows(end) {
            end
        } else {
            point.y
        }
    };
    [or_value(point.low), point.y, or_value(point.high)]
}

/// Label and unit, unless each tick has the unit.
fn axis_label(axis: &Axis) -> String {
    if axis.unit.is_empty() || takes_prefixes(&axis.unit) {
        axis.label.clone()
    } else {
        format!("{} ({})", axis.label, axis.unit)
    }
}

/// The letters of a title that would be wider than its plot are smaller.
pub(super) fn title_em(title: &str, room: f64) -> f64 {
    let share = room / text_width(title, TITLE_EM).max(1.0);
    TITLE_EM * share.clamp(0.6, 1.0)
}

/// The name as the legend has room for it.
pub(super) fn legend_name(name: &str) -> String {
    if name.chars().count() <= MAX_NAME {
        return name.to_owned();
    }
    name.chars().take(MAX_NAME - 1).chain(['…']).collect()
}

/// Entries flow from left to right in as many rows as they need. One series alone needs none.
fn legend(plot: &Plot, (left, top): (f64, f64), right: f64, em: f64) -> (Vec<(f64, f64)>, f64) {
    if plot.series.len() < 2 {
        return (Vec::new(), 0.0);
    }
    let row = em * 1.6;
    let (mut x, mut baseline) = (left, top + em * 1.1);
    let mut places = Vec::with_capacity(plot.series.len());
    for series in &plot.series {
        let entry = SWATCH + text_width(&legend_name(&series.name), em);
        if x > left && x + entry > right {
            (x, baseline) = (left, baseline + row);
        }
        places.push((x, baseline));
        x += entry + em * 1.5;
    }
    (places, baseline - top + em * 0.7)
}

/// Takes the labels from ticks where they would touch others: powers of ten keep theirs first, then those on the left.
fn thin(ticks: &mut [Tick], ends: impl Fn(&Tick) -> (f64, f64)) {
    const GAP: f64 = 8.0;
    let is_power =
        |tick: &Tick| tick.value > 0.0 && power_of_ten(decade(tick.value, 9)) == tick.value;
    let (first, rest): (Vec<_>, Vec<_>) = ticks.iter_mut().partition(|tick| is_power(tick));
    let mut taken: Vec<(f64, f64)> = Vec::new();
    for tick in first.into_iter().chain(rest) {
        let (start, end) = ends(tick);
        if taken
            .iter()
            .any(|other| start < other.1 + GAP && other.0 < end + GAP)
        {
            tick.label.clear();
        } else {
            taken.push((start, end));
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn where_labels_would_touch_powers_of_ten_keep_theirs() {
        let tick = |value: f64| Tick {
            value,
            label: value.to_string(),
        };
        let mut ticks = [5.0, 10.0, 20.0, 50.0, 100.0].map(tick);
        // Each label is 30 wide, and 5 is 21 from 10.
        thin(&mut ticks, |tick| {
            let middle = 70.0 * libm::log10(tick.value);
            (middle - 15.0, middle + 15.0)
        });
        let left = ticks.map(|tick| tick.label);
        assert_eq!(left, ["", "10", "", "", "100"]);
    }
}
