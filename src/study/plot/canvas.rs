//! The only place that knows crate `plotters`: shapes and text, to SVG or to pixels, by the same calls.
//!
//! Its charts are not used, only its two backends: ticks, legends and labels that never lie on each other are ours.

pub(super) use plotters::backend::DrawingBackend as Backend;
use plotters::backend::{BitMapBackend, SVGBackend};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{
    Color, FontDesc, FontFamily, FontStyle, RGBAColor, RGBColor, ShapeStyle, TextStyle,
    register_font,
};
use std::io;
use std::sync::LazyLock;

/// Backends count in whole pixels; four to a unit of the layout is finer than the eye sees.
const FINE: f64 = 4.0;

/// What browsers look for, and the name under which the embedded font is known to the pixels.
const FAMILY: &str = "system-ui, sans-serif";

/// Whether the embedded font is there. It is a font, so it is.
static FONT: LazyLock<bool> = LazyLock::new(|| {
    let bytes = epaint_default_fonts::UBUNTU_LIGHT;
    register_font(FAMILY, FontStyle::Normal, bytes).is_ok()
});

/// A colour by its use, so that a page can give it another in the dark.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::study) enum Ink {
    /// What lies below everything.
    Paper,
    /// Titles and emphasis.
    Text,
    /// Labels.
    Muted,
    /// Axes and their ticks.
    Axis,
    /// Lines across the plot.
    Grid,
    /// A series' own colour.
    Series(usize),
    /// Any other: red, green, blue.
    Rgb([u8; 3]),
}

/// Okabe and Ito 2008, "Color Universal Design": told apart with any colour vision. Without its yellow, which is too
/// pale on white.
pub(in crate::study) const SERIES: [[u8; 3]; 7] = [
    [0x00, 0x72, 0xb2],
    [0xd5, 0x5e, 0x00],
    [0x00, 0x9e, 0x73],
    [0xcc, 0x79, 0xa7],
    [0xe6, 0x9f, 0x00],
    [0x56, 0xb4, 0xe9],
    [0x55, 0x5b, 0x66],
];

impl Ink {
    fn rgb(self) -> [u8; 3] {
        match self {
            Ink::Paper => [0xff; 3],
            Ink::Text => [0x1c, 0x1f, 0x24],
            Ink::Muted => [0x4f, 0x56, 0x61],
            Ink::Axis => [0x8c, 0x93, 0x9e],
            Ink::Grid => [0xe7, 0xe9, 0xed],
            Ink::Series(i) => SERIES[i % SERIES.len()],
            Ink::Rgb(rgb) => rgb,
        }
    }

    fn with(self, alpha: f64) -> RGBAColor {
        let [r, g, b] = self.rgb();
        RGBColor(r, g, b).mix(alpha)
    }
}

/// Which end of a text stands at its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(in crate::study) enum Side {
    Start,
    Middle,
    End,
}

/// Shapes and text at places in layout units, from the top left corner.
pub(in crate::study) struct Canvas<B: Backend> {
    backend: B,
    /// What the backend calls a size, for each em.
    size_of_em: f64,
    /// How far below a text's top the backend puts its baseline, in em.
    baseline: f64,
}

/// Pixels, twice as many each way as layout units.
pub(in crate::study) struct Raster {
    width: u32,
    height: u32,
    rgb: Vec<u8>,
}

fn fine(length: f64) -> i32 {
    (length * FINE).round() as i32
}

fn size(width: f64, height: f64) -> (u32, u32) {
    (fine(width).max(1) as u32, fine(height).max(1) as u32)
}

/// What `draw` draws, as the elements of an SVG whose view box counts in [`fine`] units, with the box's two sides.
pub(super) fn elements(
    width: f64,
    height: f64,
    draw: impl FnOnce(&mut Canvas<SVGBackend>),
) -> (String, (u32, u32)) {
    let size = size(width, height);
    let mut text = String::new();
    let mut canvas = Canvas {
        backend: SVGBackend::with_string(&mut text, size),
        size_of_em: 1.24,
        baseline: 0.76,
    };
    draw(&mut canvas);
    canvas.finish();
    drop(canvas);
    // The outermost element is ours to write. An attribute's quotes are never in a text: those are escaped.
    let inner = text.split_once('>').map_or("", |(_, inner)| inner).trim();
    let inner = inner.strip_suffix("</svg>").unwrap_or(inner);
    (inner.replace(" opacity=\"1\"", ""), size)
}

/// A place of the layout in the units of [`elements`].
pub(super) fn in_elements(length: f64) -> i32 {
    fine(length)
}

/// What `draw` draws, as pixels.
pub(in crate::study) fn raster(
    width: f64,
    height: f64,
    draw: impl FnOnce(&mut Canvas<BitMapBackend>),
) -> Raster {
    let (fine_width, fine_height) = size(width, height);
    let mut rgb = vec![255; fine_width as usize * fine_height as usize * 3];
    let mut canvas = Canvas {
        backend: BitMapBackend::with_buffer(&mut rgb, (fine_width, fine_height)),
        // The embedded font is 1.121 em from ascent to descent, and half of that is above its baseline.
        size_of_em: 1.121,
        baseline: 0.56,
    };
    draw(&mut canvas);
    canvas.finish();
    drop(canvas);
    Raster::halved(&rgb, fine_width, fine_height)
}

/// How long `text` is at `em` units a letter's height. Browsers' fonts are wider than the embedded one.
pub(in crate::study) fn text_width(text: &str, em: f64) -> f64 {
    let by_count = text.chars().count() as f64 * em * 0.6;
    if !*FONT {
        return by_count;
    }
    let font = FontDesc::new(FontFamily::Name(FAMILY), 1121.0, FontStyle::Normal);
    font.layout_box(text)
        .map_or(by_count, |((left, _), (right, _))| {
            f64::from(right - left) / 1000.0 * em * 1.08
        })
}

impl<B: Backend> Canvas<B> {
    // Backends into memory have nothing to refuse, so what they return is not asked.

    fn finish(&mut self) {
        self.backend.present().ok();
    }

    fn point((x, y): (f64, f64)) -> (i32, i32) {
        (fine(x), fine(y))
    }

    /// A filled rectangle.
    pub(in crate::study) fn rectangle(&mut self, from: (f64, f64), to: (f64, f64), ink: Ink) {
        let (from, to) = (Self::point(from), Self::point(to));
        self.backend.draw_rect(from, to, &ink.with(1.0), true).ok();
    }

    /// A line through `points`, `width` units wide.
    pub(in crate::study) fn line(&mut self, points: &[(f64, f64)], width: f64, ink: Ink) {
        let style = ShapeStyle {
            color: ink.with(1.0),
            filled: false,
            stroke_width: fine(width).max(1) as u32,
        };
        let points = points.iter().copied().map(Self::point);
        self.backend.draw_path(points, &style).ok();
    }

    /// A filled shape.
    pub(super) fn polygon(&mut self, points: &[(f64, f64)], ink: Ink, alpha: f64) {
        let points = points.iter().copied().map(Self::point);
        self.backend.fill_polygon(points, &ink.with(alpha)).ok();
    }

    /// A disc.
    pub(super) fn disc(&mut self, at: (f64, f64), radius: f64, ink: Ink, alpha: f64) {
        let radius = fine(radius).max(1) as u32;
        self.backend
            .draw_circle(Self::point(at), radius, &ink.with(alpha), true)
            .ok();
    }

    /// `text` on a baseline, `em` units high.
    pub(in crate::study) fn text(
        &mut self,
        text: &str,
        (x, baseline): (f64, f64),
        em: f64,
        ink: Ink,
        side: Side,
    ) {
        if !*FONT {
            return;
        }
        let h_pos = match side {
            Side::Start => HPos::Left,
            Side::Middle => HPos::Center,
            Side::End => HPos::Right,
        };
        let size = em * FINE * self.size_of_em;
        let font = FontDesc::new(FontFamily::Name(FAMILY), size, FontStyle::Normal);
        let color = ink.with(1.0);
        let style = TextStyle::from(font)
            .color(&color)
            .pos(Pos::new(h_pos, VPos::Top));
        // Files of XML may not hold control characters, and names come from users' files.
        let text: String = text
            .chars()
            .map(|c| if c.is_control() { '\u{fffd}' } else { c })
            .collect();
        let at = Self::point((x, baseline - self.baseline * em));
        self.backend.draw_text(&text, &style, at).ok();
    }
}

impl Raster {
    /// Two by two pixels become their mean: what a line covers in part, it colours in part.
    fn halved(rgb: &[u8], fine_width: u32, fine_height: u32) -> Raster {
        let (width, height) = ((fine_width / 2).max(1), (fine_height / 2).max(1));
        let at = |x: u32, y: u32, channel: u32| {
            let pixel = y as usize * fine_width as usize + x as usize;
            let value = rgb.get(pixel * 3 + channel as usize);
            u32::from(value.copied().unwrap_or(255))
        };
        let mut halved = Vec::with_capacity(width as usize * height as usize * 3);
        for y in (0..height).map(|y| 2 * y) {
            for x in (0..width).map(|x| 2 * x) {
                halved.extend([0, 1, 2].map(|channel| {
                    let sum = at(x, y, channel)
                        + at(x + 1, y, channel)
                        + at(x, y + 1, channel)
                        + at(x + 1, y + 1, channel);
                    (sum / 4) as u8
                }));
            }
        }
        Raster {
            width,
            height,
            rgb: halved,
        }
    }

    /// This below a picture of `rgb`; `beside` fills what is less wide.
    pub(in crate::study) fn below(
        self,
        width: u32,
        height: u32,
        rgb: &[u8],
        beside: [u8; 3],
    ) -> Raster {
        let total = width.max(self.width);
        let mut stacked = Vec::new();
        let parts = [(width, height, rgb), (self.width, self.height, &self.rgb)];
        for (width, height, rgb) in parts {
            let bytes = width as usize * 3;
            for y in 0..height as usize {
                let row = rgb.get(y * bytes..(y + 1) * bytes).unwrap_or_default();
                stacked.extend_from_slice(row);
                let missing = total as usize - row.len() / 3;
                stacked.extend(std::iter::repeat_n(beside, missing).flatten());
            }
        }
        Raster {
            width: total,
            height: height + self.height,
            rgb: stacked,
        }
    }

    /// As a file.
    pub(in crate::study) fn png(&self) -> io::Result<Vec<u8>> {
        crate::output::rgb_png(self.width, self.height, &self.rgb)
    }

    #[cfg(test)]
    pub(in crate::study) fn pixels(&self) -> impl Iterator<Item = [u8; 3]> {
        self.rgb.as_chunks::<3>().0.iter().copied()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_embedded_font_measures_text() {
        assert!(*FONT);
        let one = text_width("milliseconds", 10.0);
        assert!((40.0..90.0).contains(&one), "{one}");
        assert!((text_width("millisecondsmilliseconds", 10.0) / one - 2.0).abs() < 0.05);
    }

    #[test]
    fn pixels_show_text() {
        let picture = raster(100.0, 20.0, |canvas| {
            canvas.text("report", (2.0, 15.0), 12.0, Ink::Text, Side::Start);
        });
        assert!(picture.pixels().any(|[r, g, b]| r < 90 && g < 90 && b < 90));
    }
}
