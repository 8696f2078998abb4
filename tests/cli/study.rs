//! `luch study`.

use super::Folder;
use luch::study::results::Results;
use std::io::{BufRead, BufReader};
use std::process::{Command, Stdio};

/// A study that ends at once.
const SMALL: [&str; 10] = [
    "study",
    "bvh",
    "model.obj",
    "-q",
    "-o",
    "out",
    "--size",
    "8x8",
    "--budget",
    "0.1",
];

fn small(more: &[&'static str]) -> Vec<&'static str> {
    [&SMALL[..], more].concat()
}

const FEW: [&str; 6] = [
    "--presets",
    "fast",
    "--leaf-sizes",
    "2",
    "--layouts",
    "none",
];

#[test]
fn a_study_leaves_a_report_every_sample_and_every_plot_twice() {
    let folder = Folder::with_scene_and_model();
    folder.luch_succeeds(&small(&FEW));
    let results = folder.read("out/results.json");
    let results =
        Results::from_json(std::str::from_utf8(&results).expect("UTF-8")).expect("results");
    assert!(!results.partial);
    assert_eq!(results.circumstances.subject, "model.obj");
    assert_eq!(results.circumstances.model_sha256.len(), 64);
    let csv = String::from_utf8(folder.read("out/results.csv")).expect("UTF-8");
    assert_eq!(csv.lines().count(), results.runs.len() + 1);
    let page = String::from_utf8(folder.read("out/report.html")).expect("UTF-8");
    assert!(page.contains("model.obj") && page.contains("luch study bvh model.obj"));
    assert!(page.contains("Columns of results.csv") && page.contains("what the run took, seconds"));
    for plot in ["render-time-by-bytes", "build-time-and-render-time"] {
        assert!(
            folder
                .read(&format!("out/{plot}.png"))
                .starts_with(b"\x89PNG")
        );
        assert!(folder.read(&format!("out/{plot}.svg")).starts_with(b"<svg"));
    }
}

#[test]
fn a_folder_with_a_study_is_only_taken_to_resume_it() {
    let folder = Folder::with_scene_and_model();
    folder.luch_fails(
        &["study", "rays", "model.obj", "-o", "out", "--resume"],
        1,
        "out: has no results.json to resume; leave --resume out to begin",
    );
    folder.luch_succeeds(&small(&FEW));
    let before = folder.read("out/results.json");
    folder.luch_fails(
        &small(&FEW),
        1,
        "out: holds a study already; go on with it by --resume, or choose another folder with -o",
    );
    assert!(folder.read("out/results.json") == before);
    folder.luch_succeeds(&small(&[&FEW[..], &["--resume"]].concat()));
    folder.luch_fails(
        &["study", "rays", "model.obj", "-o", "out", "--resume", "--size", "8x8"],
        1,
        "out/results.json: was measured a study of bvh, this would be rays; begin another folder with -o",
    );
}

#[test]
fn nonsense_is_refused_with_a_sentence() {
    let folder = Folder::with_scene_and_model();
    let see = "(see luch study --help)";
    let fails = |more: &[&str], error: &str| {
        let arguments = [&["study", "bvh", "model.obj"], more].concat();
        folder.luch_fails(&arguments, 1, error);
    };
    fails(
        &["--leaf-sizes", "0"],
        &format!(
            "invalid value '0' for '--leaf-sizes <SIZES>': a leaf of 0 primitives cannot be; expected a whole number \
             from 1 to 16 {see}"
        ),
    );
    fails(
        &["--presets", "best"],
        &format!(
            "invalid value 'best' for '--presets <NAMES>': no preset is called \"best\"; there are fastest, very-fast, \
             fast, medium, slow, very-slow {see}"
        ),
    );
    fails(
        &["--budget", "0.01"],
        "a budget of 0.01 minutes is too small for a study; give it at least 0.1",
    );
    folder.luch_fails(
        &["study", "bvh", "terrain:5"],
        1,
        "terrain:5: expected a whole number of primitives from 10 to 10000000 after the colon",
    );
    folder.luch_fails(
        &["study", "samples", "--samples", "3", "-o", "out"],
        1,
        "3 samples a pixel do not make a square grid; use 1 or 4",
    );
}

#[cfg(unix)]
#[test]
fn an_interrupt_writes_what_is_there_and_says_that_it_is_partial() {
    let folder = Folder::with_scene_and_model();
    let arguments = [
        "study",
        "bvh",
        "terrain:20000",
        "-o",
        "out",
        "--size",
        "64x64",
    ];
    let mut child = folder
        .command(&arguments)
        .stderr(Stdio::piped())
        .stdout(Stdio::null())
        .spawn()
        .expect("the program runs");
    let mut err = BufReader::new(child.stderr.take().expect("piped")).lines();
    // The first rounds: something has been measured.
    let percent = |line: &str| {
        line.strip_prefix("Progress: ")?
            .strip_suffix('%')?
            .parse()
            .ok()
    };
    let begun = err.find(|line| {
        let line = line.as_deref().unwrap_or_default();
        percent(line).is_some_and(|percent: u32| percent > 32)
    });
    let signal = Command::new("kill")
        .args(["-INT", &child.id().to_string()])
        .status();
    if !signal.as_ref().is_ok_and(|status| status.success()) {
        child.kill().expect("a running program");
    }
    let last = err.map_while(Result::ok).last();
    let code = child.wait().expect("an end").code();
    assert!(begun.is_some());
    assert_eq!(code, Some(130));
    assert_eq!(
        last.as_deref(),
        Some("error: interrupted; what was measured is written, and --resume goes on")
    );
    let results = folder.read("out/results.json");
    let results =
        Results::from_json(std::str::from_utf8(&results).expect("UTF-8")).expect("results");
    assert!(results.partial && !results.runs.is_empty());
    let page = String::from_utf8(folder.read("out/report.html")).expect("UTF-8");
    assert!(page.contains("--resume"));
}
