//! The models in `assets/` are made by the project: these tests make them again and compare. `BLESS=1` writes them.

use crate::common::picture;
use glam::Vec3;
use luch::generate;
use luch::load;
use luch::mesh::Mesh;
use luch::scene::Scene;
use luch::shade::Shading;
use std::fmt::Write;
use std::fs;
use std::path::{Path, PathBuf};

fn asset(name: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("assets/models")
        .join(name)
}

/// Holds a file in `assets/models` against what it should be.
fn assert_asset(name: &str, expected: &[u8]) {
    let path = asset(name);
    if std::env::var_os("BLESS").is_some() {
        fs::write(&path, expected).expect("a writable asset");
    }
    let found = fs::read(&path).unwrap_or_default();
    assert!(
        found == expected,
        "{name} is not what the project makes; BLESS=1 writes it anew"
    );
}

/// A mesh as OBJ, with its smooth normals.
fn obj(mesh: &Mesh, comment: &str) -> String {
    let mut text = format!("# {comment}\no {}\n", mesh.name);
    for p in &mesh.positions {
        writeln!(text, "v {:.5} {:.5} {:.5}", p.x, p.y, p.z).expect("a string");
    }
    for n in &mesh.normals {
        writeln!(text, "vn {:.4} {:.4} {:.4}", n.x, n.y, n.z).expect("a string");
    }
    for corners in &mesh.triangles {
        let [a, b, c] = corners.map(|i| i + 1);
        writeln!(text, "f {a}//{a} {b}//{b} {c}//{c}").expect("a string");
    }
    text
}

#[test]
fn the_knot_is_what_the_generator_makes() {
    let text = obj(
        &generate::knot(96, 12),
        "a tube along a trefoil knot, made by luch (generate::knot), CC0",
    );
    assert_asset("knot.obj", text.as_bytes());
}

/// A cube of side 2: for each side its normal and its corners, counter-clockwise from outside.
fn cube_sides() -> [(Vec3, [Vec3; 4]); 6] {
    [
        Vec3::X,
        Vec3::NEG_X,
        Vec3::Y,
        Vec3::NEG_Y,
        Vec3::Z,
        Vec3::NEG_Z,
    ]
    .map(|n| {
        // Any two axes of the side, the second a quarter turn on from the first.
        let e1 = Vec3::new(n.z, n.x, n.y).abs();
        let e2 = n.cross(e1);
        (n, [n - e1 - e2, n + e1 - e2, n + e1 + e2, n - e1 + e2])
    })
}

/// The image's corners, in the order of a side's: (0, 0) is the upper left one.
const CUBE_UVS: [[f32; 2]; 4] = [[0.0, 1.0], [1.0, 1.0], [1.0, 0.0], [0.0, 0.0]];

fn cube_obj() -> String {
    let mut text = String::from(
        "# a cube, made by luch (tests/assets.rs), CC0\nmtllib cube.mtl\no cube\nusemtl red\n",
    );
    for (n, corners) in cube_sides() {
        for p in corners {
            writeln!(text, "v {} {} {}", p.x, p.y, p.z).expect("a string");
        }
        writeln!(text, "vn {} {} {}", n.x, n.y, n.z).expect("a string");
    }
    for [u, v] in CUBE_UVS {
        // OBJ counts v from below.
        writeln!(text, "vt {u} {}", 1.0 - v).expect("a string");
    }
    for side in 1..=6 {
        let corner = |i: usize| format!("{}/{i}/{side}", (side - 1) * 4 + i);
        writeln!(
            text,
            "f {} {} {} {}",
            corner(1),
            corner(2),
            corner(3),
            corner(4)
        )
        .expect("a string");
    }
    text
}

const CUBE_MTL: &str = "# the cube's material\nnewmtl red\nKd 0.8 0.1 0.1\n";

/// A square of side 2 that faces +z.
const SHEET_OBJ: &str = "# a square, made by luch (tests/assets.rs), CC0
o sheet
v -1 -1 0
v 1 -1 0
v 1 1 0
v -1 1 0
f 1 2 3 4
";

/// Positions, normals, texture coordinates and indices, one after the other.
fn cube_buffer() -> Vec<u8> {
    let sides = cube_sides();
    let positions = sides
        .iter()
        .flat_map(|(_, corners)| corners.iter().flat_map(|p| p.to_array()));
    let normals = sides.iter().flat_map(|(n, _)| [n.to_array(); 4]).flatten();
    let uvs = [CUBE_UVS; 6].into_iter().flatten().flatten();
    let mut bytes: Vec<u8> = positions
        .chain(normals)
        .chain(uvs)
        .flat_map(f32::to_le_bytes)
        .collect();
    let indices = (0..6u16).flat_map(|side| [0, 1, 2, 0, 2, 3].map(|i| side * 4 + i));
    bytes.extend(indices.flat_map(u16::to_le_bytes));
    bytes
}

/// The cube's JSON, its buffer at `uri` or, where that is empty, in the GLB's chunk.
fn cube_json(uri: &str) -> String {
    let uri = if uri.is_empty() {
        String::new()
    } else {
        format!("\"uri\":\"{uri}\",")
    };
    format!(
        r#"{{"asset":{{"version":"2.0","generator":"luch (tests/assets.rs), CC0"}},
"scene":0,"scenes":[{{"nodes":[0]}}],"nodes":[{{"name":"cube","mesh":0}}],
"meshes":[{{"name":"cube","primitives":[{{"attributes":{{"POSITION":0,"NORMAL":1,"TEXCOORD_0":2}},"indices":3,"material":0}}]}}],
"materials":[{{"name":"red","doubleSided":true,"pbrMetallicRoughness":{{"baseColorFactor":[0.8,0.1,0.1,1],"metallicFactor":0}}}}],
"buffers":[{{{uri}"byteLength":840}}],
"bufferViews":[{{"buffer":0,"byteOffset":0,"byteLength":288}},{{"buffer":0,"byteOffset":288,"byteLength":288}},{{"buffer":0,"byteOffset":576,"byteLength":192}},{{"buffer":0,"byteOffset":768,"byteLength":72}}],
"accessors":[{{"bufferView":0,"componentType":5126,"count":24,"type":"VEC3","min":[-1,-1,-1],"max":[1,1,1]}},{{"bufferView":1,"componentType":5126,"count":24,"type":"VEC3"}},{{"bufferView":2,"componentType":5126,"count":24,"type":"VEC2"}},{{"bufferView":3,"componentType":5123,"count":36,"type":"SCALAR"}}]}}
"#
    )
}

fn cube_glb() -> Vec<u8> {
    let mut json = cube_json("").into_bytes();
    json.resize(json.len().next_multiple_of(4), b' ');
    let chunk = |kind: &[u8; 4], bytes: &[u8]| {
        [&(bytes.len() as u32).to_le_bytes()[..], kind, bytes].concat()
    };
    let chunks = [chunk(b"JSON", &json), chunk(b"BIN\0", &cube_buffer())].concat();
    let length = (chunks.len() + 12) as u32;
    [
        b"glTF",
        &2u32.to_le_bytes()[..],
        &length.to_le_bytes(),
        &chunks,
    ]
    .concat()
}

#[test]
fn the_sheet_is_what_this_file_says() {
    assert_asset("sheet.obj", SHEET_OBJ.as_bytes());
}

#[test]
fn the_cube_is_what_this_file_makes() {
    assert_eq!(cube_buffer().len(), 840);
    assert_asset("cube.obj", cube_obj().as_bytes());
    assert_asset("cube.mtl", CUBE_MTL.as_bytes());
    assert_asset("cube.bin", &cube_buffer());
    assert_asset("cube.gltf", cube_json("cube.bin").as_bytes());
    assert_asset("cube.glb", &cube_glb());
}

#[test]
fn the_same_cube_as_gltf_glb_and_obj_is_the_same_scene() {
    let scenes = ["cube.gltf", "cube.glb", "cube.obj"].map(|name| {
        let opened = load::open(&asset(name), &load::Options::default())
            .unwrap_or_else(|error| panic!("{error}"));
        let (scene, _) = opened
            .scene(0.0, &picture::viewpoint(1.0))
            .unwrap_or_else(|error| panic!("{error}"));
        scene
    });
    let corners = |scene: &Scene| -> Vec<_> {
        assert_eq!(scene.instances().len(), 1);
        let mesh = &scene.meshes()[0];
        let vertex = |&i: &u32| {
            (
                mesh.positions[i as usize],
                mesh.normals[i as usize],
                mesh.uvs[0][i as usize],
            )
        };
        mesh.triangles.iter().flatten().map(vertex).collect()
    };
    let [gltf, glb, obj] = &scenes;
    assert_eq!(corners(gltf).len(), 36);
    assert_eq!(corners(gltf), corners(glb));
    assert_eq!(corners(gltf), corners(obj));
    // The materials differ in kind; their colour alone is the same.
    let flat = |scene| picture::bits(&picture::of(scene, 32, 24, Shading::Flat));
    assert_eq!(flat(gltf), flat(glb));
    assert_eq!(flat(gltf), flat(obj));
}
