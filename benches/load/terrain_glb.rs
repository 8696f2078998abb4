//! A landscape as GLB, as far as the scene; throughput in bytes.

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Throughput};
use glam::Vec3;
use luch::generate;
use luch::load::{self, Viewpoint};
use serde_json::json;
use std::path::Path;
use std::{fs, io};

/// The cells of a landscape of about 1.1 million triangles, along one side.
const CELLS: u32 = 741;

pub(super) fn case(group: &mut BenchmarkGroup<WallTime>, folder: &Path) {
    let path = folder.join("terrain.glb");
    let length = write_terrain(&path).expect("the landscape on the disk");
    let viewpoint = Viewpoint::of_file(1.0);
    group.throughput(Throughput::Bytes(length));
    group.bench_function("terrain.glb", |bench| {
        bench.iter(|| {
            let mut asset = load::open(&path, &load::Options::default())?;
            asset.take_scene(0.0, &viewpoint)
        })
    });
}

/// Writes a landscape with normals, and says how many bytes it has.
fn write_terrain(path: &Path) -> io::Result<u64> {
    let mesh = generate::terrain(CELLS, 1);
    let points = || mesh.positions.iter();
    let floats = |v: &Vec3| v.to_array().map(f32::to_le_bytes);
    let corners = mesh.triangles.as_flattened().iter();
    let views: [Vec<u8>; 3] = [
        points().flat_map(floats).flatten().collect(),
        points().flat_map(|_| floats(&Vec3::Y)).flatten().collect(),
        corners.flat_map(|corner| corner.to_le_bytes()).collect(),
    ];
    let [positions, normals, indices] = views.each_ref().map(Vec::len);
    let vertices = mesh.positions.len();
    let mut text = json!({
        "asset": {"version": "2.0"},
        "scenes": [{"nodes": [0]}],
        "nodes": [{"mesh": 0}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0, "NORMAL": 1}, "indices": 2}]}],
        "accessors": [
            {"bufferView": 0, "componentType": 5126, "type": "VEC3", "count": vertices},
            {"bufferView": 1, "componentType": 5126, "type": "VEC3", "count": vertices},
            {"bufferView": 2, "componentType": 5125, "type": "SCALAR", "count": indices / 4},
        ],
        "bufferViews": [
            {"buffer": 0, "byteLength": positions},
            {"buffer": 0, "byteOffset": positions, "byteLength": normals},
            {"buffer": 0, "byteOffset": positions + normals, "byteLength": indices},
        ],
        "buffers": [{"byteLength": positions + normals + indices}],
    })
    .to_string();
    while !text.len().is_multiple_of(4) {
        text.push(' ');
    }
    let binary = views.concat();
    let word = |length: usize| (length as u32).to_le_bytes();
    let file = [
        b"glTF".as_slice(),
        &word(2),
        &word(12 + 8 + text.len() + 8 + binary.len()),
        &word(text.len()),
        b"JSON",
        text.as_bytes(),
        &word(binary.len()),
        b"BIN\0",
        &binary,
    ]
    .concat();
    fs::write(path, &file)?;
    Ok(file.len() as u64)
}
