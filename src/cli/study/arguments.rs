//! What `luch study` can be told.

use super::super::reading::Reading;
use super::super::values::{Size, whole_number};
use clap::{Args, Subcommand};
use luch::accel::{Isa, Layout, Preset};
use luch::study::scaling::COUNTS;
use luch::study::scenes::{FEWEST, MOST, Shape};
use luch::study::setting;
use std::num::NonZeroU8;
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  luch study bvh helmet.glb --quick                what to use for this model, within a minute
  luch study bvh terrain:1000000 -o terrain        a generated scene of a million triangles
  luch study scaling --counts 10,1000,100000       how weakly time depends on complexity
  luch study samples                               the paper's table, on the paper's scene
  luch study rays helmet.glb                       rays a second by kind
  luch study bvh helmet.glb --budget 30 --resume   goes on where an interrupted study stopped

Each writes a folder: report.html (open it), results.csv and results.json (every raw sample), the plots as SVG and PNG.
Generated scenes: sphereflake, terrain, grid, hair, random-triangles and random-spheres, as in terrain:1000000.

Exit codes: 0 done, 1 usage or scene, 2 output, 3 a setting changed the picture, 130 interrupted, 143
terminated.";

/// Everything `luch study` can be told.
#[derive(Args, Debug)]
#[command(after_help = EXAMPLES)]
pub(in super::super) struct StudyArguments {
    #[command(subcommand)]
    pub(super) command: StudyCommand,
}

#[derive(Debug, Subcommand)]
pub(super) enum StudyCommand {
    /// Every setting of the search tree on one model: size, build and render time, and what to use
    Bvh(BvhArguments),
    /// Ever more primitives: how time, memory and nodes a ray grow, with a tree and without
    Scaling(ScalingArguments),
    /// The paper's table: what samples a pixel cost and bring
    Samples(SamplesArguments),
    /// Rays a second by kind, with and without shading
    Rays(RaysArguments),
}

/// What every study can be told.
#[derive(Args, Debug)]
pub(super) struct Common {
    /// The folder of the report [default: luch-study- and the study's name]
    #[arg(short, long, value_name = "FOLDER")]
    output: Option<PathBuf>,

    /// Ends within a minute; the default within ten
    #[arg(long, conflicts_with = "budget")]
    pub(super) quick: bool,

    /// Fits the plan to so many minutes
    #[arg(long, value_name = "MINUTES", allow_negative_numbers = true, value_parser = minutes)]
    pub(super) budget: Option<f64>,

    /// Goes on with the study in the folder
    #[arg(long)]
    pub(super) resume: bool,

    /// The size of the pictures [default: 640x360, 320x180 when it is quick; 640x480 for samples]
    #[arg(long, value_name = "WxH", allow_hyphen_values = true)]
    pub(super) size: Option<Size>,

    /// Threads where all are asked for [default: all cores]
    #[arg(short, long, value_name = "N", allow_negative_numbers = true, value_parser = whole_number(1..=1024))]
    pub(super) threads: Option<u32>,

    /// Say the causes of an error
    #[arg(short, long, conflicts_with = "quiet")]
    pub(super) verbose: bool,

    /// Say nothing but errors
    #[arg(short, long)]
    pub(super) quiet: bool,

    #[command(flatten)]
    pub(super) reading: Reading,
}

#[derive(Args, Debug)]
pub(super) struct BvhArguments {
    /// A .glb, .gltf, .obj or .toml file, or a generated scene such as terrain:1000000
    pub(super) model: PathBuf,

    /// A camera of the model, by name or by index from 0
    #[arg(long, value_name = "NAME|INDEX")]
    pub(super) camera: Option<String>,

    /// Only these presets [default: all]
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = preset)]
    pub(super) presets: Option<Vec<Preset>>,

    /// Only these leaf sizes [default: 1 to 16]
    #[arg(long, value_name = "SIZES", value_delimiter = ',', allow_negative_numbers = true, value_parser = setting::leaf_size)]
    pub(super) leaf_sizes: Option<Vec<NonZeroU8>>,

    /// Only these layouts: wide, small, bvh2, cwbvh, none [default: all]
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = layout)]
    pub(super) layouts: Option<Vec<Layout>>,

    /// Only these kernels: scalar, avx2, avx512 [default: those of the machine]
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = setting::kernel)]
    pub(super) kernels: Option<Vec<Isa>>,

    #[command(flatten)]
    pub(super) common: Common,
}

#[derive(Args, Debug)]
pub(super) struct ScalingArguments {
    /// A model to be thinned and subdivided, instead of generated shapes
    pub(super) model: Option<PathBuf>,

    /// A camera of the model, by name or by index from 0
    #[arg(long, value_name = "NAME|INDEX", requires = "model")]
    pub(super) camera: Option<String>,

    /// Only these shapes: sphereflake, terrain, grid, hair, random-triangles, random-spheres [default: all]
    #[arg(long, value_name = "NAMES", value_delimiter = ',', conflicts_with = "model",
        value_parser = shape)]
    pub(super) shapes: Option<Vec<Shape>>,

    /// How many primitives [default: 10 to 10,000,000 by powers of ten, as far as time goes]
    #[arg(long, value_name = "NUMBERS", value_delimiter = ',', allow_negative_numbers = true,
        default_values_t = COUNTS, hide_default_value = true, value_parser = whole_number(FEWEST..=MOST))]
    pub(super) counts: Vec<u32>,

    #[command(flatten)]
    pub(super) common: Common,
}

#[derive(Args, Debug)]
pub(super) struct SamplesArguments {
    /// A scene or a model; the paper's figure 4 where there is none
    #[arg(value_name = "SCENE")]
    pub(super) input: Option<PathBuf>,

    /// A camera of the model, by name or by index from 0
    #[arg(long, value_name = "NAME|INDEX")]
    pub(super) camera: Option<String>,

    /// How many samples a pixel, square numbers
    #[arg(long, value_name = "NUMBERS", value_delimiter = ',', allow_negative_numbers = true,
        default_values_t = [1, 4, 16, 25], value_parser = whole_number(1..=65_536))]
    pub(super) samples: Vec<u32>,

    #[command(flatten)]
    pub(super) common: Common,
}

#[derive(Args, Debug)]
pub(super) struct RaysArguments {
    /// A .glb, .gltf, .obj or .toml file, or a generated scene such as terrain:1000000
    pub(super) model: PathBuf,

    /// A camera of the model, by name or by index from 0
    #[arg(long, value_name = "NAME|INDEX")]
    pub(super) camera: Option<String>,

    /// Only these kernels: scalar, avx2, avx512 [default: those of the machine]
    #[arg(long, value_name = "NAMES", value_delimiter = ',', value_parser = setting::kernel)]
    pub(super) kernels: Option<Vec<Isa>>,

    #[command(flatten)]
    pub(super) common: Common,
}

fn minutes(text: &str) -> Result<f64, String> {
    let minutes = text
        .parse()
        .map_err(|_| "expected a number of minutes, as in 2.5");
    minutes.map_err(String::from)
}

fn preset(name: &str) -> Result<Preset, String> {
    setting::named("preset", name, &setting::PRESETS, setting::preset)
}

fn layout(name: &str) -> Result<Layout, String> {
    setting::named("layout", name, &setting::LAYOUTS, setting::layout)
}

fn shape(name: &str) -> Result<Shape, String> {
    setting::named("shape", name, &Shape::ALL, Shape::name)
}

impl StudyCommand {
    pub(super) fn common(&self) -> &Common {
        match self {
            StudyCommand::Bvh(arguments) => &arguments.common,
            StudyCommand::Scaling(arguments) => &arguments.common,
            StudyCommand::Samples(arguments) => &arguments.common,
            StudyCommand::Rays(arguments) => &arguments.common,
        }
    }

    pub(super) fn name(&self) -> &'static str {
        match self {
            StudyCommand::Bvh(_) => "bvh",
            StudyCommand::Scaling(_) => "scaling",
            StudyCommand::Samples(_) => "samples",
            StudyCommand::Rays(_) => "rays",
        }
    }
}

impl StudyArguments {
    /// Whether the causes of an error are wanted.
    pub(in super::super) fn is_verbose(&self) -> bool {
        self.command.common().verbose
    }
}

impl Common {
    /// The folder of the study of this name.
    pub(super) fn output(&self, study: &str) -> PathBuf {
        let default = || PathBuf::from(format!("luch-study-{study}"));
        self.output.clone().unwrap_or_else(default)
    }
}
