//! What the numbers say to whoever renders this model.

use super::super::case::{Measure, Threads, What};
use super::super::estimate::Estimate;
use super::super::results::{Measured, NO_TIME, Results};
use super::super::show::in_words;
use super::super::statistics::break_even;
use super::{DEFAULT, LAYOUT, NO_TREE};

const BUILD: Measure = Measure {
    what: What::Build,
    threads: Threads::All,
};
pub(super) const FRAME: Measure = Measure {
    what: What::Frame,
    threads: Threads::All,
};

/// A case with its build and frame, all threads.
#[derive(Clone, Copy)]
pub(super) struct Timed<'a> {
    pub(super) case: &'a Measured,
    pub(super) build: Estimate,
    pub(super) frame: Estimate,
}

/// Every case that was timed and gave the reference's picture.
pub(super) fn timed(results: &Results) -> Vec<Timed<'_>> {
    let of_case = |case| {
        let timed = Timed {
            case,
            build: results.estimate(&case.name, BUILD)?,
            frame: results.estimate(&case.name, FRAME)?,
        };
        Some(timed)
    };
    results.cases.iter().filter_map(of_case).collect()
}

/// What can be asked of `luch render` for a case; `None` where it is only there for studies.
fn options(case: &Measured) -> Option<String> {
    let s = &case.settings;
    if !s.packets || !["wide", "small"].contains(&s.layout.as_str()) {
        return None;
    }
    let mut words = Vec::new();
    if s.preset != "medium" {
        words.push(format!("--bvh {}", s.preset));
    }
    if s.builder != "own" {
        words.push(format!("--bvh-builder {}", s.builder));
    }
    if s.leaf_size != super::DEFAULT_LEAF_SIZE {
        words.push(format!("--leaf-size {}", s.leaf_size));
    }
    if s.layout == "small" {
        words.push("--small-memory".into());
    }
    Some(words.join(" "))
}

/// One sentence that says what to use for this model, and what else was found; nothing where nothing was timed.
pub(super) fn findings(results: &Results) -> Vec<String> {
    let all = timed(results);
    let Some(default) = all.iter().find(|timed| timed.case.name == DEFAULT).copied() else {
        return Vec::new();
    };
    // Kernels are the machine's affair, not a choice.
    let usable: Vec<(Timed, String)> = all
        .iter()
        .filter(|timed| timed.case.settings.kernel == default.case.settings.kernel)
        .filter_map(|timed| Some((*timed, options(timed.case)?)))
        .collect();
    // The least of those that are surely below the default: machines are noisy.
    let least = |cost: fn(&Timed) -> [f64; 3]| {
        let [low, _, _] = cost(&default);
        let surely = usable.iter().filter(|(timed, _)| cost(timed)[2] < low);
        surely.min_by(|(a, _), (b, _)| cost(a)[1].total_cmp(&cost(b)[1]))
    };
    let total = |timed: &Timed| {
        let (a, b) = (timed.build, timed.frame);
        [a.low + b.low, a.median + b.median, a.high + b.high]
    };
    let frame = |timed: &Timed| [timed.frame.low, timed.frame.median, timed.frame.high];
    let (once, often) = (least(total), least(frame));
    let saved = |timed: &Timed, cost: fn(&Timed) -> [f64; 3]| {
        100.0 * (1.0 - cost(timed)[1] / cost(&default)[1])
    };
    let build_and_frame = |timed: &Timed| {
        let (build, frame) = (in_words(timed.build.median), in_words(timed.frame.median));
        format!("build {build}, frame {frame}")
    };
    let for_one = match once {
        Some((once, words)) => format!(
            "for one picture use {words} ({}: {:.0} % less in all than the defaults)",
            build_and_frame(once),
            saved(once, total)
        ),
        None => format!(
            "for one picture keep the defaults ({}): no setting is surely faster in all",
            build_and_frame(&default)
        ),
    };
    let for_many = match often {
        Some((often, words)) => {
            let before = once.map_or(default, |(once, _)| *once);
            let frames = break_even(
                often.build.median,
                often.frame.median,
                before.build.median,
                before.frame.median,
            );
            let from = frames
                .filter(|frames| *frames > 1.0)
                .map_or(String::new(), |frames| {
                    format!(" from {:.0} on", libm::ceil(frames))
                });
            format!(
                "for many pictures{from} use {words} (frame {}, {:.0} % less than the defaults)",
                in_words(often.frame.median),
                saved(often, frame)
            )
        }
        None => "for many keep the defaults, too: no setting's frames are surely faster".into(),
    };
    let mut lines = vec![format!("For this model: {for_one}; {for_many}.")];
    lines.extend(spread(&all, &default));
    lines.extend(without_a_tree(results, &default));
    lines
}

/// How far apart the settings of each question are.
fn spread(all: &[Timed], default: &Timed) -> Vec<String> {
    let mut lines = Vec::new();
    for group in [
        super::PRESET,
        super::LEAF_SIZE,
        LAYOUT,
        super::KERNEL,
        super::OBVHS,
    ] {
        let members: Vec<&Timed> = all
            .iter()
            .filter(|timed| timed.case.group == group && timed.case.name != NO_TREE)
            .chain([default])
            .collect();
        let by_frame = |a: &&&Timed, b: &&&Timed| a.frame.median.total_cmp(&b.frame.median);
        let (best, worst) = (
            members.iter().min_by(by_frame),
            members.iter().max_by(by_frame),
        );
        if let (Some(best), Some(worst)) = (best, worst)
            && members.len() > 1
        {
            lines.push(format!(
                "By {group}, frames take from {} ({}) to {} ({}), a factor of {:.2}.",
                in_words(best.frame.median),
                best.case.name,
                in_words(worst.frame.median),
                worst.case.name,
                worst.frame.median / best.frame.median
            ));
        }
    }
    lines
}

/// What the tree is worth.
fn without_a_tree(results: &Results, default: &Timed) -> Option<String> {
    let none = results.case(NO_TREE)?;
    let frame = results.estimate(NO_TREE, FRAME).map(|frame| frame.median);
    match (frame, &none.left_out) {
        (Some(frame), _) => Some(format!(
            "Without any tree a frame takes {}, {:.0} times as long.",
            in_words(frame),
            frame / default.frame.median
        )),
        (None, Some(reason)) if reason != NO_TIME => {
            Some(format!("Without any tree {reason}: it was not measured."))
        }
        _ => None,
    }
}
