//! Whether a file has the animation that a user chose.

use super::{AnimationChoice, AnimationFacts, Asset, Options};
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
                let by_name = animations.iter().position(|facts| facts.name == *wanted);
                let by_index = || wanted.parse().ok().filter(|&index| index < count);
                by_name.or_else(by_index).into_iter().collect()
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
    let choice = &options.animation;
    let models = || {
        asset
            .models
            .iter()
            .map(|placed| &placed.model.facts.animations)
    };
    let is_found = models().any(|animations| !choice.chosen(animations).is_empty());
    match choice {
        AnimationChoice::None => {}
        _ if is_found => {}
        AnimationChoice::Named(wanted) => {
            let known: Vec<&AnimationFacts> = models().flatten().collect();
            let problem = format!("there is no animation \"{wanted}\"; {}", there(&known));
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

fn there(known: &[&AnimationFacts]) -> String {
    const SHOWN: usize = 8;
    let called = |(index, facts): (usize, &&AnimationFacts)| match facts.name.as_str() {
        "" => index.to_string(),
        name => format!("{index} \"{name}\""),
    };
    let called: Vec<String> = known.iter().enumerate().map(called).collect();
    match called.as_slice() {
        [] => "the file has none".into(),
        [only] => format!("there is {only}"),
        [first @ .., last] if first.len() < SHOWN => {
            format!("there are {} and {last}", first.join(", "))
        }
        _ => format!("there are {}, ...", called[..SHOWN].join(", ")),
    }
}
