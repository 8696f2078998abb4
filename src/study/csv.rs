//! `results.csv`: every raw sample, for whoever has other questions.

use super::results::{Measured, Results, Run};

/// The columns of `results.csv`, in order, each with what it holds.
pub const COLUMNS: [(&str, &str); 23] = [
    ("study", "bvh, scaling, samples or rays"),
    ("case", "the case's name"),
    ("group", "the question the case belongs to"),
    ("scene", "the scene's name"),
    ("primitives", "triangles, spheres and planes"),
    ("builder", "own or obvhs"),
    ("preset", "as in --bvh"),
    ("leaf_size", "the most primitives of a leaf"),
    ("layout", "wide, small, bvh2, cwbvh, or none for no tree"),
    ("kernel", "as in LUCH_ISA"),
    ("packets", "whether rays go together: true or false"),
    ("samples", "a pixel"),
    ("nodes", "of all trees"),
    ("leaves", "of all trees"),
    ("depth", "nodes on the longest way down"),
    ("bytes", "of nodes and primitives in memory, bytes"),
    (
        "sah_cost",
        "surface-area cost, a node and a primitive costing 1 each",
    ),
    ("round", "from 1"),
    (
        "measure",
        "build, frame, or the kind of rays of search alone",
    ),
    ("threads", "one or all"),
    ("seconds", "what the run took, seconds"),
    ("rays", "how many were traced; 0 of a build"),
    (
        "same_picture",
        "whether the picture has the reference's bits: true or false",
    ),
];

impl Results {
    /// `results.csv` (RFC 4180): [`COLUMNS`], then every raw sample, one row a run.
    pub fn to_csv(&self) -> String {
        let names: Vec<&str> = COLUMNS.iter().map(|(name, _)| *name).collect();
        let mut csv = names.join(",") + "\r\n";
        for run in &self.runs {
            let Some(case) = self.case(&run.case) else {
                continue;
            };
            let row = self.row(run, case).map(|field| quoted(&field));
            csv += &(row.join(",") + "\r\n");
        }
        csv
    }

    fn row(&self, run: &Run, case: &Measured) -> [String; COLUMNS.len()] {
        let (s, facts) = (&case.settings, case.facts.clone().unwrap_or_default());
        [
            self.study.clone(),
            case.name.clone(),
            case.group.clone(),
            case.scene.clone(),
            case.primitives.to_string(),
            s.builder.clone(),
            s.preset.clone(),
            s.leaf_size.to_string(),
            s.layout.clone(),
            s.kernel.clone(),
            s.packets.to_string(),
            s.samples.to_string(),
            facts.nodes.to_string(),
            facts.leaves.to_string(),
            facts.depth.to_string(),
            facts.bytes.to_string(),
            facts.sah_cost.to_string(),
            run.round.to_string(),
            run.measure.what.name().to_owned(),
            run.measure.threads.name().to_owned(),
            run.seconds.to_string(),
            run.rays.to_string(),
            run.same_picture.to_string(),
        ]
    }
}

/// A field as RFC 4180 wants it.
fn quoted(field: &str) -> String {
    if field.contains([',', '"', '\n', '\r']) {
        format!("\"{}\"", field.replace('"', "\"\""))
    } else {
        field.to_owned()
    }
}

#[cfg(test)]
pub(super) mod tests {
    use super::super::case::{Measure, Settings, Threads, What};
    use super::super::results::{Circumstances, Facts};
    use super::super::sets::Kind;
    use super::*;

    /// Two runs of one case.
    pub(in super::super) fn results() -> Results {
        let settings = Settings {
            builder: "own".into(),
            preset: "medium".into(),
            leaf_size: 8,
            layout: "wide".into(),
            kernel: "scalar".into(),
            packets: true,
            samples: 1,
        };
        let measured = Measured {
            name: "leaf size 4".into(),
            group: "leaf size".into(),
            scene: "a \"good\", old chair".into(),
            primitives: 100,
            settings,
            facts: Some(Facts {
                nodes: 2,
                leaves: 13,
                depth: 2,
                leaf_sizes: vec![0, 0, 0, 13],
                bytes: 5000,
                sah_cost: 12.5,
                same_picture: true,
                ..Facts::default()
            }),
            left_out: None,
        };
        let run = |what, seconds, rays, same_picture| Run {
            case: "leaf size 4".into(),
            round: 1,
            measure: Measure {
                what,
                threads: Threads::All,
            },
            seconds,
            rays,
            same_picture,
        };
        Results {
            cases: vec![measured],
            runs: vec![
                run(What::Build, 0.25, 0, true),
                run(What::Rays(Kind::Mirror), 0.5, 4096, true),
            ],
            ..Results::new("bvh", Circumstances::default())
        }
    }

    #[test]
    fn csv_has_its_columns_and_one_row_a_run() {
        let csv = results().to_csv();
        let lines: Vec<&str> = csv.split("\r\n").collect();
        assert_eq!(
            lines[0],
            "study,case,group,scene,primitives,builder,preset,leaf_size,layout,kernel,packets,samples,nodes,leaves,\
             depth,bytes,sah_cost,round,measure,threads,seconds,rays,same_picture"
        );
        let case = "bvh,leaf size 4,leaf size,\"a \"\"good\"\", old chair\",100,own,medium,8,wide,scalar,true,1,2,13,2,5000,12.5";
        assert_eq!(lines[1], format!("{case},1,build,all,0.25,0,true"));
        assert_eq!(lines[2], format!("{case},1,mirror,all,0.5,4096,true"));
        assert_eq!(lines[3..], [""]);
    }
}
