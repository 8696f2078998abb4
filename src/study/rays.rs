//! `luch study rays`: rays a second by kind, for one model and camera, with and without shading.

use super::case::{Case, Measure, Source, Threads, What};
use super::plot::{Plot, Scale, Series, Style};
use super::report::{Report, Table};
use super::results::{Measured, Results};
use super::sets::Kind;
use super::show::{axis, column, number, point, text};
use crate::accel::{Isa, Options};

/// What is timed of every case: search alone of each kind, and whole frames.
pub const MEASURES: [Measure; 10] = [
    measure(What::Rays(Kind::Primary), Threads::One),
    measure(What::Rays(Kind::Shadow), Threads::One),
    measure(What::Rays(Kind::Mirror), Threads::One),
    measure(What::Rays(Kind::Incoherent), Threads::One),
    measure(What::Frame, Threads::One),
    measure(What::Rays(Kind::Primary), Threads::All),
    measure(What::Rays(Kind::Shadow), Threads::All),
    measure(What::Rays(Kind::Mirror), Threads::All),
    measure(What::Rays(Kind::Incoherent), Threads::All),
    measure(What::Frame, Threads::All),
];

const fn measure(what: What, threads: Threads) -> Measure {
    Measure { what, threads }
}

/// A case for each kernel, the usual one first.
pub fn cases(source: &Source, kernels: &[Isa]) -> Vec<Case> {
    let case = |&isa: &Isa| Case {
        name: format!("{isa} kernels"),
        group: "kernel".into(),
        source: source.clone(),
        options: Options {
            isa,
            ..Options::default()
        },
        samples: 1,
    };
    kernels.iter().rev().map(case).collect()
}

/// What was found, to be shown.
pub fn report(results: &Results) -> Report {
    Report {
        title: format!("Rays a second: {}", results.circumstances.subject),
        findings: findings(results),
        plots: plot(results).into_iter().collect(),
        tables: vec![table(results)],
        ..Report::default()
    }
}

/// What a measure is called in full.
fn words(what: What) -> String {
    match what {
        What::Frame => "all rays of a frame, with shading".into(),
        What::Rays(kind) => format!("{}, search alone", kind.name()),
        What::Build => "build".into(),
    }
}

fn findings(results: &Results) -> Vec<String> {
    let Some(case) = results.cases.first() else {
        return Vec::new();
    };
    let sentence = |threads: Threads| {
        let rates: Option<Vec<String>> = MEASURES
            .iter()
            .filter(|measure| measure.threads == threads)
            .map(|&measure| {
                let rate = results.mrays(&case.name, measure)?.median;
                Some(format!("{rate:.1} {}", words(measure.what)))
            })
            .collect();
        let threads = threads.name();
        rates.map(|rates| {
            format!(
                "With {threads} of the threads, Mrays/s: {}.",
                rates.join("; ")
            )
        })
    };
    [Threads::One, Threads::All]
        .into_iter()
        .filter_map(sentence)
        .collect()
}

/// Rates by kind: each kernel a series.
fn plot(results: &Results) -> Option<Plot> {
    let all = MEASURES
        .iter()
        .filter(|measure| measure.threads == Threads::All);
    let all: Vec<Measure> = all.copied().collect();
    let of_case = |case: &Measured| {
        let points = all.iter().zip(1..).filter_map(|(&measure, place)| {
            let rate = results.mrays(&case.name, measure)?;
            Some(point(f64::from(place), rate, words(measure.what)))
        });
        Series {
            name: case.name.clone(),
            style: Style::Points,
            points: points.collect(),
        }
    };
    let series: Vec<Series> = results.cases.iter().map(of_case).collect();
    let order: Vec<String> = all
        .iter()
        .zip(1..)
        .map(|(m, n)| format!("{n} {}", words(m.what)))
        .collect();
    series
        .iter()
        .any(|series| !series.points.is_empty())
        .then(|| Plot {
            name: "rays-a-second".into(),
            title: "Rays a second by kind, all threads".into(),
            caption: format!("From left to right: {}.", order.join("; ")),
            x: axis("kind of rays", "", Scale::Linear),
            y: axis("rays a second", "Mrays/s", Scale::Log),
            series,
        })
}

fn table(results: &Results) -> Table {
    let mut rows = Vec::new();
    for case in &results.cases {
        for &measure in &MEASURES {
            let Some(e) = results.mrays(&case.name, measure) else {
                continue;
            };
            rows.push(vec![
                text(&case.name),
                text(words(measure.what)),
                text(measure.threads.name()),
                number(Some(e.median), 2),
                number(Some(e.low), 2),
                number(Some(e.high), 2),
            ]);
        }
    }
    Table {
        title: "Rays a second: medians with intervals of 95 %".into(),
        columns: vec![
            column("kernels", ""),
            column("rays", ""),
            column("threads", ""),
            column("median", "Mrays/s"),
            column("from", "Mrays/s"),
            column("to", "Mrays/s"),
        ],
        rows,
    }
}
