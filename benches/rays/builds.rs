//! How long trees take to build, and how much memory they take.

use super::embree::{Build, Embree, Quality};
use super::engines::options;
use super::scenes;
use luch::accel::{Accel, Options, Preset};
use luch::scene::Scene;
use rayon::ThreadPoolBuilder;
use std::fs;

/// What one builder made of one scene.
#[derive(Clone, Debug)]
pub(crate) struct BuildRow {
    pub(crate) scene: String,
    pub(crate) triangles: u32,
    pub(crate) builder: &'static str,
    pub(crate) threads: usize,
    pub(crate) seconds: f64,
    pub(crate) bytes_per_triangle: f64,
    /// The most that the build took beyond what there was before it; where the system tells.
    pub(crate) peak_per_triangle: Option<f64>,
    /// Nodes, depth and SAH cost, which Embree does not tell.
    pub(crate) shape: Option<(usize, usize, f32)>,
}

const PRESETS: [(&str, Preset); 3] = [
    ("luch fastest", Preset::Fastest),
    ("luch fast", Preset::Fast),
    ("luch medium", Preset::Medium),
];

/// Of a small scene the quickest of five builds, of a large one the only one.
const LARGE: u32 = 200_000;

/// Every builder's row, on one thread and on all.
pub(crate) fn of_scene(
    name: &str,
    scene: &Scene,
    embree: Option<&Embree>,
) -> Result<Vec<BuildRow>, String> {
    let all = rayon::current_num_threads();
    let counts = if all > 1 { vec![1, all] } else { vec![1] };
    let triangles = scene.primitive_count();
    let per_triangle = |bytes: f64| bytes / f64::from(triangles.max(1));
    let again = if triangles < LARGE { 5 } else { 1 };
    let soup = embree.and_then(|embree| Some((embree, scenes::triangles(scene)?)));
    let mut rows = Vec::new();
    for threads in counts {
        let pool = ThreadPoolBuilder::new()
            .num_threads(threads)
            .build()
            .map_err(|e| e.to_string())?;
        let row = |builder| BuildRow {
            scene: scenes::short_name(name),
            triangles,
            builder,
            threads,
            seconds: f64::INFINITY,
            bytes_per_triangle: 0.0,
            peak_per_triangle: None,
            shape: None,
        };
        for (builder, preset) in PRESETS {
            let options = Options {
                preset,
                ..options()
            };
            let mut row = row(builder);
            for _ in 0..again {
                let before = forget_peak();
                let accel = pool.install(|| Accel::build(scene, &options));
                let peak = before.and_then(|before| Some(peak()?.saturating_sub(before)));
                let s = accel.statistics();
                row.seconds = row.seconds.min(s.build_time.as_secs_f64());
                row.bytes_per_triangle = per_triangle(s.bytes as f64);
                row.peak_per_triangle = peak.map(|bytes| per_triangle(bytes as f64));
                row.shape = Some((s.nodes, s.depth, s.sah_cost));
            }
            rows.push(row);
        }
        let Some((embree, (positions, corners))) = &soup else {
            continue;
        };
        for (builder, quality) in [
            ("embree medium", Quality::Medium),
            ("embree high", Quality::High),
        ] {
            let mut row = row(builder);
            for _ in 0..again {
                let build = Build {
                    quality,
                    robust: false,
                    threads,
                };
                let built = embree.build(positions, corners, build)?;
                let [bytes, peak] = built.memory().map(|bytes| per_triangle(bytes as f64));
                row.seconds = row.seconds.min(built.build_time.as_secs_f64());
                (row.bytes_per_triangle, row.peak_per_triangle) = (bytes, Some(peak));
            }
            rows.push(row);
        }
    }
    Ok(rows)
}

/// Makes the system forget the process's greatest size so far, and tells its present one; Linux only.
fn forget_peak() -> Option<u64> {
    fs::write("/proc/self/clear_refs", "5").ok()?;
    status("VmRSS:")
}

/// The process's greatest size since [`forget_peak`].
fn peak() -> Option<u64> {
    status("VmHWM:")
}

/// A line of `/proc/self/status`, in bytes.
fn status(name: &str) -> Option<u64> {
    let status = fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find_map(|line| line.strip_prefix(name))?;
    let kilobytes: u64 = line.split_whitespace().next()?.parse().ok()?;
    Some(kilobytes * 1024)
}

/// The names of [`line`]'s columns.
pub(crate) const HEADER: &str = "scene          triangles builder        threads  seconds   B/tri peak B/tri     nodes  depth     SAH";

/// A row of the table.
pub(crate) fn line(row: &BuildRow) -> String {
    let peak = row
        .peak_per_triangle
        .map_or("-".into(), |bytes| format!("{bytes:.0}"));
    let shape = row
        .shape
        .map_or(["-"; 3].map(String::from), |(nodes, depth, sah)| {
            [nodes.to_string(), depth.to_string(), format!("{sah:.2}")]
        });
    let [nodes, depth, sah] = shape;
    format!(
        "{:<14.14} {:>9} {:<14} {:>7} {:>8.3} {:>7.1} {:>10} {:>9} {:>6} {:>7}",
        row.scene,
        row.triangles,
        row.builder,
        row.threads,
        row.seconds,
        row.bytes_per_triangle,
        peak,
        nodes,
        depth,
        sah,
    )
}
