//! What every report opens and closes with.

use super::csv::COLUMNS;
use super::report::{Report, Table};
use super::results::{Circumstances, Results};
use super::show::{column, in_words, text};

/// Puts into `report` on what it was measured, what makes it doubtful, and how to repeat it.
pub fn complete(report: &mut Report, results: &Results) {
    let c = &results.circumstances;
    report.partial = results.partial;
    report.warnings = results.remarks();
    let of_study = std::mem::replace(&mut report.circumstances, circumstances(c, results));
    report.circumstances.extend(of_study);
    report.tables.push(columns());
    report.repeat = vec![c.command.clone()];
    if results.partial {
        report.repeat.push(format!("{} --resume", c.command));
    }
}

/// What `results.csv` beside the report holds.
fn columns() -> Table {
    Table {
        title: "Columns of results.csv, which has a row for every run".into(),
        columns: vec![column("column", ""), column("what it holds", "")],
        rows: COLUMNS
            .map(|(name, what)| vec![text(name), text(what)])
            .to_vec(),
    }
}

fn circumstances(c: &Circumstances, results: &Results) -> Vec<(String, String)> {
    let rounds = results.runs.iter().map(|run| run.round).max().unwrap_or(0);
    let [width, height] = c.size;
    let share = |share: Option<f64>| {
        share.map_or("unknown".into(), |share| format!("{:.0} %", 100.0 * share))
    };
    let pairs = [
        ("Subject", c.subject.clone()),
        ("SHA-256 of its files", c.model_sha256.clone()),
        (
            "Processor",
            format!("{}, {} logical cores", c.cpu, c.logical_cores),
        ),
        (
            "Memory",
            c.memory.map_or(String::new(), |bytes| {
                format!("{:.0} GiB", bytes as f64 / (1u64 << 30) as f64)
            }),
        ),
        ("System", c.system.clone()),
        ("Threads", c.threads.to_string()),
        ("Kernels", c.kernel.clone()),
        (
            "Program",
            format!("luch {}, commit {}", c.version, c.commit),
        ),
        ("Compiler", c.compiler.clone()),
        ("Command", c.command.clone()),
        ("Pictures", format!("{width} x {height}")),
        (
            "Method",
            format!(
                "{rounds} rounds after a warm-up, settings in turns; medians with intervals of 95 % (bootstrap); \
                 loading, writing and counting are not timed"
            ),
        ),
        ("Took", in_words(c.seconds)),
        ("Other programs used meanwhile", share(c.others_share)),
        (
            "Load before",
            c.load_before
                .map_or("unknown".into(), |load| format!("{load:.2}")),
        ),
    ];
    pairs
        .into_iter()
        .filter(|(_, value)| !value.is_empty())
        .map(|(name, value)| (name.to_owned(), value))
        .collect()
}
