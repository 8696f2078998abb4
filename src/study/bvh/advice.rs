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
    let Some(usual) = all.iter().find(|timed| timed.case.name == DEFAULT) else {
        return Vec::new();
    };
    let mut lines = vec![what_to_use(results, &all, usual)];
    lines.extend(spread(&all, usual));
    lines.extend(without_a_tree(results, usual));
    lines
}

/// What `luch render` draws of a model unless it is told otherwise: pixels, and samples of each.
const PICTURE: ([u32; 2], u32) = ([1280, 720], 4);

/// The advice, for a picture as people render them: the study's own are smaller, so that their times are multiplied.
fn what_to_use(results: &Results, all: &[Timed], usual: &Timed) -> String {
    let rays = |[width, height]: [u32; 2], samples: u32| {
        f64::from(width) * f64::from(height) * f64::from(samples)
    };
    let factor = rays(PICTURE.0, PICTURE.1)
        / rays(results.circumstances.size, usual.case.settings.samples).max(1.0);
    fn of<'a>(timed: &Timed<'a>, factor: f64) -> Timed<'a> {
        Timed {
            frame: timed.frame.times(factor),
            ..*timed
        }
    }
    let default = of(usual, factor);
    // Kernels are the machine's affair, not a choice.
    let usable: Vec<(Timed, String)> = all
        .iter()
        .filter(|timed| timed.case.settings.kernel == default.case.settings.kernel)
        .filter_map(|timed| Some((of(timed, factor), options(timed.case)?)))
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
        format!("build {build}, picture {frame}")
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
                "for many pictures{from} use {words} (picture {}, {:.0} % less than the defaults)",
                in_words(often.frame.median),
                saved(often, frame)
            )
        }
        None => "for many keep the defaults, too: no setting's pictures are surely faster".into(),
    };
    let ([width, height], samples) = PICTURE;
    format!(
        "For this model, at {width} x {height} with {samples} samples a pixel: {for_one}; {for_many}."
    )
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

#[cfg(test)]
mod tests {
    use super::super::super::case::Settings;
    use super::super::super::results::{Circumstances, Facts, Run};
    use super::*;

    /// A study of the defaults and of the preset `fastest`, each with these builds and frames, seconds.
    fn studied(default: [[f64; 3]; 2], fastest: [[f64; 3]; 2]) -> Results {
        let mut results = Results::new("bvh", Circumstances::default());
        results.circumstances.size = [1280, 720];
        let cases = [
            (DEFAULT, "medium", default),
            ("preset fastest", "fastest", fastest),
        ];
        for (name, preset, times) in cases {
            results.cases.push(Measured {
                name: name.into(),
                group: name.into(),
                scene: "a chair".into(),
                primitives: 100,
                settings: Settings {
                    builder: "own".into(),
                    preset: preset.into(),
                    leaf_size: 8,
                    layout: "wide".into(),
                    kernel: "scalar".into(),
                    packets: true,
                    samples: 4,
                },
                facts: Some(Facts {
                    same_picture: true,
                    ..Facts::default()
                }),
                left_out: None,
            });
            for (measure, seconds) in [BUILD, FRAME].into_iter().zip(times) {
                for (round, seconds) in (1..).zip(seconds) {
                    results.runs.push(Run {
                        case: name.into(),
                        round,
                        measure,
                        seconds,
                        rays: 1,
                        same_picture: true,
                    });
                }
            }
        }
        results
    }

    #[test]
    fn a_setting_that_is_surely_faster_is_advised_and_from_when_the_other_pays_off() {
        // 0.3 s against 1.2 s for one; each frame of the default then saves 0.1 s of the 0.9 s.
        let default = [[1.0; 3], [0.1; 3]];
        let results = studied(default, [[0.1; 3], [0.2; 3]]);
        let advice = &findings(&results)[0];
        assert!(
            advice.contains("for one picture use --bvh fastest"),
            "{advice}"
        );
        assert!(advice.contains("for many keep the defaults"), "{advice}");
        let results = studied(default, [[2.0; 3], [0.05; 3]]);
        let advice = &findings(&results)[0];
        assert!(
            advice.contains("for one picture keep the defaults"),
            "{advice}"
        );
        // A second more for the build, a twentieth less for each picture.
        assert!(
            advice.contains("for many pictures from 20 on use --bvh fastest"),
            "{advice}"
        );
    }

    #[test]
    fn a_setting_within_the_noise_is_not_advised() {
        let results = studied(
            [[1.0, 1.1, 1.2], [0.1, 0.11, 0.12]],
            [[0.9, 1.0, 1.1], [0.09, 0.10, 0.11]],
        );
        let advice = &findings(&results)[0];
        assert!(
            advice.contains("for one picture keep the defaults"),
            "{advice}"
        );
        assert!(advice.contains("for many keep the defaults"), "{advice}");
    }
}
