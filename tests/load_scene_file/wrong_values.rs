//! Values of the wrong type or out of range.

use super::{LEAST, assert_error, camera_error, error, scene};

#[test]
fn only_the_far_distance_may_be_infinite() {
    for far in ["inf", "+inf"] {
        let text = LEAST.replace("[[material]]", &format!("far = {far}\n[[material]]"));
        assert!(scene(&text).is_ok());
    }
    assert_eq!(
        camera_error("far = -inf"),
        "scene.toml: line 4: far in [camera] is -inf, expected a number above 0, or inf"
    );
    assert_eq!(
        camera_error("far = 1e39"),
        "scene.toml: line 4: far in [camera] is 1e39, expected a number above 0, or inf"
    );
    assert_eq!(
        camera_error("near = inf"),
        "scene.toml: line 4: near in [camera] is inf, expected a finite number, 0 or more"
    );
}

#[test]
fn a_value_of_the_wrong_type_is_told_with_its_key_and_line() {
    for (more, line, message) in [
        (
            "[render]\nwidth = \"big\"",
            2,
            "width in [render] is \"big\", expected a whole number above 0",
        ),
        (
            "[render]\nwidth = 640.0",
            2,
            "width in [render] is 640.0, expected a whole number above 0",
        ),
        (
            "[render]\nwidth = 1979-05-27",
            2,
            "width in [render] is 1979-05-27, expected a whole number above 0",
        ),
        (
            "[render]\nmax_depth = true",
            2,
            "max_depth in [render] is true, expected a whole number, 0 or more",
        ),
        (
            "[render]\nshading = 1",
            2,
            "shading in [render] is 1, expected \"blinn-phong\", \"phong\", \"lambert\" or \"flat\"",
        ),
        (
            "[render]\ntexture_filter = 1",
            2,
            "texture_filter in [render] is 1, expected \"footprint\" or \"point\"",
        ),
        (
            "[ambient]\ncolor = 1",
            2,
            "color in [ambient] is 1, expected three finite numbers, [red, green, blue], each 0 or more",
        ),
        (
            "[ambient]\ncolor = [1, 1]",
            2,
            "color in [ambient] is [1, 1], expected three finite numbers, [red, green, blue], each 0 or more",
        ),
        (
            "[ambient]\ncolor = [1, 1, 1, 1]",
            2,
            "color in [ambient] is [1, 1, 1, 1], expected three finite numbers, [red, green, blue], each 0 or more",
        ),
        (
            "[ambient]\ncolor = [\n  1,\n  \"x\",\n  3,\n]",
            2,
            "color in [ambient] is [ 1, \"x\", 3, ], expected three finite numbers, [red, green, blue], each 0 or more",
        ),
        (
            "[ambient]\ncolor = { r = 1 }",
            2,
            "color in [ambient] is a table, expected three finite numbers, [red, green, blue], each 0 or more",
        ),
        (
            "[[material]]\nname = 1",
            2,
            "name in [[material]] is 1, expected a text in quotes",
        ),
        (
            "[[material]]\nname = \"b\"\nchecker = 1",
            3,
            "checker is 1, expected one checker { color, size }",
        ),
        (
            "[[render]]\n",
            1,
            "render is a list of tables, expected one [render]",
        ),
        (
            "[plane]\n",
            1,
            "plane is a table, expected a list of [[plane]]",
        ),
    ] {
        assert_error(more, line, message);
    }
    assert_eq!(
        error("sphere = [1]"),
        "scene.toml: line 1: sphere is 1, expected a list of [[sphere]]"
    );
    assert_eq!(
        error("camera = 5"),
        "scene.toml: line 1: camera is 5, expected one [camera]"
    );
}

#[test]
fn long_values_are_cut() {
    let text = format!(
        "[[material]]\nname = \"b\"\nshininess = \"{}\"",
        "x".repeat(5000)
    );
    let cut = format!("\"{}…", "x".repeat(58));
    assert_error(
        &text,
        3,
        &format!("shininess in [[material]] is {cut}, expected a finite number, 0 or more"),
    );
}

#[test]
fn a_value_out_of_range_is_told_with_its_key_and_line() {
    let color = "three finite numbers, [red, green, blue], each 0 or more";
    let xyz = "three finite numbers, [x, y, z]";
    for (more, line, message) in [
        (
            "[render]\nwidth = 0",
            2,
            "width in [render] is 0, expected a whole number above 0",
        ),
        (
            "[render]\nheight = -3",
            2,
            "height in [render] is -3, expected a whole number above 0",
        ),
        (
            "[render]\nheight = 4294967296",
            2,
            "height in [render] is 4294967296, expected a whole number above 0",
        ),
        (
            "[render]\nheight = 99999999999999999999",
            2,
            "height in [render] is 99999999999999999999, expected a whole number above 0",
        ),
        (
            "[render]\nmax_depth = -1",
            2,
            "max_depth in [render] is -1, expected a whole number, 0 or more",
        ),
        (
            "[render]\nsamples = 5",
            2,
            "samples in [render] is 5, expected a square number up to 65536, such as 4 or 9",
        ),
        (
            "[render]\nsamples = 0",
            2,
            "samples in [render] is 0, expected a square number up to 65536, such as 1",
        ),
        (
            "[render]\nsamples = 4294967295",
            2,
            "samples in [render] is 4294967295, expected a square number up to 65536, such as 65536",
        ),
        (
            "[render]\npattern = \"spread\"\nsamples = 65537",
            3,
            "samples in [render] is 65537, expected a whole number from 1 to 65536",
        ),
        (
            "[render]\nfilter = \"gauss\"",
            2,
            "filter in [render] is \"gauss\", expected \"box\", \"blackman-harris\", \"gaussian\" or \"mitchell\"; did you mean \"gaussian\"?",
        ),
        (
            "[render]\nadaptive = 1",
            2,
            "adaptive in [render] is 1, expected true or false",
        ),
        (
            "[render]\nshading = \"blin-phong\"",
            2,
            "shading in [render] is \"blin-phong\", expected \"blinn-phong\", \"phong\", \"lambert\" or \"flat\"; did you mean \"blinn-phong\"?",
        ),
        (
            "[background]\ncolor = [0, 0, -1]",
            2,
            &format!("color in [background] is [0, 0, -1], expected {color}"),
        ),
        (
            "[ambient]\ncolor = [nan, 0, 0]",
            2,
            &format!("color in [ambient] is [nan, 0, 0], expected {color}"),
        ),
        (
            "[[material]]\nname = \"b\"\ndiffuse = [0, 0, -1]",
            3,
            &format!("diffuse in [[material]] is [0, 0, -1], expected {color}"),
        ),
        (
            "[[material]]\nname = \"b\"\nspecular = [0, 0, inf]",
            3,
            &format!("specular in [[material]] is [0, 0, inf], expected {color}"),
        ),
        (
            "[[material]]\nname = \"b\"\nemission = [0, 0, 1e40]",
            3,
            &format!("emission in [[material]] is [0, 0, 1e40], expected {color}"),
        ),
        (
            "[[material]]\nname = \"b\"\nshininess = -1",
            3,
            "shininess in [[material]] is -1, expected a finite number, 0 or more",
        ),
        (
            "[[material]]\nname = \"b\"\ntransmission = 2",
            3,
            "transmission in [[material]] is 2, expected a number from 0 to 1",
        ),
        (
            "[[material]]\nname = \"b\"\ntransmission = 1\nior = 0",
            4,
            "ior in [[material]] is 0, expected a finite number above 0",
        ),
        (
            "[[material]]\nname = \"b\"\ntransmission = 1\nthin = 1",
            4,
            "thin in [[material]] is 1, expected true or false",
        ),
        (
            "[[material]]\nname = \"b\"\ntransmission = 1\nattenuation_color = [1, 1, 1.5]",
            4,
            "attenuation_color in [[material]] is [1, 1, 1.5], expected three numbers from 0 to 1, [red, green, blue]",
        ),
        (
            "[[material]]\nname = \"b\"\ntransmission = 1\nattenuation_distance = 0",
            4,
            "attenuation_distance in [[material]] is 0, expected a number above 0, or inf",
        ),
        (
            "[[material]]\nname = \"b\"\ntransmission = 1\ndispersion = -1",
            4,
            "dispersion in [[material]] is -1, expected a finite number, 0 or more",
        ),
        (
            "[[material]]\nname = \"b\"\nreflectivity = 1.5",
            3,
            "reflectivity in [[material]] is 1.5, expected a number from 0 to 1",
        ),
        (
            "[[material]]\nname = \"b\"\nreflectivity = nan",
            3,
            "reflectivity in [[material]] is nan, expected a number from 0 to 1",
        ),
        (
            "[[material]]\nname = \"b\"\nchecker = { color = [0, 0, 0], size = 0 }",
            3,
            "size in checker { color, size } is 0, expected a finite number above 0",
        ),
        (
            "[[sphere]]\ncenter = [0, 0, nan]",
            2,
            &format!("center in [[sphere]] is [0, 0, nan], expected {xyz}"),
        ),
        (
            "[[sphere]]\ncenter = [0, 0, 0]\nradius = 0",
            3,
            "radius in [[sphere]] is 0, expected a finite number above 0",
        ),
        (
            "[[sphere]]\ncenter = [0, 0, 0]\nradius = 1e-60",
            3,
            "radius in [[sphere]] is 1e-60, expected a finite number above 0",
        ),
        (
            "[[sphere]]\ncenter = [0, 0, 0]\nradius = inf",
            3,
            "radius in [[sphere]] is inf, expected a finite number above 0",
        ),
        (
            "[[plane]]\npoint = [0, 0, 0]\nnormal = [0, -0.0, 0]",
            3,
            &format!("normal in [[plane]] is [0, -0.0, 0], expected {xyz}, that are not all 0"),
        ),
        (
            "[[light]]\ntype = \"directional\"\ndirection = [0, 0, 0]",
            3,
            &format!("direction in [[light]] is [0, 0, 0], expected {xyz}, that are not all 0"),
        ),
        (
            "[[light]]\ntype = \"point\"\nposition = [0, inf, 0]",
            3,
            &format!("position in [[light]] is [0, inf, 0], expected {xyz}"),
        ),
        (
            "[[light]]\ntype = \"point\"\nposition = [0, 0, 0]\nintensity = -1",
            4,
            "intensity in [[light]] is -1, expected a finite number, 0 or more",
        ),
        (
            "[[light]]\ntype = \"pont\"",
            2,
            "type in [[light]] is \"pont\", expected \"point\", \"directional\" or \"spot\"; did you mean \"point\"?",
        ),
        (
            "[[light]]\ntype = \"point\"\nposition = [0, 0, 0]\nfalloff = \"inverse\"",
            4,
            "falloff in [[light]] is \"inverse\", expected \"none\" or \"inverse-square\"; did you mean \"inverse-square\"?",
        ),
    ] {
        assert_error(more, line, message);
    }
}

#[test]
fn a_camera_must_see_something() {
    let fov = "expected an angle above 0 and below 180 degrees";
    for (entry, message) in [
        (
            "up = [0, 0, 0]",
            "up in [camera] is [0, 0, 0], expected three finite numbers, [x, y, z], that are not all 0",
        ),
        ("fov_x = 0", &format!("fov_x in [camera] is 0, {fov}")),
        ("fov_y = 180", &format!("fov_y in [camera] is 180, {fov}")),
        (
            "fov_y = 179.9999999999",
            &format!("fov_y in [camera] is 179.9999999999, {fov}"),
        ),
        ("fov_y = nan", &format!("fov_y in [camera] is nan, {fov}")),
        (
            "near = -1",
            "near in [camera] is -1, expected a finite number, 0 or more",
        ),
        (
            "far = 0",
            "far in [camera] is 0, expected a number above 0, or inf",
        ),
        (
            "far = 2\nnear = 2.0",
            "far in [camera] is 2, expected a number above near (2), or inf",
        ),
        (
            "model_camera = \"x\"",
            "[camera] has both model_camera and position; remove one of the two",
        ),
    ] {
        let line = if entry.starts_with("model_camera") {
            2
        } else {
            4
        };
        assert_eq!(
            camera_error(entry),
            format!("scene.toml: line {line}: {message}")
        );
    }
    assert_eq!(
        error("[camera]\nposition = [1, 2, 3]\nlook_at = [1, 2, 3.0]"),
        "scene.toml: line 3: look_at in [camera] equals position, so that it looks nowhere; move one"
    );
    assert_eq!(
        error("[camera]\nmodel_camera = \"a\"\nfov_y = 4"),
        "scene.toml: line 3: [camera] has both model_camera and fov_y; remove one of the two"
    );
    let (_, rest) = LEAST.split_at(LEAST.find("[[material]]").unwrap_or_default());
    assert_eq!(
        error(&format!("[camera]\nmodel_camera = \"a\"\n{rest}")),
        "scene.toml: line 2: no model has a camera named \"a\""
    );
    assert_eq!(
        error(rest),
        "scene.toml: has no [camera]; write one with position = [x, y, z] and look_at = [x, y, z]"
    );
}
