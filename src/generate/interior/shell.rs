//! The room itself and what belongs to it. Lengths are metres, `y` is up.

use super::parts::{add_box, add_patch, add_quad, add_ring, add_turned, v};
use super::{Finish, Room};
use crate::generate::Random;
use glam::Vec3;

/// Floor, ceiling and four walls, one with a window, and skirting along them: a few triangles as large as the room.
pub(super) fn shell(room: &mut Room, size: Vec3) {
    let (w, h, d) = (size.x, size.y, size.z);
    add_quad(
        room.of(Finish::Floor),
        v(0.0, 0.0, 0.0),
        v(0.0, 0.0, d),
        v(w, 0.0, 0.0),
    );
    let walls = room.of(Finish::Wall);
    add_quad(walls, v(0.0, h, 0.0), v(w, 0.0, 0.0), v(0.0, 0.0, d));
    add_quad(walls, v(0.0, 0.0, d), v(0.0, h, 0.0), v(w, 0.0, 0.0));
    add_quad(walls, v(0.0, 0.0, 0.0), v(0.0, h, 0.0), v(0.0, 0.0, d));
    add_quad(walls, v(w, 0.0, 0.0), v(0.0, 0.0, d), v(0.0, h, 0.0));
    // Around the window in the wall at z = 0: below, above, left, right.
    let [left, right, sill, lintel] = WINDOW;
    for (x0, x1, y0, y1) in [
        (0.0, w, 0.0, sill),
        (0.0, w, lintel, h),
        (0.0, left, sill, lintel),
        (right, w, sill, lintel),
    ] {
        add_quad(
            walls,
            v(x0, y0, 0.0),
            v(x1 - x0, 0.0, 0.0),
            v(0.0, y1 - y0, 0.0),
        );
    }
    let wood = room.of(Finish::Wood);
    add_box(wood, v(0.0, 0.0, 0.0), v(w, 0.08, 0.015));
    add_box(wood, v(0.0, 0.0, d - 0.015), v(w, 0.08, d));
    add_box(wood, v(0.0, 0.0, 0.015), v(0.015, 0.08, d - 0.015));
    add_box(wood, v(w - 0.015, 0.0, 0.015), v(w, 0.08, d - 0.015));
}

/// Left, right, below, above.
const WINDOW: [f32; 4] = [1.6, 3.6, 0.9, 2.2];

/// A frame with glazing bars and a handle, and a curtain in folds on either side.
pub(super) fn window(room: &mut Room) {
    let [left, right, sill, lintel] = WINDOW;
    let frame = room.of(Finish::Wood);
    let bar = |x0, x1, y0, y1| (v(x0, y0, -0.04), v(x1, y1, 0.04));
    let middle = (left + right) / 2.0;
    for (min, max) in [
        bar(left, right, sill, sill + 0.06),
        bar(left, right, lintel - 0.06, lintel),
        bar(left, left + 0.06, sill, lintel),
        bar(right - 0.06, right, sill, lintel),
        bar(middle - 0.04, middle + 0.04, sill, lintel),
        bar(left, right, 1.54, 1.57),
    ] {
        add_box(frame, min, max);
    }
    add_box(
        frame,
        v(left - 0.1, sill - 0.04, -0.02),
        v(right + 0.1, sill, 0.22),
    );
    add_ring(
        room.of(Finish::Metal),
        v(middle, 1.4, 0.06),
        0.03,
        0.006,
        32,
    );
    add_turned(
        room.of(Finish::Metal),
        v(middle, 1.25, 0.07),
        &[(0.008, 0.0), (0.012, 0.06), (0.008, 0.13)],
        24,
    );
    for (from, to) in [(left - 0.35, left + 0.25), (right - 0.25, right + 0.35)] {
        add_patch(room.of(Finish::Cloth), 97, 13, |i, j| {
            let (s, t) = (i as f32 / 96.0, j as f32 / 12.0);
            let fold = libm::sinf(s * 50.0) * (0.02 + 0.03 * (1.0 - t));
            v(from + (to - from) * s, 0.05 + 2.3 * t, 0.16 + fold)
        });
    }
    let rod = room.of(Finish::Metal);
    add_box(rod, v(left - 0.5, 2.36, 0.14), v(right + 0.5, 2.38, 0.16));
    for k in 0..24 {
        add_ring(
            rod,
            v(left - 0.4 + 0.12 * k as f32, 2.36, 0.15),
            0.02,
            0.003,
            16,
        );
    }
}

/// A rug of soft waves with a fringe of threads at both ends.
pub(super) fn rug(room: &mut Room, at: Vec3) {
    let mut random = Random::new(7);
    let cloth = room.of(Finish::Cloth);
    add_patch(cloth, 61, 41, |i, j| {
        let (x, z) = (i as f32 * 0.04 - 1.2, 0.8 - j as f32 * 0.04);
        at + v(
            x,
            0.012 + 0.004 * libm::sinf(7.0 * x) * libm::sinf(9.0 * z),
            z,
        )
    });
    for k in 0..320 {
        let z = -0.8 + 0.01 * (k / 2) as f32;
        let (x, out) = if k % 2 == 0 { (-1.2, -1.0) } else { (1.2, 1.0) };
        let start = at + v(x, 0.012, z);
        let along = v(out * 0.07, -0.009, 0.02 * random.next_signed());
        add_quad(cloth, start, along, v(0.0, 0.0, -0.002 * out));
    }
}
