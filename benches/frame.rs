//! A whole small frame: camera, search, shading, film, on all threads.

use criterion::{Criterion, Throughput};
use luch::accel::{Accel, Options};
use luch::load::{self, Viewpoint, scene_file};
use luch::render::{Progress, Settings, render};
use luch::shade::Shading;
use std::path::Path;

/// `frame/figure-4` and `frame/mixed`, 320 x 240, 4 samples a pixel; throughput in camera rays.
pub(crate) fn whole_frames(criterion: &mut Criterion) {
    let mut group = criterion.benchmark_group("frame");
    group.sample_size(20);
    for name in ["figure-4", "mixed"] {
        let path = Path::new(env!("CARGO_MANIFEST_DIR")).join(format!("assets/scenes/{name}.toml"));
        let viewpoint = Viewpoint::of_file(4.0 / 3.0);
        let Ok((scene, _)) = scene_file::open(&path, &load::Options::default())
            .and_then(|asset| asset.scene(0.0, &viewpoint))
        else {
            continue;
        };
        let Ok(settings) = Settings::new(320, 240, 4, 5, Shading::BlinnPhong) else {
            continue;
        };
        let accel = Accel::build(&scene, &Options::default());
        group.throughput(Throughput::Elements(320 * 240 * 4));
        group.bench_function(name, |bench| {
            bench.iter(|| render(&scene, &accel, &settings, &Progress::default()))
        });
    }
}
