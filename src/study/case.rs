//! One thing that is measured, and what of it.

use super::sets::Kind;
use super::setting;
use crate::accel::Options;
use crate::scene::{Scene, SceneError};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// A scene, and everything that was chosen about search and picture.
#[derive(Clone)]
pub struct Case {
    /// Its own within a plan, and the same from run to run, as in "leaf size 4".
    pub name: String,
    /// The question it belongs to, as in "leaf size": a plot shows the cases of one.
    pub group: String,
    /// What is drawn.
    pub source: Source,
    /// How it is searched.
    pub options: Options,
    /// Samples a pixel, a square number.
    pub samples: u32,
}

/// Where a case's scene comes from.
#[derive(Clone)]
pub struct Source {
    /// As in tables.
    pub name: String,
    /// About how many primitives it has, for the plan.
    pub primitives: u64,
    /// Makes it; called when it is needed, and again where it was too large to keep.
    pub make: Arc<dyn Fn() -> Result<Arc<Scene>, SceneError> + Send + Sync>,
}

impl Source {
    /// A scene that is there already.
    pub fn of(name: &str, scene: Arc<Scene>) -> Source {
        Source {
            name: name.to_owned(),
            primitives: u64::from(scene.primitive_count()),
            make: Arc::new(move || Ok(scene.clone())),
        }
    }
}

/// What is timed.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(into = "String", try_from = "String")]
pub enum What {
    /// From the scene to the finished tree.
    Build,
    /// A whole picture: camera, search, shading, film.
    Frame,
    /// Search alone, of one kind of rays.
    Rays(Kind),
}

impl What {
    /// As in tables.
    pub fn name(self) -> &'static str {
        match self {
            What::Build => "build",
            What::Frame => "frame",
            What::Rays(kind) => kind.name(),
        }
    }
}

impl From<What> for String {
    fn from(what: What) -> String {
        what.name().into()
    }
}

impl TryFrom<String> for What {
    type Error = String;

    fn try_from(name: String) -> Result<What, String> {
        let all = Kind::ALL.map(What::Rays);
        let mut all = [What::Build, What::Frame].into_iter().chain(all);
        let found = all.find(|what| what.name() == name);
        found.ok_or_else(|| format!("nothing that is measured is called \"{name}\""))
    }
}

/// How many threads do it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub enum Threads {
    /// One.
    One,
    /// As many as the study may use.
    All,
}

impl Threads {
    /// As in tables.
    pub fn name(self) -> &'static str {
        match self {
            Threads::One => "one",
            Threads::All => "all",
        }
    }
}

/// What of every case of a plan is timed in each round.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Measure {
    /// What.
    pub what: What,
    /// On how many threads.
    pub threads: Threads,
}

/// The settings of a case, as files have them.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Settings {
    /// `own` or `obvhs`.
    pub builder: String,
    /// As in `--bvh`.
    pub preset: String,
    /// The most primitives of a leaf.
    pub leaf_size: u8,
    /// `wide`, `small`, `bvh2`, `cwbvh`, or `none` for no tree at all.
    pub layout: String,
    /// As in `LUCH_ISA`.
    pub kernel: String,
    /// Whether rays go together.
    pub packets: bool,
    /// A pixel.
    pub samples: u32,
}

impl Case {
    /// Its settings by name.
    pub fn settings(&self) -> Settings {
        let options = &self.options;
        Settings {
            builder: setting::builder(options.builder).into(),
            preset: setting::preset(options.preset).into(),
            leaf_size: setting::leaf_size_of(options),
            layout: setting::layout(options.layout).into(),
            kernel: options.isa.name().into(),
            packets: options.packets,
            samples: self.samples,
        }
    }
}
