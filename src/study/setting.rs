//! The names of what can be chosen about search, as tables and files have them.

use crate::accel::{Builder, Isa, Layout, Options, Preset};
use std::num::NonZeroU8;

/// Every preset, the quickest build first.
pub const PRESETS: [Preset; 6] = [
    Preset::Fastest,
    Preset::VeryFast,
    Preset::Fast,
    Preset::Medium,
    Preset::Slow,
    Preset::VerySlow,
];

/// Every layout, luch's own first.
pub const LAYOUTS: [Layout; 5] = [
    Layout::Wide,
    Layout::Small,
    Layout::Bvh2,
    Layout::CwBvh,
    Layout::List,
];

/// The leaf size where none is asked for.
pub const DEFAULT_LEAF_SIZE: u8 = 8;
/// The greatest leaf size there is.
pub const MOST_LEAF_SIZE: u8 = 16;

/// One word.
pub fn preset(preset: Preset) -> &'static str {
    match preset {
        Preset::Fastest => "fastest",
        Preset::VeryFast => "very-fast",
        Preset::Fast => "fast",
        Preset::Medium => "medium",
        Preset::Slow => "slow",
        Preset::VerySlow => "very-slow",
    }
}

/// One word.
pub fn builder(builder: Builder) -> &'static str {
    match builder {
        Builder::Own => "own",
        Builder::Obvhs => "obvhs",
    }
}

/// One word.
pub fn layout(layout: Layout) -> &'static str {
    match layout {
        Layout::Wide => "wide",
        Layout::Small => "small",
        Layout::Bvh2 => "bvh2",
        Layout::CwBvh => "cwbvh",
        Layout::List => "none",
    }
}

/// What `known` calls `name`.
///
/// # Errors
///
/// None of them: the sentence says which there are.
pub fn named<T: Copy>(
    what: &str,
    name: &str,
    known: &[T],
    name_of: impl Fn(T) -> &'static str,
) -> Result<T, String> {
    let found = known.iter().copied().find(|&one| name_of(one) == name);
    found.ok_or_else(|| {
        let names: Vec<&str> = known.iter().map(|&one| name_of(one)).collect();
        format!(
            "no {what} is called \"{name}\"; there are {}",
            names.join(", ")
        )
    })
}

/// A leaf size from 1 to [`MOST_LEAF_SIZE`].
///
/// # Errors
///
/// Anything else.
pub fn leaf_size(text: &str) -> Result<NonZeroU8, String> {
    let size: Option<NonZeroU8> = text.parse().ok();
    size.filter(|size| size.get() <= MOST_LEAF_SIZE).ok_or_else(|| {
        format!("a leaf of {text} primitives cannot be; expected a whole number from 1 to {MOST_LEAF_SIZE}")
    })
}

/// The leaf size that the options come to.
pub fn leaf_size_of(options: &Options) -> u8 {
    options.leaf_size.map_or(DEFAULT_LEAF_SIZE, NonZeroU8::get)
}

/// As in `LUCH_ISA`.
///
/// # Errors
///
/// No such kernels, or none on this machine.
pub fn kernel(name: &str) -> Result<Isa, String> {
    let known = Isa::available();
    named("kernel of this machine", name, &known, Isa::name)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_name_leads_back_to_what_it_names() {
        for one in PRESETS {
            assert_eq!(named("preset", preset(one), &PRESETS, preset), Ok(one));
        }
        for one in LAYOUTS {
            assert_eq!(named("layout", layout(one), &LAYOUTS, layout), Ok(one));
        }
    }

    #[test]
    fn an_unknown_preset_is_refused_with_those_there_are() {
        let error = named("preset", "best", &PRESETS, preset).expect_err("nonsense");
        assert_eq!(
            error,
            "no preset is called \"best\"; there are fastest, very-fast, fast, medium, slow, very-slow"
        );
    }

    #[test]
    fn leaves_of_none_and_of_seventeen_are_refused() {
        for text in ["0", "17", "-1", "many"] {
            assert!(leaf_size(text).is_err_and(|error| error.contains("from 1 to 16")));
        }
    }
}
