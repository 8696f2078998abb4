//! What stands along the walls, each thing at its place on the floor.

use super::parts::{add_box, add_cushion, add_patch, add_turned, v};
use super::{Finish, Room};
use crate::generate::Random;
use glam::Vec3;

/// A row of cupboards along the wall at x = `at.x`, each of two doors with panels and handles, and shelves with books above.
pub(super) fn cupboards(room: &mut Room, at: Vec3, count: u32) {
    for k in 0..count {
        let left = at + v(0.0, 0.0, 0.9 * k as f32);
        add_box(
            room.of(Finish::Wood),
            left + v(0.0, 0.09, 0.0),
            left + v(0.4, 0.88, 0.89),
        );
        for side in 0..2 {
            door(
                room,
                left + v(0.4, 0.1, 0.01 + 0.44 * side as f32),
                side == 0,
            );
        }
    }
    let length = 0.9 * count as f32;
    add_box(
        room.of(Finish::Wood),
        at + v(0.0, 0.88, -0.02),
        at + v(0.44, 0.92, length + 0.02),
    );
    let mut random = Random::new(5);
    for shelf in 0..3 {
        let y = 1.35 + 0.38 * shelf as f32;
        add_box(
            room.of(Finish::Wood),
            at + v(0.0, y - 0.025, 0.0),
            at + v(0.26, y, length),
        );
        let mut z = 0.05;
        while z < length - 0.1 {
            let (thickness, height, depth) = (
                0.015 + 0.035 * random.next_f32(),
                0.18 + 0.12 * random.next_f32(),
                0.14 + 0.08 * random.next_f32(),
            );
            let book = at + v(0.02, y, z);
            add_box(
                room.of(Finish::Cloth),
                book,
                book + v(depth, height, thickness),
            );
            // Here and there a gap.
            z += thickness + if random.next_f32() < 0.1 { 0.12 } else { 0.001 };
        }
    }
}

/// A framed panel, 0.43 wide, with hinges and a bent handle at one edge.
fn door(room: &mut Room, at: Vec3, handle_far: bool) {
    let wood = room.of(Finish::Wood);
    let (w, h) = (0.43, 0.76);
    for (z0, z1, y0, y1) in [
        (0.0, w, 0.0, 0.07),
        (0.0, w, h - 0.07, h),
        (0.0, 0.07, 0.07, h - 0.07),
        (w - 0.07, w, 0.07, h - 0.07),
    ] {
        add_box(wood, at + v(0.0, y0, z0), at + v(0.022, y1, z1));
    }
    add_box(
        wood,
        at + v(0.0, 0.07, 0.07),
        at + v(0.01, h - 0.07, w - 0.07),
    );
    add_box(
        wood,
        at + v(0.01, 0.1, 0.1),
        at + v(0.018, h - 0.1, w - 0.1),
    );
    let metal = room.of(Finish::Metal);
    let (handle, hinge) = if handle_far {
        (w - 0.035, 0.0)
    } else {
        (0.035, w)
    };
    let knob = [
        (0.012, -0.07),
        (0.006, -0.06),
        (0.005, 0.0),
        (0.006, 0.06),
        (0.012, 0.07),
    ];
    add_turned(metal, at + v(0.05, 0.55, handle), &knob, 24);
    for y in [0.49, 0.61] {
        add_cushion(
            metal,
            at + v(0.035, y, handle),
            v(0.016, 0.006, 0.006),
            0.8,
            20,
        );
    }
    for y in [0.12, 0.62] {
        add_turned(
            metal,
            at + v(0.024, y, hinge),
            &[(0.005, 0.0), (0.005, 0.05)],
            12,
        );
    }
}

/// A sofa of boxes under soft cushions.
pub(super) fn sofa(room: &mut Room, at: Vec3) {
    let cloth = room.of(Finish::Cloth);
    add_box(cloth, at + v(-1.05, 0.1, -0.42), at + v(1.05, 0.28, 0.42));
    for side in [-1.0, 1.0] {
        add_cushion(
            cloth,
            at + v(0.98 * side, 0.4, 0.0),
            v(0.12, 0.25, 0.44),
            0.4,
            36,
        );
    }
    for k in 0..3 {
        let x = -0.58 + 0.58 * k as f32;
        add_cushion(cloth, at + v(x, 0.35, -0.05), v(0.29, 0.1, 0.38), 0.4, 36);
        add_cushion(cloth, at + v(x, 0.65, 0.3), v(0.29, 0.26, 0.12), 0.5, 36);
    }
    for (x, tilt) in [(-0.7, 0.12), (0.1, 0.16), (0.75, 0.1)] {
        add_cushion(cloth, at + v(x, 0.58, tilt), v(0.2, 0.18, 0.07), 0.6, 36);
    }
}

/// A pot with a plant of long bent leaves.
pub(super) fn plant(room: &mut Room, at: Vec3) {
    let pot = [
        (0.1, 0.0),
        (0.12, 0.02),
        (0.15, 0.2),
        (0.17, 0.3),
        (0.16, 0.3),
        (0.14, 0.24),
        (0.001, 0.24),
    ];
    add_turned(room.of(Finish::China), at, &pot, 40);
    let mut random = Random::new(9);
    for _ in 0..70 {
        let away = random.direction();
        let out = v(away.x, 0.0, away.z).normalize_or(Vec3::X);
        let (reach, height) = (
            0.15 + 0.3 * random.next_f32(),
            0.5 + 0.7 * random.next_f32(),
        );
        let side = out.cross(Vec3::Y) * 0.02;
        add_patch(room.of(Finish::Leaf), 3, 11, |i, j| {
            let t = j as f32 / 10.0;
            let spine = at
                + v(0.0, 0.24, 0.0)
                + out * (reach * t * t + 0.03)
                + Vec3::Y * (height * t * (1.3 - 0.6 * t));
            // Slightly open at the tip: no triangle is empty.
            spine + side * ((i as f32 - 1.0) * (1.02 - t))
        });
    }
}
