//! An environment as few lights of equal energy.
//!
//! Debevec 2005, "A Median Cut Algorithm for Light Probe Sampling": the picture is cut in two of equal energy along its
//! longer side, and so on with the parts; each part becomes a light at its centre of energy. Here it is the part of most
//! energy that is cut next, so that there may be any number of lights, and what is as small as the sun stays whole.

use super::DistantLight;
use super::equirect::{Equirect, colatitude, longitudes, solid_angle};
use crate::color::Rgb;
use glam::{DVec3, Vec3};
use std::f64::consts::PI;

/// What holds less than this share of all energy holds none: so much is lost to rounding in the sums.
const NOTHING: f64 = 1e-12;
/// Columns and rows of a part that is small enough for any shadow.
const SMALLEST: usize = 2;

/// The lights of a picture: `count` of them, and fewer where it is black or has but few pixels that are not. Neighbours
/// in the list are neighbours in the picture.
pub(super) fn lights(picture: &Equirect, count: u32) -> Vec<Part> {
    let sums = Sums::of(picture);
    let whole = Cell {
        columns: (0, picture.width as usize),
        rows: (0, picture.height as usize),
    };
    let mut parts: Vec<Part> = sums.part(whole).into_iter().collect();
    while parts.len() < count as usize {
        let cuttable = parts.iter().enumerate().filter(|(_, part)| !part.is_small);
        // The first of equals, so that the order of the parts decides.
        let greatest = cuttable.min_by(|(_, a), (_, b)| b.energy.total_cmp(&a.energy));
        let Some((index, part)) = greatest else {
            break;
        };
        let halves = sums.halves(part.cell).into_iter().flatten();
        let halves: Vec<Part> = halves.filter_map(|cell| sums.part(cell)).collect();
        parts.splice(index..=index, halves);
    }
    parts
}

/// A part of a picture.
#[derive(Clone, Copy, Debug)]
pub(super) struct Part {
    cell: Cell,
    /// Luminance times solid angle.
    pub(super) energy: f64,
    /// Whether it is not to be cut.
    pub(super) is_small: bool,
    /// The light it becomes, in the space of the picture.
    pub(super) light: DistantLight,
}

/// A rectangle of pixels, each side from its first to before its last.
#[derive(Clone, Copy, Debug)]
struct Cell {
    columns: (usize, usize),
    rows: (usize, usize),
}

/// What is known of the rectangle above and left of a pixel's corner.
#[derive(Clone, Copy, Debug, Default)]
struct Sum {
    /// Luminance times solid angle.
    energy: f64,
    /// Directions times energy.
    moment: DVec3,
    /// Radiance times solid angle.
    light: DVec3,
}

/// Sums over rectangles.
struct Sums {
    width: usize,
    height: usize,
    /// Of the rectangles above and left of each corner of a pixel, `(width + 1) * (height + 1)` of them.
    corners: Vec<Sum>,
}

impl Sums {
    fn of(picture: &Equirect) -> Sums {
        let (width, height) = (picture.width as usize, picture.height as usize);
        let longitudes = longitudes(picture.width);
        let mut corners = vec![Sum::default(); width + 1];
        let mut above = corners.clone();
        for (y, pixels) in (0..picture.height).zip(picture.rows()) {
            let (sin, cos) = colatitude(f64::from(y) + 0.5, picture.height);
            let solid_angle = solid_angle(y, picture.width, picture.height);
            let mut row = Sum::default();
            let mut below = vec![row];
            for ((pixel, (x, z)), above) in pixels.iter().zip(&longitudes).zip(above.iter().skip(1))
            {
                let energy = f64::from(pixel.luminance()) * solid_angle;
                let light = DVec3::new(pixel.r.into(), pixel.g.into(), pixel.b.into());
                row = row.plus(&Sum {
                    energy,
                    moment: DVec3::new(x * sin, cos, z * sin) * energy,
                    light: light * solid_angle,
                });
                below.push(above.plus(&row));
            }
            corners.extend_from_slice(&below);
            above = below;
        }
        Sums {
            width,
            height,
            corners,
        }
    }

    fn corner(&self, x: usize, y: usize) -> Sum {
        let corner = self.corners.get(y * (self.width + 1) + x);
        corner.copied().unwrap_or_default()
    }

    fn sum(&self, cell: Cell) -> Sum {
        let ((left, right), (top, bottom)) = (cell.columns, cell.rows);
        let [a, b] = [self.corner(right, bottom), self.corner(left, top)];
        let [c, d] = [self.corner(left, bottom), self.corner(right, top)];
        a.plus(&b).minus(&c.plus(&d))
    }

    fn has_energy(&self, cell: Cell) -> bool {
        let all = self.corner(self.width, self.height).energy;
        self.sum(cell).energy > all * NOTHING
    }

    /// A cell without black columns and rows at its sides as a part; `None` where all of it is black.
    fn part(&self, cell: Cell) -> Option<Part> {
        let ((left, right), (top, bottom)) = (cell.columns, cell.rows);
        let column = |x: &usize| {
            self.has_energy(Cell {
                columns: (*x, *x + 1),
                ..cell
            })
        };
        let columns = (
            (left..right).find(column)?,
            (left..right).rfind(column)? + 1,
        );
        let cell = Cell { columns, ..cell };
        let row = |y: &usize| {
            self.has_energy(Cell {
                rows: (*y, *y + 1),
                ..cell
            })
        };
        let rows = ((top..bottom).find(row)?, (top..bottom).rfind(row)? + 1);
        let cell = Cell { rows, ..cell };
        Some(Part {
            cell,
            energy: self.sum(cell).energy,
            is_small: columns.1 - columns.0 <= SMALLEST && rows.1 - rows.0 <= SMALLEST,
            light: self.light(cell),
        })
    }

    /// A cell cut where its energy is nearest to halved, across its longer side; `None` for a single pixel.
    fn halves(&self, cell: Cell) -> Option<[Cell; 2]> {
        let ((left, right), (top, bottom)) = (cell.columns, cell.rows);
        let middle_row = 0.5 * (top + bottom) as f64;
        let cos_elevation = colatitude(middle_row, self.height as u32).0;
        let (width, height) = ((right - left) as f64 * cos_elevation, (bottom - top) as f64);
        let is_wide = (width >= height || bottom - top == 1) && right - left > 1;
        let at = |place: usize| match is_wide {
            true => [(left, place), (place, right)].map(|columns| Cell { columns, ..cell }),
            false => [(top, place), (place, bottom)].map(|rows| Cell { rows, ..cell }),
        };
        let (first, last) = if is_wide {
            (left, right)
        } else {
            (top, bottom)
        };
        let imbalance = |place: &usize| {
            let [a, b] = at(*place).map(|half| self.sum(half).energy);
            (a - b).abs()
        };
        let places = first + 1..last;
        places
            .min_by(|a, b| imbalance(a).total_cmp(&imbalance(b)))
            .map(at)
    }

    fn light(&self, cell: Cell) -> DistantLight {
        let sum = self.sum(cell);
        let ((left, right), (top, bottom)) = (cell.columns, cell.rows);
        let [x, y] = [left + right, top + bottom].map(|sum| 0.5 * sum as f64);
        // A cell about all of the equator may have its centre of energy in the middle of the sphere.
        let (sin, cos) = colatitude(y, self.height as u32);
        let longitude = PI * (2.0 * x / self.width as f64 - 1.0);
        let middle = DVec3::new(sin * libm::cos(longitude), cos, sin * libm::sin(longitude));
        let to_light = (sum.moment / sum.energy).normalize_or(middle);
        let [r, g, b] = (sum.light / PI).max(DVec3::ZERO).as_vec3().to_array();
        DistantLight {
            to_light: to_light.as_vec3().normalize_or(Vec3::Y),
            irradiance: Rgb::new(r, g, b),
        }
    }
}

impl Sum {
    fn plus(&self, other: &Sum) -> Sum {
        Sum {
            energy: self.energy + other.energy,
            moment: self.moment + other.moment,
            light: self.light + other.light,
        }
    }

    fn minus(&self, other: &Sum) -> Sum {
        Sum {
            energy: self.energy - other.energy,
            moment: self.moment - other.moment,
            light: self.light - other.light,
        }
    }
}
