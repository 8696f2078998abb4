//! What an animation of a model moves.

use super::Line;
use luch::load::AnimationFacts;
use serde::Serialize;

/// An animation of a model.
#[derive(Serialize)]
pub(super) struct Animation {
    name: String,
    /// When its last key is.
    seconds: f64,
    moves: Vec<Moves>,
}

/// A kind of thing that it moves.
#[derive(Serialize)]
struct Moves {
    what: String,
    /// How many channels move one.
    channels: usize,
}

impl Animation {
    pub(super) fn of(facts: &AnimationFacts) -> Animation {
        let moves = facts.moves.iter().map(|moved| Moves {
            what: moved.what.clone(),
            channels: moved.count,
        });
        Animation {
            name: facts.name.clone(),
            seconds: facts.seconds,
            moves: moves.collect(),
        }
    }

    /// As in `0 "Run": 1.5 s, 20 x rotation, 1 x translation`.
    fn in_words(&self, index: usize) -> String {
        let moves = self.moves.iter();
        let moves: String = moves
            .map(|moves| format!(", {} x {}", moves.channels, moves.what))
            .collect();
        // To a tenth of a millisecond: times are 32-bit numbers.
        let seconds = (self.seconds * 1e4).round() / 1e4;
        match self.name.as_str() {
            "" => format!("{index}: {seconds} s{moves}"),
            name => format!("{index} \"{name}\": {seconds} s{moves}"),
        }
    }
}

/// A line for each of the first, or for none.
pub(super) fn in_words(animations: &[Animation]) -> Vec<Line> {
    const SHOWN: usize = 16;
    if animations.is_empty() {
        return vec![("animations", "0".into())];
    }
    let shown = animations.iter().enumerate().take(SHOWN);
    let mut lines: Vec<Line> = shown
        .map(|(index, animation)| ("animation", animation.in_words(index)))
        .collect();
    if animations.len() > SHOWN {
        lines.push((
            "animations",
            format!("{}, the first {SHOWN} above", animations.len()),
        ));
    }
    lines
}
