//! Where a study leaves its results, and finds them again.

use super::super::{Failure, print};
use super::subject::Subject;
use luch::study::plan::Plan;
use luch::study::plot;
use luch::study::report::{Report, html};
use luch::study::results::Results;
use std::fs;
use std::io::Write;
use std::path::{Path, PathBuf};
use tempfile::NamedTempFile;

/// The file that a study goes on from.
const RESULTS: &str = "results.json";

/// Where a study leaves its results.
pub(super) struct Folder {
    path: PathBuf,
    resume: bool,
}

impl Folder {
    /// A folder to be, or one that is there. One that holds a study is only taken to `resume` that.
    pub(super) fn open(path: &Path, resume: bool) -> Result<Folder, Failure> {
        let folder = Folder {
            path: path.to_owned(),
            resume,
        };
        let has_study = folder.path(RESULTS).exists();
        if has_study && !resume {
            return Err(Failure::usage_or_scene(format!(
                "{}: holds a study already; go on with it by --resume, or choose another folder with -o",
                print::path(path)
            )));
        }
        if !has_study && resume {
            return Err(Failure::usage_or_scene(format!(
                "{}: has no {RESULTS} to resume; leave --resume out to begin",
                print::path(path)
            )));
        }
        Ok(folder)
    }

    /// Makes the folder, if it is not there.
    pub(super) fn make(&self) -> Result<(), Failure> {
        fs::create_dir_all(&self.path).map_err(|error| self.problem(&self.path, "make", &error))
    }

    pub(super) fn path(&self, name: &str) -> PathBuf {
        self.path.join(name)
    }

    fn problem(&self, path: &Path, verb: &str, error: &std::io::Error) -> Failure {
        let path = print::path(path);
        Failure::output(format!("{path}: cannot {verb} this: {error}"))
    }

    /// What an earlier sitting left, where this one resumes it.
    pub(super) fn results(&self) -> Result<Option<Results>, Failure> {
        if !self.resume {
            return Ok(None);
        }
        let path = self.path(RESULTS);
        let text = fs::read_to_string(&path)
            .map_err(|error| Failure::usage_or_scene(format!("{}: {error}", print::path(&path))))?;
        Results::from_json(&text).map(Some).map_err(|problem| {
            let path = print::path(&path);
            Failure::usage_or_scene(format!("{path}: not the results of a study: {problem}"))
        })
    }

    /// Refuses to mix what cannot be compared.
    pub(super) fn must_match(
        &self,
        results: &Results,
        plan: &Plan,
        subject: &Subject,
    ) -> Result<(), Failure> {
        let then = &results.circumstances;
        let now = super::circumstances(plan, subject, None);
        let pairs = [
            ("a study of", results.study.clone(), plan.study.to_owned()),
            ("of the model", then.subject.clone(), now.subject),
            (
                "of files with the hash",
                then.model_sha256.clone(),
                now.model_sha256,
            ),
            ("with the commit", then.commit.clone(), now.commit),
            ("on", then.cpu.clone(), now.cpu),
            (
                "with threads",
                then.threads.to_string(),
                now.threads.to_string(),
            ),
            (
                "of the size",
                format!("{:?}", then.size),
                format!("{:?}", now.size),
            ),
        ];
        match pairs.iter().find(|(_, then, now)| then != now) {
            Some((what, then, now)) => Err(Failure::usage_or_scene(format!(
                "{}: was measured {what} {then}, this would be {now}; begin another folder with -o",
                print::path(&self.path(RESULTS))
            ))),
            None => Ok(()),
        }
    }

    /// Writes what is needed to go on; what was there stays until it is whole.
    pub(super) fn save(&self, results: &Results) -> Result<(), Failure> {
        self.put(RESULTS, results.to_json().as_bytes())
    }

    /// Writes everything that people read.
    pub(super) fn write(&self, results: &Results, report: &Report) -> Result<(), Failure> {
        self.put("results.csv", results.to_csv().as_bytes())?;
        for plot in &report.plots {
            self.put(&format!("{}.svg", plot.name), plot::svg(plot).as_bytes())?;
            let path = self.path(&format!("{}.png", plot.name));
            let png = plot::png(plot).map_err(|error| self.problem(&path, "draw", &error))?;
            self.put(&format!("{}.png", plot.name), &png)?;
        }
        for picture in &report.pictures {
            self.put(&format!("{}.png", stem(&picture.name)), &picture.png)?;
        }
        self.put("report.html", html(report).as_bytes())
    }

    fn put(&self, name: &str, bytes: &[u8]) -> Result<(), Failure> {
        let path = self.path(name);
        let written = NamedTempFile::new_in(&self.path).and_then(|mut file| {
            file.write_all(bytes)?;
            file.persist(&path).map_err(|error| error.error)?;
            // Temporary files are for their owner's eyes alone; these are not.
            readable(&path)
        });
        written.map_err(|error| self.problem(&path, "write", &error))
    }
}

/// A picture's name as a file's.
fn stem(name: &str) -> String {
    let letter = |c: char| {
        if c.is_ascii_alphanumeric() {
            c.to_ascii_lowercase()
        } else {
            '-'
        }
    };
    name.chars().map(letter).collect()
}

#[cfg(unix)]
fn readable(path: &Path) -> std::io::Result<()> {
    use std::os::unix::fs::PermissionsExt;
    fs::set_permissions(path, fs::Permissions::from_mode(0o644))
}

#[cfg(not(unix))]
fn readable(_: &Path) -> std::io::Result<()> {
    Ok(())
}
