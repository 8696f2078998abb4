//! A terrain as OBJ; throughput in bytes.

use criterion::measurement::WallTime;
use criterion::{BenchmarkGroup, Throughput};
use luch::load;
use std::fs;
use std::path::Path;

/// Squares along one side of the terrain.
const SIDE: usize = 300;

/// A terrain of `2 SIDE^2` triangles with texture coordinates and normals, as a modelling program writes it.
fn terrain() -> String {
    let mut text = String::from("o terrain\n");
    let places = || (0..=SIDE).flat_map(|y| (0..=SIDE).map(move |x| (x as f32, y as f32)));
    for (x, y) in places() {
        text += &format!("v {:.6} {:.6} {:.6}\n", x / 7.0, (x * y) % 1.3, y / 7.0);
    }
    for (x, y) in places() {
        text += &format!("vt {:.6} {:.6}\n", x / 300.0, y / 300.0);
    }
    for (x, y) in places() {
        text += &format!("vn {:.4} 0.9 {:.4}\n", x % 0.3, y % 0.3);
    }
    for (x, y) in (0..SIDE).flat_map(|y| (0..SIDE).map(move |x| (x, y))) {
        let a = y * (SIDE + 1) + x + 1;
        let (b, c, d) = (a + SIDE + 1, a + SIDE + 2, a + 1);
        text += &format!("f {a}/{a}/{a} {b}/{b}/{b} {c}/{c}/{c}\n");
        text += &format!("f {a}/{a}/{a} {c}/{c}/{c} {d}/{d}/{d}\n");
    }
    text
}

pub(super) fn case(group: &mut BenchmarkGroup<WallTime>, folder: &Path) {
    let path = folder.join("terrain.obj");
    let text = terrain();
    fs::write(&path, &text).expect("a model");
    group.throughput(Throughput::Bytes(text.len() as u64));
    group.bench_function("terrain.obj", |bench| {
        bench.iter(|| load::open(&path, &load::Options::default()))
    });
}
