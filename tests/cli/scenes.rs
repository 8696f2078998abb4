//! Scene files whose values make no scene: one line each, with the line in the file.

use super::{Folder, SCENE};

/// [`SCENE`] with one line instead of another.
fn changed(from: &str, to: &str) -> String {
    assert_eq!(SCENE.matches(from).count(), 1, "{from}");
    SCENE.replace(from, to)
}

#[test]
fn a_wrong_value_is_one_line_that_names_it() {
    for (from, to, problem) in [
        (
            "radius = 1",
            "radiu = 1",
            "line 14: unknown key \"radiu\" in [[sphere]]; did you mean \"radius\"?",
        ),
        (
            "radius = 1",
            "radius = 0",
            "line 14: radius in [[sphere]] is 0, expected a finite number above 0",
        ),
        (
            "position = [0, 0, -5]",
            "position = [nan, 0, -5]",
            "line 2: position in [camera] is [nan, 0, -5], expected three finite numbers, [x, y, z]",
        ),
        (
            "position = [5, 5, -5]",
            "position = [5, inf, -5]",
            "line 9: position in [[light]] is [5, inf, -5], expected three finite numbers, [x, y, z]",
        ),
        (
            "look_at = [0, 0, 0]",
            "look_at = [0, 0, -5]",
            "line 3: look_at in [camera] equals position, so that it looks nowhere; move one",
        ),
        (
            "width = 8",
            "width = 0",
            "line 5: width in [render] is 0, expected a whole number above 0",
        ),
        (
            "width = 8\nheight = 8",
            "width = 100000\nheight = 100000",
            "[render]: a picture of 100000 x 100000 pixels needs 200000 MB of memory, more than the 4294 MB allowed; make it smaller",
        ),
        (
            "[[sphere]]",
            "[[plane]]\npoint = [0, 0, 0]\nnormal = [0, 0, 0]\nmaterial = \"red\"\n[[sphere]]",
            "line 14: normal in [[plane]] is [0, 0, 0], expected three finite numbers, [x, y, z], that are not all 0",
        ),
        (
            "[[sphere]]",
            "[[model]]\npath = \"model.obj\"\nscale = 0\n[[sphere]]",
            "line 14: scale in [[model]] is 0, expected a finite number or three, [x, y, z], none of them 0, which would make a singular matrix",
        ),
        (
            "[[sphere]]",
            "[[model]]\npath = \"model.obj\"\nrotation = [0, 0, 0, 0]\n[[sphere]]",
            "line 14: rotation in [[model]] is [0, 0, 0, 0], expected a quaternion of four finite numbers, [x, y, z, w], that are not all 0",
        ),
        (
            "[[sphere]]",
            "[[model]]\npath = \"model.txt\"\n[[sphere]]",
            "line 13: path in [[model]] is \"model.txt\", expected a name that ends in .gltf, .glb or .obj",
        ),
        (
            "material = \"red\"",
            "material = \"rad\"",
            "line 15: no material is named \"rad\"; did you mean \"red\"?",
        ),
    ] {
        let folder = Folder::with_scene_and_model();
        std::fs::write(folder.path("scene.toml"), changed(from, to)).expect("writable");
        folder.luch_fails(
            &["render", "scene.toml"],
            1,
            &format!("scene.toml: {problem}"),
        );
        assert_eq!(folder.names(), ["model.obj", "scene.toml"]);
    }
}
