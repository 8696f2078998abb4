//! Where pictures go, and where they must not go.

use super::{EXR, Folder, PNG, SCENE, asset};
use std::fs;

#[test]
fn an_output_that_cannot_be_written_is_found_before_the_scene_is_read() {
    let folder = Folder::with_scene_and_model();
    fs::create_dir(folder.path("folder.png")).expect("a folder");
    for (output, problem) in [
        (
            "nowhere/a.png",
            "cannot write into its folder: No such file or directory (os error 2)",
        ),
        ("folder.png", "is a folder, expected a file"),
        (".", "is a folder, expected a file"),
        (
            "a.jpg",
            "its name does not end in .png or .exr; give it one of these",
        ),
        (
            "a",
            "its name does not end in .png or .exr; give it one of these",
        ),
    ] {
        // The input is not even there.
        let error = format!("{output}: {problem}");
        folder.luch_fails(
            &["render", "lost.toml", "-o", "good.png", "-o", output],
            2,
            &error,
        );
    }
    assert_eq!(folder.names(), ["folder.png", "model.obj", "scene.toml"]);
}

#[test]
fn the_same_output_twice_is_refused_however_it_is_spelt() {
    let folder = Folder::with_scene_and_model();
    for twice in ["a.png", "./a.png"] {
        folder.luch_fails(
            &["render", "scene.toml", "-o", "a.png", "-o", twice],
            1,
            &format!("{twice}: is given twice as an output"),
        );
    }
    folder.luch_fails(
        &["render", "-o", "-", "-o", "-"],
        1,
        "-: is given twice as an output",
    );
    assert_eq!(folder.names(), ["model.obj", "scene.toml"]);
}

/// A model with a texture, called as its picture would be.
fn textured() -> Folder {
    let mtl = b"newmtl a\nmap_Kd model.png\n";
    let obj = b"mtllib a.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nf 1/1 2/1 3/1\n";
    let folder = Folder::new(&[("a.mtl", mtl), ("model.obj", obj)]);
    folder.luch_succeeds(&["render", "--size", "4x4", "-o", "model.png"]);
    folder
}

#[test]
fn a_texture_that_was_read_is_never_overwritten() {
    let folder = textured();
    let texture = folder.read("model.png");
    folder.luch_fails(
        &["render", "model.obj"],
        1,
        "model.png: was read for this picture; choose another output",
    );
    fs::create_dir(folder.path("below")).expect("a folder");
    let absolute = folder.path("model.png").display().to_string();
    for spelling in ["./model.png", "below/../model.png", &absolute] {
        let error = format!("{spelling}: was read for this picture; choose another output");
        folder.luch_fails(
            &["render", "model.obj", "-o", "b.png", "-o", spelling],
            1,
            &error,
        );
    }
    assert_eq!(folder.read("model.png"), texture);
    assert_eq!(folder.names(), ["a.mtl", "below", "model.obj", "model.png"]);
}

#[cfg(unix)]
#[test]
fn a_link_to_what_was_read_is_never_followed() {
    use std::os::unix::fs::symlink;
    let folder = textured();
    let [model, texture] = ["model.obj", "model.png"].map(|name| folder.read(name));
    symlink("model.obj", folder.path("link.png")).expect("a link");
    symlink(folder.path("model.png"), folder.path("other.png")).expect("a link");
    for link in ["link.png", "other.png"] {
        let error = format!("{link}: was read for this picture; choose another output");
        folder.luch_fails(&["render", "model.obj", "-o", link], 1, &error);
    }
    assert_eq!(
        [model, texture],
        ["model.obj", "model.png"].map(|name| folder.read(name))
    );
}

#[test]
fn an_input_called_as_a_picture_is_safe_too() {
    // Reading it fails before it could be overwritten.
    let folder = Folder::new(&[("scene.png", SCENE.as_bytes())]);
    let ran = folder.luch(&["render", "scene.png"]);
    assert_eq!(ran.code, Some(1), "{}", ran.err);
    assert_eq!(folder.read("scene.png"), SCENE.as_bytes());
    assert_eq!(folder.names(), ["scene.png"]);
}

#[test]
fn a_picture_on_standard_output_is_alone_there() {
    let folder = Folder::with_scene_and_model();
    let png = folder.luch_succeeds(&["render", "model.obj", "--size", "8x8", "-v", "-o", "-"]);
    assert!(png.out.starts_with(PNG) && png.out.ends_with(b"IEND\xae\x42\x60\x82"));
    for said in [
        "camera: none in the file; ",
        "read model.obj\n",
        "1 triangle, ",
        "rays: ",
        "load ",
    ] {
        assert!(png.err.contains(said), "{said}: {}", png.err);
    }
    folder.luch_succeeds(&["render", "model.obj", "--size", "8x8", "-o", "same.png"]);
    assert_eq!(folder.read("same.png"), png.out);
    let exr = folder.luch_succeeds(&["render", "scene.toml", "-q", "--format", "exr", "-o", "-"]);
    assert!(exr.out.starts_with(EXR));
    assert_eq!(exr.err, "");
    assert_eq!(folder.names(), ["model.obj", "same.png", "scene.toml"]);
}

#[test]
fn one_render_can_have_several_outputs() {
    let folder = Folder::with_scene_and_model();
    let outputs = ["-o", "a.png", "-o", "a.exr", "-o", "-", "-o", "B.PNG"];
    let ran = folder.luch_succeeds(&[&["render", "scene.toml"], &outputs[..]].concat());
    assert!(folder.read("a.png").starts_with(PNG) && folder.read("a.exr").starts_with(EXR));
    assert_eq!(folder.read("a.png"), folder.read("B.PNG"));
    assert_eq!(folder.read("a.png"), ran.out);
    let written: Vec<&str> = ran
        .err
        .lines()
        .filter(|line| line.starts_with("wrote "))
        .collect();
    assert_eq!(written, ["wrote a.png", "wrote a.exr", "wrote B.PNG"]);
}

#[test]
fn a_picture_is_called_after_its_input_and_lies_in_the_current_folder() {
    let folder = Folder::new(&[]);
    fs::create_dir(folder.path("below")).expect("a folder");
    fs::write(folder.path("below/room.v2.toml"), SCENE).expect("writable");
    folder.luch_succeeds(&["render", "below/room.v2.toml", "-q"]);
    assert_eq!(folder.names(), ["below", "room.v2.png"]);
}

#[test]
fn without_arguments_it_is_figure_4() {
    let folder = Folder::new(&[]);
    let ran = folder.luch_succeeds(&["render", "--size", "64x48"]);
    assert!(
        ran.out().ends_with("\nwrote figure-4.png\n"),
        "{}",
        ran.out()
    );
    let embedded = folder.read("figure-4.png");
    let file = asset("scenes/figure-4.toml");
    folder.luch_succeeds(&["render", &file, "--size", "64x48"]);
    assert!(embedded.starts_with(PNG));
    assert_eq!(embedded, folder.read("figure-4.png"));
    assert_eq!(folder.names(), ["figure-4.png"]);
}

#[test]
fn bit_depth_display_and_exposure_reach_the_png_and_not_the_exr() {
    let folder = Folder::with_scene_and_model();
    let mut pictures = Vec::new();
    for more in [
        &[][..],
        &["--bit-depth", "16"],
        &["--exposure", "-1"],
        &["--display", "agx"],
    ] {
        let outputs = ["render", "scene.toml", "-q", "-o", "a.png", "-o", "a.exr"];
        folder.luch_succeeds(&[&outputs[..], more].concat());
        pictures.push((folder.read("a.png"), halves(&folder.read("a.exr"))));
    }
    for (index, (png, exr)) in pictures.iter().enumerate().skip(1) {
        assert!(*png != pictures[0].0, "{index}");
        assert!(*exr == pictures[0].1, "{index}");
    }
}

/// Every number of an EXR's first layer.
fn halves(bytes: &[u8]) -> Vec<f32> {
    use exr::prelude::{ReadChannels, ReadLayers, read};
    let image = read()
        .no_deep_data()
        .largest_resolution_level()
        .all_channels()
        .first_valid_layer()
        .all_attributes()
        .from_buffered(std::io::Cursor::new(bytes))
        .expect("an EXR");
    let channels = &image.layer_data.channel_data.list;
    channels
        .iter()
        .flat_map(|channel| channel.sample_data.values_as_f32())
        .collect()
}
