//! What a file asked for and did not get: data, which the command line prints.

/// More kinds than these are counted as one, so that a hostile file's do not take all time and memory.
const MOST_KINDS: usize = 200;

/// Stands for the kinds after those.
const UNLISTED: &str = "warnings of further kinds, which are not listed";

/// Something harmless that was ignored or mended.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Warning {
    /// One line, the file's name first where it is not the model itself.
    pub message: String,
    /// How often it happened.
    pub count: usize,
}

/// Warnings in the order in which they first happened, each kind once.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Warnings(Vec<Warning>);

impl Warnings {
    /// Notes `message`; one that is noted already is counted.
    pub fn add(&mut self, message: impl Into<String>) {
        self.add_times(message, 1);
    }

    /// Notes that `message` happened `count` times; nothing where that is zero.
    pub fn add_times(&mut self, message: impl Into<String>, count: usize) {
        let message = message.into();
        let is_full = self.0.len() >= MOST_KINDS;
        match self.0.iter_mut().find(|known| known.message == message) {
            Some(known) => known.count = known.count.saturating_add(count),
            None if is_full && message != UNLISTED => self.add_times(UNLISTED, count),
            None if count > 0 => self.0.push(Warning { message, count }),
            None => {}
        }
    }

    /// Takes over all of `other`.
    pub fn append(&mut self, other: Warnings) {
        other
            .0
            .into_iter()
            .for_each(|warning| self.add_times(warning.message, warning.count));
    }

    /// Every kind once, in the order of first happening.
    pub fn iter(&self) -> impl Iterator<Item = &Warning> {
        self.0.iter()
    }
}

impl std::fmt::Display for Warning {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.count {
            1 => write!(f, "{}", self.message),
            count => write!(f, "{} ({count} times)", self.message),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_same_warning_is_said_once_with_its_count() {
        let mut warnings = Warnings::default();
        ["a", "b", "a"]
            .into_iter()
            .for_each(|message| warnings.add(message));
        let said: Vec<String> = warnings.iter().map(ToString::to_string).collect();
        assert_eq!(said, ["a (2 times)", "b"]);
    }

    #[test]
    fn kinds_without_end_are_counted_as_one() {
        let mut warnings = Warnings::default();
        (0..10_000).for_each(|kind| warnings.add(format!("kind {kind}")));
        assert_eq!(warnings.iter().count(), MOST_KINDS + 1);
        let counted: usize = warnings.iter().map(|warning| warning.count).sum();
        assert_eq!(counted, 10_000);
    }
}
