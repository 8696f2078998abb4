//! The plots of a study of one model's tree.

use super::super::estimate::Estimate;
use super::super::plot::{Axis, Plot, Point, Scale, Series, Style};
use super::super::results::{Measured, Results};
use super::super::show::{axis, point};
use super::super::statistics::{break_even, correlation, front, rank_correlation};
use super::advice::{FRAME, Timed, timed};
use super::{DEFAULT, KERNEL, LAYOUT, LEAF_SIZE, OBVHS, PRESET};

/// Every plot that there are numbers for.
pub(super) fn plots(results: &Results) -> Vec<Plot> {
    let bytes = |case: &Measured| {
        let facts = case.facts.as_ref()?;
        Some(facts.bytes as f64 / case.primitives.max(1) as f64)
    };
    let nodes = |case: &Measured| Some(case.facts.as_ref()?.nodes as f64);
    let sah = |case: &Measured| Some(case.facts.as_ref()?.sah_cost);
    let plots = [
        front_of_choices(results),
        by_leaf_size(results),
        against(
            results,
            "render-time-by-bytes",
            "Render time against the tree's size",
            axis(
                "size of the tree and its primitives",
                "B per primitive",
                Scale::Linear,
            ),
            bytes,
        ),
        against(
            results,
            "render-time-by-nodes",
            "Render time against the number of nodes",
            axis("nodes", "", Scale::Log),
            nodes,
        ),
        against(
            results,
            "render-time-by-sah",
            "Render time against surface-area cost",
            axis("surface-area cost", "", Scale::Linear),
            sah,
        ),
        pays_off(results),
    ];
    plots.into_iter().flatten().collect()
}

/// The cases that a frame's time can be compared over: those of the same kernels, with packets, and with a tree.
fn comparable(results: &Results) -> Vec<Timed<'_>> {
    let is_comparable =
        |timed: &Timed| timed.case.group != KERNEL && timed.case.settings.layout != "none";
    timed(results).into_iter().filter(is_comparable).collect()
}

/// The questions, as series.
const SERIES: [&str; 5] = [DEFAULT, PRESET, LEAF_SIZE, LAYOUT, OBVHS];

/// Render time against something of the tree, with the correlation stated.
fn against(
    results: &Results,
    name: &str,
    title: &str,
    x: Axis,
    of: impl Fn(&Measured) -> Option<f64>,
) -> Option<Plot> {
    let cases = comparable(results);
    let point_of = |timed: &Timed| {
        let (x, y) = (of(timed.case)?, results.estimate(&timed.case.name, FRAME)?);
        Some(point(x, y, timed.case.name.clone()))
    };
    let series: Vec<Series> = SERIES
        .iter()
        .map(|&group| Series {
            name: group.into(),
            style: Style::Points,
            points: cases
                .iter()
                .filter(|timed| timed.case.group == group)
                .filter_map(point_of)
                .collect(),
        })
        .filter(|series| !series.points.is_empty())
        .collect();
    // Other layouts have nodes of another kind: they are shown, but not in the correlation.
    let own = cases.iter().filter(|timed| timed.case.group != LAYOUT);
    let (xs, ys): (Vec<f64>, Vec<f64>) = own
        .filter_map(|timed| Some((of(timed.case)?, timed.frame.median)))
        .unzip();
    let caption = match (correlation(&xs, &ys), rank_correlation(&xs, &ys)) {
        (Some(r), Some(rank)) => format!(
            "Over the {} trees of luch's own layout the correlation is {r:.2} (of ranks {rank:.2}).",
            xs.len()
        ),
        _ => "There are too few cases for a correlation.".into(),
    };
    (!series.is_empty()).then(|| Plot {
        name: name.into(),
        title: title.into(),
        caption,
        x,
        y: axis("time of a frame", "s", Scale::Linear),
        series,
    })
}

/// Render time by leaf size.
fn by_leaf_size(results: &Results) -> Option<Plot> {
    let mut cases: Vec<Timed> = comparable(results);
    cases.retain(|timed| [LEAF_SIZE, DEFAULT].contains(&timed.case.group.as_str()));
    cases.sort_by_key(|timed| timed.case.settings.leaf_size);
    let points: Vec<Point> = cases
        .iter()
        .filter_map(|timed| {
            let size = timed.case.settings.leaf_size;
            let y = results.estimate(&timed.case.name, FRAME)?;
            Some(point(f64::from(size), y, format!("at most {size}")))
        })
        .collect();
    (points.len() > 1).then(|| Plot {
        name: "render-time-by-leaf-size".into(),
        title: "Render time against leaf size".into(),
        caption: "The most primitives that a leaf may have; the builder makes smaller ones where that costs less.".into(),
        x: axis("most primitives of a leaf", "", Scale::Linear),
        y: axis("time of a frame", "s", Scale::Linear),
        series: vec![Series {
            name: "frame".into(),
            style: Style::LineAndPoints,
            points,
        }],
    })
}

/// Build time against render time, with the front of best choices.
fn front_of_choices(results: &Results) -> Option<Plot> {
    let cases = comparable(results);
    let places: Vec<(f64, f64)> = cases
        .iter()
        .map(|timed| (timed.build.median, timed.frame.median))
        .collect();
    let best = front(&places);
    let mut series: Vec<Series> = SERIES
        .iter()
        .map(|&group| {
            let of_group = cases
                .iter()
                .enumerate()
                .filter(|(_, timed)| timed.case.group == group);
            let points = of_group.filter_map(|(index, timed)| {
                let y = results.estimate(&timed.case.name, FRAME)?;
                Some(Point {
                    marked: best.contains(&index),
                    ..point(timed.build.median, y, timed.case.name.clone())
                })
            });
            Series {
                name: group.into(),
                style: Style::Points,
                points: points.collect(),
            }
        })
        .filter(|series| !series.points.is_empty())
        .collect();
    if series.is_empty() {
        return None;
    }
    let line = best
        .iter()
        .filter_map(|&index| cases.get(index))
        .map(|timed| {
            point(
                timed.build.median,
                Estimate::exactly(timed.frame.median),
                timed.case.name.clone(),
            )
        });
    series.insert(
        0,
        Series {
            name: "front of best choices".into(),
            style: Style::Dashed,
            points: line.collect(),
        },
    );
    let names: Vec<&str> = best
        .iter()
        .map(|&index| cases[index].case.name.as_str())
        .collect();
    Some(Plot {
        name: "build-time-and-render-time".into(),
        title: "Build time against render time".into(),
        caption: format!("No setting is better in both than {}.", names.join(", ")),
        x: axis("time of a build, all threads", "s", Scale::Log),
        y: axis("time of a frame", "s", Scale::Linear),
        series,
    })
}

/// What so many pictures of one scene cost in all, for the front of best choices.
fn pays_off(results: &Results) -> Option<Plot> {
    let cases = comparable(results);
    let places: Vec<(f64, f64)> = cases
        .iter()
        .map(|timed| (timed.build.median, timed.frame.median))
        .collect();
    let best: Vec<&Timed> = front(&places)
        .iter()
        .filter_map(|&index| cases.get(index))
        .collect();
    let quickest = best.first()?;
    let frames = [1.0, 2.0, 5.0, 10.0, 20.0, 50.0, 100.0, 200.0, 500.0, 1000.0];
    let series: Vec<Series> = best
        .iter()
        .map(|timed| {
            let points = frames.iter().map(|&count| {
                let each = (timed.build.median + count * timed.frame.median) / count;
                let at = Estimate::exactly(each);
                let name = &timed.case.name;
                point(count, at, format!("{name}, {count} pictures"))
            });
            Series {
                name: timed.case.name.clone(),
                style: Style::Line,
                points: points.collect(),
            }
        })
        .collect();
    let slower = best.iter().skip(1).filter_map(|timed| {
        let frames = break_even(
            timed.build.median,
            timed.frame.median,
            quickest.build.median,
            quickest.frame.median,
        )?;
        Some(format!(
            "{} after {:.0}",
            timed.case.name,
            libm::ceil(frames)
        ))
    });
    let slower: Vec<String> = slower.collect();
    let [width, height] = results.circumstances.size;
    let caption = if slower.is_empty() {
        format!(
            "{} is the quickest to build and to render.",
            quickest.case.name
        )
    } else {
        format!(
            "Pictures of {width} x {height}. Against {}, the slower builds have paid off: {} of them.",
            quickest.case.name,
            slower.join(", ")
        )
    };
    Some(Plot {
        name: "pays-off".into(),
        title: "What a picture costs with its share of the build".into(),
        caption,
        x: axis("pictures of one scene", "", Scale::Log),
        y: axis("build and frames, for each picture", "s", Scale::Log),
        series,
    })
}
