//! From a film to the bytes of a file, on all threads: `write/exr-components`, a film of 1920 x 1080 pixels with 23 channels,
//! light as halves and depth as floats; throughput in pixels.

use criterion::{Criterion, Throughput};
use luch::accel::{Accel, Options};
use luch::film::Layers;
use luch::load::{self, Viewpoint, scene_file};
use luch::output::{self, Format};
use luch::render::{Progress, Settings, render};
use luch::shade::Shading;
use std::path::Path;

pub(crate) fn films(criterion: &mut Criterion) {
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("assets/scenes/mixed.toml");
    let (scene, _) = scene_file::open(&path, &load::Options::default())
        .and_then(|asset| asset.scene(0.0, &Viewpoint::of_file(16.0 / 9.0)))
        .expect("a scene");
    // Beauty and depth are five channels, the components eighteen.
    let layers = Layers {
        components: true,
        ..Layers::default()
    };
    let settings = Settings::new(1920, 1080, 1, 5, Shading::BlinnPhong)
        .and_then(|settings| settings.with_layers(layers))
        .expect("settings");
    let accel = Accel::build(&scene, &Options::default());
    let film = render(&scene, &accel, &settings, &Progress::default());

    let mut group = criterion.benchmark_group("write");
    group.sample_size(10);
    group.throughput(Throughput::Elements(1920 * 1080));
    group.bench_function("exr-components", |bench| {
        bench.iter(|| {
            let mut bytes = Vec::new();
            let options = output::Options::default();
            output::encode(&film, Format::Exr, &options, Path::new("film"), &mut bytes)
                .expect("a film")
        })
    });
}
