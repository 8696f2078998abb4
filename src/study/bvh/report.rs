//! The report of a study of one model's tree.

use super::super::case::{Measure, Threads, What};
use super::super::report::{Report, Table};
use super::super::results::{Measured, Results};
use super::super::sets::Kind;
use super::super::show::{column, number, text};
use super::{advice, plots};

/// What was found, to be shown.
pub fn report(results: &Results) -> Report {
    Report {
        title: format!(
            "How the BVH affects render time: {}",
            results.circumstances.subject
        ),
        findings: advice::findings(results),
        circumstances: explanations(),
        plots: plots::plots(results),
        tables: vec![
            times(results),
            trees(results),
            tests(results),
            leaf_sizes(results),
        ],
        ..Report::default()
    }
}

/// What the words of the tables mean.
fn explanations() -> Vec<(String, String)> {
    let pairs = [
        (
            "Builders",
            "own: at fastest stretches of a curve, at very-fast joined neighbours, at fast split from the top, from medium on \
             both, of which the better is kept; obvhs: its joined neighbours and reinsertion",
        ),
        (
            "Layouts",
            "wide: eight children a node, triangles by eight; small: by four; bvh2: obvhs's binary nodes; cwbvh: obvhs's \
             compressed nodes of eight, whose leaves have at most three primitives whatever is asked for, and whose boxes \
             are grown by half a ten-thousandth of the scene; none: every primitive in turn. Kernels and packets are of luch's \
             own two layouts",
        ),
    ];
    pairs
        .map(|(name, words)| (name.to_owned(), words.to_owned()))
        .to_vec()
}

/// Medians with their intervals.
fn times(results: &Results) -> Table {
    let build = |threads| Measure {
        what: What::Build,
        threads,
    };
    let mut columns = vec![
        column("case", ""),
        column("runs", ""),
        column("build, one thread", "ms"),
        column("build", "ms"),
        column("frame", "ms"),
        column("from", "ms"),
        column("to", "ms"),
    ];
    columns.extend(Kind::ALL.map(|kind| column(kind.name(), "Mrays/s")));
    let row = |case: &Measured| {
        let ms = |measure| {
            results
                .estimate(&case.name, measure)
                .map(|e| 1e3 * e.median)
        };
        let frame = results.estimate(&case.name, advice::FRAME);
        let mut cells = vec![
            text(&case.name),
            number(
                Some(results.seconds(&case.name, advice::FRAME).len() as f64),
                0,
            ),
            number(ms(build(Threads::One)), 1),
            number(ms(build(Threads::All)), 1),
            number(frame.map(|e| 1e3 * e.median), 1),
            number(frame.map(|e| 1e3 * e.low), 1),
            number(frame.map(|e| 1e3 * e.high), 1),
        ];
        cells.extend(Kind::ALL.map(|kind| {
            let measure = Measure {
                what: What::Rays(kind),
                threads: Threads::One,
            };
            number(results.mrays(&case.name, measure).map(|e| e.median), 2)
        }));
        cells
    };
    Table {
        title: "Times: medians, the frame's with its interval of 95 %; rays on one thread, without shading".into(),
        columns,
        rows: results.cases.iter().map(row).collect(),
    }
}

/// What the trees are like.
fn trees(results: &Results) -> Table {
    let columns = vec![
        column("case", ""),
        column("builder", ""),
        column("preset", ""),
        column("leaf size", ""),
        column("layout", ""),
        column("kernel", ""),
        column("packets", ""),
        column("nodes", ""),
        column("leaves", ""),
        column("depth", ""),
        column("size", "B per primitive"),
        column("SAH cost", ""),
    ];
    let row = |case: &Measured| {
        let s = &case.settings;
        let facts = case.facts.as_ref();
        let size = facts.map(|facts| facts.bytes as f64 / case.primitives.max(1) as f64);
        vec![
            text(&case.name),
            text(&s.builder),
            text(&s.preset),
            number(Some(f64::from(s.leaf_size)), 0),
            text(&s.layout),
            text(&s.kernel),
            text(if s.packets { "on" } else { "off" }),
            number(facts.map(|facts| facts.nodes as f64), 0),
            number(facts.map(|facts| facts.leaves as f64), 0),
            number(facts.map(|facts| facts.depth as f64), 0),
            number(size, 1),
            number(facts.map(|facts| facts.sah_cost), 2),
        ]
    };
    Table {
        title: "Trees".into(),
        columns,
        rows: results.cases.iter().map(row).collect(),
    }
}

/// What rays test.
fn tests(results: &Results) -> Table {
    let mut columns = vec![column("case", "")];
    for kind in Kind::ALL {
        columns.push(column(&format!("{}: nodes", kind.name()), "a ray"));
        columns.push(column(&format!("{}: primitives", kind.name()), "a ray"));
    }
    let row = |case: &Measured| {
        let mut cells = vec![text(&case.name)];
        for kind in Kind::ALL {
            let facts = case.facts.as_ref();
            let tests = facts.and_then(|facts| facts.tests.iter().find(|tests| tests.kind == kind));
            cells.push(number(tests.map(|tests| tests.nodes), 2));
            cells.push(number(tests.map(|tests| tests.primitives), 2));
        }
        cells
    };
    Table {
        title: "Nodes and primitives tested by a ray on its own way, counted apart from every timed run".into(),
        columns,
        rows: results.cases.iter().map(row).collect(),
    }
}

/// How many leaves have how many primitives.
fn leaf_sizes(results: &Results) -> Table {
    let lists = results.cases.iter().filter_map(|case| {
        let sizes = &case.facts.as_ref()?.leaf_sizes;
        // A list without a tree is one leaf of everything.
        (sizes.len() <= 64).then_some((case, sizes))
    });
    let lists: Vec<_> = lists.collect();
    let most = lists
        .iter()
        .map(|(_, sizes)| sizes.len())
        .max()
        .unwrap_or(0);
    let mut columns = vec![column("case", "")];
    columns.extend((1..=most).map(|size| column(&format!("of {size}"), "leaves")));
    let row = |(case, sizes): &(&Measured, &Vec<u64>)| {
        let mut cells = vec![text(&case.name)];
        cells.extend((0..most).map(|i| number(sizes.get(i).map(|&count| count as f64), 0)));
        cells
    };
    Table {
        title: "Leaves by the number of their primitives".into(),
        columns,
        rows: lists.iter().map(row).collect(),
    }
}
