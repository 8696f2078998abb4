//! The report of a study of ever more primitives.

use super::super::case::What;
use super::super::estimate::Estimate;
use super::super::plot::{Plot, Scale, Series, Style};
use super::super::report::{Report, Table};
use super::super::results::{Measured, Results, Tests};
use super::super::sets::Kind;
use super::super::show::{axis, column, number, point, text};
use super::WITHOUT_TREE;
use super::growth::{Figure, Growths, by_n, groups, seconds};

/// What was found, to be shown.
pub fn report(results: &Results) -> Report {
    let frame = |case: &Measured| seconds(results, case, What::Frame);
    let build = |case: &Measured| seconds(results, case, What::Build);
    let nodes = |case: &Measured| Some(Estimate::exactly(primary(case)?.nodes));
    let bytes = |case: &Measured| Some(Estimate::exactly(case.facts.as_ref()?.bytes as f64));
    let plots = [
        plot(
            results,
            ["frame-time", "Time of a frame", "s"],
            true,
            &frame,
        ),
        plot(
            results,
            ["nodes-a-ray", "Nodes a camera ray visits", ""],
            false,
            &nodes,
        ),
        plot(
            results,
            ["build-time", "Time of a build on all threads", "s"],
            false,
            &build,
        ),
        plot(
            results,
            ["memory", "Memory of tree and primitives", "B"],
            false,
            &bytes,
        ),
    ];
    Report {
        title: "How render time grows with the number of primitives".into(),
        findings: findings(results),
        plots: plots.into_iter().flatten().collect(),
        tables: vec![growths(results), figures(results)],
        ..Report::default()
    }
}

/// What camera rays test.
fn primary(case: &Measured) -> Option<&Tests> {
    let tests = &case.facts.as_ref()?.tests;
    tests.iter().find(|tests| tests.kind == Kind::Primary)
}

fn plot(
    results: &Results,
    [name, title, unit]: [&str; 3],
    with_lists: bool,
    of: Figure,
) -> Option<Plot> {
    let series: Vec<Series> = groups(results)
        .into_iter()
        .filter(|group| with_lists || !group.ends_with(WITHOUT_TREE))
        .map(|group| {
            let figures = by_n(results, &group, of);
            let points = figures
                .iter()
                .map(|&(n, y)| point(n, y, format!("{group}, {n}")));
            let is_list = group.ends_with(WITHOUT_TREE);
            Series {
                points: points.collect(),
                style: if is_list {
                    Style::Dashed
                } else {
                    Style::LineAndPoints
                },
                name: group,
            }
        })
        .filter(|series| !series.points.is_empty())
        .collect();
    (!series.is_empty()).then(|| Plot {
        name: name.into(),
        title: format!("{title} against the number of primitives"),
        caption:
            "Both axes are logarithmic: what grows in proportion rises one decade for each decade."
                .into(),
        x: axis("primitives", "", Scale::Log),
        y: axis(&title.to_lowercase(), unit, Scale::Log),
        series,
    })
}

/// The paper's claim, with numbers.
fn findings(results: &Results) -> Vec<String> {
    let frame = |case: &Measured| seconds(results, case, What::Frame);
    let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
    let mut details = Vec::new();
    for group in groups(results) {
        let growths = Growths::of(&by_n(results, &group, &frame));
        let (Some(power), Some([times, more])) = (&growths.power, growths.whole) else {
            continue;
        };
        if !group.ends_with(WITHOUT_TREE) {
            (least, most) = (least.min(power.exponent), most.max(power.exponent));
        }
        let best = growths
            .best()
            .map_or(String::new(), |best| format!(", nearest to {best}"));
        details.push(format!(
            "{group}: {more:.0} times as many primitives take {times:.1} times as long, as n^{:.2}{best}.",
            power.exponent
        ));
    }
    let mut lines = Vec::new();
    if least <= most {
        let verdict = match most {
            most if most < 0.5 => "cost does depend only weakly on complexity",
            most if most < 0.9 => "cost depends on complexity, but less than in proportion",
            _ => "cost does not depend only weakly on complexity",
        };
        lines.push(format!(
            "With a tree, the time of a frame grows as n^{least:.2} to n^{most:.2}: here {verdict} (the paper's claim)."
        ));
    }
    lines.extend(details);
    lines
}

/// The fits, each with its goodness.
fn growths(results: &Results) -> Table {
    let frame = |case: &Measured| seconds(results, case, What::Frame);
    let build = |case: &Measured| seconds(results, case, What::Build);
    let nodes = |case: &Measured| Some(Estimate::exactly(primary(case)?.nodes));
    let bytes = |case: &Measured| Some(Estimate::exactly(case.facts.as_ref()?.bytes as f64));
    let figures: [(&str, Figure); 4] = [
        ("frame", &frame),
        ("build", &build),
        ("nodes a ray", &nodes),
        ("memory", &bytes),
    ];
    let mut rows = Vec::new();
    for group in groups(results) {
        for (what, of) in figures {
            let growths = Growths::of(&by_n(results, &group, of));
            let fits = growths
                .fits
                .iter()
                .map(|(_, fit)| fit.as_ref().map(|fit| fit.r_squared));
            let power = growths.power.as_ref();
            let mut row = vec![text(&group), text(what)];
            row.extend(fits.map(|r_squared| number(r_squared, 3)));
            row.push(number(power.map(|power| power.exponent), 3));
            row.push(number(power.map(|power| power.r_squared), 3));
            rows.push(row);
        }
    }
    Table {
        title: "Growth: the goodness R² of a + b g(n), and the exponent of a power of n".into(),
        columns: vec![
            column("shape", ""),
            column("of", ""),
            column("log n", "R²"),
            column("√n", "R²"),
            column("n", "R²"),
            column("exponent", ""),
            column("of the power", "R²"),
        ],
        rows,
    }
}

/// Everything by n.
fn figures(results: &Results) -> Table {
    let row = |case: &Measured| {
        let ms = |what| seconds(results, case, what).map(|e| 1e3 * e.median);
        let tests = primary(case);
        vec![
            text(&case.group),
            number(Some(case.primitives as f64), 0),
            number(ms(What::Frame), 2),
            number(ms(What::Build), 2),
            number(tests.map(|tests| tests.nodes), 2),
            number(tests.map(|tests| tests.primitives), 2),
            number(case.facts.as_ref().map(|facts| facts.bytes as f64), 0),
        ]
    };
    Table {
        title: "Figures: medians, all threads; nodes and primitives of camera rays".into(),
        columns: vec![
            column("shape", ""),
            column("primitives", ""),
            column("frame", "ms"),
            column("build", "ms"),
            column("nodes", "a ray"),
            column("primitives tested", "a ray"),
            column("memory", "B"),
        ],
        rows: results.cases.iter().map(row).collect(),
    }
}
