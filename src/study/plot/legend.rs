//! What the colours and markers of a plot stand for.

use super::canvas::{Backend, Canvas, Ink, Side};
use super::draw::{RADIUS, dashes, has_markers, marker};
use super::layout::{self, Layout, SWATCH};
use super::{Plot, Style};

/// Every series' line or marker with its name, where the layout has room for it.
pub(super) fn legend<B: Backend>(canvas: &mut Canvas<B>, plot: &Plot, layout: &Layout) {
    for (i, (series, &(x, baseline))) in plot.series.iter().zip(&layout.legend).enumerate() {
        let y = baseline - 0.35 * layout.em;
        let ends = [(x, y), (x + SWATCH - 7.0, y)];
        match series.style {
            Style::Points => {}
            Style::Line | Style::LineAndPoints => canvas.line(&ends, 1.75, Ink::Series(i)),
            Style::Dashed => {
                for dash in dashes(&ends, 7.0, 4.5) {
                    canvas.line(&dash, 1.75, Ink::Series(i));
                }
            }
        }
        if has_markers(series) {
            marker(
                canvas,
                i,
                (x + (SWATCH - 7.0) / 2.0, y),
                RADIUS,
                Ink::Series(i),
                1.0,
            );
        }
        let name = layout::legend_name(&series.name);
        canvas.text(
            &name,
            (x + SWATCH, baseline),
            layout.em,
            Ink::Muted,
            Side::Start,
        );
    }
}
