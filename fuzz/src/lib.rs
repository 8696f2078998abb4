//! What the targets share: bytes become files in a folder, and files a picture.

use luch::accel::{Accel, Options as AccelOptions};
use luch::load::{self, Options, Surrounding, Viewpoint};
use luch::render::{Progress, Settings, render};
use luch::shade::Shading;
use std::fs;
use std::path::Path;
use std::sync::OnceLock;
use tempfile::TempDir;

/// Below what the fuzzer allows, so that what breaks a limit of luch's is a finding.
const MAX_MEMORY: u64 = 256 << 20;

/// More primitives than these are not searched: the doors are what is tried, and runs should be many.
const MOST_PRIMITIVES: u32 = 20_000;

/// A model of one triangle whose texture is `image.EXTENSION`.
const TEXTURED: &str = r#"{"asset":{"version":"2.0"},"scene":0,"scenes":[{"nodes":[0]}],"nodes":[{"mesh":0}],
"meshes":[{"primitives":[{"attributes":{"POSITION":0,"TEXCOORD_0":1},"material":0}]}],
"materials":[{"pbrMetallicRoughness":{"baseColorTexture":{"index":0}}}],
"extensionsUsed":["EXT_texture_webp","KHR_texture_basisu"],
"textures":[{"source":0,"extensions":{"EXT_texture_webp":{"source":0},"KHR_texture_basisu":{"source":0}}}],
"images":[{"uri":"image.EXTENSION"}],"accessors":[
{"bufferView":0,"componentType":5126,"type":"VEC3","count":3},{"bufferView":0,"componentType":5126,"type":"VEC2","count":3}],
"bufferViews":[{"buffer":0,"byteLength":36}],
"buffers":[{"byteLength":36,"uri":"data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA"}]}"#;

/// A ball lit by `environment.EXTENSION`.
const LIT: &str = r#"material = [{ name = "white", diffuse = [1, 1, 1] }]
sphere = [{ center = [0, 0, 0], radius = 1, material = "white" }]
camera = { position = [0, 0, 4], look_at = [0, 0, 0] }
environment = { kind = "file", path = "environment.EXTENSION" }"#;

/// Opens, builds and renders the first of these files, all of which lie in one folder.
pub fn files(files: &[(&str, &[u8])]) {
    static FOLDER: OnceLock<TempDir> = OnceLock::new();
    let folder = FOLDER.get_or_init(|| {
        // Memory rather than a disk, where there is such a folder.
        let memory = Path::new("/dev/shm");
        let folder = if memory.is_dir() {
            tempfile::tempdir_in(memory)
        } else {
            tempfile::tempdir()
        };
        folder.expect("a temporary folder")
    });
    for (name, bytes) in files {
        fs::write(folder.path().join(name), bytes).expect("a writable folder");
    }
    if let Some((name, _)) = files.first() {
        opened(&folder.path().join(name));
    }
}

/// A textured triangle with these bytes for its image.
pub fn image(extension: &str, bytes: &[u8]) {
    let gltf = TEXTURED.replace("EXTENSION", extension);
    let image = format!("image.{extension}");
    files(&[("textured.gltf", gltf.as_bytes()), (&image, bytes)]);
}

/// A ball in an environment with these bytes for its picture.
pub fn environment(extension: &str, bytes: &[u8]) {
    let scene = LIT.replace("EXTENSION", extension);
    let picture = format!("environment.{extension}");
    files(&[("lit.toml", scene.as_bytes()), (&picture, bytes)]);
}

/// What stands before and after the first zero.
pub fn halves(bytes: &[u8]) -> (&[u8], &[u8]) {
    let end = bytes.iter().position(|&byte| byte == 0);
    let (first, second) = bytes.split_at(end.unwrap_or(bytes.len()));
    (first, second.get(1..).unwrap_or_default())
}

fn opened(path: &Path) {
    let options = Options {
        max_memory: Some(MAX_MEMORY),
        ..Options::default()
    };
    let asset = match load::open(path, &options) {
        Ok(asset) => asset,
        Err(error) => return one_line(&error.to_string()),
    };
    asset.warnings.iter().for_each(|w| one_line(&w.to_string()));
    // Scenes say what is about them; the studio of models takes time, and is always the same.
    let mut viewpoint = Viewpoint::of_file(1.0);
    if !asset.is_scene_file {
        viewpoint.environment = Surrounding::Ready(None);
    }
    let (scene, choices) = match asset.scene(0.0, &viewpoint) {
        Ok(made) => made,
        Err(error) => return one_line(&error.to_string()),
    };
    choices.lines.iter().for_each(|line| one_line(line));
    if scene.primitive_count() > MOST_PRIMITIVES {
        return;
    }
    let accel = Accel::build(&scene, &AccelOptions::default());
    let settings = Settings::new(8, 8, 1, 3, Shading::BlinnPhong).expect("right settings");
    let film = render(&scene, &accel, &settings, &Progress::default());
    let beauty = film.layers.first().map_or(&[][..], |layer| &layer.values);
    assert!(beauty.iter().all(|number| number.is_finite()));
}

#[track_caller]
fn one_line(text: &str) {
    assert!(
        !text.is_empty() && !text.contains(char::is_control),
        "{text:?}"
    );
}
