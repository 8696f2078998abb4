//! A laid table, chairs, and a lamp above them, each at its place on the floor (the lamp at its lower rim).

use super::parts::{add_box, add_cushion, add_ring, add_turned, v};
use super::{Finish, Room};
use crate::generate::Random;
use glam::Vec3;

/// A table on four turned legs, laid for four.
pub(super) fn table(room: &mut Room, at: Vec3) {
    let wood = room.of(Finish::Wood);
    add_box(wood, at + v(-0.9, 0.72, -0.5), at + v(0.9, 0.76, 0.5));
    add_box(wood, at + v(-0.8, 0.62, -0.42), at + v(0.8, 0.72, -0.39));
    add_box(wood, at + v(-0.8, 0.62, 0.39), at + v(0.8, 0.72, 0.42));
    let leg = [
        (0.02, 0.0),
        (0.03, 0.02),
        (0.022, 0.06),
        (0.035, 0.2),
        (0.04, 0.3),
        (0.03, 0.4),
        (0.045, 0.5),
        (0.03, 0.52),
        (0.04, 0.72),
    ];
    for (x, z) in [(-0.8, -0.4), (0.8, -0.4), (-0.8, 0.4), (0.8, 0.4)] {
        add_turned(wood, at + v(x, 0.0, z), &leg, 20);
    }
    let top = at + v(0.0, 0.76, 0.0);
    for (x, z) in [(-0.55, -0.27), (0.45, -0.27), (-0.45, 0.27), (0.55, 0.27)] {
        let china = room.of(Finish::China);
        let plate = [
            (0.001, 0.004),
            (0.07, 0.004),
            (0.075, 0.0),
            (0.08, 0.006),
            (0.11, 0.014),
            (0.13, 0.02),
            (0.128, 0.023),
            (0.1, 0.016),
            (0.075, 0.01),
            (0.001, 0.009),
        ];
        add_turned(china, top + v(x, 0.0, z), &plate, 40);
        let cup = [
            (0.025, 0.0),
            (0.028, 0.004),
            (0.032, 0.03),
            (0.038, 0.06),
            (0.04, 0.08),
            (0.037, 0.08),
            (0.034, 0.05),
            (0.028, 0.02),
            (0.001, 0.01),
        ];
        add_turned(china, top + v(x + 0.19, 0.0, z), &cup, 32);
        add_ring(china, top + v(x + 0.235, 0.042, z), 0.02, 0.004, 24);
        let metal = room.of(Finish::Metal);
        add_cushion(
            metal,
            top + v(x - 0.17, 0.006, z),
            v(0.012, 0.003, 0.03),
            1.0,
            16,
        );
        add_box(
            metal,
            top + v(x - 0.173, 0.003, z),
            top + v(x - 0.167, 0.008, z + 0.15),
        );
    }
    bowl_of_fruit(room, top);
}

fn bowl_of_fruit(room: &mut Room, at: Vec3) {
    let arc = |k: u32, radius: f32| {
        let angle = 0.1 + 1.4 * k as f32 / 14.0;
        (
            radius * libm::sinf(angle),
            0.17 - radius * libm::cosf(angle),
        )
    };
    let outside = (0..15).map(|k| arc(k, 0.17));
    let profile: Vec<(f32, f32)> = outside
        .chain((0..15).rev().map(|k| arc(k, 0.165)))
        .collect();
    add_turned(room.of(Finish::China), at, &profile, 48);
    let mut random = Random::new(3);
    for k in 0..7 {
        let angle = k as f32 * 0.9;
        let out = if k == 0 { 0.0 } else { 0.085 };
        let center = at
            + v(
                out * libm::cosf(angle),
                0.075 + 0.02 * random.next_f32(),
                out * libm::sinf(angle),
            );
        add_cushion(
            room.of(Finish::Cloth),
            center,
            v(0.036, 0.034, 0.036),
            1.0,
            24,
        );
    }
}

/// A chair that faces `toward` (1 or -1 along z): turned legs, slats in the back, a cushion.
pub(super) fn chair(room: &mut Room, at: Vec3, toward: f32) {
    let wood = room.of(Finish::Wood);
    let leg = [
        (0.014, 0.0),
        (0.02, 0.1),
        (0.016, 0.12),
        (0.022, 0.3),
        (0.018, 0.44),
    ];
    for (x, z) in [(-0.19, -0.19), (0.19, -0.19), (-0.19, 0.19), (0.19, 0.19)] {
        add_turned(wood, at + v(x, 0.0, z), &leg, 14);
    }
    add_box(wood, at + v(-0.22, 0.43, -0.22), at + v(0.22, 0.455, 0.22));
    let back = at - v(0.0, 0.0, 0.2 * toward);
    let post = [
        (0.018, 0.45),
        (0.015, 0.7),
        (0.02, 0.95),
        (0.012, 0.98),
        (0.02, 1.0),
        (0.001, 1.02),
    ];
    add_turned(wood, back - v(0.19, 0.0, 0.0), &post, 14);
    add_turned(wood, back + v(0.19, 0.0, 0.0), &post, 14);
    for k in 0..4 {
        let y = 0.55 + 0.11 * k as f32;
        add_box(
            wood,
            back + v(-0.18, y, -0.008),
            back + v(0.18, y + 0.06, 0.008),
        );
    }
    add_cushion(
        room.of(Finish::Cloth),
        at + v(0.0, 0.475, 0.0),
        v(0.2, 0.03, 0.2),
        0.45,
        32,
    );
}

/// A lamp that hangs on a chain: a shade open at both ends and a bulb. Light comes from below the bulb.
pub(super) fn hanging_lamp(room: &mut Room, at: Vec3, ceiling: f32) {
    let metal = room.of(Finish::Metal);
    let links = ((ceiling - at.y - 0.2) / 0.025) as u32;
    for k in 0..links {
        add_ring(
            metal,
            at + v(0.0, 0.2 + 0.025 * k as f32, 0.0),
            0.014,
            0.003,
            16,
        );
    }
    let shade: Vec<(f32, f32)> = (0..13)
        .map(|k| (0.22 - 0.012 * k as f32, 0.015 * k as f32))
        .collect();
    add_turned(room.of(Finish::China), at, &shade, 64);
    add_cushion(
        room.of(Finish::China),
        at + v(0.0, 0.1, 0.0),
        v(0.03, 0.045, 0.03),
        1.0,
        24,
    );
}
