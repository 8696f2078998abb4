//! From a file to an asset: `load/knot.obj` and `load/cube.glb`, in bytes, and what the files below make themselves.

mod terrain_glb;
mod terrain_obj;
mod textures;

use criterion::{Criterion, Throughput};
use luch::load;
use std::path::Path;
use tempfile::TempDir;

pub(crate) fn files(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("load");
    for name in ["knot.obj", "cube.glb"] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("assets/models")
            .join(name);
        group.throughput(Throughput::Bytes(
            path.metadata().map_or(0, |metadata| metadata.len()),
        ));
        group.bench_function(name, |bench| {
            bench.iter(|| load::open(&path, &load::Options::default()))
        });
    }
    group.sample_size(10);
    let folder = TempDir::new().expect("a folder");
    terrain_obj::case(&mut group, folder.path());
    terrain_glb::case(&mut group, folder.path());
    textures::case(&mut group, folder.path());
}
