//! The command line.

use super::engines::Engine;
use super::scenes;
use clap::Parser;
use clap::error::ErrorKind;
use luch::study::sets::Kind;
use std::process::exit;

/// Rays a second of luch and, where LUCH_EMBREE names a library of Embree 4, of Embree, on the same rays.
#[derive(Clone, Debug, Parser)]
#[command(
    name = "cargo bench --bench rays --",
    override_usage = "cargo bench --bench rays -- [OPTIONS] [SCENES]..."
)]
pub(crate) struct Arguments {
    /// Generated scenes by name, or model files; all generated ones, and the real interior where it is, if none
    #[arg(value_name = "SCENES")]
    names: Vec<String>,
    /// The same, with commas between them
    #[arg(long, value_delimiter = ',', value_name = "NAMES")]
    scenes: Vec<String>,
    /// Timed rounds, after one to warm up; the median counts
    #[arg(long, default_value_t = 5, value_name = "N")]
    pub(crate) rounds: usize,
    /// A ninth of the rays (640 x 360)
    #[arg(long)]
    pub(crate) quick: bool,
    /// Only the table of rays, on one thread
    #[arg(long)]
    pub(crate) only_rays: bool,
    /// Write benches/record/NAME.csv and .txt, too
    #[arg(long, value_name = "NAME")]
    pub(crate) record: Option<String>,
    /// Only trace rays of this kind in the first scene, to count instructions: primary, shadow, mirror, incoherent
    #[arg(long, value_name = "KIND", value_parser = kind)]
    pub(crate) kernel_only: Option<Kind>,
    /// How many rays --kernel-only traces a round, about
    #[arg(long, default_value_t = 20_000, value_name = "N")]
    pub(crate) rays: u32,
    /// Whose kernel --kernel-only runs: luch, embree, embree-robust, embree16, linear
    #[arg(long, default_value = "luch", value_name = "ENGINE", value_parser = engine)]
    pub(crate) engine: Engine,
    /// Given by cargo
    #[arg(long, hide = true)]
    bench: bool,
}

impl Arguments {
    /// This run's arguments. Ends the program, in peace, where they are meant for the other benchmarks: `cargo bench --
    /// frame/` gives them to every program.
    pub(crate) fn of_this_run() -> Arguments {
        let arguments = Arguments::try_parse().unwrap_or_else(|error| match error.kind() {
            ErrorKind::UnknownArgument => {
                let message = error.to_string();
                not_for_us(message.lines().next().unwrap_or_default())
            }
            _ => error.exit(),
        });
        let unknown = arguments
            .asked()
            .find(|name| !scenes::exists(name))
            .cloned();
        match unknown {
            Some(name) if arguments.scenes.contains(&name) => {
                let known = scenes::GENERATED.join(", ");
                eprintln!("error: no scene or file \"{name}\"; the scenes are {known}");
                exit(2);
            }
            Some(name) => not_for_us(&format!("no scene or file \"{name}\"")),
            None => arguments,
        }
    }

    fn asked(&self) -> impl Iterator<Item = &String> {
        self.scenes.iter().chain(&self.names)
    }

    /// The names of the scenes to be measured.
    pub(crate) fn scenes(&self) -> Vec<String> {
        if self.asked().next().is_some() {
            return self.asked().cloned().collect();
        }
        let mut names: Vec<String> = scenes::GENERATED.map(String::from).into();
        let real = scenes::real_interior().map(|file| file.display().to_string());
        // Beside the one it is held against.
        names.splice(1..1, real);
        names
    }

    /// The size of the picture whose pixels the rays go through.
    pub(crate) fn size(&self) -> [u32; 2] {
        if self.quick { [640, 360] } else { [1920, 1080] }
    }
}

fn kind(name: &str) -> Result<Kind, String> {
    let found = Kind::ALL.into_iter().find(|kind| kind.name() == name);
    found.ok_or_else(|| "the kinds are primary, shadow, mirror, incoherent".into())
}

fn engine(name: &str) -> Result<Engine, String> {
    let found = Engine::ALL.into_iter().find(|engine| engine.name() == name);
    found.ok_or_else(|| "the engines are luch, embree, embree-robust, embree16, linear".into())
}

fn not_for_us(reason: &str) -> ! {
    eprintln!("rays: nothing measured: {reason} (--help tells what there is)");
    exit(0);
}
