//! Closest and any hit on generated scenes, one thread, 64 rays a batch: primary rays of an 8 x 8 tile, and rays that
//! have nothing in common.

use criterion::{BenchmarkId, Criterion, Throughput};
use glam::Vec3;
use luch::accel::{Accel, Options};
use luch::camera::Camera;
use luch::generate::{self, Random};
use luch::ray::Ray;
use luch::scene::{Scene, SceneDescription};
use std::hint::black_box;

/// The side of the square picture whose rays are traced.
const SIDE: u32 = 256;

fn scenes() -> Vec<(&'static str, SceneDescription)> {
    let camera = |position| Camera::looking_at(position, Vec3::ZERO, Vec3::Y, 0.8);
    let near = camera(Vec3::new(1.0, 1.2, 1.6));
    vec![
        (
            "icosphere-82k",
            generate::mesh_scene(generate::icosphere(6), camera(Vec3::Z * 3.0)),
        ),
        (
            "terrain-131k",
            generate::mesh_scene(generate::terrain(256, 1), near),
        ),
        (
            "hair-100k",
            generate::mesh_scene(generate::hair(5_000, 10, 2), near),
        ),
        (
            "sphereflake-66k",
            generate::sphere_scene(generate::sphereflake(5), camera(Vec3::new(2.0, 2.0, 3.0))),
        ),
    ]
}

fn primary_rays(scene: &Scene) -> Vec<Vec<Ray>> {
    let view = scene.camera().view(SIDE, SIDE);
    let tile = |left: u32, top: u32| {
        let pixels = (0..64).map(|p| (left + p % 8, top + p / 8));
        pixels
            .map(|(i, j)| view.primary_ray(f64::from(i) + 0.5, f64::from(j) + 0.5))
            .collect()
    };
    let corners = (0..SIDE)
        .step_by(8)
        .flat_map(|top| (0..SIDE).step_by(8).map(move |left| (left, top)));
    corners.map(|(left, top)| tile(left, top)).collect()
}

fn incoherent_rays(scene: &Scene) -> Vec<Vec<Ray>> {
    let mut random = Random::new(1);
    let bounds = scene.bounds();
    let (center, half) = (bounds.center(), (bounds.max - bounds.min) * 0.5);
    let mut ray = || {
        Ray::new(
            center + random.in_cube() * half,
            random.direction(),
            0.0,
            f32::INFINITY,
        )
    };
    (0..SIDE * SIDE / 64)
        .map(|_| (0..64).map(|_| ray()).collect())
        .collect()
}

/// `rays/closest/...` and `rays/any/...`
pub(crate) fn closest_and_any_hit(criterion: &mut Criterion) {
    for (name, description) in scenes() {
        let Ok(scene) = Scene::new(description) else {
            continue;
        };
        let accel = Accel::build(&scene, &Options::default());
        for (kind, batches) in [
            ("primary", primary_rays(&scene)),
            ("incoherent", incoherent_rays(&scene)),
        ] {
            let mut group = criterion.benchmark_group("rays");
            group.throughput(Throughput::Elements(u64::from(SIDE * SIDE)));
            group.bench_function(BenchmarkId::new(format!("closest/{kind}"), name), |bench| {
                let mut hits = Vec::new();
                bench.iter(|| {
                    batches
                        .iter()
                        .for_each(|rays| accel.intersect_all(black_box(rays), &mut hits))
                });
            });
            group.bench_function(BenchmarkId::new(format!("any/{kind}"), name), |bench| {
                let mut occluded = Vec::new();
                bench.iter(|| {
                    batches
                        .iter()
                        .for_each(|rays| accel.occluded_all(black_box(rays), &mut occluded))
                });
            });
        }
        let mut group = criterion.benchmark_group("build");
        group
            .throughput(Throughput::Elements(u64::from(scene.primitive_count())))
            .sample_size(10);
        group.bench_function(name, |bench| {
            bench.iter(|| Accel::build(&scene, &Options::default()))
        });
    }
}
