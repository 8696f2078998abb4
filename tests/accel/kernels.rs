//! Every kernel, layout, preset and leaf size gives the bits of the oracle, alone and in packets.

use super::batches::{self, Batch};
use super::bits;
use crate::common::scenes::{self, Named};
use luch::accel::{Accel, Builder, Isa, Layout, Options, Preset, linear};
use luch::scene::Scene;
use rayon::prelude::*;
use std::collections::BTreeMap;
use std::num::NonZeroU8;

/// Presets with leaf sizes: each of either kind at least once, not each with each.
const TREES: [(Preset, u8); 8] = [
    (Preset::Fastest, 1),
    (Preset::VeryFast, 4),
    (Preset::Fast, 8),
    (Preset::Medium, 16),
    (Preset::Slow, 4),
    (Preset::VerySlow, 1),
    (Preset::Medium, 1),
    (Preset::Fast, 255),
];

/// More triangles than this are built in few ways.
const MANY: usize = 10_000;

/// The trees to build over a scene; without a leaf size the preset's own.
fn trees(scene: &Scene) -> Vec<(Preset, Option<u8>)> {
    let triangles: usize = scene.meshes().iter().map(|m| m.triangles.len()).sum();
    let mut trees = vec![(Preset::Medium, None)];
    if triangles > MANY {
        trees.push((Preset::Fastest, Some(4)));
    } else {
        trees.extend(TREES.map(|(preset, leaf_size)| (preset, Some(leaf_size))));
    }
    trees
}

/// All ways to build and to search that are tried on a scene.
fn ways(scene: &Scene) -> Vec<Options> {
    let mut ways = Vec::new();
    for (preset, leaf_size) in trees(scene) {
        for (layout, builder) in [
            (Layout::Wide, Builder::Own),
            (Layout::Small, Builder::Obvhs),
        ] {
            for isa in Isa::available() {
                for packets in [false, true] {
                    ways.push(Options {
                        preset,
                        leaf_size: leaf_size.and_then(NonZeroU8::new),
                        builder,
                        layout,
                        isa,
                        packets,
                    });
                }
            }
        }
    }
    ways
}

/// How many rays each kernel was compared on, by its name and whether in packets.
pub(super) type Compared = BTreeMap<(&'static str, bool), usize>;

/// Compares the ways on some batches, and counts.
pub(super) fn compare(name: &str, scene: &Scene, batches: &[Batch], ways: &[Options]) -> Compared {
    let expected: Vec<Vec<_>> = batches
        .iter()
        .map(|batch| {
            let answer = |ray| {
                (
                    bits(linear::intersect(scene, ray)),
                    linear::occluded(scene, ray),
                )
            };
            batch.rays.par_iter().map(answer).collect()
        })
        .collect();
    let compare_one = |options: &Options| {
        let accel = Accel::build(scene, options);
        let (mut hits, mut occluded) = (Vec::new(), Vec::new());
        let mut count = 0;
        for (batch, expected) in batches.iter().zip(&expected) {
            accel.intersect_all(&batch.rays, &mut hits);
            accel.occluded_all(&batch.rays, &mut occluded);
            assert_eq!(
                (hits.len(), occluded.len()),
                (batch.rays.len(), batch.rays.len())
            );
            for (index, ray) in batch.rays.iter().enumerate() {
                assert_eq!(
                    (bits(hits[index]), occluded[index]),
                    expected[index],
                    "{name}, {}, ray {index}: {options:?}: {ray:?}",
                    batch.name
                );
            }
            count += batch.rays.len();
        }
        ((options.isa.name(), options.packets), count)
    };
    let counts: Vec<_> = ways.par_iter().map(compare_one).collect();
    let mut compared = Compared::new();
    for (kernel, count) in counts {
        *compared.entry(kernel).or_default() += count;
    }
    compared
}

/// How many kernels this machine has, told by the standard library alone.
fn kernels_of_this_machine() -> usize {
    #[cfg(target_arch = "x86_64")]
    {
        let avx2 = is_x86_feature_detected!("avx2");
        let avx512 = is_x86_feature_detected!("avx512f")
            && is_x86_feature_detected!("avx512bw")
            && is_x86_feature_detected!("avx512dq")
            && is_x86_feature_detected!("avx512vl");
        1 + usize::from(avx2) + usize::from(avx512)
    }
    #[cfg(not(target_arch = "x86_64"))]
    {
        1
    }
}

#[test]
fn every_kernel_of_this_machine_equals_the_oracle() {
    let mut compared = Compared::new();
    for Named { name, scene } in scenes::all() {
        let scene = scene.expect(name);
        let mut batches = batches::coherent(&scene);
        batches.push(Batch {
            name: "nasty",
            rays: scenes::nasty_rays(&scene, 300),
        });
        for (kernel, count) in compare(name, &scene, &batches, &ways(&scene)) {
            *compared.entry(kernel).or_default() += count;
        }
    }
    // Each alone and in packets.
    assert_eq!(
        compared.len(),
        2 * kernels_of_this_machine(),
        "{compared:?}"
    );
    for (kernel, count) in compared {
        assert!(count > 200_000, "{kernel:?}: {count} rays");
    }
}

#[test]
fn coherent_rays_are_not_all_misses() {
    // Else the comparison would say little.
    for Named { name, scene } in scenes::all() {
        let scene = scene.expect(name);
        let accel = Accel::build(&scene, &Options::default());
        let (mut rays, mut met) = (0, 0);
        for batch in batches::coherent(&scene) {
            let mut hits = Vec::new();
            accel.intersect_all(&batch.rays, &mut hits);
            rays += hits.len();
            met += hits.iter().flatten().count();
        }
        assert!(
            name == "empty" || met * 20 > rays,
            "{name}: {met} of {rays}"
        );
    }
}

#[test]
fn any_hit_agrees_with_closest_hit_where_everything_is_opaque() {
    for Named { name, scene } in scenes::all() {
        let scene = scene.expect(name);
        if scene.materials().iter().any(|m| !m.is_opaque()) {
            continue;
        }
        let mut batches = batches::coherent(&scene);
        batches.push(Batch {
            name: "nasty",
            rays: scenes::nasty_rays(&scene, 300),
        });
        for isa in Isa::available() {
            for packets in [false, true] {
                let options = Options {
                    isa,
                    packets,
                    ..Options::default()
                };
                let accel = Accel::build(&scene, &options);
                let (mut hits, mut occluded) = (Vec::new(), Vec::new());
                for batch in &batches {
                    accel.intersect_all(&batch.rays, &mut hits);
                    accel.occluded_all(&batch.rays, &mut occluded);
                    let met: Vec<bool> = hits.iter().map(Option::is_some).collect();
                    assert_eq!(met, occluded, "{name}, {}: {options:?}", batch.name);
                }
            }
        }
    }
}

#[test]
fn a_batch_of_one_is_a_ray() {
    for Named { name, scene } in scenes::all() {
        let scene = scene.expect(name);
        let accel = Accel::build(&scene, &Options::default());
        for ray in scenes::nasty_rays(&scene, 100) {
            let (mut hits, mut occluded) = (Vec::new(), Vec::new());
            accel.intersect_all(&[ray], &mut hits);
            accel.occluded_all(&[ray], &mut occluded);
            assert_eq!(
                [bits(accel.intersect(&ray))].as_slice(),
                hits.into_iter().map(bits).collect::<Vec<_>>()
            );
            assert_eq!([accel.occluded(&ray)].as_slice(), occluded, "{name}");
        }
    }
}
