//! `luch study samples`: the paper's table. What supersampling costs, and what it brings.

use super::case::{Case, Measure, Source, Threads, What};
use super::estimate::Estimate;
use super::plot::{Axis, Plot, Point, Scale, Series, Style};
use super::report::{Report, Table};
use super::results::{Measured, Results};
use super::show::{self, column, in_words, number, point};
use crate::accel::Options;

/// The paper's picture.
pub const SIZE: [u32; 2] = [640, 480];
/// The paper's samples a pixel, and the milliseconds they took it: one thread, C++, a desktop of about 2015.
pub const PAPER: [(u32, f64); 4] = [(1, 1783.0), (4, 7504.0), (16, 34_344.0), (25, 61_333.0)];
/// What errors are reckoned against.
pub const ERROR_AGAINST: u32 = 256;

/// What is timed of every case.
pub const MEASURES: [Measure; 2] = [frame(Threads::One), frame(Threads::All)];

const fn frame(threads: Threads) -> Measure {
    Measure {
        what: What::Frame,
        threads,
    }
}

/// A case for each number of samples.
pub fn cases(source: &Source, samples: &[u32], options: &Options) -> Vec<Case> {
    let case = |&samples: &u32| Case {
        name: format!("{samples} a pixel"),
        group: "samples".into(),
        source: source.clone(),
        options: *options,
        samples,
    };
    samples.iter().map(case).collect()
}

/// What was found, to be shown.
pub fn report(results: &Results) -> Report {
    Report {
        title: format!("What samples cost: {}", results.circumstances.subject),
        findings: findings(results),
        plots: [times(results), errors(results)]
            .into_iter()
            .flatten()
            .collect(),
        tables: vec![table(results)],
        ..Report::default()
    }
}

fn seconds(results: &Results, case: &Measured, threads: Threads) -> Option<f64> {
    results
        .estimate(&case.name, frame(threads))
        .map(|e| e.median)
}

/// The time of a case over that of one sample.
fn ratio(results: &Results, case: &Measured, threads: Threads) -> Option<f64> {
    let one = results
        .cases
        .iter()
        .find(|case| case.settings.samples == 1)?;
    Some(seconds(results, case, threads)? / seconds(results, one, threads)?)
}

fn paper(samples: u32) -> Option<f64> {
    PAPER.iter().find(|(n, _)| *n == samples).map(|(_, ms)| *ms)
}

fn findings(results: &Results) -> Vec<String> {
    let mut lines = Vec::new();
    let most = results
        .cases
        .iter()
        .max_by_key(|case| case.settings.samples);
    if let Some(case) = most
        && let Some(times) = ratio(results, case, Threads::One)
        && let Some(one) = seconds(results, case, Threads::One)
    {
        let samples = case.settings.samples;
        let of_paper = paper(samples).map_or(String::new(), |ms| {
            let (times, faster) = (ms / PAPER[0].1, ms / 1e3 / one);
            format!(
                " (the paper: {times:.1} times, {:.1} s, {faster:.0} times as long as here)",
                ms / 1e3
            )
        });
        lines.push(format!(
            "{samples} samples a pixel take {times:.1} times as long as one on one thread, {}{of_paper}.",
            in_words(one)
        ));
    }
    let errors: Vec<(u32, f64)> = results
        .cases
        .iter()
        .filter_map(|case| Some((case.settings.samples, case.facts.as_ref()?.error?)))
        .collect();
    if let (Some((a, from)), Some((b, to))) = (errors.first(), errors.last())
        && a != b
    {
        lines.push(format!(
            "From {a} to {b} samples the error against {ERROR_AGAINST} falls from {from:.4} to {to:.4} of a display's range."
        ));
    }
    lines
}

fn axis(label: &str, unit: &str) -> Axis {
    show::axis(label, unit, Scale::Log)
}

fn times(results: &Results) -> Option<Plot> {
    let of_threads = |name: &str, threads| {
        let points = results.cases.iter().filter_map(|case| {
            let n = case.settings.samples;
            let e = results.estimate(&case.name, frame(threads))?;
            let label = format!("{n} a pixel, {name}");
            Some(point(f64::from(n), e, label))
        });
        Series {
            name: name.into(),
            style: Style::LineAndPoints,
            points: points.collect(),
        }
    };
    let of_paper = PAPER.iter().map(|&(n, ms)| {
        point(
            f64::from(n),
            Estimate::exactly(ms / 1e3),
            format!("{n} a pixel, the paper"),
        )
    });
    let mut series = vec![
        of_threads("one thread", Threads::One),
        of_threads("all threads", Threads::All),
    ];
    if series.iter().all(|series| series.points.is_empty()) {
        return None;
    }
    series.push(Series {
        name: "the paper, one thread of 2015".into(),
        style: Style::Dashed,
        points: of_paper.collect(),
    });
    Some(Plot {
        name: "time-by-samples".into(),
        title: "Time of a frame against samples a pixel".into(),
        caption: "640 x 480 pixels. A line that rises one decade a decade costs each sample alike."
            .into(),
        x: axis("samples a pixel", ""),
        y: axis("time of a frame", "s"),
        series,
    })
}

fn errors(results: &Results) -> Option<Plot> {
    let points: Vec<Point> = results
        .cases
        .iter()
        .filter_map(|case| {
            let (n, error) = (case.settings.samples, case.facts.as_ref()?.error?);
            let x = seconds(results, case, Threads::All)?;
            Some(point(x, Estimate::exactly(error), format!("{n} a pixel")))
        })
        .collect();
    (points.len() > 1).then(|| Plot {
        name: "error-by-time".into(),
        title: "Error against time".into(),
        caption: format!(
            "Root mean square of the difference to {ERROR_AGAINST} samples a pixel over display channels of 0 to 1."
        ),
        x: axis("time of a frame, all threads", "s"),
        y: axis("error", ""),
        series: vec![Series {
            name: "regular grid".into(),
            style: Style::LineAndPoints,
            points,
        }],
    })
}

fn table(results: &Results) -> Table {
    let row = |case: &Measured| {
        let n = case.settings.samples;
        vec![
            number(Some(f64::from(n)), 0),
            number(seconds(results, case, Threads::One).map(|s| 1e3 * s), 1),
            number(ratio(results, case, Threads::One), 2),
            number(seconds(results, case, Threads::All).map(|s| 1e3 * s), 1),
            number(ratio(results, case, Threads::All), 2),
            number(paper(n), 0),
            number(paper(n).map(|ms| ms / PAPER[0].1), 1),
            number(case.facts.as_ref().and_then(|facts| facts.error), 5),
        ]
    };
    Table {
        title: "The paper's table".into(),
        columns: vec![
            column("samples", "a pixel"),
            column("one thread", "ms"),
            column("to one sample", ""),
            column("all threads", "ms"),
            column("to one sample, all", ""),
            column("the paper", "ms"),
            column("the paper to one", ""),
            column("error", "RMS"),
        ],
        rows: results.cases.iter().map(row).collect(),
    }
}
