//! Whether a file has the animation that a user chose.

use super::{AnimationChoice, AnimationFacts, Asset, Options, choice};
use crate::Error;

impl AnimationChoice {
    /// Those of `animations` that are chosen, by index.
    pub(super) fn chosen(&self, animations: &[AnimationFacts]) -> Vec<usize> {
        let count = animations.len();
        match self {
            AnimationChoice::None => Vec::new(),
            AnimationChoice::First => (0..count.min(1)).collect(),
            AnimationChoice::All => (0..count).collect(),
            AnimationChoice::Named(wanted) => {
                let found = choice::find("animation", wanted, &names(animations));
                found.into_iter().collect()
            }
        }
    }
}

/// The asset, if one of its models has the animation that the options name. Where they choose any and there is none, a
/// warning says so.
///
/// # Errors
///
/// No model has an animation of that name or index.
pub(super) fn check(mut asset: Asset, options: &Options) -> Result<Asset, Error> {
    let chosen = &options.animation;
    let models = || {
        asset
            .models
            .iter()
            .map(|placed| &placed.model.facts.animations)
    };
    let is_found = models().any(|animations| !chosen.chosen(animations).is_empty());
    match chosen {
        AnimationChoice::None => {}
        _ if is_found => {}
        AnimationChoice::Named(wanted) => {
            let problem = choice::no_such("animation", wanted, &names(models().flatten()));
            return Err(Error::malformed(&asset.file, "", problem));
        }
        AnimationChoice::First | AnimationChoice::All => {
            asset
                .warnings
                .add("has no animation: at every time it is the same");
        }
    }
    Ok(asset)
}

fn names<'a>(animations: impl IntoIterator<Item = &'a AnimationFacts>) -> Vec<&'a str> {
    let animations = animations.into_iter();
    animations.map(|facts| facts.name.as_str()).collect()
}
