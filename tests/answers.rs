//! Models that tell their own right answer: a tick where they are drawn well, a cross where not.
//!
//! The answers are those of the models' own descriptions in Khronos' collection of sample assets. The models lie in
//! the folder that `LUCH_TEST_MODELS` names, or else in `../shared/models`; the project has none of them.

use super::common::picture;
use luch::camera::Camera;
use luch::load::{self, CameraChoice, Viewpoint};
use luch::shade::Shading;
use std::env;
use std::io::{self, Write};
use std::path::{Path, PathBuf};

const SIDE: u32 = 128;
/// The vertical field of view: 45 degrees.
const FOV_Y: f64 = std::f64::consts::FRAC_PI_4;

type Pixel = [f32; 4];

/// A square picture that is seen straight from the front (+Z).
struct Picture {
    pixels: Vec<Pixel>,
    center: [f64; 2],
    half: f64,
}

impl Picture {
    /// What is seen at a place of the plane z = 0.
    fn at(&self, x: f64, y: f64) -> Pixel {
        let side = f64::from(SIDE);
        let column = ((x - self.center[0]) / self.half + 1.0) * 0.5 * side;
        let row = (1.0 - (y - self.center[1]) / self.half) * 0.5 * side;
        self.pixels[row as usize * SIDE as usize + column as usize]
    }

    fn count(&self, is_counted: impl Fn(&Pixel) -> bool) -> usize {
        self.pixels.iter().filter(|pixel| is_counted(pixel)).count()
    }
}

/// Of this model the square about `center` that reaches `half` to each side; nothing, and a line that says so, where
/// there is no such model.
fn seen(model: &str, center: [f64; 2], half: f64, shading: Shading) -> Option<Picture> {
    let root = env::var_os("LUCH_TEST_MODELS").map_or_else(
        || Path::new(env!("CARGO_MANIFEST_DIR")).join("../shared/models"),
        PathBuf::from,
    );
    let file = root.join("valid").join(model);
    if !file.is_file() {
        let file = file.display();
        // Past the harness, which keeps what tests that pass print.
        let _ = writeln!(
            io::stderr(),
            "SKIPPED, not passed: 1 model was not tried, since there is no {file}; \
             LUCH_TEST_MODELS can name another folder that has it"
        );
        return None;
    }
    let [x, y] = center;
    let distance = half / libm::tan(FOV_Y / 2.0);
    let camera = Camera::looking_at([x, y, distance], [x, y, 0.0], [0.0, 1.0, 0.0], FOV_Y);
    let viewpoint = Viewpoint {
        camera: CameraChoice::Given(camera),
        ..picture::viewpoint(1.0)
    };
    let (scene, _) = load::open(&file, &load::Options::default())
        .and_then(|asset| asset.scene(0.0, &viewpoint))
        .unwrap_or_else(|error| panic!("{error}"));
    let film = picture::of(&scene, SIDE, SIDE, shading);
    let (pixels, _) = film.layers[0].values.as_chunks::<4>();
    Some(Picture {
        pixels: pixels.to_vec(),
        center,
        half,
    })
}

/// Which of red, green and blue are there: more than a third of the strongest.
fn hue(&[r, g, b, _]: &Pixel) -> [bool; 3] {
    let strongest = r.max(g).max(b);
    [r, g, b].map(|channel| strongest > 0.05 && channel > strongest / 3.0)
}

const RED: [bool; 3] = [true, false, false];
const GREEN: [bool; 3] = [false, true, false];
const BLUE: [bool; 3] = [false, false, true];
const YELLOW: [bool; 3] = [true, true, false];
const CYAN: [bool; 3] = [false, true, true];
const MAGENTA: [bool; 3] = [true, false, true];

fn is_dark(&[r, g, b, _]: &Pixel) -> bool {
    r.max(g).max(b) < 0.05
}

#[test]
fn vertex_colors_leave_each_tick_its_own_color_and_no_cross() {
    let model = "khr-VertexColorTest-glTF/VertexColorTest.gltf";
    let Some(picture) = seen(model, [0.0, 0.0], 1.0, Shading::Flat) else {
        return;
    };
    for hue_of_tick in [RED, GREEN, BLUE] {
        assert!(picture.count(|pixel| hue(pixel) == hue_of_tick) > 50);
    }
    // The crosses hold the two channels that the vertices' colours put out.
    for hue_of_cross in [CYAN, MAGENTA, YELLOW] {
        assert_eq!(picture.count(|pixel| hue(pixel) == hue_of_cross), 0);
    }
}

#[test]
fn texture_offsets_show_no_yellow_tile() {
    let model = "khr-TextureTransformTest-glTF/TextureTransformTest.gltf";
    let Some(picture) = seen(model, [0.0, 0.55], 1.7, Shading::Flat) else {
        return;
    };
    for x in [-1.1, 0.0, 1.1] {
        for (dx, dy) in [(-0.4, 0.4), (0.4, 0.4), (-0.4, -0.4), (0.0, 0.4)] {
            assert_ne!(hue(&picture.at(x + dx, 0.55 + dy)), YELLOW, "tile at {x}");
        }
    }
}

#[test]
fn a_turned_and_a_scaled_texture_point_at_the_tick() {
    let model = "khr-TextureTransformTest-glTF/TextureTransformTest.gltf";
    let Some(picture) = seen(model, [0.0, -0.55], 1.7, Shading::Flat) else {
        return;
    };
    // The arrow leaves the tile's upper left corner; the markers' places are those of their nodes.
    let halfway =
        |tile: f64, [x, y]: [f64; 2]| picture.at(tile + (x - 0.5) / 2.0, -0.55 + (y + 0.5) / 2.0);
    assert!(is_dark(&halfway(-1.1, [-0.079, -0.516])), "turned");
    for wrong in [[0.278, -0.278], [0.516, 0.079]] {
        assert!(!is_dark(&halfway(-1.1, wrong)), "turned to {wrong:?}");
    }
    assert!(is_dark(&halfway(0.0, [0.0185, -0.0185])), "scaled");
}

#[test]
fn unlit_objects_have_their_colors_and_no_others() {
    let model = "khr-UnlitTest-Binary/UnlitTest.glb";
    let Some(picture) = seen(model, [0.0, 0.0], 5.0, Shading::BlinnPhong) else {
        return;
    };
    // #FF7F00 and #007FFF, whose 7F is 0.2122 of linear light; the file says 0.2176, of a gamma of 2.2.
    let orange = [1.0, 0.2122, 0.0];
    let blue = [0.0, 0.2122, 1.0];
    let is_near = |pixel: &Pixel, color: [f32; 3]| {
        let pairs = pixel.iter().zip(color);
        pairs.into_iter().all(|(a, b)| (a - b).abs() < 0.006)
    };
    let background = picture.pixels[0];
    let others = picture
        .count(|pixel| *pixel != background && !is_near(pixel, orange) && !is_near(pixel, blue));
    assert_eq!(others, 0, "pixels that are lit");
    assert!(picture.count(|pixel| is_near(pixel, orange)) > 50);
    assert!(picture.count(|pixel| is_near(pixel, blue)) > 50);
}

#[test]
fn negative_scale_turns_no_face_inside_out() {
    let model = "khr-NegativeScaleTest-Binary/NegativeScaleTest.glb";
    // The rows of ticks, each block of which has a cross behind it.
    let Some(picture) = seen(model, [1.9, 2.1], 2.6, Shading::Flat) else {
        return;
    };
    assert_eq!(picture.count(|pixel| hue(pixel) == RED), 0, "crosses");
    assert!(picture.count(|pixel| hue(pixel) == GREEN) > 50, "ticks");
}

#[test]
fn alpha_modes_show_ticks_and_no_cross() {
    let model = "khr-AlphaBlendModeTest-Binary/AlphaBlendModeTest.glb";
    let Some(picture) = seen(model, [-2.0, 0.3], 1.7, Shading::Flat) else {
        return;
    };
    assert_eq!(picture.count(|pixel| hue(pixel) == RED), 0, "crosses");
    assert!(picture.count(|pixel| hue(pixel) == GREEN) > 10, "ticks");
}
