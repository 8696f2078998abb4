//! Plots: what is shown, apart from how it is drawn.

mod axis;
mod canvas;
mod draw;
mod layout;
mod legend;
mod marker;
mod number;
mod place;

pub(super) use canvas::{Ink, Raster, Side, raster};
pub(super) use number::{engineering, thousands};

use std::io;

/// A plot of series over two axes.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Plot {
    /// The stem of its files' names, without extension.
    pub name: String,
    /// What it shows, in a few words.
    pub title: String,
    /// What to see in it, in a sentence or two.
    pub caption: String,
    /// Left to right.
    pub x: Axis,
    /// Bottom to top.
    pub y: Axis,
    /// Drawn in order, the first one lowest. Colours repeat after seven, then with other markers.
    pub series: Vec<Series>,
}

/// One direction of a plot.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Axis {
    /// What it measures, without its unit, as in "build time".
    pub label: String,
    /// As in "s" or "Mrays/s"; may be empty. Seconds and bytes get prefixes at their ticks, as in "10 ms".
    pub unit: String,
    /// How values become places.
    pub scale: Scale,
}

/// How values become places along an axis.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Scale {
    /// Equal differences are equally far apart.
    #[default]
    Linear,
    /// Equal ratios are equally far apart. Only values above zero have a place.
    Log,
}

/// Points that belong together.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Series {
    /// What the legend says.
    pub name: String,
    /// How it is drawn.
    pub style: Style,
    /// In the order in which a line joins them.
    pub points: Vec<Point>,
}

/// How a series is drawn.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Style {
    /// Markers, for measurements without an order.
    #[default]
    Points,
    /// A line, for what is known everywhere.
    Line,
    /// Markers joined by a line, for measurements in order.
    LineAndPoints,
    /// A broken line, for fits and references.
    Dashed,
}

/// A value with its spread.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Point {
    /// Along the first axis.
    pub x: f64,
    /// Along the second axis.
    pub y: f64,
    /// The error bar's lower end; `y` where there is none.
    pub low: f64,
    /// The error bar's upper end; `y` where there is none.
    pub high: f64,
    /// What it is, shown under the pointer, and beside it where it is marked and there is room.
    pub label: String,
    /// Emphasised: on the front of best choices.
    pub marked: bool,
}

/// Magnitudes past this have no place on any axis: differences and ratios of them could overflow.
const GREATEST: f64 = 1e100;

impl Scale {
    /// Whether `value` has a place.
    fn shows(self, value: f64) -> bool {
        let magnitude = value.abs();
        match self {
            Scale::Linear => magnitude <= GREATEST,
            Scale::Log => value >= 1.0 / GREATEST && magnitude <= GREATEST,
        }
    }
}

impl Plot {
    /// The points that have a place on both axes, with their series' index.
    fn shown(&self) -> impl Iterator<Item = (usize, &Point)> {
        let series = self.series.iter().enumerate();
        series
            .flat_map(|(i, series)| series.points.iter().map(move |point| (i, point)))
            .filter(|(_, point)| self.shows(point))
    }

    fn shows(&self, point: &Point) -> bool {
        self.x.scale.shows(point.x) && self.y.scale.shows(point.y)
    }

    /// Says how many points have no place in the plot, and why; empty where all have one.
    pub fn left_out(&self) -> String {
        let points = || self.series.iter().flat_map(|series| &series.points);
        let is_number =
            |point: &Point| Scale::Linear.shows(point.x) && Scale::Linear.shows(point.y);
        let without_number = points().filter(|point| !is_number(point)).count();
        let not_above_zero = points()
            .filter(|point| is_number(point) && !self.shows(point))
            .count();
        let mut sentences = Vec::new();
        if not_above_zero > 0 {
            sentences.push(format!(
                "{} left out, which a logarithmic axis cannot show: not above zero.",
                counted(not_above_zero)
            ));
        }
        if without_number > 0 {
            sentences.push(format!(
                "{} left out: no finite number.",
                counted(without_number)
            ));
        }
        sentences.join(" ")
    }
}

/// "1 point is" or "3 points are".
fn counted(points: usize) -> String {
    match points {
        1 => "1 point is".into(),
        n => format!("{n} points are"),
    }
}

/// `plot` as a file of its own: light, with its title, text as text.
pub fn svg(plot: &Plot) -> String {
    let layout = layout::Layout::new(plot, layout::Form::File);
    draw::as_svg(plot, &layout)
}

/// `plot` within a page that has its title already: for a wide column, and for a phone's.
pub(super) fn in_page(plot: &Plot) -> [String; 2] {
    [layout::Form::Wide, layout::Form::Narrow]
        .map(|form| draw::as_svg(plot, &layout::Layout::new(plot, form)))
}

/// `plot` as [`svg`] shows it, 1600 pixels wide.
///
/// # Errors
///
/// The encoder refuses, which it has no reason to do.
pub fn png(plot: &Plot) -> io::Result<Vec<u8>> {
    let layout = layout::Layout::new(plot, layout::Form::File);
    draw::as_raster(plot, &layout).png()
}

#[cfg(test)]
mod tests;
