use super::*;
use std::f64::consts::{FRAC_PI_2, PI};

const ROUGHNESSES: [f32; 10] = [0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0];

/// The unit vector at this cosine to +z and angle about it.
fn toward(cos: f64, phi: f64) -> Vec3 {
    let sin = (1.0 - cos * cos).max(0.0).sqrt();
    Vec3::new(
        (sin * phi.cos()) as f32,
        (sin * phi.sin()) as f32,
        cos as f32,
    )
}

/// What comes back of light of radiance 1 from everywhere: the lobe summed over half vectors, which lie densest about the
/// normal.
pub(in crate::shade) fn furnace(facets: &Facets, cos_view: f64) -> f64 {
    const SLOPES: u32 = 128;
    const DIRECTIONS: u32 = 128;
    let v = toward(cos_view, 0.0);
    let mut sum = 0.0;
    for i in 0..SLOPES {
        let t = (f64::from(i) + 0.5) / f64::from(SLOPES);
        let theta = FRAC_PI_2 * t * t * t;
        let across = 3.0 * FRAC_PI_2 * t * t / f64::from(SLOPES);
        for j in 0..DIRECTIONS {
            let phi = PI * (f64::from(j) + 0.5) / f64::from(DIRECTIONS);
            let h = toward(theta.cos(), phi);
            let cos_both = v.dot(h);
            if cos_both <= 0.0 {
                continue;
            }
            let l = (h * (2.0 * cos_both) - v).normalize();
            // `reflected` gives radiance times π. The other side of the viewer's plane is alike.
            let light = f64::from(reflected(facets, Vec3::Z, l, v, Rgb::WHITE).g) / PI;
            let solid = 2.0 * theta.sin() * across * PI / f64::from(DIRECTIONS);
            sum += light * 4.0 * f64::from(cos_both) * solid;
        }
    }
    sum
}

fn white(roughness: f32) -> Facets {
    Facets::new(Rgb::WHITE, 1.0, roughness)
}

#[test]
fn no_energy_is_made() {
    for roughness in ROUGHNESSES {
        for cos in [0.05, 0.1, 0.2, 0.4, 0.6, 0.8, 1.0] {
            let back = furnace(&white(roughness), cos);
            assert!(back <= 1.02, "roughness {roughness}, n.v {cos}: {back}");
        }
    }
}

#[test]
fn what_is_lost_is_what_the_head_of_the_file_says() {
    for (cos, percent) in [
        (1.0, [0.0, 0.0, 0.0, 0.0, 0.0, 0.7, 7.4, 24.9, 51.0, 62.5]),
        (0.6, [0.0, 0.0, 0.0, 0.1, 1.9, 6.0, 10.6, 17.0, 31.5, 41.7]),
        (0.3, [0.0, 0.0, 0.4, 3.7, 6.9, 7.7, 7.7, 8.5, 14.3, 20.7]),
        (0.1, [0.0, 1.5, 6.5, 6.0, 4.5, 3.4, 2.8, 2.9, 4.5, 6.9]),
    ] {
        for (roughness, percent) in ROUGHNESSES.into_iter().zip(percent) {
            let lost = 100.0 * (1.0 - furnace(&white(roughness), cos));
            assert!((lost - percent).abs() < 0.3, "{roughness} {cos}: {lost}");
        }
    }
}

#[test]
fn the_table_is_the_sum_of_the_lobe() {
    for roughness in [0.1, 0.15, 0.25, 0.35, 0.5, 0.65, 0.75, 0.85, 0.9, 0.95, 1.0] {
        let ends = [
            Facets::new(Rgb::WHITE, 0.0, roughness),
            Facets::new(Rgb::BLACK, 1.0, roughness),
        ];
        for cos in [0.02, 0.05, 0.1, 0.2, 0.35, 0.5, 0.7, 0.9, 1.0] {
            let summed = ends.map(|facets| furnace(&facets, cos) as f32);
            let table = albedo(cos as f32, roughness);
            let far = if roughness < 0.15 && cos < 0.1 {
                0.02
            } else {
                0.01
            };
            for (summed, table) in summed.into_iter().zip(table) {
                assert!(
                    (summed - table).abs() < far,
                    "roughness {roughness}, n.v {cos}: {summed} {table}"
                );
            }
        }
    }
}

#[test]
fn the_table_never_makes_light() {
    for i in 0..=64u8 {
        for j in 0..=64u8 {
            let [a, b] = albedo(f32::from(i) / 64.0, f32::from(j) / 64.0);
            assert!(
                a >= 0.0 && b >= 0.0 && a + b <= 1.0 + 1e-6,
                "{i} {j}: {a} {b}"
            );
        }
    }
}

#[test]
fn without_roughness_the_table_is_schlicks_formula() {
    for i in 0..=100u8 {
        let cos = f32::from(i) / 100.0;
        let edge = (1.0 - cos) * (1.0 - cos) * (1.0 - cos) * (1.0 - cos) * (1.0 - cos);
        let [a, b] = albedo(cos, 0.0);
        assert!((a - (1.0 - edge)).abs() < 1e-6 && (b - edge).abs() < 1e-6);
    }
    assert_eq!(albedo(0.0, 0.0), [0.0, 1.0]);
}

#[test]
fn light_and_viewer_may_change_places() {
    for roughness in ROUGHNESSES {
        let facets = Facets::new(Rgb::new(1.0, 0.7, 0.3), 0.9, roughness);
        for (a, b) in [(0.9, 0.2), (0.5, 0.45), (0.02, 0.8), (0.1, 0.05)] {
            let (l, v) = (toward(a, 0.0), toward(b, 2.9));
            let there = reflected(&facets, Vec3::Z, l, v, Rgb::WHITE).g / l.z;
            let back = reflected(&facets, Vec3::Z, v, l, Rgb::WHITE).g / v.z;
            assert!((there - back).abs() <= 1e-5 * there, "{there} {back}");
        }
    }
}

/// Where `f`, which falls, is half of what it is at 0: an angle from 0 to a right one.
fn half_width(f: impl Fn(f64) -> f64) -> f64 {
    let (mut inside, mut outside) = (0.0, FRAC_PI_2);
    for _ in 0..60 {
        let between = 0.5 * (inside + outside);
        if f(between) > 0.5 * f(0.0) {
            inside = between;
        } else {
            outside = between;
        }
    }
    inside
}

#[test]
fn a_highlight_is_as_wide_as_ggxs() {
    for step in 2..=16u8 {
        let roughness = f32::from(step) * 0.05;
        let alpha = f64::from(roughness) * f64::from(roughness);
        let ggx = half_width(|theta| {
            let root = theta.cos() * theta.cos() * (alpha * alpha - 1.0) + 1.0;
            alpha * alpha / (PI * root * root)
        });
        // The light behind the viewer: the half vector is their direction, and nothing is in shadow.
        let ours = half_width(|theta| {
            let v = toward(theta.cos(), 0.0);
            f64::from(reflected(&white(roughness), Vec3::Z, v, v, Rgb::WHITE).r) * theta.cos()
        });
        let off = ours / ggx - 1.0;
        assert!(off.abs() < 0.02, "roughness {roughness}: {ours} {ggx}");
    }
}

#[test]
fn a_highlight_is_as_high_as_its_formula() {
    // l = v = n: D / 4, of which the paper's units are π times: (s + 2) / 8.
    for roughness in [0.2, 0.5, 1.0] {
        let facets = Facets::new(Rgb::new(1.0, 0.5, 0.25), 1.0, roughness);
        let lit = reflected(&facets, Vec3::Y, Vec3::Y, Vec3::Y, Rgb::grey(2.0));
        let height = (exponent(roughness) + 2.0) / 4.0;
        assert!((lit.r / height - 1.0).abs() < 1e-5 && (lit.b / height - 0.25).abs() < 1e-5);
    }
}

#[test]
fn a_metals_highlight_has_its_colour_and_is_white_at_the_edge() {
    let gold = Facets::new(Rgb::new(1.0, 0.766, 0.336), 1.0, 0.3);
    let mirrored = |cos| {
        let lit = reflected(
            &gold,
            Vec3::Z,
            toward(cos, 0.0),
            toward(cos, PI),
            Rgb::WHITE,
        );
        (lit.g / lit.r, lit.b / lit.r)
    };
    let (green, blue) = mirrored(1.0);
    assert!((green - 0.766).abs() < 1e-5 && (blue - 0.336).abs() < 1e-5);
    // 0.336 + 0.664 (1 - 1/2)^5.
    assert!((mirrored(0.5).1 - 0.356_75).abs() < 1e-5);
    assert!(mirrored(0.01).1 > 0.95);
}

#[test]
fn no_highlight_leaks_through_from_behind_and_none_is_no_number() {
    let facets = white(0.1);
    let behind = Vec3::new(0.8, -0.6, 0.0);
    assert_eq!(
        reflected(&facets, Vec3::Y, behind, Vec3::Y, Rgb::WHITE),
        Rgb::BLACK
    );
    let hair = 1e-30;
    for (l, v) in [
        (Vec3::new(1.0, hair, 0.0), Vec3::NEG_X),
        (Vec3::new(1.0, hair, 0.0), Vec3::X),
        (Vec3::new(1.0, hair, 0.0), Vec3::Y),
        (Vec3::Y, Vec3::NEG_Y),
        (Vec3::Y, behind),
        (Vec3::ZERO, Vec3::ZERO),
    ] {
        assert!(reflected(&facets, Vec3::Y, l, v, Rgb::WHITE).is_finite());
    }
}

#[test]
fn exponents_and_roughnesses_are_each_others_inverse() {
    for roughness in [0.02, 0.1, 0.3, 0.5, 0.7, 0.9] {
        let back = roughness_of(exponent(roughness));
        assert!((back - roughness).abs() < 1e-4, "{roughness}: {back}");
    }
    // (√2 - 1) α² / (1 - α²) = 1 where α² = 1 / √2.
    let widest = 0.5f32.sqrt().sqrt().sqrt();
    assert!((roughness_of(0.0) - widest).abs() < 1e-6);
    assert_eq!((exponent(1.0), exponent(0.0)), (0.0, f32::INFINITY));
    assert_eq!(roughness_of(f32::INFINITY), 0.0);
    assert!(roughness_of(f32::MAX) < 1e-3 && roughness_of(-1.0) == roughness_of(0.0));
}
