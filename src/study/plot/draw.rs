//! A plot onto a canvas, from its grid up to its labels.

use super::canvas::{self, Backend, Canvas, Ink, Raster, Side};
use super::layout::{self, Form, Layout, TITLE_EM};
use super::legend::legend;
use super::marker::Marker;
use super::number::engineering;
use super::place::{Area, beside};
use super::{Axis, Plot, Point, Series, Style};
use crate::study::report::escape;
use std::fmt::Write;

/// A marker's size, and an emphasised one's.
pub(super) const RADIUS: f64 = 4.0;
const MARKED_RADIUS: f64 = 5.2;

/// How much of their colour points keep beside emphasised ones.
const FAINT: f64 = 0.6;

/// More labels beside points than this would be a thicket.
const MAX_LABELS: usize = 12;

/// As an SVG. Every point has an invisible disc over it with what the pointer shows as its title.
pub(super) fn as_svg(plot: &Plot, layout: &Layout) -> String {
    let (elements, (width, height)) = canvas::elements(layout.width, layout.height, |canvas| {
        draw(canvas, plot, layout)
    });
    let mut svg = format!(
        "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {width} {height}\" width=\"{}\" height=\"{:.0}\" \
         role=\"img\" aria-label=\"{}\">\n{elements}<g class=\"hits\" fill=\"none\" pointer-events=\"all\">\n",
        layout.width,
        layout.height,
        escape(&plot.title),
    );
    for (series, point) in plot.shown() {
        let (x, y) = layout.at(point.x, point.y);
        let [x, y, radius] = [x, y, 3.0 * RADIUS].map(canvas::in_elements);
        let said = escape(&said(plot, &plot.series[series], point));
        // Writing to a string cannot fail.
        writeln!(
            svg,
            "<circle cx=\"{x}\" cy=\"{y}\" r=\"{radius}\"><title>{said}</title></circle>"
        )
        .ok();
    }
    svg.push_str("</g>\n</svg>\n");
    svg
}

/// As pixels.
pub(super) fn as_raster(plot: &Plot, layout: &Layout) -> Raster {
    canvas::raster(layout.width, layout.height, |canvas| {
        draw(canvas, plot, layout)
    })
}

/// What the pointer shows at a point, line by line.
fn said(plot: &Plot, series: &Series, point: &Point) -> String {
    let value = |axis: &Axis, value: f64| {
        let number = engineering(value, &axis.unit, 4);
        if axis.unit.is_empty() || super::number::takes_prefixes(&axis.unit) {
            number
        } else {
            format!("{number} {}", axis.unit)
        }
    };
    let mut lines = vec![point.label.clone(), series.name.clone()];
    lines.dedup();
    lines.push(format!("{}: {}", plot.x.label, value(&plot.x, point.x)));
    let [low, _, high] = layout::extent(plot, point);
    let mut line = format!("{}: {}", plot.y.label, value(&plot.y, point.y));
    if low < high {
        line += &format!(" ({} to {})", value(&plot.y, low), value(&plot.y, high));
    }
    lines.push(line);
    lines.retain(|line| !line.is_empty());
    lines.join("\n")
}

fn draw<B: Backend>(canvas: &mut Canvas<B>, plot: &Plot, layout: &Layout) {
    let em = layout.em;
    if layout.form == Form::File {
        canvas.rectangle((0.0, 0.0), (layout.width, layout.height), Ink::Paper);
        let title_em = layout::title_em(&plot.title, layout.right - layout.margin);
        let at = (layout.margin, layout.margin + TITLE_EM);
        canvas.text(&plot.title, at, title_em, Ink::Text, Side::Start);
        let note = (layout.margin, layout.height - layout.margin);
        canvas.text(&plot.left_out(), note, em * 0.9, Ink::Muted, Side::Start);
    }
    axes(canvas, layout);
    for (i, series) in plot.series.iter().enumerate() {
        line(canvas, plot, layout, i, series);
    }
    points(canvas, plot, layout);
    labels(canvas, plot, layout);
    legend(canvas, plot, layout);
    if plot.shown().next().is_none() {
        let middle = (
            (layout.left + layout.right) / 2.0,
            (layout.top + layout.bottom) / 2.0,
        );
        canvas.text("no data", middle, em * 1.2, Ink::Muted, Side::Middle);
    }
}

/// Grid, ticks, their numbers, and what the axes measure.
fn axes<B: Backend>(canvas: &mut Canvas<B>, layout: &Layout) {
    let Layout {
        left,
        right,
        top,
        bottom,
        em,
        ..
    } = *layout;
    for tick in &layout.y_ticks.0 {
        let y = layout.up(tick.value);
        canvas.line(&[(left, y), (right, y)], 0.75, Ink::Grid);
        canvas.text(
            &tick.label,
            (left - 8.0, y + 0.35 * em),
            em,
            Ink::Muted,
            Side::End,
        );
    }
    for tick in &layout.x_ticks.0 {
        let x = layout.across(tick.value);
        canvas.line(&[(x, top), (x, bottom)], 0.75, Ink::Grid);
        canvas.line(&[(x, bottom), (x, bottom + 5.0)], 1.0, Ink::Axis);
        canvas.text(
            &tick.label,
            (x, bottom + em * 1.5),
            em,
            Ink::Muted,
            Side::Middle,
        );
    }
    for &value in &layout.x_ticks.1 {
        let x = layout.across(value);
        canvas.line(&[(x, bottom), (x, bottom + 3.0)], 0.75, Ink::Axis);
    }
    for &value in &layout.y_ticks.1 {
        let y = layout.up(value);
        canvas.line(&[(left - 3.0, y), (left, y)], 0.75, Ink::Axis);
    }
    canvas.line(&[(left, bottom), (right, bottom)], 1.0, Ink::Axis);
    if !layout.y_ticks.1.is_empty() {
        canvas.line(&[(left, top), (left, bottom)], 1.0, Ink::Axis);
    }
    canvas.text(
        &layout.y_label,
        (layout.margin, top - em * 0.8),
        em,
        Ink::Text,
        Side::Start,
    );
    canvas.text(
        &layout.x_label,
        (right, bottom + em * 3.2),
        em,
        Ink::Text,
        Side::End,
    );
}

fn line<B: Backend>(
    canvas: &mut Canvas<B>,
    plot: &Plot,
    layout: &Layout,
    i: usize,
    series: &Series,
) {
    let points = series.points.iter().filter(|point| plot.shows(point));
    let path: Vec<_> = points.map(|point| layout.at(point.x, point.y)).collect();
    if path.len() < 2 {
        return;
    }
    match series.style {
        Style::Points => {}
        Style::Line | Style::LineAndPoints => canvas.line(&path, 1.75, Ink::Series(i)),
        Style::Dashed => {
            for dash in dashes(&path, 7.0, 4.5) {
                canvas.line(&dash, 1.75, Ink::Series(i));
            }
        }
    }
}

/// The pieces of `path` that a broken line shows.
pub(super) fn dashes(path: &[(f64, f64)], dash: f64, gap: f64) -> Vec<Vec<(f64, f64)>> {
    let mut dashes = Vec::new();
    let mut current = Vec::new();
    let (mut drawn, mut left) = (true, dash);
    for pair in path.windows(2) {
        let &[from, to] = pair else { continue };
        let (dx, dy) = (to.0 - from.0, to.1 - from.1);
        let length = (dx * dx + dy * dy).sqrt();
        let mut done = 0.0;
        if drawn && current.is_empty() {
            current.push(from);
        }
        while length - done > left {
            done += left;
            let at = (from.0 + dx * done / length, from.1 + dy * done / length);
            if drawn {
                current.push(at);
                dashes.push(std::mem::take(&mut current));
            } else {
                current.push(at);
            }
            drawn = !drawn;
            left = if drawn { dash } else { gap };
        }
        left -= length - done;
        if drawn {
            current.push(to);
        }
    }
    if current.len() > 1 {
        dashes.push(current);
    }
    dashes
}

/// Whether a series' points are drawn, or only its line.
pub(super) fn has_markers(series: &Series) -> bool {
    matches!(series.style, Style::Points | Style::LineAndPoints)
}

/// Error bars, then markers; emphasised ones last, so that nothing covers them.
fn points<B: Backend>(canvas: &mut Canvas<B>, plot: &Plot, layout: &Layout) {
    let with_markers = || plot.shown().filter(|(i, _)| has_markers(&plot.series[*i]));
    for (i, point) in plot.shown() {
        let [low, _, high] = layout::extent(plot, point);
        if point.low < high {
            let x = layout.across(point.x);
            // A bar that ends where a logarithmic axis never comes goes down to its end.
            let endless = point.low < point.y && low == point.y;
            let bottom = if endless {
                layout.bottom
            } else {
                layout.up(low)
            };
            let (low, high) = (bottom, layout.up(high));
            canvas.line(&[(x, low), (x, high)], 1.0, Ink::Series(i));
            for y in [low, high] {
                canvas.line(&[(x - 3.0, y), (x + 3.0, y)], 1.0, Ink::Series(i));
            }
        }
    }
    let any_marked = with_markers().any(|(_, point)| point.marked);
    let alpha = if any_marked { FAINT } else { 1.0 };
    for (i, point) in with_markers().filter(|(_, point)| !point.marked) {
        let at = layout.at(point.x, point.y);
        marker(canvas, i, at, RADIUS + 1.0, Ink::Paper, 1.0);
        marker(canvas, i, at, RADIUS, Ink::Series(i), alpha);
    }
    for (i, point) in with_markers().filter(|(_, point)| point.marked) {
        let at = layout.at(point.x, point.y);
        marker(canvas, i, at, MARKED_RADIUS + 2.8, Ink::Text, 1.0);
        marker(canvas, i, at, MARKED_RADIUS + 1.4, Ink::Paper, 1.0);
        marker(canvas, i, at, MARKED_RADIUS, Ink::Series(i), 1.0);
    }
}

pub(super) fn marker<B: Backend>(
    canvas: &mut Canvas<B>,
    series: usize,
    at: (f64, f64),
    radius: f64,
    ink: Ink,
    alpha: f64,
) {
    match Marker::of(series) {
        Marker::Disc => canvas.disc(at, radius, ink, alpha),
        shape => canvas.polygon(&shape.corners(at, radius), ink, alpha),
    }
}

/// The emphasised points' labels, beside them, where there is room.
fn labels<B: Backend>(canvas: &mut Canvas<B>, plot: &Plot, layout: &Layout) {
    let em = layout.em * 0.92;
    let places = plot.shown().map(|(_, point)| layout.at(point.x, point.y));
    let mut taken: Vec<Area> = places
        .map(|at| Area::around(at, MARKED_RADIUS + 2.0))
        .collect();
    for series in plot
        .series
        .iter()
        .filter(|series| series.style != Style::Points)
    {
        let points = series.points.iter().filter(|point| plot.shows(point));
        let path: Vec<_> = points.map(|point| layout.at(point.x, point.y)).collect();
        taken.extend(
            dashes(&path, 3.0, 3.0)
                .concat()
                .into_iter()
                .map(|at| Area::around(at, 2.0)),
        );
    }
    let bounds = Area {
        left: layout.left,
        top: layout.top - em,
        right: layout.right + 18.0,
        bottom: layout.bottom,
    };
    let marked = plot
        .shown()
        .filter(|(_, point)| point.marked && !point.label.is_empty());
    for (_, point) in marked.take(MAX_LABELS) {
        let at = layout.at(point.x, point.y);
        let size = (canvas::text_width(&point.label, em), em * 1.1);
        if let Some(area) = beside(at, size, MARKED_RADIUS + 8.0, &bounds, &taken) {
            canvas.text(
                &point.label,
                (area.left, area.bottom - em * 0.25),
                em,
                Ink::Text,
                Side::Start,
            );
            taken.push(area);
        }
    }
}
