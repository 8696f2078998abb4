//! What a file may take: memory, files elsewhere, and what happens to numbers that are none.

use super::file::{File, floats, warnings};
use image::{ImageBuffer, ImageFormat, Rgba};
use luch::load::{self, Options, Viewpoint, gltf};
use serde_json::json;
use std::fs;
use std::io::Cursor;
use tempfile::TempDir;

fn within(bytes: u64) -> Options {
    Options {
        max_memory: Some(bytes),
        ..Options::default()
    }
}

/// The file in a folder, which is gone with the first of these.
fn written(file: &File) -> (TempDir, std::path::PathBuf) {
    let folder = TempDir::new().expect("a folder");
    let mut json = file.json.clone();
    json["buffers"] = json!([{"uri": "model.bin", "byteLength": file.bytes.len()}]);
    let path = folder.path().join("model.gltf");
    fs::write(folder.path().join("model.bin"), &file.bytes).expect("a writable folder");
    fs::write(&path, json.to_string()).expect("a writable folder");
    (folder, path)
}

fn problem(file: &File, most: u64) -> String {
    let (folder, path) = written(file);
    let prefix = format!("{}/", folder.path().display());
    match gltf::open(&path, &within(most)) {
        Ok(_) => "none".into(),
        Err(error) => error.to_string().replace(&prefix, ""),
    }
}

#[test]
fn a_file_that_does_not_fit_is_refused_part_by_part() {
    let mut file = File::triangle();
    assert_eq!(problem(&file, 1 << 20), "none");
    let ending = "left; make it smaller, or allow more with --max-memory";
    let refused = problem(&file, 100);
    assert!(refused.starts_with("model.gltf: takes 1 MB of memory, ") && refused.ends_with(ending));
    // A node's braces become some hundred bytes each.
    file.json["nodes"] = json!(vec![json!({"mesh": 0}); 10_000]);
    let refused = problem(&file, 4 << 20);
    assert!(
        refused.starts_with("model.gltf: its JSON takes 16 MB of memory, "),
        "{refused}"
    );
    let mut file = File::new();
    file.attribute("POSITION", "VEC3", &floats(&[0.5; 9 * 100_000]));
    let refused = problem(&file, 1 << 20);
    assert!(
        refused.starts_with("model.bin: takes 4 MB of memory, "),
        "{refused}"
    );
    let refused = problem(&file, 5 << 20);
    let expected = "model.gltf: mesh \"chair\", primitive 0 takes 5 MB of memory, ";
    assert!(refused.starts_with(expected), "{refused}");
}

#[test]
fn an_image_that_does_not_fit_costs_its_texture() {
    let mut file = File::triangle();
    file.attribute("TEXCOORD_0", "VEC2", &floats(&[0.0; 6]));
    let white = ImageBuffer::from_pixel(2000, 2000, Rgba([255_u8; 4]));
    let mut png = Cursor::new(Vec::new());
    white
        .write_to(&mut png, ImageFormat::Png)
        .expect("room in memory");
    let view = file.view(png.get_ref());
    file.json["images"] = json!([{"bufferView": view, "mimeType": "image/png"}]);
    file.json["textures"] = json!([{"source": 0}]);
    file.json["materials"] = json!([{"pbrMetallicRoughness": {"baseColorTexture": {"index": 0}}}]);
    file.primitive()["material"] = 0.into();
    let (_folder, path) = written(&file);
    let shown = |most| gltf::open(&path, &within(most)).expect("the file is right");
    assert_eq!(shown(1 << 30).textures.len(), 1);
    let model = shown(10 << 20);
    assert_eq!(model.textures.len(), 0);
    let said = warnings(&model);
    assert!(
        said[0].starts_with("image 0: 2000 x 2000 pixels: takes "),
        "{said:?}"
    );
}

#[test]
fn a_scene_that_multiplies_what_was_read_is_refused() {
    // A mesh flattened by every node cannot be shared: each gets a copy.
    let mut file = File::new();
    let triangle = [0., 0., 0., 1., 0., 0., 0., 1., 0.];
    file.attribute("POSITION", "VEC3", &floats(&triangle.repeat(3000)));
    file.json["nodes"] = json!(vec![json!({"mesh": 0, "scale": [1, 1, 0]}); 1000]);
    file.json["scenes"] = json!([{"nodes": (0..1000).collect::<Vec<_>>()}]);
    let (_folder, path) = written(&file);
    let asset = load::open(&path, &within(100 << 20)).expect("the file is right");
    let viewpoint = Viewpoint::of_file(1.0);
    let problem = asset
        .scene(0.0, &viewpoint)
        .map(drop)
        .map_err(|e| e.to_string());
    let problem = problem.expect_err("a thousand copies do not fit");
    assert!(
        problem.contains("the scene with its search tree takes 913 MB of memory, "),
        "{problem}"
    );
}

#[test]
fn coordinates_and_colours_that_are_no_numbers_are_told() {
    let mut file = File::triangle();
    let uvs = [0.0, f32::NAN, f32::INFINITY, 0.0, 1.0, 1.0];
    file.attribute("TEXCOORD_0", "VEC2", &floats(&uvs));
    let colors = [f32::NAN, 0., 0., 0., f32::NAN, 0., 0., 0., 0.5];
    file.attribute("COLOR_0", "VEC3", &floats(&colors));
    let model = file.model();
    let mesh = &model.meshes[0];
    assert!(mesh.uvs[0].iter().all(|uv| uv.is_finite()));
    assert!(mesh.colors.as_flattened().iter().all(|c| c.is_finite()));
    assert_eq!(
        warnings(&model),
        [
            "texture coordinates that are no finite numbers are (0, 0) (2 times)",
            "a channel of a vertex colour that is no number is 0 (2 times)",
        ]
    );
}
