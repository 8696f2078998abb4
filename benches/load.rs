//! From a file to an asset.

use criterion::{Criterion, Throughput};
use luch::load;
use std::path::Path;

/// `load/knot.obj` and `load/cube.glb`; throughput in bytes.
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
}
