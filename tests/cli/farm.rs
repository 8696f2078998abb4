//! The jobs for farms that come with the project.

use super::{Folder, asset};
use std::fs;

#[test]
fn every_option_of_the_jobs_is_one_that_the_program_has() {
    let help = Folder::new(&[]).luch_succeeds(&["render", "--help"]);
    for job in ["farm/frames.yaml", "farm/frames.slurm"] {
        let text = fs::read_to_string(asset(job)).expect("an asset");
        let is_comment = |line: &&str| line.trim_start().starts_with('#');
        let words = text.lines().filter(|line| !is_comment(line));
        let words = words.flat_map(str::split_whitespace);
        let options: Vec<&str> = words.filter(|word| word.starts_with("--")).collect();
        assert!(options.contains(&"--skip-existing"), "{job}");
        for option in options {
            assert!(
                help.out().contains(&format!("{option} "))
                    || help.out().contains(&format!("{option}\n")),
                "{job}: {option}"
            );
        }
    }
}
