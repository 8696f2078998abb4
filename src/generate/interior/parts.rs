//! What furniture is made of: boxes, turned shapes, cushions, sheets.

use crate::mesh::Mesh;
use glam::{Vec2, Vec3};
use std::f64::consts::TAU;

pub(super) const fn v(x: f32, y: f32, z: f32) -> Vec3 {
    Vec3::new(x, y, z)
}

/// A box between two corners, its six sides flat and each with the whole texture once a unit of length.
pub(super) fn add_box(mesh: &mut Mesh, min: Vec3, max: Vec3) {
    let size = max - min;
    for axis in 0..3 {
        let (across, up) = ((axis + 1) % 3, (axis + 2) % 3);
        for far in [false, true] {
            let mut corner = min;
            corner[axis] = if far { max[axis] } else { min[axis] };
            let [mut a, mut b] = [Vec3::ZERO; 2];
            a[across] = size[across];
            b[up] = size[up];
            // Outward: `a x b` points along the axis.
            if far {
                add_quad(mesh, corner, a, b);
            } else {
                add_quad(mesh, corner, b, a);
            }
        }
    }
}

/// The parallelogram at `corner` along `a` and `b`, its front to `a x b`.
pub(super) fn add_quad(mesh: &mut Mesh, corner: Vec3, a: Vec3, b: Vec3) {
    let first = mesh.positions.len() as u32;
    let (right, down) = (a.length(), b.length());
    mesh.positions
        .extend([corner, corner + a, corner + a + b, corner + b]);
    mesh.normals.extend([a.cross(b).normalize_or_zero(); 4]);
    mesh.uvs[0].extend([(0.0, 0.0), (right, 0.0), (right, down), (0.0, down)].map(Vec2::from));
    mesh.triangles
        .extend([[first, first + 1, first + 2], [first, first + 2, first + 3]]);
}

/// A shape turned on a lathe about the vertical through `foot`: (radius, height) from below to above, radii above zero
/// where the shape is not closed by a tip. Its front is outside where heights go up.
pub(super) fn add_turned(mesh: &mut Mesh, foot: Vec3, profile: &[(f32, f32)], around: u32) {
    let rows = profile.len() as u32;
    add_patch(mesh, around + 1, rows, |i, j| {
        let angle = TAU * f64::from(i % around) / f64::from(around);
        let (sin, cos) = (libm::sin(angle) as f32, libm::cos(angle) as f32);
        let (radius, height) = profile[j as usize];
        foot + Vec3::new(radius * cos, height, -radius * sin)
    });
}

/// An ellipsoid with corners: `roundness` 1 is round, less is boxier.
pub(super) fn add_cushion(mesh: &mut Mesh, center: Vec3, half: Vec3, roundness: f64, around: u32) {
    let power = |x: f64| libm::copysign(libm::pow(x.abs(), roundness), x);
    let rows = around / 2 + 1;
    add_patch(mesh, around + 1, rows, |i, j| {
        let east = TAU * f64::from(i % around) / f64::from(around);
        // Not quite from pole to pole: the cap's triangles stay triangles.
        let north = (0.001 + 0.998 * f64::from(j) / f64::from(rows - 1) - 0.5) * TAU / 2.0;
        let ring = power(libm::cos(north));
        let p = [
            ring * power(libm::cos(east)),
            power(libm::sin(north)),
            -ring * power(libm::sin(east)),
        ];
        center + Vec3::from(p.map(|x| x as f32)) * half
    });
}

/// A ring of `around` by 12 facets, its hole along z.
pub(super) fn add_ring(mesh: &mut Mesh, center: Vec3, radius: f32, thickness: f32, around: u32) {
    add_patch(mesh, around + 1, 13, |i, j| {
        let turn = |k: u32, n: u32| {
            let angle = TAU * f64::from(k % n) / f64::from(n);
            (libm::cos(angle) as f32, libm::sin(angle) as f32)
        };
        let ((cos, sin), (out, up)) = (turn(i, around), turn(j, 12));
        let reach = radius + thickness * out;
        center + Vec3::new(reach * cos, reach * sin, thickness * up)
    });
}

/// A grid of vertices with smooth normals; its front is to (along the columns) x (along the rows).
pub(super) fn add_patch(
    mesh: &mut Mesh,
    columns: u32,
    rows: u32,
    point: impl Fn(u32, u32) -> Vec3,
) {
    let first = mesh.positions.len() as u32;
    for j in 0..rows {
        for i in 0..columns {
            // The slopes of the patch at this vertex, from its neighbours. A patch that closes repeats its first
            // column as its last: there the neighbour lies beyond the seam.
            let closed = point(0, j).distance(point(columns - 1, j)) < 1e-6;
            let (left, right) = match (i, closed) {
                (0, true) => (columns - 2, 1),
                (i, true) if i == columns - 1 => (columns - 2, 1),
                (i, _) => (i.saturating_sub(1), (i + 1).min(columns - 1)),
            };
            let across = point(right, j) - point(left, j);
            let up = point(i, (j + 1).min(rows - 1)) - point(i, j.saturating_sub(1));
            mesh.positions.push(point(i, j));
            mesh.normals.push(across.cross(up).normalize_or(Vec3::Y));
            mesh.uvs[0].push(Vec2::new(
                i as f32 / (columns - 1) as f32,
                j as f32 / (rows - 1) as f32,
            ));
        }
    }
    let cells = super::super::grid_triangles(columns, rows);
    let placed = cells
        .into_iter()
        .map(|[a, b, c]| [first + a, first + c, first + b]);
    mesh.triangles.extend(placed);
}
