//! Which samples a picture gets: the arguments, where they are silent the file, where that is the defaults.

use super::values;
use clap::Args;
use luch::load::Asset;
use luch::sampling::{Filter, Pattern, Sampling};

/// What can be said of samples beside their number.
#[derive(Args, Clone, Copy, Debug)]
pub(super) struct SamplingArguments {
    /// How the samples of a pixel lie: in the paper's regular grid, or spread for any number of them [default: the scene
    /// file's, or grid; spread for models]
    #[arg(long, value_name = "PATTERN", value_parser = values::named("a pattern", Pattern::ALL, Pattern::name))]
    pattern: Option<Pattern>,

    /// How samples become a pixel: of its square alone, or of a wider place about its centre [default: the scene file's,
    /// or box; blackman-harris for models]
    #[arg(long, value_name = "FILTER", value_parser = values::named("a filter", Filter::ALL, Filter::name))]
    filter: Option<Filter>,

    /// Take more than 4 samples only where these, or those of pixels around, differ in colour, object or side [default:
    /// the scene file's word; on for models]
    #[arg(long)]
    adaptive: bool,

    /// Take all samples everywhere
    #[arg(long, conflicts_with = "adaptive")]
    no_adaptive: bool,
}

/// What a model's pixels get at most.
const SAMPLES_OF_MODELS: u32 = 16;

impl SamplingArguments {
    /// The sampling of a picture, where `samples` were asked for.
    pub(super) fn of(&self, samples: Option<u32>, asset: &Asset) -> Sampling {
        let picture = &asset.picture;
        let default = if asset.is_scene_file {
            Sampling::grid(1)
        } else {
            Sampling {
                samples: SAMPLES_OF_MODELS,
                pattern: Pattern::Spread,
                filter: Filter::BlackmanHarris,
                adaptive: true,
            }
        };
        let asked = match (self.adaptive, self.no_adaptive) {
            (true, _) => Some(true),
            (_, true) => Some(false),
            _ => picture.adaptive,
        };
        Sampling {
            samples: samples.or(picture.samples).unwrap_or(default.samples),
            pattern: self.pattern.or(picture.pattern).unwrap_or(default.pattern),
            filter: self.filter.or(picture.filter).unwrap_or(default.filter),
            adaptive: asked.unwrap_or(default.adaptive),
        }
    }

    /// Whether anything was said.
    pub(super) fn is_said(&self) -> bool {
        self.pattern.is_some() || self.filter.is_some() || self.adaptive || self.no_adaptive
    }
}
