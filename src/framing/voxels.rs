//! A coarse grid over faces, through which it is cheap to look in very many directions.

use super::Face;
use crate::geometry::Bounds;
use glam::{DVec3, UVec3};

/// Cells along the longest side.
const CELLS: f64 = 48.0;
/// Points that are put on small faces, and on large ones, about: with more, only every so many are taken.
const POINTS: f64 = 5e5;
/// A face on which there are more points is large.
const LARGE: f64 = 100.0;
/// A side of a cell is faced by what is turned toward it at least so much (a cosine); by a way that grazes it, too.
const FACING: f64 = 0.3;
const GRAZING: f64 = 0.05;
/// Steps along a ray, in cells.
const STEP: f64 = 0.6;

/// What faces do in a cell: a bit for each side of the cell, +x, -x, +y, -y, +z, -z.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Cell {
    /// Toward which sides fronts face.
    fronts: u8,
    /// Toward which sides backs face that are seen.
    backs: u8,
    /// Whether something in it is not clear.
    is_opaque: bool,
    /// How many faces have their middle in it.
    pub(super) faces: u32,
}

impl Cell {
    pub(super) fn is_empty(&self) -> bool {
        self.fronts | self.backs == 0
    }
}

/// What a ray meets first.
#[derive(Clone, Copy, Debug)]
pub(super) struct Met {
    pub(super) distance: f64,
    /// Whether it is the front of something.
    pub(super) is_front: bool,
}

/// The cells over a box.
#[derive(Clone, Debug)]
pub(super) struct Voxels {
    pub(super) min: DVec3,
    pub(super) max: DVec3,
    /// The side of a cell.
    pub(super) side: f64,
    /// The corner of the first cell: there is a layer of empty cells around the box.
    corner: DVec3,
    counts: UVec3,
    cells: Vec<Cell>,
}

impl Voxels {
    /// The faces' cells; `None` where the box has no volume to look through.
    pub(super) fn of(faces: &[Face], bounds: &Bounds) -> Option<Voxels> {
        let (min, max) = (bounds.min.as_dvec3(), bounds.max.as_dvec3());
        let size = max - min;
        let side = size.max_element() / CELLS;
        if bounds.is_empty() || size.min_element() <= 2.0 * side {
            return None;
        }
        let counts = (size / side).floor().as_uvec3() + 3;
        let mut voxels = Voxels {
            min,
            max,
            side,
            corner: min - side,
            counts,
            cells: vec![Cell::default(); counts.element_product() as usize],
        };
        // Half a cell apart, so that no cell that a face crosses is left empty.
        let points = |face: &Face| {
            let [a, b, c] = face.points();
            let along = |edge: DVec3| libm::ceil(2.0 * edge.length() / side).max(1.0);
            (along(b - a), along(c - a))
        };
        // Of walls, which are few and large, none is missed for the sake of the many and small.
        let is_large = |face: &Face| {
            let (rows, columns) = points(face);
            rows * columns > LARGE
        };
        for large in [false, true] {
            let of_size = faces.iter().filter(|face| is_large(face) == large);
            let counts = of_size.clone().map(points);
            let total: f64 = counts.map(|(rows, columns)| rows * columns).sum();
            let every = libm::ceil(total / POINTS).max(1.0) as usize;
            for face in of_size.step_by(every) {
                voxels.add(face, points(face));
            }
        }
        Some(voxels)
    }

    fn add(&mut self, face: &Face, (rows, columns): (f64, f64)) {
        let [a, b, c] = face.points();
        let normal = face.area_normal().normalize_or_zero();
        let (fronts, mut backs) = (sides(normal, FACING), 0);
        if face.double_sided {
            backs = sides(-normal, FACING);
        }
        for row in 0..=rows as u32 {
            let v = f64::from(row) / rows;
            for column in 0..=columns as u32 {
                let w = (1.0 - v) * f64::from(column) / columns;
                let at = self.index(a + (b - a) * v + (c - a) * w);
                if let Some(cell) = at.and_then(|at| self.cells.get_mut(at)) {
                    cell.fronts |= fronts;
                    cell.backs |= backs;
                    cell.is_opaque |= !face.is_clear;
                }
            }
        }
        let at = self.index((a + b + c) / 3.0);
        if let Some(cell) = at.and_then(|at| self.cells.get_mut(at)) {
            cell.faces += 1;
        }
    }

    /// The number of the cell around a point.
    fn index(&self, point: DVec3) -> Option<usize> {
        let place = (point - self.corner) / self.side;
        // Written to be false for NaN.
        let is_within = place.cmpge(DVec3::ZERO).all() && place.cmplt(self.counts.as_dvec3()).all();
        if !is_within {
            return None;
        }
        let UVec3 { x, y, z } = place.as_uvec3();
        Some(((z * self.counts.y + y) * self.counts.x + x) as usize)
    }

    /// The cell around a point; an empty one outside.
    pub(super) fn at(&self, point: DVec3) -> Cell {
        let at = self.index(point);
        at.and_then(|at| self.cells.get(at))
            .copied()
            .unwrap_or_default()
    }

    /// Every cell with faces' middles in it, and its own middle.
    pub(super) fn filled(&self) -> impl Iterator<Item = (DVec3, Cell)> + Clone {
        let (columns, rows) = (self.counts.x as usize, self.counts.y as usize);
        let middle = move |at: usize| {
            let place = [at % columns, at / columns % rows, at / columns / rows];
            DVec3::from_array(place.map(|x| x as f64 + 0.5)) * self.side + self.corner
        };
        let cells = self.cells.iter().enumerate();
        cells
            .filter(|(_, cell)| cell.faces > 0)
            .map(move |(at, cell)| (middle(at), *cell))
    }

    /// The first thing that is seen from a point along a unit direction, within a distance.
    pub(super) fn meets(&self, from: DVec3, direction: DVec3, within: f64) -> Option<Met> {
        let toward_eye = sides(-direction, GRAZING);
        self.along(from, direction, within)
            .find_map(|(distance, cell)| {
                let is_seen = (cell.fronts | cell.backs) & toward_eye != 0;
                is_seen.then_some(Met {
                    distance,
                    is_front: cell.fronts & toward_eye != 0,
                })
            })
    }

    /// The first thing from a point along a unit direction, whether it is seen or not.
    pub(super) fn bumps_into(&self, from: DVec3, direction: DVec3) -> Option<Met> {
        let toward_eye = sides(-direction, GRAZING);
        let mut cells = self.along(from, direction, f64::INFINITY);
        let (distance, cell) = cells.find(|(_, cell)| !cell.is_empty())?;
        Some(Met {
            distance,
            is_front: cell.fronts & toward_eye != 0,
        })
    }

    /// Whether a point is seen from afar, by a viewer in this direction.
    pub(super) fn is_seen_from(&self, point: DVec3, towards_viewer: DVec3) -> bool {
        // What is in the cell itself and the next does not hide it.
        let start = point + towards_viewer * (2.0 * self.side);
        let toward_viewer = sides(towards_viewer, GRAZING);
        let mut cells = self.along(start, towards_viewer, f64::INFINITY);
        !cells.any(|(_, cell)| cell.is_opaque && (cell.fronts | cell.backs) & toward_viewer != 0)
    }

    fn along(
        &self,
        from: DVec3,
        direction: DVec3,
        within: f64,
    ) -> impl Iterator<Item = (f64, Cell)> {
        let step = STEP * self.side;
        let distances = (0u32..).map(move |number| f64::from(number) * step);
        distances
            .take_while(move |&distance| distance < within)
            .map_while(move |distance| {
                let at = self.index(from + direction * distance)?;
                Some((distance, *self.cells.get(at)?))
            })
    }
}

/// The sides of a cell that a direction is turned toward, by at least a cosine.
fn sides(direction: DVec3, least: f64) -> u8 {
    let one = |x: f64, bit: u8| {
        let (positive, negative) = (u8::from(x > least), u8::from(x < -least));
        positive << bit | negative << (bit + 1)
    };
    one(direction.x, 0) | one(direction.y, 2) | one(direction.z, 4)
}
