//! What a picture shows that nobody framed: how much of it the model fills, and from where a room is seen.

use super::common::{models, picture};
use luch::film::Film;
use luch::framing::{Direction, View};
use luch::generate::{self, Decoration};
use luch::load::{self, CameraChoice, Options, Viewpoint};
use luch::mesh::Mesh;
use luch::shade::Shading;
use std::fmt::Write;
use std::fs;
use std::path::Path;

const WIDTH: u32 = 96;
const HEIGHT: u32 = 64;

/// The folders of those that cover less than a quarter of a picture, and why.
const SPARSE: [(&str, &str); 23] = [
    ("khr-Avocado-glTF", "upright"),
    ("khr-BrainStem-Draco", "upright, its arms held out"),
    ("khr-IridescenceLamp-glTF", "upright"),
    ("khr-RiggedSimple-Binary", "an upright rod"),
    ("khr-SimpleSkin-Embedded", "an upright strip"),
    ("lgl-pirate", "upright, its arms held out"),
    ("pc-cat", "upright"),
    ("cesn-CesiumBalloonKTX2", "upright, round, a basket below"),
    ("agen-Animation_Skin_03", "a bent square"),
    ("godot-dutch_ship_medium_1k", "masts and ropes"),
    (
        "khr-AnisotropyBarnLamp-KTX2-Basisu",
        "an arm between a shade and a plate",
    ),
    ("khr-LightsPunctualLamp-glTF", "a thin bow"),
    (
        "khr-GlassVaseFlowers-Binary",
        "stems and glass, with gaps between",
    ),
    ("khr-SheenChair-glTF", "legs, with gaps between"),
    ("khr-Fox-Binary", "legs, long and narrow"),
    (
        "khr-AnisotropyStrengthTest-Binary",
        "an upright board of things, with gaps between",
    ),
    (
        "khr-ClearCoatTest-Binary",
        "an upright board of things, with gaps between",
    ),
    (
        "khr-EnvironmentTest-glTF",
        "three long rows of balls, with gaps between",
    ),
    (
        "khr-InterpolationTest-Binary",
        "an upright board of cubes, with gaps between",
    ),
    (
        "khr-NormalTangentTest-Binary",
        "an upright board of things, with gaps between",
    ),
    (
        "khr-TextureCoordinateTest-glTF",
        "four boards, with gaps between",
    ),
    ("khr-SimpleSparseAccessor-glTF", "three teeth"),
    (
        "khr-TriangleWithoutIndices-glTF",
        "half of an upright square",
    ),
];

/// Of those whose first and last pixel are not four fifths of a side apart, and why.
const NOT_FITTED: [(&str, &str); 3] = [
    ("bevy-PalmTree", "stands on an island in a sea that goes on"),
    ("gkj-hotel-room-lotus-carpet", "a room, seen from inside"),
    (
        "godot-dutch_ship_medium_1k",
        "its bowsprit is thinner than a pixel",
    ),
];

/// A share that is just a quarter in one picture may be a pixel less in another.
const A_QUARTER: f64 = 0.245;

/// What the model covers of a picture.
struct Cover {
    /// The share of the pixels.
    area: f64,
    /// The share of the width or the height, whichever is greater, from the first to the last pixel.
    side: f64,
}

#[test]
fn real_models_fill_the_picture() {
    let test = "real_models_fill_the_picture";
    let Some(folder) = models::folder(test, "valid") else {
        return;
    };
    let mut wrong = Vec::new();
    for file in models::below(&folder, &["gltf", "glb"]) {
        let Ok((cover, said)) = cover(&file) else {
            continue;
        };
        let name = file.parent().and_then(Path::file_name).unwrap_or_default();
        let name = name.to_string_lossy();
        let (area, side) = (cover.area * 100.0, cover.side * 100.0);
        models::say(&format!(
            "    {area:3.0} % covered, {side:3.0} % of the tighter side  {name}{said}"
        ));
        let is_named = |list: &[(&str, &str)]| list.iter().any(|(named, _)| *named == name);
        if cover.area < A_QUARTER && !is_named(&SPARSE) {
            wrong.push(format!("{name} covers {area:.1} %"));
        }
        // A pixel at each end.
        if (cover.side - 0.8).abs() > 0.04 && !is_named(&NOT_FITTED) {
            wrong.push(format!("{name} fills {side:.0} %"));
        }
    }
    assert!(wrong.is_empty(), "{}", wrong.join("; "));
}

/// What a framed model covers, whatever cameras it has, and what was said of the camera.
fn cover(file: &Path) -> Result<(Cover, String), luch::Error> {
    let asset = load::open(file, &Options::default())?;
    let viewpoint = Viewpoint {
        camera: CameraChoice::Framed(View::default()),
        ..Viewpoint::of_file(f64::from(WIDTH) / f64::from(HEIGHT))
    };
    let (scene, choices) = asset.scene(0.0, &viewpoint)?;
    let said = choices
        .lines
        .iter()
        .find(|line| line.starts_with("camera:"));
    let said = said.map_or(String::new(), |line| format!("; {line}"));
    let film = picture::of(&scene, WIDTH, HEIGHT, Shading::Flat);
    Ok((covered(&film), said))
}

fn covered(film: &Film) -> Cover {
    let (pixels, _) = film.layers[0].values.as_chunks::<4>();
    let places = (0..).zip(pixels).filter(|(_, pixel)| pixel[3] > 0.0);
    let places: Vec<(u32, u32)> = places.map(|(at, _)| (at % WIDTH, at / WIDTH)).collect();
    let span = |all: &dyn Fn(&(u32, u32)) -> u32, size: u32| {
        let (least, most) = (places.iter().map(all).min(), places.iter().map(all).max());
        let pixels = most.zip(least).map_or(0, |(most, least)| most + 1 - least);
        f64::from(pixels) / f64::from(size)
    };
    Cover {
        area: places.len() as f64 / f64::from(WIDTH * HEIGHT),
        side: span(&|place| place.0, WIDTH).max(span(&|place| place.1, HEIGHT)),
    }
}

/// The vertices and faces of a mesh as OBJ has them, after `before` other vertices.
fn obj(mesh: &Mesh, before: usize) -> String {
    let mut text = format!("o {}\n", mesh.name);
    for p in &mesh.positions {
        let _ = writeln!(text, "v {} {} {}", p.x, p.y, p.z);
    }
    for triangle in &mesh.triangles {
        let [a, b, c] = triangle.map(|index| index as usize + 1 + before);
        let _ = writeln!(text, "f {a} {b} {c}");
    }
    text
}

fn room_as_obj() -> String {
    let mut before = 0;
    let meshes = generate::interior(Decoration::Plain).meshes;
    let of_mesh = |mesh: &Mesh| {
        let text = obj(mesh, before);
        before += mesh.positions.len();
        text
    };
    meshes.iter().map(of_mesh).collect()
}

#[test]
fn a_room_in_a_file_is_seen_from_inside_and_from_above_on_request() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("room.obj");
    fs::write(&file, room_as_obj()).expect("written");
    let asset = load::open(&file, &Options::default()).expect("a room");
    let (scene, choices) = asset.scene(0.0, &Viewpoint::of_file(1.5)).expect("a scene");
    let said = "camera: none in the file; a room, seen from inside";
    assert!(
        choices.lines.iter().any(|line| line == said),
        "{:?}",
        choices.lines
    );
    let film = picture::of(&scene, WIDTH, HEIGHT, Shading::Flat);
    // All but the window.
    assert!(covered(&film).area > 0.9);
    let top = View {
        direction: Direction::Top,
        ..View::default()
    };
    let from_above = Viewpoint {
        camera: CameraChoice::Framed(top),
        ..Viewpoint::of_file(1.5)
    };
    let (scene, _) = asset.scene(0.0, &from_above).expect("a scene");
    assert!(scene.camera().position.y > 2.6);
}

#[test]
fn a_floor_that_is_left_out_of_the_frame_is_said_and_seen() {
    let folder = tempfile::tempdir().expect("a folder");
    let file = folder.path().join("ball.obj");
    let ball = Mesh {
        name: "ball".into(),
        ..generate::icosphere(3)
    };
    let floor =
        "o Sea\nv -100 -1 -100\nv -100 -1 100\nv 100 -1 100\nv 100 -1 -100\nf -4 -3 -2 -1\n";
    fs::write(&file, obj(&ball, 0) + floor).expect("written");
    let asset = load::open(&file, &Options::default()).expect("a ball");
    let (scene, choices) = asset.scene(0.0, &Viewpoint::of_file(1.5)).expect("a scene");
    // The diagonal of 200 by 200 over that of 2 by 2 by 2.
    let said = "camera: none in the file; a three-quarter view, fitted to the model, without \"Sea\", 82 times as large as the rest";
    assert!(
        choices.lines.iter().any(|line| line == said),
        "{:?}",
        choices.lines
    );
    let distance = scene.camera().position.length();
    assert!((3.0..6.0).contains(&distance), "{distance}");
    // The camera looks down: the floor is everywhere else.
    let film = picture::of(&scene, WIDTH, HEIGHT, Shading::Flat);
    assert!(covered(&film).area > 0.8);
}
