//! Rays a second, beside Embree's: `cargo bench --bench rays`. What it measures and how to repeat it is in
//! `benches/README.md`.

#![allow(
    clippy::print_stdout,
    clippy::print_stderr,
    reason = "a benchmark prints its tables"
)]

#[path = "rays/arguments.rs"]
mod arguments;
#[path = "rays/builds.rs"]
mod builds;
#[path = "rays/embree.rs"]
mod embree;
#[path = "rays/embree_layouts.rs"]
mod embree_layouts;
#[path = "rays/engines.rs"]
mod engines;
#[path = "rays/frames.rs"]
mod frames;
#[path = "rays/kernel.rs"]
mod kernel;
#[path = "rays/measure.rs"]
mod measure;
#[path = "rays/record.rs"]
mod record;
#[path = "rays/scenes.rs"]
mod scenes;
#[path = "rays/table.rs"]
mod table;

use arguments::Arguments;
use embree::Embree;
use engines::{Arena, Engine, Round, Threads};
use luch::accel::Accel;
use luch::study::sets::{self, Kind};
use measure::{Difference, race};
use record::Results;
use std::fs;
use std::path::Path;
use std::process::ExitCode;
use table::Row;

/// Scenes above this are too slow for the oracle.
const MOST_FOR_LINEAR: u32 = 100_000;

fn main() -> ExitCode {
    let arguments = Arguments::of_this_run();
    match run(&arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error}");
            ExitCode::FAILURE
        }
    }
}

fn run(arguments: &Arguments) -> Result<(), String> {
    let embree = std::env::var_os("LUCH_EMBREE").map(|file| Embree::load(Path::new(&file)));
    let embree = embree
        .transpose()
        .map_err(|error| format!("LUCH_EMBREE: {error}"))?;
    if let Some(kind) = arguments.kernel_only {
        return kernel::run(arguments, kind, arguments.engine, embree.as_ref());
    }
    let mut results = Results::default();
    if embree.is_none() {
        results
            .say("LUCH_EMBREE names no library: no Embree in the tables (see benches/README.md)\n");
    }
    results.say(table::HEADER);
    for name in arguments.scenes() {
        if let Err(reason) = race_in(&name, arguments, embree.as_ref(), &mut results) {
            results.say(format!(
                "{:<14} not loaded: {reason}",
                scenes::short_name(&name)
            ));
        }
    }
    if !arguments.only_rays {
        frames(arguments, &mut results)?;
        builds(&mut results);
    }
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("target/rays.json");
    // The build's own folder may be elsewhere.
    let folder = file.parent().map_or(Ok(()), fs::create_dir_all);
    let written =
        folder.and_then(|()| fs::write(&file, format!("{:#}\n", table::json(&results.rows))));
    written.map_err(|error| format!("{}: {error}", file.display()))?;
    match &arguments.record {
        Some(name) => results
            .write_record(name)
            .map_err(|error| format!("record {name}: {error}")),
        None => Ok(()),
    }
}

/// The rows of one scene, and its builds, which are shown later.
fn race_in(
    name: &str,
    arguments: &Arguments,
    embree: Option<&Embree>,
    results: &mut Results,
) -> Result<(), String> {
    let scene = scenes::make(name)?;
    if !arguments.only_rays {
        results
            .builds
            .extend(builds::of_scene(name, &scene, embree)?);
    }
    let accel = Accel::build(&scene, &engines::options());
    let arena = Arena::new(&scene, &accel, embree)?;
    let rounding = 1e-5 * scene.bounds().extent();
    let sets = sets::make(&scene, &accel, sets::light(&scene), arguments.size());
    for (kind, set) in Kind::ALL.into_iter().zip(&sets) {
        let round = Round::new(kind, set, arena.has_embree());
        let few = scene.primitive_count() <= MOST_FOR_LINEAR;
        let mut engines = Engine::ALL.to_vec();
        engines.retain(|&engine| engine != Engine::Linear || few);
        let mut measured = race(&arena, &round, &engines, Threads::One, arguments.rounds);
        if !arguments.only_rays {
            engines.retain(|&engine| engine != Engine::Linear);
            measured.extend(race(
                &arena,
                &round,
                &engines,
                Threads::All,
                arguments.rounds,
            ));
        }
        let ours = arena.answers(Engine::Luch, &round);
        let theirs = arena.answers(Engine::EmbreeRobust, &round);
        let row = Row {
            scene: scenes::short_name(name),
            triangles: scene.primitive_count(),
            kind,
            measured,
            difference: ours
                .zip(theirs)
                .map(|(ours, theirs)| Difference::between(&ours, &theirs, rounding)),
            from_oracle: few.then(|| against_oracle(&arena, &round, kind)),
        };
        results.say(row.line());
        results.rows.push(row);
    }
    Ok(())
}

/// Luch against the oracle on the oracle's few rays.
fn against_oracle(arena: &Arena, round: &Round, kind: Kind) -> Difference {
    let few = sets::RaySet::in_batches(round.few());
    let round = Round::new(kind, &few, false);
    let of = |engine| arena.answers(engine, &round).unwrap_or_default();
    Difference::between(&of(Engine::Luch), &of(Engine::Linear), 0.0)
}

/// Whole frames, where the interior was among the scenes.
fn frames(arguments: &Arguments, results: &mut Results) -> Result<(), String> {
    if results.rows.iter().all(|row| row.scene != "interior") {
        return Ok(());
    }
    results.frames = frames::of_interior(arguments)?;
    results.say(format!("\n{}", frames::HEADER));
    let lines: Vec<String> = results.frames.iter().map(frames::line).collect();
    lines.into_iter().for_each(|line| results.say(line));
    Ok(())
}

fn builds(results: &mut Results) {
    results.say(format!("\n{}", builds::HEADER));
    let lines: Vec<String> = results.builds.iter().map(builds::line).collect();
    lines.into_iter().for_each(|line| results.say(line));
}
