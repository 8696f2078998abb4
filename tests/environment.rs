//! Light from all around: closed forms, brute force, and what must not change it.

use glam::{Mat3, Vec3};
use luch::color::Rgb;
use luch::environment::{
    DistantLight, Environment, Equirect, MAX_ROUNDS, Surroundings, sky, studio, uniform,
};
use std::f32::consts::{FRAC_PI_2, PI, TAU};
use std::sync::{Arc, LazyLock};

/// Of each level that the environment is filtered to, and one between two of them.
const ROUGHNESSES: [f32; 9] = [0.0, 0.125, 0.177, 0.25, 0.3, 0.354, 0.5, 0.707, 1.0];

static STUDIO: LazyLock<Surroundings> = LazyLock::new(|| ready(studio()));

fn asked(radiance: Equirect) -> Environment {
    Environment {
        radiance: Arc::new(radiance),
        rotation: 0.0,
        intensity: 1.0,
        lights: 64,
    }
}

fn ready(radiance: Equirect) -> Surroundings {
    Surroundings::new(&asked(radiance))
}

/// The middle of a pixel.
fn direction(x: u32, y: u32, picture: &Equirect) -> Vec3 {
    let longitude = ((x as f32 + 0.5) / picture.width as f32 - 0.5) * TAU;
    let colatitude = (y as f32 + 0.5) / picture.height as f32 * PI;
    let sin = colatitude.sin();
    Vec3::new(
        sin * longitude.cos(),
        colatitude.cos(),
        sin * longitude.sin(),
    )
}

/// A picture whose pixels are what `radiance` says of their middles.
fn painted(width: u32, radiance: impl Fn(Vec3) -> f32) -> Equirect {
    let mut picture = uniform(Rgb::BLACK);
    (picture.width, picture.height) = (width, width / 2);
    picture.pixels = (0..width * width / 2)
        .map(|at| Rgb::grey(radiance(direction(at % width, at / width, &picture))))
        .collect();
    picture
}

/// Each pixel's direction, radiance (green) and solid angle.
fn pixels(picture: &Equirect) -> impl Iterator<Item = (Vec3, f64, f64)> {
    let (width, height) = (picture.width, picture.height);
    picture.pixels.iter().zip(0..).map(move |(pixel, at)| {
        let cos = |row: u32| (f64::from(row) / f64::from(height) * f64::from(PI)).cos();
        let y: u32 = at / width;
        let solid_angle = f64::from(TAU) / f64::from(width) * (cos(y) - cos(y + 1));
        (
            direction(at % width, y, picture),
            f64::from(pixel.g),
            solid_angle,
        )
    })
}

/// Directions all around, about as far from each other everywhere.
fn all_around(count: u32) -> impl Iterator<Item = Vec3> {
    (0..count).map(move |i| {
        let y = 1.0 - (2 * i + 1) as f32 / count as f32;
        let (sin, turn) = ((1.0 - y * y).sqrt(), i as f32 * 2.399_963_2);
        Vec3::new(sin * turn.cos(), y, sin * turn.sin())
    })
}

/// What a white matt surface shows of lights.
fn lit(n: Vec3, lights: &[DistantLight]) -> f32 {
    let of = |light: &DistantLight| light.irradiance.g * n.dot(light.to_light).max(0.0);
    lights.iter().map(of).sum()
}

#[test]
fn in_light_of_one_from_everywhere_everything_shows_one() {
    let furnace = ready(uniform(Rgb::WHITE));
    for d in all_around(50).chain([Vec3::Y, Vec3::NEG_Y, Vec3::NEG_X]) {
        for roughness in ROUGHNESSES {
            let shown = furnace.radiance(d, roughness);
            assert!((shown.r - 1.0).abs() < 1e-5, "{d} {roughness}: {shown:?}");
        }
        assert!((furnace.irradiance(d).g - 1.0).abs() < 1e-5, "{d}");
    }
    for rounds in 1..=MAX_ROUNDS {
        let of_round = |round| furnace.lights(round, rounds).iter().map(|l| l.irradiance.b);
        let all: f32 = (0..rounds).flat_map(of_round).sum();
        assert!((all - 4.0).abs() < 1e-4, "{rounds}: {all}");
    }
}

#[test]
fn under_half_a_white_sky_a_slope_shows_what_lambert_says() {
    let half = ready(painted(128, |d| if d.y > 0.0 { 1.0 } else { 0.0 }));
    for slope in [0.0f32, 0.5, 1.0, FRAC_PI_2, 2.0, 2.5, PI] {
        let n = Vec3::new(slope.sin() * 0.6, slope.cos(), slope.sin() * 0.8);
        let expected = (1.0 + slope.cos()) / 2.0;
        let shown = half.irradiance(n).g;
        assert!(
            (shown - expected).abs() < 2e-3,
            "{slope}: {shown} {expected}"
        );
    }
}

#[test]
fn another_size_has_the_same_energy() {
    let energy = |picture: &Equirect| pixels(picture).map(|(_, l, w)| l * w).sum::<f64>();
    let picture = painted(37 * 2, |d| (3.0 * d.x).exp() + (5.0 * d.y).exp());
    for (width, height) in [(512, 256), (16, 8), (50, 31), (1, 1)] {
        let ratio = energy(&picture.resized(width, height)) / energy(&picture);
        assert!((ratio - 1.0).abs() < 1e-5, "{width} x {height}: {ratio}");
    }
}

#[test]
fn a_rough_mirror_shows_the_mean_over_its_lobe() {
    let picture = studio();
    for roughness in [0.125f32, 0.25, 0.5, 1.0] {
        // The exponent of a lobe as wide as GGX's, once more.
        let a2 = roughness.powi(4);
        let cos2 = 1.0 - (2f32.sqrt() - 1.0) * a2 / (1.0 - a2);
        let s = if cos2 > 0.0 {
            0.5f32.ln() / cos2.sqrt().ln()
        } else {
            0.0
        };
        let exponent = f64::from(s / 4.0 + 1.0);
        for d in all_around(12) {
            let (mut sum, mut weight) = (0.0, 0.0);
            for (toward, radiance, solid_angle) in pixels(&picture) {
                let w = f64::from(d.dot(toward)).max(0.0).powf(exponent) * solid_angle;
                sum += w * radiance;
                weight += w;
            }
            let (expected, shown) = (sum / weight, f64::from(STUDIO.radiance(d, roughness).g));
            let off = (shown - expected).abs() / (expected + 0.1);
            assert!(off < 0.03, "{roughness} {d}: {shown} {expected}");
        }
    }
}

#[test]
fn brightness_falls_all_the_way_from_a_small_bright_spot() {
    let middle = Vec3::new(0.3, 0.5, -0.7).normalize();
    let (side, _) = middle.any_orthonormal_pair();
    let spot = ready(painted(512, |d| {
        if d.dot(middle) > 0.9998 { 1000.0 } else { 0.0 }
    }));
    for roughness in ROUGHNESSES {
        // Below half the lobe's width lies what interpolation does.
        let width = 0.8 * (roughness * roughness).max(1.0 / 64.0);
        let shown = |step: u32| {
            let angle = (step as f32 * width).min(PI);
            let d = middle * angle.cos() + side * angle.sin();
            spot.radiance(d, roughness).g
        };
        let peak = shown(0);
        assert!(peak > 0.0);
        for step in 0..30 {
            let (near, far) = (shown(step), shown(step + 1));
            assert!(
                far <= near && far >= 0.0,
                "{roughness} {step}: {near} {far}"
            );
        }
        assert_eq!(spot.radiance(-middle, roughness).g, 0.0);
    }
}

#[test]
fn neither_the_seam_nor_a_pole_nor_a_level_is_seen() {
    let near = |a: Rgb, b: Rgb| (a.g - b.g).abs() < 2e-3 * (1.0 + a.g);
    let (step, seam) = (1e-5, Vec3::new(-0.8, -0.6, 0.0));
    for roughness in ROUGHNESSES {
        for (a, b) in [
            (seam + Vec3::Z * step, seam - Vec3::Z * step),
            (Vec3::new(step, 1.0, 0.0), Vec3::new(-step, 1.0, step)),
            (Vec3::new(step, -1.0, 0.0), Vec3::new(-step, -1.0, step)),
        ] {
            let [a, b] = [a, b].map(|d| STUDIO.radiance(d.normalize(), roughness));
            assert!(near(a, b), "{roughness}: {a:?} {b:?}");
        }
        for d in all_around(40) {
            let [a, b] = [-1e-5, 1e-5].map(|off| STUDIO.radiance(d, roughness + off));
            assert!(near(a, b), "{roughness} {d}: {a:?} {b:?}");
        }
    }
}

#[test]
fn lights_have_about_the_same_energy() {
    let energies = || STUDIO.lights(0, 1).iter().map(|light| light.irradiance.g);
    let (least, most) = (
        energies().fold(9.0, f32::min),
        energies().fold(0.0, f32::max),
    );
    assert_eq!(energies().count(), 64);
    assert!(most < 2.0 * least, "{least} {most}");
    let (all, picture) = (energies().sum::<f32>(), studio());
    let expected: f64 = pixels(&picture)
        .map(|(_, l, w)| l * w / f64::from(PI))
        .sum();
    assert!(
        (f64::from(all) - expected).abs() < 1e-4 * expected,
        "{all} {expected}"
    );
}

#[test]
fn each_round_has_lights_of_its_own_that_stand_for_all() {
    for (rounds, most_on_average) in [(1, 0.01), (2, 0.06), (3, 0.16), (4, 0.12)] {
        let mut seen: Vec<DistantLight> = Vec::new();
        for round in 0..rounds {
            let lights = STUDIO.lights(round, rounds);
            assert!(lights.iter().all(|light| !seen.contains(light)));
            seen.extend_from_slice(lights);
            let off = |n: Vec3| {
                let expected = STUDIO.irradiance(n).g;
                (lit(n, lights) * rounds as f32 - expected).abs() / expected
            };
            let mean = all_around(200).map(off).sum::<f32>() / 200.0;
            assert!(mean < most_on_average, "{round} of {rounds}: {mean}");
        }
        assert_eq!(seen.len(), 64);
    }
    assert_eq!(STUDIO.lights(5, 4), STUDIO.lights(1, 4));
    assert_eq!(STUDIO.lights(3, 9), STUDIO.lights(3, 4));
    assert_eq!(STUDIO.lights(7, 0), STUDIO.lights(0, 1));
}

#[test]
fn each_round_has_its_share_of_the_sun() {
    let sun = Vec3::new(0.4, 0.6, -0.3).normalize();
    let surroundings = ready(sky(sun));
    let of_sun = |round, rounds| {
        let lights = surroundings.lights(round, rounds).iter();
        let near = lights.filter(|light| light.to_light.dot(sun) > 0.999);
        near.map(|light| light.irradiance.g).sum::<f32>()
    };
    let all = of_sun(0, 1);
    assert!(all > 0.5, "{all}");
    for round in 0..4 {
        let share = of_sun(round, 4) / all;
        assert!((share - 0.25).abs() < 0.02, "{share}");
    }
}

#[test]
fn a_turned_environment_is_one_whose_columns_moved() {
    let picture = painted(512, |d| 1.0 + d.x + 0.5 * (7.0 * d.z).sin() + d.y * d.x);
    let mut moved = picture.clone();
    // A column farther left is one farther about +Y, against +Z.
    moved
        .pixels
        .chunks_mut(512)
        .for_each(|row| row.rotate_left(72));
    let angle = 72.0 / 512.0 * TAU;
    let rotation = |rotation| Environment {
        rotation,
        ..asked(picture.clone())
    };
    let [still, turned] = [0.0, angle].map(|angle| Surroundings::new(&rotation(angle)));
    let moved = ready(moved);
    for d in all_around(100) {
        for roughness in ROUGHNESSES {
            let [a, b] = [&turned, &moved].map(|of| of.radiance(d, roughness).g);
            assert!((a - b).abs() < 1e-3, "{d} {roughness}: {a} {b}");
        }
    }
    // +Z comes to +X after a quarter.
    let turn = Mat3::from_rotation_y(angle);
    for (before, after) in still.lights(0, 1).iter().zip(turned.lights(0, 1)) {
        assert!((turn * before.to_light).abs_diff_eq(after.to_light, 1e-5));
        assert_eq!(before.irradiance, after.irradiance);
    }
}

#[test]
fn a_studio_is_neutral_and_lights_from_the_upper_left() {
    let picture = studio();
    assert!(
        picture
            .pixels
            .iter()
            .all(|p| p.r == p.g && p.g == p.b && p.r > 0.0)
    );
    // The default viewer: 35 degrees from +Z toward +X, slightly from above.
    let viewer = Vec3::new(0.532, 0.375, 0.760).normalize();
    let right = Vec3::Y.cross(viewer).normalize();
    let up = viewer.cross(right);
    let (mut lit_side, mut count) = (0.0, 0.0);
    for n in all_around(500) {
        let shown = STUDIO.irradiance(n).g;
        assert!((0.3..1.15).contains(&shown), "{n}: {shown}");
        if n.dot(viewer) > 0.0 && n.dot(up - right) > 0.0 {
            (lit_side, count) = (lit_side + shown, count + 1.0);
        }
    }
    assert!(
        (0.8..0.9).contains(&(lit_side / count)),
        "{}",
        lit_side / count
    );
}

#[test]
fn a_sky_is_as_bright_as_white_and_always_a_sky() {
    let level = |sun: Vec3| ready(sky(sun)).irradiance(Vec3::Y);
    let noon = level(Vec3::new(0.6, 1.0, 0.8).normalize());
    for channel in [noon.r, noon.g, noon.b] {
        assert!((channel - 1.0).abs() < 0.02, "{noon:?}");
    }
    let dusk = level(Vec3::new(1.0, 0.0, 0.0));
    assert!(dusk.g > 0.001 && dusk.g < 0.2, "{dusk:?}");
    for odd in [
        Vec3::Y,
        Vec3::NEG_Y,
        Vec3::new(0.0, -0.6, 0.8),
        Vec3::ZERO,
        Vec3::NAN,
    ] {
        let pixels = sky(odd).pixels;
        assert!(
            pixels
                .iter()
                .all(|p| p.is_finite() && p.r >= 0.0 && p.g > 0.0),
            "{odd}"
        );
    }
}

#[test]
fn numbers_that_make_no_sense_make_no_light() {
    let of = |width, height, pixels| Equirect {
        width,
        height,
        pixels,
    };
    let bad = vec![Rgb::new(f32::NAN, -1.0, f32::INFINITY), Rgb::grey(1e38)];
    for (picture, rotation, intensity, lights) in [
        (of(0, 7, vec![]), 0.0, 1.0, 0),
        (of(3, 2, bad), 1e30, 1.0, u32::MAX),
        (of(1, 1, vec![]), 0.0, 1.0, 3),
        (of(2, 9, vec![Rgb::WHITE]), f32::NAN, 1.0, 5),
        (uniform(Rgb::WHITE), 0.0, f32::NAN, 64),
    ] {
        let asked = Environment {
            radiance: Arc::new(picture),
            rotation,
            intensity,
            lights,
        };
        let surroundings = Surroundings::new(&asked);
        for d in [Vec3::X, Vec3::Y, Vec3::NEG_Z] {
            let shown = [0.0, 0.4, f32::NAN].map(|roughness| surroundings.radiance(d, roughness));
            assert!(
                shown.iter().all(|shown| shown.is_finite()),
                "{asked:?}: {shown:?}"
            );
        }
        for round in 0..4 {
            let finite = |l: &DistantLight| l.to_light.is_normalized() && l.irradiance.is_finite();
            assert!(
                surroundings.lights(round, 4).iter().all(finite),
                "{asked:?}"
            );
        }
    }
}

#[test]
fn any_number_of_threads_makes_the_same_bits() {
    let of = |threads| {
        let pool = rayon::ThreadPoolBuilder::new().num_threads(threads).build();
        pool.map(|pool| pool.install(|| ready(sky(Vec3::new(0.1, 0.7, 0.2)))))
    };
    let (Ok(one), Ok(three)) = (of(1), of(3)) else {
        panic!("no threads");
    };
    for d in all_around(500) {
        for roughness in ROUGHNESSES {
            assert_eq!(one.radiance(d, roughness), three.radiance(d, roughness));
        }
    }
    assert_eq!(one.lights(0, 1), three.lights(0, 1));
}
