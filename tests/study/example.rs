//! A report with everything a report can have.

use luch::study::heat::heat_map;
use luch::study::plot::{Axis, Plot, Point, Scale, Series, Style};
use luch::study::report::{Cell, Column, Picture, Report, Table};

pub(crate) fn report() -> Report {
    Report {
        title: "How the size of a BVH affects the render time of terrain-1m".into(),
        partial: true,
        findings: vec![
            "For this model, build with the preset “medium” and leaves of up to four triangles: a frame takes 41.2 ms, and \
             no setting with a faster build is faster after three frames."
                .into(),
            "Render time follows the surface-area cost (correlation 0.97, 0.94 to 0.99), not the number of bytes (0.31).".into(),
            "Without a BVH the same frame takes 1900 times as long.".into(),
        ],
        circumstances: [
            ("machine", "AMD EPYC 9R14, 2 cores of 192, 24 GiB"),
            ("system", "Linux 6.12.48"),
            ("kernel", "AVX-512"),
            ("compiler", "rustc 1.91.0 (f8297e351 2025-10-28), release, lto"),
            ("commit", "183012f2a9"),
            ("command", "luch study bvh terrain-1m.glb -o study --budget 10"),
            ("model", "terrain-1m.glb, 1 048 576 triangles, sha256 9f2b64c1e07dd1a0…"),
            ("runs", "432 of 480, interleaved, 9 of each setting"),
        ]
        .map(|(name, value)| (name.into(), value.into()))
        .into(),
        warnings: vec![
            "Other processes used 14 % of the machine during 12 of 432 runs; medians are hardly touched by this.".into(),
            "cwbvh, leaf size 8: the picture differs from the reference in 3 pixels. It counts as a failure and has no time.".into(),
        ],
        plots: vec![against_bytes(), against_cost(), scaling(), samples()],
        pictures: vec![
            heat("before", "Nodes tested a pixel with the preset “fastest”.", 1.0),
            heat("after", "The same with “slow”, on the same scale.", 0.6),
        ],
        tables: vec![settings(), paper()],
        repeat: vec![
            "cargo install luch --version 0.1.0 --locked".into(),
            "luch study bvh terrain-1m.glb -o study --budget 10 --resume".into(),
        ],
    }
}

fn axis(label: &str, unit: &str, scale: Scale) -> Axis {
    Axis {
        label: label.into(),
        unit: unit.into(),
        scale,
    }
}

fn point(x: f64, y: f64, spread: f64, label: &str, marked: bool) -> Point {
    Point {
        x,
        y,
        low: y * (1.0 - spread),
        high: y * (1.0 + spread),
        label: label.into(),
        marked,
    }
}

/// Numbers that look like measurements, the same every time.
fn noise(i: usize) -> f64 {
    let mixed = (i as u64 + 1).wrapping_mul(0x9e37_79b9_7f4a_7c15);
    (mixed >> 40) as f64 / f64::from(1 << 24) - 0.5
}

const PRESETS: [&str; 4] = ["fastest", "fast", "medium", "slow"];
const LEAVES: [usize; 5] = [1, 2, 4, 8, 16];

/// Bytes, build seconds, render seconds, surface-area cost.
fn setting(preset: usize, leaf: usize) -> [f64; 4] {
    let size = LEAVES[leaf] as f64;
    let bytes = 18e6 * (1.0 + 3.5 / size);
    let build = 0.06 * f64::from(1 << (2 * preset)) * (1.0 + 0.4 / size);
    let cost = 42.0 - 4.5 * preset as f64 + 9.0 * (leaf as f64 - 2.0).abs();
    let render = 0.0011 * cost * (1.0 + 0.16 * noise(preset * 5 + leaf));
    [bytes, build, render, cost]
}

fn against_bytes() -> Plot {
    let series = PRESETS.iter().enumerate().map(|(preset, name)| {
        let points = LEAVES.iter().enumerate().map(|(leaf, size)| {
            let [_, build, render, _] = setting(preset, leaf);
            let label = format!("{name}, leaf {size}");
            point(
                build,
                render,
                0.03,
                &label,
                leaf == 2 || (preset == 0 && leaf == 1),
            )
        });
        Series {
            name: (*name).into(),
            style: Style::Points,
            points: points.collect(),
        }
    });
    Plot {
        name: "build-against-render".into(),
        title: "Build time against render time".into(),
        caption: "Ringed settings are the front of best choices: none other is faster to build and to render. Bars are \
                  bootstrap intervals of 95 %."
            .into(),
        x: axis("build time", "s", Scale::Log),
        y: axis("render time of a frame", "s", Scale::Linear),
        series: series.collect(),
    }
}

fn against_cost() -> Plot {
    let points = (0..20).map(|i| {
        let [_, _, render, cost] = setting(i / 5, i % 5);
        let label = format!("{}, leaf {}", PRESETS[i / 5], LEAVES[i % 5]);
        point(cost, 1e3 * render, 0.025, &label, false)
    });
    let fit = [20.0, 62.0].map(|cost| point(cost, 1.1 * cost, 0.0, "", false));
    Plot {
        name: "cost".into(),
        title: "Render time against surface-area cost".into(),
        caption: "The cost explains most of the time: correlation 0.97 (0.94 to 0.99).".into(),
        x: axis("surface-area cost", "", Scale::Linear),
        y: axis("render time of a frame", "ms", Scale::Linear),
        series: vec![
            Series {
                name: "settings".into(),
                style: Style::Points,
                points: points.collect(),
            },
            Series {
                name: "proportional".into(),
                style: Style::Dashed,
                points: fit.into(),
            },
        ],
    }
}

fn scaling() -> Plot {
    let steps = || (1..=7).map(|exponent| f64::from(10i32.pow(exponent)));
    let measured = |name: &str, time: fn(f64) -> f64, to: f64, k: usize| Series {
        name: name.into(),
        style: Style::LineAndPoints,
        points: steps()
            .filter(|n| *n <= to)
            .enumerate()
            .map(|(i, n)| point(n, time(n) * (1.0 + 0.2 * noise(9 * k + i)), 0.05, "", false))
            .collect(),
    };
    let mut series = vec![
        measured("sphereflake", |n| 0.008 * n.ln(), 1e7, 1),
        measured("terrain", |n| 0.005 * n.ln() + 1e-5 * n.sqrt(), 1e7, 2),
        measured("grid", |n| 0.003 * n.ln(), 1e7, 3),
        measured("hair", |n| 0.01 * n.ln() + 1e-4 * n.sqrt(), 1e7, 4),
        measured("random", |n| 0.006 * n.ln() + 3e-5 * n.sqrt(), 1e7, 5),
        measured("brute force", |n| 1e-3 * n, 1e5, 6),
    ];
    series.push(Series {
        name: "0.005 log n".into(),
        style: Style::Dashed,
        points: steps()
            .map(|n| point(n, 0.005 * n.ln(), 0.0, "", false))
            .collect(),
    });
    // What a logarithmic axis cannot show.
    series[0].points.push(point(0.0, 0.01, 0.0, "empty", false));
    Plot {
        name: "scaling".into(),
        title: "Time a frame against the number of primitives".into(),
        caption: "A million times as many primitives take seven times as long.".into(),
        x: axis("primitives", "", Scale::Log),
        y: axis("time a frame", "s", Scale::Log),
        series,
    }
}

fn samples() -> Plot {
    let line = |name: &str, style, second: f64| Series {
        name: name.into(),
        style,
        points: [1.0, 4.0, 16.0, 25.0]
            .map(|n| point(n, second * n, 0.02, "", false))
            .into(),
    };
    Plot {
        name: "samples".into(),
        title: "Speed of a single setting".into(),
        caption: "Only one point: its axes still make sense.".into(),
        x: axis("samples", "", Scale::Linear),
        y: axis("speed", "Mrays/s", Scale::Linear),
        series: vec![Series {
            points: line("here", Style::Points, 42.5).points[..1].to_vec(),
            ..Series::default()
        }],
    }
}

fn heat(name: &str, caption: &str, factor: f32) -> Picture {
    let (width, height) = (320, 240);
    let value = |i: u32| {
        let (x, y) = ((i % width) as f32 / 40.0, (i / width) as f32 / 40.0);
        let hill = (x - 4.0) * (x - 4.0) + (y - 3.0) * (y - 3.0);
        factor
            * 180.0
            * (0.15 + 1.0 / (1.0 + hill))
            * (1.0 + 0.3 * ((3.0 * x).sin() * (4.0 * y).cos()))
    };
    let values: Vec<f32> = (0..width * height).map(value).collect();
    Picture {
        name: name.into(),
        group: "Nodes tested a pixel".into(),
        caption: caption.into(),
        png: heat_map(&values, width, height, "nodes tested a pixel", 200.0).unwrap(),
    }
}

fn column(name: &str, unit: &str) -> Column {
    Column {
        name: name.into(),
        unit: unit.into(),
    }
}

fn settings() -> Table {
    let rows = (0..20).map(|i| {
        let [bytes, build, render, cost] = setting(i / 5, i % 5);
        vec![
            Cell::Text(PRESETS[i / 5].into()),
            Cell::Number(LEAVES[i % 5] as f64, 0),
            Cell::Number(bytes / LEAVES[i % 5] as f64, 0),
            Cell::Number(bytes, 0),
            Cell::Number(cost, 2),
            Cell::Number(1e3 * build, 1),
            // A run that failed.
            Cell::Number(if i == 7 { f64::NAN } else { 1e3 * render }, 2),
            Cell::Number(1.0 / render, 1),
        ]
    });
    Table {
        title: "Every setting".into(),
        columns: vec![
            column("preset", ""),
            column("leaf", ""),
            column("nodes", ""),
            column("bytes", ""),
            column("cost", "SAH"),
            column("build", "ms"),
            column("frame", "ms"),
            column("speed", "Mrays/s"),
        ],
        rows: rows.collect(),
    }
}

fn paper() -> Table {
    Table {
        title: "Beside the paper’s <times>".into(),
        columns: vec![
            column("samples", ""),
            column("here", "s"),
            column("paper", "s"),
            column("ratio", ""),
        ],
        rows: vec![
            vec![
                Cell::Number(1.0, 0),
                Cell::Number(0.012, 3),
                Cell::Number(18.5, 1),
                Cell::Number(1.0, 2),
            ],
            vec![
                Cell::Number(16.0, 0),
                Cell::Number(0.171, 3),
                Cell::Number(281.0, 1),
                Cell::Number(14.25, 2),
            ],
        ],
    }
}
