//! What cannot be asked: one line that says what can, and exit code 1.

use super::Folder;

#[test]
fn a_slip_of_the_pen_is_one_line() {
    let folder = Folder::with_scene_and_model();
    for (arguments, error) in [
        (&[][..], "no command given (see luch --help)"),
        (
            &["paint"],
            "unrecognized subcommand 'paint' (see luch --help)",
        ),
        (
            &["render", "--sample"],
            "unexpected argument '--sample' found; tip: a similar argument exists: '--samples' (see luch render --help)",
        ),
        (
            &["render", "a.glb", "b.glb"],
            "unexpected argument 'b.glb' found (see luch render --help)",
        ),
        (
            &["render", "-q", "-v"],
            "the argument '--quiet' cannot be used with '--verbose' (see luch render --help)",
        ),
        (
            &["info"],
            "the following required arguments were not provided: <INPUT> (see luch info --help)",
        ),
        (
            &["render", "--eye", "1,2,3"],
            "the following required arguments were not provided: --target <X,Y,Z> (see luch render --help)",
        ),
        (
            &["render", "--size", "8x8", "--width", "8"],
            "the argument '--size <WxH>' cannot be used with '--width <PIXELS>' (see luch render --help)",
        ),
        (
            &[
                "render", "--camera", "1", "--eye", "1,2,3", "--target", "0,0,0",
            ],
            "the argument '--camera <NAME|INDEX>' cannot be used with: --eye <X,Y,Z> --target <X,Y,Z> (see luch render --help)",
        ),
        (
            &["render", "--view", "top", "--camera", "1"],
            "the argument '--view <SIDE>' cannot be used with '--camera <NAME|INDEX>' (see luch render --help)",
        ),
        (
            &["completions", "ksh"],
            "invalid value 'ksh' for '<SHELL>' [possible values: bash, elvish, fish, powershell, zsh]; tip: a similar \
             value exists: 'zsh' (see luch completions --help)",
        ),
        (
            &["a\n\nb"],
            "unrecognized subcommand 'a b' (see luch --help)",
        ),
    ] {
        folder.luch_fails(arguments, 1, error);
    }
    assert_eq!(folder.names(), ["model.obj", "scene.toml"]);
}

#[test]
fn a_sun_is_for_a_sky_alone() {
    let folder = Folder::with_scene_and_model();
    let error = "--sun is where the sun of a sky stands; use it with --environment sky";
    for more in [&[][..], &["--environment", "studio"]] {
        let arguments = [&["render", "scene.toml", "--sun", "0,45"], more].concat();
        folder.luch_fails(&arguments, 1, error);
    }
}

#[test]
fn a_bad_value_is_told_what_is_expected() {
    let folder = Folder::with_scene_and_model();
    for (option, value, expected) in [
        (
            "size <WxH>",
            "640",
            "expected width x height in pixels, as in 1280x720",
        ),
        (
            "size <WxH>",
            "-1x5",
            "expected width x height in pixels, as in 1280x720",
        ),
        (
            "width <PIXELS>",
            "wide",
            "expected a whole number, at least 0",
        ),
        (
            "height <PIXELS>",
            "1.5",
            "expected a whole number, at least 0",
        ),
        ("samples <N>", "-4", "expected a whole number, at least 0"),
        ("max-depth <N>", "-1", "expected a whole number, at least 0"),
        ("threads <N>", "0", "expected a whole number from 1 to 1024"),
        ("leaf-size <N>", "0", "expected a whole number from 1 to 16"),
        (
            "leaf-size <N>",
            "256",
            "expected a whole number from 1 to 16",
        ),
        (
            "environment <studio|sky|none|#RRGGBB|FILE>",
            "sky.png",
            "expected studio, sky, none, a colour of six hex digits, as in '#808080', or a .hdr or .exr file",
        ),
        (
            "environment-rotation <DEGREES>",
            "inf",
            "expected an angle in degrees",
        ),
        (
            "environment-intensity <FACTOR>",
            "-1",
            "expected a finite number, 0 or more",
        ),
        (
            "environment-lights <N>",
            "1025",
            "expected a whole number from 1 to 1024",
        ),
        (
            "sun <AZIMUTH,ELEVATION>",
            "0,91",
            "expected two angles in degrees with a comma between, as in -15,45, the second from -90 to 90",
        ),
        (
            "fov <DEGREES>",
            "180",
            "expected an angle above 0 and below 180 degrees",
        ),
        (
            "fov <DEGREES>",
            "-5",
            "expected an angle above 0 and below 180 degrees",
        ),
        (
            "fov <DEGREES>",
            "nan",
            "expected an angle above 0 and below 180 degrees",
        ),
        (
            "orbit <YAW,PITCH>",
            "20",
            "expected two angles in degrees with a comma between, as in -30,10",
        ),
        (
            "zoom <X>",
            "0",
            "expected a number from 0.001 to 1000; 2 is twice as large",
        ),
        (
            "exposure <EV>",
            "nan",
            "expected a number of stops from -100 to 100",
        ),
        (
            "exposure <EV>",
            "-inf",
            "expected a number of stops from -100 to 100",
        ),
        (
            "eye <X,Y,Z>",
            "nan,0,0",
            "expected three finite numbers with commas between, as in 1,2,0.5",
        ),
        (
            "eye <X,Y,Z>",
            "1,2",
            "expected three finite numbers with commas between, as in 1,2,0.5",
        ),
        (
            "layers <NAMES>",
            "cost",
            "beauty is in every picture; ask for beauty,cost",
        ),
        (
            "layers <NAMES>",
            "beauty,fog",
            "there is no layer \"fog\"; known are beauty, data, Z, N, P, UV, albedo, cryptomatte, components, lights, bounces, cost, samples, all, with commas between",
        ),
        (
            "background <#RRGGBB|transparent|environment>",
            "grey",
            "expected a colour of six hex digits, as in '#808080', transparent or environment",
        ),
    ] {
        let name = option.split(' ').next().unwrap_or_default();
        let error = format!(
            "invalid value '{value}' for '--{option}': {expected} (see luch render --help)"
        );
        folder.luch_fails(&["render", &format!("--{name}"), value], 1, &error);
    }
    for (option, value, possible) in [
        ("bit-depth <BITS>", "12", "8, 16"),
        (
            "display <TRANSFORM>",
            "film",
            "srgb, reinhard, aces-hill, agx, pbr-neutral",
        ),
        (
            "shading <MODEL>",
            "toon",
            "flat, lambert, phong, blinn-phong",
        ),
        (
            "bvh <PRESET>",
            "best",
            "fastest, very-fast, fast, medium, slow, very-slow",
        ),
        (
            "view <SIDE>",
            "below",
            "front, back, left, right, top, three-quarter",
        ),
        ("format <FORMAT>", "tga", "png, exr"),
    ] {
        let name = option.split(' ').next().unwrap_or_default();
        let error = format!(
            "invalid value '{value}' for '--{option}' [possible values: {possible}] (see luch render --help)"
        );
        folder.luch_fails(&["render", &format!("--{name}"), value], 1, &error);
    }
}

#[test]
fn a_picture_that_cannot_be_is_refused_before_anything_is_rendered() {
    let folder = Folder::with_scene_and_model();
    for (arguments, error) in [
        (
            &["--size", "0x0"][..],
            "a picture of 0 x 0 pixels has no pixels; both must be above 0",
        ),
        (
            &["--size", "100000x100000"],
            "a picture of 100000 x 100000 pixels needs 200000 MB of memory, more than the 4294 MB allowed; make it smaller",
        ),
        (
            &["--width", "0"],
            "a picture of 0 x 8 pixels has no pixels; both must be above 0",
        ),
        (
            &["--samples", "5"],
            "5 samples a pixel do not make a square grid; use 4 or 9",
        ),
        (
            &["--pattern", "spread", "--samples", "65537"],
            "65537 samples a pixel cannot be; use 1 to 65536",
        ),
        (
            &["--max-depth", "10001"],
            "a depth of 10001 mirror bounces is above the limit of 10000",
        ),
        (
            &["--eye", "1,2,3", "--target", "1,2,3"],
            "--eye and --target are the same point; move one of them",
        ),
        (
            &["--camera", "front"],
            "scene.toml: there is no camera \"front\"; the file has none",
        ),
        (
            &["-o", "-", "--json"],
            "-o - and --json both want standard output; give the picture a name",
        ),
    ] {
        folder.luch_fails(&[&["render", "scene.toml"], arguments].concat(), 1, error);
    }
    assert_eq!(folder.names(), ["model.obj", "scene.toml"]);
}
