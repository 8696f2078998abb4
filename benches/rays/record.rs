//! `benches/record/<name>.csv` and `.txt`: the tables, and on what they were made.

use super::builds::BuildRow;
use super::frames::FrameRow;
use super::table::Row;
use std::fs;
use std::io;
use std::path::Path;
use std::process::Command;

/// Everything that was measured.
#[derive(Clone, Debug, Default)]
pub(crate) struct Results {
    pub(crate) rows: Vec<Row>,
    pub(crate) builds: Vec<BuildRow>,
    pub(crate) frames: Vec<FrameRow>,
    /// What was printed.
    pub(crate) lines: Vec<String>,
}

impl Results {
    /// Prints a line and keeps it for the record.
    pub(crate) fn say(&mut self, line: impl Into<String>) {
        let line = line.into();
        println!("{line}");
        self.lines.push(line);
    }

    /// Writes both files of a record.
    pub(crate) fn write_record(&self, name: &str) -> io::Result<()> {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("benches/record");
        fs::write(folder.join(format!("{name}.csv")), self.csv())?;
        let text = format!("{}\n{}\n", circumstances(), self.lines.join("\n"));
        fs::write(folder.join(format!("{name}.txt")), text)
    }

    /// A line for every figure, every round by itself.
    fn csv(&self) -> String {
        let mut csv =
            String::from("table,scene,triangles,what,engine,isa,threads,figure,unit,rounds\n");
        for row in &self.rows {
            for m in &row.measured {
                let rounds: Vec<String> = m
                    .mrays_per_second
                    .iter()
                    .map(|r| format!("{r:.4}"))
                    .collect();
                let (scene, triangles, kind) = (&row.scene, row.triangles, row.kind.name());
                let (engine, isa, threads) = (m.engine.name(), &m.isa, m.threads.count());
                let (median, rounds) = (m.median(), rounds.join(" "));
                csv += &format!(
                    "rays,{scene},{triangles},{kind},{engine},{isa},{threads},{median:.4},Mrays/s,{rounds}\n"
                );
            }
        }
        for b in &self.builds {
            let (scene, triangles, builder, threads) =
                (&b.scene, b.triangles, b.builder, b.threads);
            let (seconds, bytes) = (b.seconds, b.bytes_per_triangle);
            csv +=
                &format!("build,{scene},{triangles},time,{builder},,{threads},{seconds:.4},s,\n");
            csv += &format!(
                "build,{scene},{triangles},memory,{builder},,{threads},{bytes:.1},bytes/triangle,\n"
            );
        }
        for f in &self.frames {
            let (whole, bare) = (f.mrays_per_second, f.bare_mrays_per_second);
            csv += &format!(
                "frame,interior,,{:?},luch,,1,{whole:.4},Mrays/s,\n",
                f.decoration
            );
            csv += &format!(
                "frame,interior,,{:?} bare,luch,,1,{bare:.4},Mrays/s,\n",
                f.decoration
            );
        }
        csv
    }
}

/// Commit, command, compiler and CPU, a line each.
fn circumstances() -> String {
    let output = |program: &str, arguments: &[&str]| {
        let output = Command::new(program).args(arguments).output().ok()?;
        let text = String::from_utf8_lossy(&output.stdout).trim().to_owned();
        (output.status.success() && !text.is_empty()).then_some(text)
    };
    let unknown = || "unknown".to_owned();
    let changed = output("git", &["status", "--porcelain", "--untracked-files=no"]);
    let commit = output("git", &["rev-parse", "--short", "HEAD"]).unwrap_or_else(unknown);
    let changed = if changed.is_some() {
        " and changes since"
    } else {
        ""
    };
    let words: Vec<String> = std::env::args()
        .skip(1)
        .filter(|word| word != "--bench")
        .collect();
    let compiler = output("rustc", &["--version"]).unwrap_or_else(unknown);
    let profile: String = ["LTO", "CODEGEN_UNITS"]
        .iter()
        .filter_map(|key| {
            std::env::var(format!("CARGO_PROFILE_BENCH_{key}"))
                .ok()
                .map(|value| format!(", {key} {value}"))
        })
        .collect();
    let cpu_information = fs::read_to_string("/proc/cpuinfo").unwrap_or_default();
    let cpu = cpu_information
        .lines()
        .find_map(|line| line.strip_prefix("model name"))
        .map_or_else(unknown, |name| {
            name.trim_start_matches([' ', '\t', ':']).to_owned()
        });
    let family: Vec<&str> = ["cpu family", "model\t", "stepping"]
        .iter()
        .filter_map(|key| {
            cpu_information
                .lines()
                .find(|line| line.starts_with(key))?
                .split(": ")
                .nth(1)
        })
        .collect();
    let threads = std::thread::available_parallelism().map_or(1, usize::from);
    format!(
        "commit    {commit}{changed}\ncommand   cargo bench --bench rays -- {}\ncompiler  {compiler}{profile}\n\
         cpu       {cpu} (family, model, stepping: {}), {threads} threads\n\
         rounds    medians; every round is in the csv\n",
        words.join(" "),
        family.join(", "),
    )
}
