//! Crops, tiles and margins: each pixel has the bits that it has in the whole picture.

use crate::common::{models, picture};
use crate::invariance::description;
use luch::accel::{Accel, Options};
use luch::film::{Film, Layers, Window};
use luch::load::{self, Viewpoint};
use luch::render::{Progress, Settings, render};
use luch::sampling::{Filter, Pattern, Sampling};
use luch::scene::Scene;
use std::path::Path;

/// Samples as a model gets them.
const OF_MODEL: Sampling = Sampling {
    samples: 16,
    pattern: Pattern::Spread,
    filter: Filter::BlackmanHarris,
    adaptive: true,
};

const WIDTH: u32 = 45;
const HEIGHT: u32 = 39;

fn settings(sampling: Sampling) -> Settings {
    let layers = Layers {
        cost: true,
        samples: true,
        components: true,
        ..Layers::default()
    };
    Settings::new(WIDTH, HEIGHT, 1, 5, Default::default())
        .and_then(|settings| settings.with_sampling(sampling))
        .and_then(|settings| settings.with_layers(layers))
        .expect("settings")
}

fn window(left: i32, top: i32, width: u32, height: u32) -> Window {
    Window {
        left,
        top,
        width,
        height,
    }
}

/// The bits of the pixels of `film` that are in a window, layer by layer.
fn bits_within(film: &Film, part: Window) -> Vec<Vec<u32>> {
    let of_film = film.window();
    let columns = || part.left..part.right() as i32;
    let rows = part.top..part.bottom() as i32;
    let places: Vec<[i32; 2]> = rows.flat_map(|j| columns().map(move |i| [i, j])).collect();
    let mut bits = Vec::new();
    for layer in &film.layers {
        let channels = layer.channels.len();
        let of_pixel = |&place: &[i32; 2]| {
            let at = of_film.index(place).expect("a pixel of the film") * channels;
            &layer.values[at..at + channels]
        };
        bits.push(
            places
                .iter()
                .flat_map(of_pixel)
                .map(|value| value.to_bits())
                .collect(),
        );
    }
    bits
}

/// Finds whether every window of a scene has the bits that the whole picture has there, and every margin those of a wider
/// one.
fn assert_windows(name: &str, scene: &Scene, sampling: Sampling) {
    let settings = settings(sampling);
    let accel = Accel::build(scene, &Options::default());
    let film = |window, side| {
        let settings = settings.with_window(window).expect("a window");
        let settings = settings.with_tile_side(side);
        render(scene, &accel, &settings, &Progress::default())
    };
    let display = Window::whole(WIDTH, HEIGHT);
    let whole = render(scene, &accel, &settings, &Progress::default());
    assert_eq!(whole.window(), display);
    let wide = film(display.grown(9), 8);
    assert_eq!([wide.display_width, wide.display_height], [WIDTH, HEIGHT]);
    assert_eq!(
        bits_within(&wide, display),
        bits_within(&whole, display),
        "{name}: overscan"
    );
    for (part, side) in [
        (window(0, 0, 1, 1), 8),
        (window(WIDTH as i32 - 1, HEIGHT as i32 - 1, 1, 1), 8),
        (window(13, 7, 29, 30), 8),
        (window(13, 7, 29, 30), 1),
        (window(13, 7, 29, 30), 5),
        (window(13, 7, 29, 30), 1000),
        (window(0, 20, WIDTH, 3), 8),
        (display.strip(2, 3), 8),
        (display.column(3, 4).strip(1, 2), 7),
        // Partly, and wholly, outside the picture.
        (window(-5, 33, 20, 10), 8),
        (window(WIDTH as i32, 3, 4, 9), 3),
        (display.grown(1), 8),
    ] {
        let found = film(part, side);
        assert_eq!(found.window(), part, "{name}");
        assert!(
            bits_within(&found, part) == bits_within(&wide, part),
            "{name}: {part:?}, tiles of {side}"
        );
    }
}

#[test]
fn a_window_has_the_whole_pictures_pixels_however_they_are_sampled() {
    let scene = Scene::new(description(1.0, 0.0)).expect("a scene");
    assert_windows("one sample", &scene, Sampling::grid(1));
    assert_windows("a grid", &scene, Sampling::grid(9));
    assert_windows("adaptive", &scene, OF_MODEL);
}

#[test]
fn a_window_of_a_paper_scene_is_a_part_of_its_picture() {
    for name in ["figure-3", "figure-4", "mixed"] {
        let file = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("assets/scenes/{name}.toml"));
        let mut asset = load::open(&file, &Default::default()).expect("a paper scene");
        let viewpoint = picture::viewpoint(4.0 / 3.0);
        let (scene, _) = asset.take_scene(0.0, &viewpoint).expect("a scene");
        assert_windows(name, &scene, Sampling::grid(4));
    }
}

#[test]
fn a_window_of_a_model_on_its_ground_in_an_environment_is_a_part_of_its_picture() {
    let test = "a_window_of_a_model_on_its_ground_in_an_environment_is_a_part_of_its_picture";
    let Some(folder) = models::folder(test, "valid") else {
        return;
    };
    for name in ["khr-Avocado-glTF"] {
        let files = models::below(&folder.join(name), &["glb", "gltf"]);
        let Some(file) = files.first() else {
            models::say(&format!("SKIPPED, not passed: {test}: there is no {name}"));
            continue;
        };
        let mut asset = load::open(file, &Default::default()).expect("a model");
        let viewpoint = Viewpoint::of_file(4.0 / 3.0);
        let (scene, _) = asset.take_scene(0.0, &viewpoint).expect("a scene");
        assert_windows(name, &scene, OF_MODEL);
    }
}
