//! What a picture shows of a file, where the file leaves one right answer only.

use super::file::{File, floats, push, shorts};
use crate::common::picture;
use luch::load::{self, Asset};
use luch::shade::Shading;
use serde_json::{Value, json};
use std::fs;

/// Texture coordinates of a square's corners, from the lower left counter-clockwise, with the image upright on it.
const UPRIGHT: [[f32; 2]; 4] = [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]];

const REPEAT: u32 = 10497;
const MIRRORED_REPEAT: u32 = 33648;
const CLAMP_TO_EDGE: u32 = 33071;
const NEAREST: u32 = 9728;

/// The square from -1 to 1 in x and y, before a parallel camera that sees exactly it. Texture 0 is an image of these
/// rows of pixels; material 0 has no texture yet.
fn square(uvs: [[f32; 2]; 4], image: &[&[[u8; 4]]]) -> File {
    let mut file = File::new();
    let corners = [[-1.0, -1.0], [1.0, -1.0], [1.0, 1.0], [-1.0, 1.0]];
    let positions = corners.map(|[x, y]| [x, y, 0.0]);
    file.attribute("POSITION", "VEC3", &floats(positions.as_flattened()));
    file.attribute("TEXCOORD_0", "VEC2", &floats(uvs.as_flattened()));
    file.indices(super::file::SHORT, &shorts(&[0, 1, 2, 0, 2, 3]));
    file.primitive()["material"] = 0.into();
    let view = file.view(&png(image));
    file.json["images"] = json!([{"bufferView": view, "mimeType": "image/png"}]);
    file.json["samplers"] = json!([{"magFilter": NEAREST}]);
    file.json["textures"] = json!([{"source": 0, "sampler": 0}]);
    file.json["materials"] = json!([{"extensions": {"KHR_materials_unlit": {}}}]);
    let parallel = json!({"xmag": 1, "ymag": 1, "znear": 0, "zfar": 10});
    file.json["cameras"] = json!([{"type": "orthographic", "orthographic": parallel}]);
    add_node(&mut file, json!({"camera": 0, "translation": [0, 0, 1]}));
    file
}

fn add_node(file: &mut File, node: Value) {
    let index = push(&mut file.json["nodes"], node);
    push(&mut file.json["scenes"][0]["nodes"], index.into());
}

fn png(rows: &[&[[u8; 4]]]) -> Vec<u8> {
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, rows[0].len() as u32, rows.len() as u32);
    encoder.set_color(png::ColorType::Rgba);
    let mut writer = encoder.write_header().expect("a header");
    let pixels = rows.concat();
    writer
        .write_image_data(pixels.as_flattened())
        .expect("pixels");
    drop(writer);
    bytes
}

fn asset(mut file: File) -> Asset {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("model.gltf");
    file.json["buffers"] = json!([{"uri": "model.bin", "byteLength": file.bytes.len()}]);
    fs::write(folder.path().join("model.bin"), &file.bytes).expect("a buffer");
    fs::write(&path, file.json.to_string()).expect("a file");
    load::open(&path, &load::Options::default()).expect("the file is right")
}

/// The pixels of a picture of the file, row by row: linear light and alpha.
fn pixels(file: File, width: u32, height: u32) -> Vec<[f32; 4]> {
    let viewpoint = picture::viewpoint(f64::from(width) / f64::from(height));
    let (scene, _) = asset(file).scene(0.0, &viewpoint).expect("a scene");
    let film = picture::of(&scene, width, height, Shading::Lambert);
    film.layers[0].values.as_chunks().0.to_vec()
}

const RED: [u8; 4] = [255, 0, 0, 255];
const GREEN: [u8; 4] = [0, 255, 0, 255];
const BLUE: [u8; 4] = [0, 0, 255, 255];
const WHITE: [u8; 4] = [255; 4];
const BLACK: [u8; 4] = [0, 0, 0, 255];

/// A pixel of light in which every channel is full or empty.
fn light(texel: [u8; 4]) -> [f32; 4] {
    texel.map(|channel| f32::from(channel) / 255.0)
}

fn base_color() -> Value {
    json!({"baseColorTexture": {"index": 0}})
}

#[test]
fn u_runs_to_the_right_and_v_down_the_image() {
    let mut file = square(UPRIGHT, &[&[RED, GREEN], &[BLUE, WHITE]]);
    file.json["materials"][0]["pbrMetallicRoughness"] = base_color();
    assert_eq!(pixels(file, 2, 2), [RED, GREEN, BLUE, WHITE].map(light));
}

#[test]
fn each_wrap_mode_says_what_lies_outside_the_image() {
    let (b, w) = (BLACK, WHITE);
    for (field, across) in [("wrapS", true), ("wrapT", false)] {
        // The image and another on each side.
        let wide = UPRIGHT.map(|uv| {
            let [u, v] = uv.map(|x| 3.0 * x - 1.0);
            if across { [u, 0.5] } else { [0.5, v] }
        });
        for (mode, expected) in [
            (REPEAT, [b, w, b, w, b, w]),
            (MIRRORED_REPEAT, [w, b, b, w, w, b]),
            (CLAMP_TO_EDGE, [b, b, b, w, w, w]),
        ] {
            let image: &[&[[u8; 4]]] = if across { &[&[b, w]] } else { &[&[b], &[w]] };
            let mut file = square(wide, image);
            file.json["materials"][0]["pbrMetallicRoughness"] = base_color();
            file.json["samplers"][0][field] = mode.into();
            let found = pixels(file, 6, 6);
            let middle = |i: usize| if across { 18 + i } else { 6 * i + 3 };
            let found: Vec<[f32; 4]> = (0..6).map(|i| found[middle(i)]).collect();
            assert_eq!(found, expected.map(light), "{field} {mode}");
        }
    }
}

#[test]
fn a_mask_shows_what_just_reaches_its_cutoff() {
    let texel = |alpha| [255, 255, 255, alpha];
    let mut file = square(UPRIGHT, &[&[texel(127), texel(128)]]);
    let material = &mut file.json["materials"][0];
    material["pbrMetallicRoughness"] = base_color();
    material["alphaMode"] = "MASK".into();
    material["alphaCutoff"] = (128.0f32 / 255.0).into();
    assert_eq!(pixels(file, 2, 2)[..2], [[0.0; 4], [1.0; 4]]);
}

/// What a square shows whose normals lean 45 degrees as `texel` says, in red light from 45 degrees to the right of the
/// viewer and green light from 45 degrees above: the cosines between normal and lights.
fn leaning(texel: [u8; 4], uvs: [[f32; 2]; 4], node: Value) -> [f32; 2] {
    let mut file = square(uvs, &[&[texel]]);
    file.json["materials"] = json!([{
        "pbrMetallicRoughness": {"metallicFactor": 0},
        "normalTexture": {"index": 0},
        // Matt, so that it shows cosines alone.
        "extensions": {"KHR_materials_specular": {"specularFactor": 0}},
    }]);
    for (field, value) in node.as_object().expect("fields") {
        file.json["nodes"][0][field] = value.clone();
    }
    let sun = |color: [f32; 3]| {
        let lux = std::f32::consts::PI;
        json!({"type": "directional", "color": color, "intensity": lux})
    };
    let lights = [sun([1.0, 0.0, 0.0]), sun([0.0, 1.0, 0.0])];
    file.json["extensions"] = json!({"KHR_lights_punctual": {"lights": lights}});
    let (sine, cosine) = (0.382_683_43, 0.923_879_5);
    let turns = [[0.0, sine, 0.0, cosine], [-sine, 0.0, 0.0, cosine]];
    for (light, rotation) in turns.iter().enumerate() {
        let carried = json!({"KHR_lights_punctual": {"light": light}});
        add_node(
            &mut file,
            json!({"rotation": rotation, "extensions": carried}),
        );
    }
    let [red, green, ..] = pixels(file, 1, 1)[0];
    [red, green]
}

#[test]
fn normals_lean_along_u_and_up_the_image_however_that_lies() {
    let mirrored = UPRIGHT.map(|[u, v]| [1.0 - u, v]);
    let overturned = UPRIGHT.map(|[u, v]| [u, 1.0 - v]);
    let (along_u, up) = ([218, 128, 218, 255], [128, 218, 218, 255]);
    let (straight, turned) = (json!({}), json!({"scale": [-1, 1, 1]}));
    for (texel, uvs, node, expected) in [
        (along_u, UPRIGHT, &straight, [1.0, 0.5]),
        (along_u, mirrored, &straight, [0.0, 0.5]),
        (along_u, UPRIGHT, &turned, [0.0, 0.5]),
        (along_u, mirrored, &turned, [1.0, 0.5]),
        (up, UPRIGHT, &straight, [0.5, 1.0]),
        (up, mirrored, &straight, [0.5, 1.0]),
        (up, overturned, &straight, [0.5, 0.0]),
        (up, UPRIGHT, &turned, [0.5, 1.0]),
    ] {
        let found = leaning(texel, uvs, node.clone());
        let is_near = |(found, expected): (f32, f32)| (found - expected).abs() < 0.01;
        assert!(
            found.into_iter().zip(expected).all(is_near),
            "{texel:?} {uvs:?} {node}: {found:?}, expected {expected:?}"
        );
    }
}

#[test]
fn a_mirrored_triangle_is_framed_from_its_front() {
    for scale in [[1, 1, 1], [-1, 1, 1], [1, 1, -1], [-1, -1, -1]] {
        let mut file = File::triangle();
        file.json["nodes"][0]["scale"] = json!(scale);
        let seen = pixels(file, 8, 8).iter().any(|&[.., alpha]| alpha > 0.0);
        assert!(seen, "{scale:?}");
    }
}

#[test]
fn a_file_in_bright_light_keeps_its_grey_background() {
    let mut file = File::triangle();
    let sun = json!({"type": "directional", "intensity": 100_000});
    file.json["extensions"] = json!({"KHR_lights_punctual": {"lights": [sun]}});
    add_node(
        &mut file,
        json!({"extensions": {"KHR_lights_punctual": {"light": 0}}}),
    );
    let (scene, choices) = asset(file)
        .scene(0.0, &picture::viewpoint(1.0))
        .expect("a scene");
    let stops = choices.exposure;
    let shown = scene.background().color.g * libm::exp2f(stops);
    let (plain, _) = asset(File::triangle())
        .scene(0.0, &picture::viewpoint(1.0))
        .expect("a scene");
    assert!(stops < -10.0 && (shown - plain.background().color.g).abs() < 1e-5);
}
