//! `[environment]`.

use super::{assert_error, with};
use luch::color::Rgb;
use luch::load::{EnvironmentChoice, EnvironmentLight, sun};
use std::path::Path;

#[test]
fn an_environment_says_what_sends_light_from_all_around() {
    assert_eq!(with("").environment, EnvironmentChoice::default());
    for (entries, light) in [
        ("kind = \"studio\"", EnvironmentLight::Studio),
        ("kind = \"sky\"", EnvironmentLight::sky()),
        (
            "kind = \"sky\"\nsun = [90, 30]",
            EnvironmentLight::Sky {
                sun: sun(90.0, 30.0),
            },
        ),
        (
            "kind = \"color\"\ncolor = [1, 2, 3]",
            EnvironmentLight::Color(Rgb::new(1.0, 2.0, 3.0)),
        ),
        (
            "kind = \"file\"\npath = \"sky.hdr\"",
            EnvironmentLight::File(Path::new("sky.hdr").into()),
        ),
    ] {
        let more = "rotation = 180\nintensity = 0.5\nlights = 100";
        let expected = EnvironmentChoice {
            light: Some(light),
            rotation: Some(std::f32::consts::PI),
            intensity: Some(0.5),
            lights: Some(100),
        };
        let found = with(&format!("[environment]\n{entries}\n{more}")).environment;
        assert_eq!(found, expected);
    }
}

#[test]
fn the_sun_stands_where_its_angles_say() {
    assert!(sun(90.0, 0.0).abs_diff_eq(glam::Vec3::X, 1e-6));
    assert!(sun(0.0, 30.0).abs_diff_eq(glam::Vec3::new(0.0, 0.5, 0.866_025), 1e-6));
    assert!(sun(12.0, 90.0).abs_diff_eq(glam::Vec3::Y, 1e-6));
}

#[test]
fn an_environment_that_makes_no_sense_is_told_with_its_line() {
    for (entries, line, message) in [
        (
            "",
            1,
            "[environment] has no kind, expected \"studio\", \"sky\", \"color\" or \"file\"",
        ),
        (
            "kind = \"skye\"",
            2,
            "kind in [environment] is \"skye\", expected \"studio\", \"sky\", \"color\" or \"file\"; did you mean \"sky\"?",
        ),
        (
            "kind = \"studio\"\nsun = [0, 0]",
            3,
            "an environment of kind \"studio\" has no sun; remove it",
        ),
        (
            "kind = \"color\"",
            1,
            "[environment] has no color, expected three finite numbers, [red, green, blue], each 0 or more",
        ),
        (
            "kind = \"sky\"\nsun = [0, 91]",
            3,
            "sun in [environment] is [0, 91], expected two angles in degrees, [azimuth, elevation], the latter from -90 to 90",
        ),
        (
            "kind = \"sky\"\nlights = 1025",
            3,
            "lights in [environment] is 1025, expected a whole number from 1 to 1024",
        ),
        (
            "kind = \"sky\"\nrotation = nan",
            3,
            "rotation in [environment] is nan, expected an angle in degrees",
        ),
        (
            "kind = \"sky\"\nturn = 1",
            3,
            "unknown key \"turn\" in [environment]; the nearest known is \"sun\"",
        ),
    ] {
        assert_error(&format!("[environment]\n{entries}"), line, message);
    }
}
