//! What can be said on the command line.

mod choices;

use super::animation::AnimationArguments;
use super::environment::EnvironmentArguments;
use super::frames::SequenceArguments;
use super::layers;
use super::provenance::ProvenanceArguments;
use super::reading::Reading;
use super::sampling::SamplingArguments;
use super::study::StudyArguments;
use super::values::{self, BackgroundValue, Size, whole_number};
use super::windows::WindowArguments;
pub(super) use choices::{
    BitDepthValue, BuilderValue, DirectionValue, FormatValue, GroundValue, LightsValue,
    PresetValue, ProgressValue, ShadingValue, TextureFilterValue,
};
use clap::builder::NonEmptyStringValueParser;
use clap::{Args, Parser, Subcommand};
use glam::Vec3;
use luch::film::Layers;
use luch::output::Display;
use std::num::NonZeroU8;
use std::path::{Path, PathBuf};

const EXAMPLES: &str = "\
Examples:
  luch render                            the paper's figure 4, into figure-4.png
  luch render model.glb                  a framed, lit picture, into model.png
  luch render model.glb -o a.png -o a.exr --size 1920x1080 --samples 16
  luch render scene.toml -o - | viewer   a PNG to another program
  luch info model.glb                    what is in a file, and what luch makes of it
  luch study bvh model.glb --quick       which search tree is the best for a model, into luch-study-bvh/report.html";

/// A ray tracer: a glTF, OBJ or scene file in, a PNG or EXR out.
#[derive(Debug, Parser)]
#[command(name = "luch", version, after_help = EXAMPLES, arg_required_else_help = true)]
pub(super) struct Arguments {
    #[command(subcommand)]
    pub(super) command: Command,
}

#[derive(Debug, Subcommand)]
pub(super) enum Command {
    /// Render a model or a scene file to a picture
    Render(Box<RenderArguments>),
    /// Tell what is in a file, and what luch makes of it
    Info(InfoArguments),
    /// Measure how the search tree affects render time, and write a report
    Study(StudyArguments),
    /// Print completions for a shell
    #[command(
        after_help = "Example:\n  luch completions bash > ~/.local/share/bash-completion/completions/luch"
    )]
    Completions {
        /// Which shell
        shell: clap_complete::Shell,
    },
}

impl Command {
    /// Whether an error is to be told to Open Job Description.
    pub(super) fn is_for_openjd(&self) -> bool {
        matches!(self, Command::Render(arguments) if arguments.progress == ProgressValue::Openjd)
    }

    /// Whether the causes of an error are wanted.
    pub(super) fn is_verbose(&self) -> bool {
        match self {
            Command::Render(arguments) => arguments.verbose,
            Command::Info(arguments) => arguments.verbose,
            Command::Study(arguments) => arguments.is_verbose(),
            Command::Completions { .. } => false,
        }
    }
}

const RENDER_EXAMPLES: &str = "\
Examples:
  luch render assets/scenes/figure-4.toml
  luch render helmet.glb --size 1920x1080 --samples 64 -o helmet.png -o helmet.exr
  luch render room.gltf --camera \"Front door\" --exposure -1
  luch render chair.obj --view left --orbit 20,15 --zoom 1.5
  luch render chair.obj --eye 2,1,3 --target 0,0.5,0 --fov 30 --background transparent
  luch render helmet.glb -o - | viewer
  luch render robot.glb --frames 1-48 --fps 24 -o shot.####.exr -o shot.####.png
  luch render helmet.glb --turntable 72 -o turn.####.png
  luch render helmet.glb -o helmet.png --json > helmet.json

Limits: 4 GiB a file; 268435456 pixels an image; 2147483647 triangles and other primitives, each as
often as it is placed; 4 GiB a picture in memory; of everything else, such as vertices and nodes,
what --max-memory holds.

Environment: LUCH_ISA=scalar|avx2|avx512 chooses the kernels that search [default: the widest that
the machine has]; all of them give the same picture.

Exit codes: 0 done, 1 usage or scene, 2 output, 3 render, 130 interrupted, 143 terminated.";

/// Everything `luch render` can be told.
#[derive(Args, Debug)]
#[command(after_help = RENDER_EXAMPLES)]
pub(super) struct RenderArguments {
    /// A .glb, .gltf, .obj or .toml file; the paper's figure 4 where there is none
    pub(super) input: Option<PathBuf>,

    /// Where the picture goes: a .png or .exr file, or - for standard output; may be repeated; a sequence's name has #### or %04d
    /// where the number of the frame goes [default: the input's name, .png, in the current folder]
    #[arg(short, long = "output", value_name = "FILE")]
    pub(super) outputs: Vec<PathBuf>,

    /// What -o - writes
    #[arg(long, value_enum, default_value = "png")]
    pub(super) format: FormatValue,

    /// The picture's size in pixels [default: the scene file's, or 640x480; 1280x720 for models]
    #[arg(long, value_name = "WxH", allow_hyphen_values = true, conflicts_with_all = ["width", "height"])]
    pub(super) size: Option<Size>,

    /// The picture's width in pixels
    #[arg(long, value_name = "PIXELS", allow_negative_numbers = true, value_parser = whole_number(0..=u32::MAX))]
    pub(super) width: Option<u32>,

    /// The picture's height in pixels
    #[arg(long, value_name = "PIXELS", allow_negative_numbers = true, value_parser = whole_number(0..=u32::MAX))]
    pub(super) height: Option<u32>,

    #[command(flatten)]
    pub(super) window: WindowArguments,

    /// Samples a pixel, at most 65536; a square number for the pattern grid; the most, where sampling is adaptive
    /// [default: the scene file's, or 1; 16 for models]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = whole_number(0..=u32::MAX))]
    pub(super) samples: Option<u32>,

    #[command(flatten)]
    pub(super) sampling: SamplingArguments,

    /// The most mirror bounces [default: the scene file's, or 5]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = whole_number(0..=u32::MAX))]
    pub(super) max_depth: Option<u32>,

    /// How surfaces answer light [default: the scene file's, or blinn-phong]
    #[arg(long, value_enum, value_name = "MODEL")]
    pub(super) shading: Option<ShadingValue>,

    /// Which part of a texture or a checkerboard a ray shows: the mean of all that it sees, or the point that it meets
    /// [default: the scene file's, or point; footprint for models]
    #[arg(long, value_enum, value_name = "FILTER")]
    pub(super) texture_filter: Option<TextureFilterValue>,

    /// List the model's cameras, and render nothing
    #[arg(long)]
    pub(super) list_cameras: bool,

    /// A camera of the model, by name or by index from 0
    #[arg(long, value_name = "NAME|INDEX", conflicts_with_all = ["eye", "target"], value_parser = NonEmptyStringValueParser::new())]
    pub(super) camera: Option<String>,

    /// Where to look from
    #[arg(long, value_name = "X,Y,Z", requires = "target", allow_hyphen_values = true, value_parser = values::vector)]
    pub(super) eye: Option<Vec3>,

    /// What to look at
    #[arg(long, value_name = "X,Y,Z", requires = "eye", allow_hyphen_values = true, value_parser = values::vector)]
    pub(super) target: Option<Vec3>,

    /// Frame the model from this side, whatever cameras the file has: its front is toward +Z, its top toward +Y
    #[arg(long, value_enum, value_name = "SIDE", conflicts_with_all = ["camera", "eye", "target"])]
    pub(super) view: Option<DirectionValue>,

    /// Frame the model, and go around it by so many degrees to the right and up; in a room, turn
    #[arg(long, value_name = "YAW,PITCH", allow_hyphen_values = true, conflicts_with_all = ["camera", "eye", "target"], value_parser = values::angles)]
    pub(super) orbit: Option<[f64; 2]>,

    /// Frame the model, so many times as large: the field of view changes, as with a lens
    #[arg(long, value_name = "X", allow_hyphen_values = true, conflicts_with_all = ["camera", "eye", "target"], value_parser = values::zoom)]
    pub(super) zoom: Option<f64>,

    /// The vertical field of view [default: the camera's; 40 with --eye; of a framed model 35, more in a room]
    #[arg(long, value_name = "DEGREES", allow_hyphen_values = true, value_parser = values::field_of_view)]
    pub(super) fov: Option<f64>,

    #[command(flatten)]
    pub(super) animation: AnimationArguments,

    #[command(flatten)]
    pub(super) sequence: SequenceArguments,

    /// How progress is told: auto is a bar on a terminal and lines on a pipe; openjd what Open Job Description reads on standard
    /// output
    #[arg(
        long,
        value_enum,
        value_name = "FORM",
        default_value = "auto",
        conflicts_with = "json"
    )]
    pub(super) progress: ProgressValue,

    /// Threads to use [default: all cores]
    #[arg(short, long, value_name = "N", allow_negative_numbers = true, value_parser = whole_number(1..=1024))]
    pub(super) threads: Option<u32>,

    /// How light becomes a PNG's colours [default: srgb for scene files, pbr-neutral for models]
    #[arg(long, value_name = "TRANSFORM", value_parser = values::display())]
    pub(super) display: Option<Display>,

    /// Stops of exposure, PNG only: each doubles the light [default: 0, or what a model's own lights need]
    #[arg(long, value_name = "EV", allow_hyphen_values = true, value_parser = values::stops)]
    pub(super) exposure: Option<f32>,

    /// What an EXR holds, with commas between: beauty; Z, the depth, or data, all such layers; components, its light by
    /// what surfaces did to it; lights, by where it came from; bounces, what mirrors show by how many there were; cost, the
    /// nodes and primitives that the rays of each pixel were tested against; samples, how many it got; or all. Of the last
    /// two a PNG gets heat maps beside it [default: beauty,data]
    #[arg(long, value_name = "NAMES", value_parser = layers::parse)]
    pub(super) layers: Option<Layers>,

    /// Bits a channel of a PNG
    #[arg(long, value_enum, value_name = "BITS", default_value = "8")]
    pub(super) bit_depth: BitDepthValue,

    /// Whose lights shine on a model: the file's, those of luch (the environment), or both in full [default: the file's,
    /// if it has any, and a quarter of the environment]
    #[arg(long, value_enum, value_name = "WHOSE")]
    pub(super) lights: Option<LightsValue>,

    /// A floor under the model that shows its shadow; in an EXR and in a transparent PNG the shadow is in alpha. auto: where a
    /// model is seen from outside and from above
    #[arg(long, value_enum, value_name = "WHEN", default_value = "auto")]
    pub(super) ground: GroundValue,

    /// The share of light that this floor mirrors, 0 to 1
    #[arg(long, value_name = "SHARE", allow_hyphen_values = true, default_value = "0", value_parser = values::share)]
    pub(super) ground_reflection: f32,

    /// What lies behind everything: a display colour, transparent, or the environment [default: the scene file's; a light
    /// grey in a model's PNG, transparent in its EXR]
    #[arg(long, value_name = "#RRGGBB|transparent|environment")]
    pub(super) background: Option<BackgroundValue>,

    #[command(flatten)]
    pub(super) environment: EnvironmentArguments,

    /// How much time the search tree's build takes for how good a tree
    #[arg(long, value_enum, value_name = "PRESET", default_value = "medium")]
    pub(super) bvh: PresetValue,

    /// Who builds the search tree: luch, or obvhs to compare
    #[arg(long, value_enum, value_name = "BUILDER", default_value = "own")]
    pub(super) bvh_builder: BuilderValue,

    /// Lay the search tree out in less memory, for a little time
    #[arg(long)]
    pub(super) small_memory: bool,

    /// The most primitives a leaf of the search tree may have, 1 to 16 [default: 8]
    #[arg(long, value_name = "N", allow_negative_numbers = true, value_parser = values::leaf_size)]
    pub(super) leaf_size: Option<NonZeroU8>,

    /// Say more: the causes of an error, each file that was read
    #[arg(short, long, conflicts_with = "quiet")]
    pub(super) verbose: bool,

    /// Say nothing but errors
    #[arg(short, long)]
    pub(super) quiet: bool,

    /// Print the summary as JSON
    #[arg(long)]
    pub(super) json: bool,

    #[command(flatten)]
    pub(super) provenance: ProvenanceArguments,

    #[command(flatten)]
    pub(super) reading: Reading,
}

impl RenderArguments {
    /// Whether standard output is the picture's: what is said then goes to standard error.
    pub(super) fn picture_to_stdout(&self) -> bool {
        self.outputs.iter().any(|path| is_stdout(path))
    }
}

/// Whether a path stands for standard output.
pub(super) fn is_stdout(path: &Path) -> bool {
    path == Path::new("-")
}

/// Everything `luch info` can be told.
#[derive(Args, Debug)]
#[command(
    after_help = "Examples:\n  luch info helmet.glb\n  luch info helmet.glb --json\n  luch info shop.glb --scene Cellar"
)]
pub(super) struct InfoArguments {
    /// A .glb, .gltf, .obj or .toml file
    pub(super) input: PathBuf,

    #[command(flatten)]
    pub(super) animation: AnimationArguments,

    /// Print it as JSON
    #[arg(long)]
    pub(super) json: bool,

    /// Say the causes of an error
    #[arg(short, long)]
    pub(super) verbose: bool,

    #[command(flatten)]
    pub(super) reading: Reading,
}
