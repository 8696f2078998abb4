//! Files as a user has them: written to a folder, opened through the front door.

use luch::load::{self, Model, obj};
use luch::material::{Material, Model as Shading, Phong};
use luch::mesh::Mesh;
use tempfile::TempDir;

pub(super) const TRIANGLE: &str = "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n";

pub(super) const TEXTURED: &str =
    "mtllib a.mtl\nusemtl a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nvt 0 0\nvt 1 0\nvt 0 1\nf 1/1 2/2 3/3\n";

pub(super) fn folder(files: &[(&str, &[u8])]) -> TempDir {
    let folder = tempfile::tempdir().unwrap();
    for (name, bytes) in files {
        let path = folder.path().join(name);
        std::fs::create_dir_all(path.parent().unwrap()).unwrap();
        std::fs::write(path, bytes).unwrap();
    }
    folder
}

pub(super) fn open(obj: impl AsRef<[u8]>) -> Model {
    open_with(obj, &[])
}

pub(super) fn open_with(obj: impl AsRef<[u8]>, beside: &[(&str, &[u8])]) -> Model {
    let folder = folder(beside);
    let path = folder.path().join("model.obj");
    std::fs::write(&path, obj).unwrap();
    obj::open(&path, &load::Options::default()).unwrap()
}

/// What stands after the file's name.
pub(super) fn problem(obj: impl AsRef<[u8]>) -> String {
    let folder = folder(&[("model.obj", obj.as_ref())]);
    let error = obj::open(&folder.path().join("model.obj"), &load::Options::default()).unwrap_err();
    let text = error.to_string();
    text.split_once("model.obj: ").unwrap().1.to_owned()
}

pub(super) fn warnings(model: &Model) -> Vec<String> {
    model.warnings.iter().map(ToString::to_string).collect()
}

pub(super) fn area(mesh: &Mesh) -> f32 {
    let one = |[a, b, c]: &[u32; 3]| {
        let [a, b, c] = [a, b, c].map(|&i| mesh.positions[i as usize]);
        (b - a).cross(c - a).length() / 2.0
    };
    mesh.triangles.iter().map(one).sum()
}

pub(super) fn png(width: u32, pixels: &[[u8; 4]]) -> Vec<u8> {
    let height = pixels.len() as u32 / width;
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, width, height);
    encoder.set_color(png::ColorType::Rgba);
    let mut writer = encoder.write_header().unwrap();
    writer.write_image_data(pixels.as_flattened()).unwrap();
    writer.finish().unwrap();
    bytes
}

pub(super) fn phong(material: &Material) -> &Phong {
    match &material.model {
        Shading::Phong(phong) => phong,
        other => panic!("{other:?}"),
    }
}
