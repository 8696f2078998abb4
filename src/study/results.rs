//! What a study found: every raw sample, on what it was measured, and as JSON and CSV.

use super::case::{Measure, Settings};
use super::sets::Kind;
use serde::{Deserialize, Serialize};

/// The form of `results.json` that this version writes.
pub const FORMAT: &str = "luch study 1";

/// Why a case was not measured that the budget did not suffice for.
pub const NO_TIME: &str = "no time";

/// Everything that a study found.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Results {
    /// [`FORMAT`].
    pub format: String,
    /// Which study: `bvh`, `scaling`, `samples` or `rays`.
    pub study: String,
    /// Whether it was stopped before it was done.
    pub partial: bool,
    /// On what, and by what, it was measured.
    pub circumstances: Circumstances,
    /// The cases, in the plan's order.
    pub cases: Vec<Measured>,
    /// Every timed run, in the order in which they took place.
    pub runs: Vec<Run>,
    /// What the report has to say about the measuring itself.
    pub warnings: Vec<String>,
}

/// On what, and by what, a study was measured.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Circumstances {
    /// As it was given.
    pub command: String,
    /// The model or the scenes.
    pub subject: String,
    /// SHA-256 of the files of the model, in order; of a generated scene nothing.
    pub model_sha256: String,
    /// Of the program.
    pub version: String,
    /// Of the program's sources.
    pub commit: String,
    /// That made the program.
    pub compiler: String,
    /// The processor.
    pub cpu: String,
    /// Cores that the system shows.
    pub logical_cores: usize,
    /// Threads that the study may use.
    pub threads: usize,
    /// Bytes of memory.
    pub memory: Option<u64>,
    /// The operating system.
    pub system: String,
    /// The kernels that search, where a case does not say otherwise.
    pub kernel: String,
    /// The size of the pictures.
    pub size: [u32; 2],
    /// The system's load before the study began, where it tells.
    pub load_before: Option<f64>,
    /// The share of the machine that others used meanwhile, 0..1, where it tells.
    pub others_share: Option<f64>,
    /// What the study took, seconds, over all its sittings.
    pub seconds: f64,
}

/// A case, and what needs no clock.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Measured {
    /// See [`super::Case::name`].
    pub name: String,
    /// See [`super::Case::group`].
    pub group: String,
    /// Of the scene.
    pub scene: String,
    /// Of the scene: triangles, spheres and planes.
    pub primitives: u64,
    /// What was chosen.
    pub settings: Settings,
    /// `None` as long as the case was not warmed up.
    pub facts: Option<Facts>,
    /// Why it was not measured.
    pub left_out: Option<String>,
}

/// What needs no clock.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Facts {
    /// Of all trees.
    pub nodes: u64,
    /// Of all trees.
    pub leaves: u64,
    /// Nodes on the longest way down.
    pub depth: u64,
    /// Leaves that hold 1, 2, 3 ... primitives.
    pub leaf_sizes: Vec<u64>,
    /// Of nodes and primitives as they lie in memory.
    pub bytes: u64,
    /// See [`crate::accel::Statistics::sah_cost`].
    pub sah_cost: f64,
    /// By kind of ray, on the same rays for every setting.
    pub tests: Vec<Tests>,
    /// The root mean square of the difference to the reference of the samples study, a display channel being 0..1.
    pub error: Option<f64>,
    /// Whether the picture has the reference's bits.
    pub same_picture: bool,
}

/// What a ray tests, on average.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Tests {
    /// Of rays.
    pub kind: Kind,
    /// How many rays were counted.
    pub rays: u64,
    /// Nodes a ray.
    pub nodes: f64,
    /// Primitives a ray.
    pub primitives: f64,
}

/// One timed run: a row of `results.csv`.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Run {
    /// The case's name.
    pub case: String,
    /// From 1; the warm-up is not here.
    pub round: u32,
    /// What was timed.
    #[serde(flatten)]
    pub measure: Measure,
    /// What it took.
    pub seconds: f64,
    /// How many rays were traced; 0 of a build.
    pub rays: u64,
    /// Of a frame, whether its picture has the reference's bits; true of everything else.
    pub same_picture: bool,
}

impl Results {
    /// Nothing yet.
    pub fn new(study: &str, circumstances: Circumstances) -> Results {
        Results {
            format: FORMAT.into(),
            study: study.into(),
            partial: true,
            circumstances,
            cases: Vec::new(),
            runs: Vec::new(),
            warnings: Vec::new(),
        }
    }

    /// The seconds of every run of a case, in order; none where a run gave another picture.
    pub fn seconds(&self, case: &str, measure: Measure) -> Vec<f64> {
        if !self.gave_the_same_picture(case) {
            return Vec::new();
        }
        let of_case = self.runs.iter().filter(|run| run.case == case);
        of_case
            .filter(|run| run.measure == measure)
            .map(|run| run.seconds)
            .collect()
    }

    /// Whether every picture of a case has the reference's bits.
    pub fn gave_the_same_picture(&self, case: &str) -> bool {
        let of_facts = self.case(case).and_then(|case| case.facts.as_ref());
        of_facts.is_none_or(|facts| facts.same_picture)
            && self
                .runs
                .iter()
                .all(|run| run.case != case || run.same_picture)
    }

    /// The case of this name.
    pub fn case(&self, name: &str) -> Option<&Measured> {
        self.cases.iter().find(|case| case.name == name)
    }

    /// `results.json`.
    pub fn to_json(&self) -> String {
        // Strings, numbers and lists only: nothing that could not be written.
        serde_json::to_string_pretty(self).unwrap_or_default() + "\n"
    }

    /// What [`Results::to_json`] wrote.
    ///
    /// # Errors
    ///
    /// Not that: the sentence says what is wrong, and where.
    pub fn from_json(text: &str) -> Result<Results, String> {
        let results: Results = serde_json::from_str(text).map_err(|error| error.to_string())?;
        match results.format.as_str() {
            FORMAT => Ok(results),
            other => Err(format!("its format is \"{other}\", expected \"{FORMAT}\"")),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::super::csv::tests::results;
    use super::*;

    #[test]
    fn json_round_trips() {
        let results = results();
        assert_eq!(Results::from_json(&results.to_json()), Ok(results));
    }

    #[test]
    fn another_format_and_other_text_are_refused() {
        let other = results().to_json().replace(FORMAT, "luch study 0");
        let error = Results::from_json(&other).expect_err("nonsense");
        assert_eq!(
            error,
            "its format is \"luch study 0\", expected \"luch study 1\""
        );
        assert!(Results::from_json("{}").is_err());
        assert!(Results::from_json("").is_err());
    }

    #[test]
    fn a_case_with_another_picture_has_no_times() {
        let mut results = results();
        let measure = results.runs[0].measure;
        assert_eq!(results.seconds("leaf size 4", measure), [0.25]);
        results.runs[1].same_picture = false;
        assert!(results.seconds("leaf size 4", measure).is_empty());
        assert!(results.remarks()[0].starts_with("FAILED: another picture"));
    }
}
