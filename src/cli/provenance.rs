//! Where a picture comes from, for the files that say so: whose it is, what it was made of and how.

use super::Failure;
use clap::Args;
use luch::Error;
use luch::accel::Accel;
use luch::film::Film;
use luch::output::{Fact, Header};
use luch::render::Settings;
use luch::scene::Scene;
use luch::shade::Shading;
use luch::study::hash::hash_of;
use luch::study::machine::{COMMIT, VERSION};
use luch::texture::TextureFilter;
use std::env;
use std::path::{Path, PathBuf};
use std::time::SystemTime;

/// What can be said of a picture's origin.
#[derive(Args, Debug)]
pub(super) struct ProvenanceArguments {
    /// Whose the picture is, for the EXR's attribute of this name
    #[arg(long, value_name = "NAME")]
    owner: Option<String>,

    /// Let an EXR say when it was made: no two runs leave the same bytes then. SOURCE_DATE_EPOCH in the environment, seconds
    /// since 1970, is said in any case
    #[arg(long)]
    timestamp: bool,
}

/// The variable by which builds that can be repeated are told what time it is
/// (reproducible-builds.org, "SOURCE_DATE_EPOCH specification" 1.1).
const SOURCE_DATE_EPOCH: &str = "SOURCE_DATE_EPOCH";

impl ProvenanceArguments {
    /// The moment that files name, in seconds since 1970, if they are to name any.
    pub(super) fn captured(&self) -> Result<Option<u64>, Failure> {
        match env::var_os(SOURCE_DATE_EPOCH) {
            Some(text) => match text.to_str().and_then(|text| text.parse().ok()) {
                Some(seconds) => Ok(Some(seconds)),
                None => Err(Failure::usage_or_scene(format!(
                    "{SOURCE_DATE_EPOCH} is {text:?}, expected seconds since 1970 as a whole number; unset it"
                ))),
            },
            None if self.timestamp => {
                let now = SystemTime::now().duration_since(SystemTime::UNIX_EPOCH);
                Ok(now.ok().map(|now| now.as_secs()))
            }
            None => Ok(None),
        }
    }
}

/// A file that was read for a picture.
pub(super) struct Input {
    /// As it was given, or without its folder, which would tell of the machine.
    name: String,
    /// In hexadecimal digits.
    sha256: String,
}

/// The files that were read, `given` as they were on the command line.
pub(super) fn inputs(read: &[PathBuf], given: &[&Path]) -> Result<Vec<Input>, Failure> {
    let input = |path: &PathBuf| {
        let name = match path.file_name() {
            Some(name) if !given.contains(&path.as_path()) => name,
            _ => path.as_os_str(),
        };
        let hash = hash_of(std::slice::from_ref(path)).map_err(Error::io(path, "read again"));
        Ok(Input {
            name: name.to_string_lossy().into_owned(),
            sha256: hash.map_err(Failure::usage_or_scene)?,
        })
    };
    read.iter().map(input).collect()
}

/// Everything that a picture is made of.
pub(super) struct Made<'a> {
    pub(super) arguments: &'a ProvenanceArguments,
    pub(super) captured: Option<u64>,
    pub(super) inputs: &'a [Input],
    pub(super) scene: &'a Scene,
    pub(super) accel: &'a Accel,
    pub(super) settings: &'a Settings,
    pub(super) film: &'a Film,
}

/// What a file says of it: nothing that a machine, its number of cores or its clock decides, unless that is asked for.
pub(super) fn header(made: &Made) -> Header {
    let mut facts = vec![
        ("version".into(), Fact::Text(VERSION.into())),
        ("commit".into(), Fact::Text(COMMIT.into())),
    ];
    for (number, input) in made.inputs.iter().enumerate() {
        let mut add = |what: &str, text: &str| {
            facts.push((format!("input/{number}/{what}"), Fact::Text(text.into())));
        };
        add("file", &input.name);
        add("sha256", &input.sha256);
    }
    let words = words_of(made.settings);
    facts.extend(words.map(|(name, word)| (name.into(), Fact::Text(word.into()))));
    let numbers = numbers_of(made);
    facts.extend(numbers.map(|(name, number)| (name.into(), Fact::Number(number))));
    Header {
        owner: made.arguments.owner.clone().unwrap_or_default(),
        captured: made.captured,
        camera: Some(*made.scene.camera()),
        frame: None,
        facts,
    }
}

fn words_of(settings: &Settings) -> [(&'static str, &'static str); 5] {
    let sampling = settings.sampling();
    let shading = match settings.shading() {
        Shading::Flat => "flat",
        Shading::Lambert => "lambert",
        Shading::Phong => "phong",
        Shading::BlinnPhong => "blinn-phong",
    };
    let texture_filter = match settings.texture_filter() {
        TextureFilter::Footprint => "footprint",
        TextureFilter::Point => "point",
    };
    [
        ("settings/pattern", sampling.pattern.name()),
        ("settings/filter", sampling.filter.name()),
        (
            "settings/sampling",
            if settings.is_adaptive() {
                "adaptive"
            } else {
                "even"
            },
        ),
        ("settings/shading", shading),
        ("settings/textureFilter", texture_filter),
    ]
}

fn numbers_of(made: &Made) -> [(&'static str, f64); 13] {
    let tree = made.accel.statistics();
    let rays = &made.film.statistics;
    [
        ("settings/samples", f64::from(made.settings.samples())),
        ("settings/maxDepth", f64::from(made.settings.max_depth())),
        ("bvh/nodes", tree.nodes as f64),
        ("bvh/leaves", tree.leaves as f64),
        ("bvh/depth", tree.depth as f64),
        ("bvh/bytes", tree.bytes as f64),
        ("bvh/sahCost", f64::from(tree.sah_cost)),
        ("samples", rays.samples() as f64),
        ("rays/transparent", rays.transparent_rays as f64),
        ("rays/shadow", rays.shadow_rays as f64),
        ("rays/mirror", rays.mirror_rays as f64),
        ("rays/refracted", rays.refracted_rays as f64),
        ("rays/all", rays.rays() as f64),
    ]
}
