//! A glTF file that a test writes.

use glam::Vec3;
use luch::load::{self, Model, gltf};
use serde_json::{Value, json};
use std::fs;
use tempfile::TempDir;

pub(crate) const BYTE: u32 = 5121;
pub(crate) const SHORT: u32 = 5123;
pub(crate) const INT: u32 = 5125;
pub(crate) const FLOAT: u32 = 5126;

/// A document and its one buffer, which lies beside it as `model.bin`.
pub(crate) struct File {
    pub(crate) json: Value,
    pub(crate) bytes: Vec<u8>,
}

impl File {
    /// One node with one mesh of one primitive, which has no attributes yet.
    pub(crate) fn new() -> File {
        let json = json!({
            "asset": {"version": "2.0"},
            "scene": 0,
            "scenes": [{"nodes": [0]}],
            "nodes": [{"mesh": 0}],
            "meshes": [{"name": "chair", "primitives": [{"attributes": {}}]}],
            "accessors": [],
            "bufferViews": [],
        });
        let bytes = Vec::new();
        File { json, bytes }
    }

    /// The same with the triangle (0, 0, 0), (1, 0, 0), (0, 1, 0) as accessor 0.
    pub(crate) fn triangle() -> File {
        let mut file = File::new();
        file.attribute(
            "POSITION",
            "VEC3",
            &floats(&[0., 0., 0., 1., 0., 0., 0., 1., 0.]),
        );
        file
    }

    /// A new view of `bytes`.
    pub(crate) fn view(&mut self, bytes: &[u8]) -> usize {
        while !self.bytes.len().is_multiple_of(4) {
            self.bytes.push(0);
        }
        let start = self.bytes.len();
        self.bytes.extend(bytes);
        let view = json!({"buffer": 0, "byteOffset": start, "byteLength": bytes.len()});
        push(&mut self.json["bufferViews"], view)
    }

    /// A new accessor of tightly packed elements.
    pub(crate) fn accessor(&mut self, component: u32, kind: &str, bytes: &[u8]) -> usize {
        let view = self.view(bytes);
        let components = match kind {
            "SCALAR" => 1,
            "VEC2" => 2,
            "VEC3" => 3,
            _ => 4,
        };
        let size = match component {
            BYTE => 1,
            SHORT => 2,
            _ => 4,
        };
        let count = bytes.len() / components / size;
        let accessor =
            json!({"bufferView": view, "componentType": component, "type": kind, "count": count});
        push(&mut self.json["accessors"], accessor)
    }

    /// A new attribute of the first primitive, of floats.
    pub(crate) fn attribute(&mut self, name: &str, kind: &str, bytes: &[u8]) -> usize {
        let accessor = self.accessor(FLOAT, kind, bytes);
        self.primitive()["attributes"][name] = accessor.into();
        accessor
    }

    /// Indices of the first primitive.
    pub(crate) fn indices(&mut self, component: u32, bytes: &[u8]) -> usize {
        let accessor = self.accessor(component, "SCALAR", bytes);
        self.primitive()["indices"] = accessor.into();
        accessor
    }

    pub(crate) fn primitive(&mut self) -> &mut Value {
        &mut self.json["meshes"][0]["primitives"][0]
    }

    /// The file on the disk, opened; an error without the folder's name.
    pub(crate) fn open(self) -> Result<Model, String> {
        self.open_with(&load::Options::default())
    }

    /// The same, read as `options` say.
    pub(crate) fn open_with(mut self, options: &load::Options) -> Result<Model, String> {
        let folder = TempDir::new().map_err(|e| e.to_string())?;
        if self.json.get("buffers").is_none() {
            let buffer = json!({"uri": "model.bin", "byteLength": self.bytes.len()});
            self.json["buffers"] = json!([buffer]);
        }
        let path = folder.path().join("model.gltf");
        fs::write(folder.path().join("model.bin"), &self.bytes).map_err(|e| e.to_string())?;
        fs::write(&path, self.json.to_string()).map_err(|e| e.to_string())?;
        let prefix = format!("{}/", folder.path().display());
        gltf::open(&path, options).map_err(|error| error.to_string().replace(&prefix, ""))
    }

    /// The same, for a file that must load.
    pub(crate) fn model(self) -> Model {
        self.open().expect("the file is right")
    }
}

pub(crate) fn push(array: &mut Value, value: Value) -> usize {
    let array = array.as_array_mut().expect("an array");
    array.push(value);
    array.len() - 1
}

pub(crate) fn floats(numbers: &[f32]) -> Vec<u8> {
    numbers.iter().flat_map(|x| x.to_le_bytes()).collect()
}

pub(crate) fn shorts(numbers: &[u16]) -> Vec<u8> {
    numbers.iter().flat_map(|x| x.to_le_bytes()).collect()
}

/// The corners of every triangle of the first mesh.
pub(crate) fn corners(model: &Model) -> Vec<[Vec3; 3]> {
    let mesh = &model.meshes[0];
    let triangles = mesh.triangles.iter();
    triangles
        .map(|t| t.map(|i| mesh.positions[i as usize]))
        .collect()
}

pub(crate) fn warnings(model: &Model) -> Vec<String> {
    model.warnings.iter().map(ToString::to_string).collect()
}
