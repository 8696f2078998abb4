//! Keys that are unknown, missing or out of place, and names and angles that do not fit each other.

use super::{assert_error, camera_error, error};

#[test]
fn an_unknown_key_is_told_with_its_line_and_the_nearest_known_key() {
    for (more, line, message) in [
        (
            "[[sphere]]\nradus = 1",
            2,
            "unknown key \"radus\" in [[sphere]]; did you mean \"radius\"?",
        ),
        (
            "[[plane]]\nnormals = 1",
            2,
            "unknown key \"normals\" in [[plane]]; did you mean \"normal\"?",
        ),
        (
            "[[light]]\ncolour = 1",
            2,
            "unknown key \"colour\" in [[light]]; did you mean \"color\"?",
        ),
        (
            "[[material]]\n\nspecualr = 1",
            3,
            "unknown key \"specualr\" in [[material]]; did you mean \"specular\"?",
        ),
        (
            "[render]\nwidht = 1",
            2,
            "unknown key \"widht\" in [render]; did you mean \"width\"?",
        ),
        (
            "[background]\ncolour = 1",
            2,
            "unknown key \"colour\" in [background]; did you mean \"color\"?",
        ),
        (
            "[ambient]\nColor = 1",
            2,
            "unknown key \"Color\" in [ambient]; did you mean \"color\"?",
        ),
        (
            "[[lights]]\n",
            1,
            "unknown key \"lights\" in a scene file; did you mean \"light\"?",
        ),
        (
            "[fog]\n",
            1,
            "unknown key \"fog\" in a scene file; the nearest known is \"model\"",
        ),
        (
            "[[material]]\nname = \"b\"\nchecker = { color = [0, 0, 0], sise = 1 }",
            3,
            "unknown key \"sise\" in checker { color, size }; did you mean \"size\"?",
        ),
        (
            "[[sphere]]\nzzz = 1\n\"a\\nb\" = 2",
            2,
            "unknown key \"zzz\" in [[sphere]]; the nearest known is \"center\"",
        ),
        (
            "[[sphere]]\n\"radi\\nus\" = 2",
            2,
            "unknown key \"radi us\" in [[sphere]]; did you mean \"radius\"?",
        ),
    ] {
        assert_error(more, line, message);
    }
    assert_eq!(
        camera_error("lookat = 1"),
        "scene.toml: line 4: unknown key \"lookat\" in [camera]; did you mean \"look_at\"?"
    );
}

#[test]
fn what_must_be_there_is_asked_for_at_the_header() {
    let xyz = "expected three finite numbers, [x, y, z]";
    for (more, message) in [
        (
            "[[material]]\n",
            "[[material]] has no name, expected a text in quotes",
        ),
        ("[[sphere]]\n", &format!("[[sphere]] has no center, {xyz}")),
        (
            "[[sphere]]\ncenter = [0, 0, 0]",
            "[[sphere]] has no radius, expected a finite number above 0",
        ),
        (
            "[[sphere]]\ncenter = [0, 0, 0]\nradius = 1",
            "[[sphere]] has no material, expected the name of a [[material]]",
        ),
        ("[[plane]]\n", &format!("[[plane]] has no point, {xyz}")),
        (
            "[[plane]]\npoint = [0, 0, 0]",
            &format!("[[plane]] has no normal, {xyz}, that are not all 0"),
        ),
        (
            "[[plane]]\npoint = [0, 0, 0]\nnormal = [0, 1, 0]",
            "[[plane]] has no material, expected the name of a [[material]]",
        ),
        (
            "[[light]]\n",
            "[[light]] has no type, expected \"point\", \"directional\" or \"spot\"",
        ),
        (
            "[[light]]\ntype = \"point\"",
            &format!("[[light]] has no position, {xyz}"),
        ),
        (
            "[[light]]\ntype = \"spot\"\ndirection = [0, 1, 0]",
            &format!("[[light]] has no position, {xyz}"),
        ),
        (
            "[[light]]\ntype = \"spot\"\nposition = [0, 1, 0]",
            &format!("[[light]] has no direction, {xyz}, that are not all 0"),
        ),
        (
            "[[light]]\ntype = \"directional\"",
            &format!("[[light]] has no direction, {xyz}, that are not all 0"),
        ),
    ] {
        assert_error(more, 1, message);
    }
    assert_error(
        "[[material]]\nname = \"b\"\nchecker = { size = 1 }",
        3,
        "checker { color, size } has no color, expected three finite numbers, [red, green, blue], each 0 or more",
    );
    assert_error(
        "[[material]]\nname = \"b\"\nchecker = { color = [0, 0, 0] }",
        3,
        "checker { color, size } has no size, expected a finite number above 0",
    );
    assert_eq!(
        error("[camera]\nlook_at = [0, 0, 0]"),
        format!("scene.toml: line 1: [camera] has no position, {xyz}")
    );
    assert_eq!(
        error("\n[camera]\nposition = [0, 0, 0]"),
        format!("scene.toml: line 2: [camera] has no look_at, {xyz}")
    );
}

#[test]
fn a_key_that_says_nothing_of_a_type_of_light_is_an_error() {
    for (light_type, keys) in [
        (
            "point",
            &[
                "direction = [0, 1, 0]",
                "inner_angle = 1",
                "outer_angle = 9",
            ][..],
        ),
        (
            "directional",
            &[
                "position = [0, 1, 0]",
                "falloff = \"none\"",
                "inner_angle = 1",
                "outer_angle = 9",
            ],
        ),
    ] {
        for entry in keys {
            let key = entry.split(' ').next().unwrap_or_default();
            assert_error(
                &format!("[[light]]\ntype = \"{light_type}\"\n{entry}"),
                3,
                &format!("a {light_type} light has no {key}; remove it"),
            );
        }
    }
}

#[test]
fn materials_are_known_by_their_names() {
    let sphere = "[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\n";
    assert_error(
        &format!("{sphere}material = \"rad\""),
        4,
        "no material is named \"rad\"; did you mean \"red\"?",
    );
    assert_error(
        &format!("{sphere}material = \"ultramarine\""),
        4,
        "no material is named \"ultramarine\"; the nearest known is \"red\"",
    );
    assert_error(
        "[[material]]\nname = \"red\"",
        2,
        "a material named \"red\" is defined already, on line 4; rename one",
    );
    let board = "[[material]]\nname = \"board\"\nchecker = { color = [0, 0, 0], size = 1 }\n";
    assert_error(
        &format!("{board}{sphere}material = \"board\""),
        7,
        "material \"board\" has a checker, which only planes can have; name another",
    );
    assert_eq!(
        error("[[sphere]]\ncenter = [0, 0, 0]\nradius = 1\nmaterial = \"red\""),
        "scene.toml: line 4: no material is named \"red\"; write a [[material]] with that name"
    );
}

#[test]
fn nothing_to_draw_is_an_error() {
    for text in [
        "",
        "\u{feff}",
        "# only words\n",
        "[camera]\nposition = [0, 0, 0]\nlook_at = [0, 0, 1]",
    ] {
        assert_eq!(
            error(text),
            "scene.toml: has nothing to draw; write a [[sphere]], a [[plane]] or a [[model]]"
        );
    }
}

#[test]
fn a_spots_inner_cone_lies_inside_its_outer_one() {
    let spot = "[[light]]\ntype = \"spot\"\nposition = [0, 0, 0]\ndirection = [0, 1, 0]\n";
    for (angles, message) in [
        (
            "outer_angle = 0",
            "outer_angle in [[light]] is 0, expected a half-angle above 0, at most 90 degrees",
        ),
        (
            "outer_angle = 91",
            "outer_angle in [[light]] is 91, expected a half-angle above 0, at most 90 degrees",
        ),
        (
            "inner_angle = -1",
            "inner_angle in [[light]] is -1, expected a half-angle of 0 degrees or more, less than outer_angle",
        ),
        (
            "inner_angle = 20\nouter_angle = 20",
            "inner_angle in [[light]] is 20, expected less than outer_angle",
        ),
        (
            "inner_angle = 50",
            "inner_angle in [[light]] is 50, expected less than outer_angle, which is 45 where it is not written",
        ),
    ] {
        assert_error(&format!("{spot}{angles}"), 5, message);
    }
}

#[test]
fn keys_that_say_nothing_of_what_goes_through_are_refused() {
    for (more, line, message) in [
        (
            "[[material]]\nname = \"b\"\nior = 1.3",
            3,
            "ior says nothing without transmission; write that, too",
        ),
        (
            "[[material]]\nname = \"b\"\ntransmission = 1\nthin = true\ndispersion = 1",
            5,
            "a thin material has no dispersion; remove it",
        ),
        (
            "[[material]]\nname = \"b\"\ntransmission = 1\nattenuation_color = [0, 1, 0]",
            4,
            "attenuation_color is what is left after attenuation_distance, which is not written; write a number above 0",
        ),
    ] {
        assert_error(more, line, message);
    }
}
