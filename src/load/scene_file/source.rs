//! A scene file's text, and errors that point into it.

use crate::Error;
use std::ops::Range;
use std::path::Path;
use toml::de::DeTable;

/// The longest piece of the file that an error repeats, in characters.
const LONGEST_EXCERPT: usize = 60;

/// The text of a scene file, and what to call it.
pub(super) struct Source<'a> {
    /// The name errors use; relative paths start in its folder.
    pub(super) file: &'a Path,
    /// All of it.
    pub(super) text: &'a str,
}

/// The text of a file's bytes.
pub(super) fn decode(file: &Path, bytes: Vec<u8>) -> Result<String, Error> {
    String::from_utf8(bytes).map_err(|error| {
        let bad = error.utf8_error().valid_up_to();
        let before = error.as_bytes().get(..bad).unwrap_or_default();
        let line = 1 + before.iter().filter(|&&byte| byte == b'\n').count();
        let byte = error.as_bytes().get(bad).copied().unwrap_or_default();
        let problem = format!("byte {byte:#04x} is not UTF-8; save the file as UTF-8");
        Error::malformed(file, format!("line {line}"), problem)
    })
}

impl<'a> Source<'a> {
    /// The TOML in the text.
    pub(super) fn document(&self) -> Result<DeTable<'a>, Error> {
        match DeTable::parse(self.text) {
            Ok(document) => Ok(document.into_inner()),
            Err(error) => {
                // Its `Display` has five lines, a picture of the place among them.
                let place = error.span().map(|span| self.line_and_column(span.start));
                let problem = one_line(error.message());
                Err(Error::Malformed {
                    file: self.file.to_owned(),
                    place: place.unwrap_or_default(),
                    problem,
                    source: Some(error.into()),
                })
            }
        }
    }

    /// An error about what stands at the byte `at`.
    pub(super) fn error(&self, at: usize, problem: impl Into<String>) -> Error {
        Error::malformed(self.file, format!("line {}", self.line(at)), problem)
    }

    /// The line of the byte `at`, from 1.
    pub(super) fn line(&self, at: usize) -> usize {
        1 + self.before(at).matches('\n').count()
    }

    /// What stands at `span`, on one line and cut to a length that a message can bear.
    pub(super) fn excerpt(&self, span: Range<usize>) -> String {
        cut(self.text.get(span).unwrap_or_default())
    }

    fn line_and_column(&self, at: usize) -> String {
        let line_start = self.before(at).rfind('\n').map_or(0, |newline| newline + 1);
        let column = 1 + self
            .text
            .get(line_start..at)
            .unwrap_or_default()
            .chars()
            .count();
        format!("line {}, column {column}", self.line(at))
    }

    fn before(&self, at: usize) -> &str {
        self.text.get(..at).unwrap_or(self.text)
    }
}

/// `text` in quotes, on one line and cut to a length that a message can bear.
pub(super) fn quoted(text: &str) -> String {
    format!("\"{}\"", cut(text))
}

/// `text` without line breaks and other control characters.
pub(super) fn one_line(text: &str) -> String {
    let words: Vec<&str> = text.split_whitespace().collect();
    words
        .join(" ")
        .replace(|c: char| c.is_control(), "\u{fffd}")
}

fn cut(text: &str) -> String {
    // A few more than are shown, so that a long text is never copied whole.
    let start: String = text.chars().take(LONGEST_EXCERPT + 1).collect();
    if start.chars().count() <= LONGEST_EXCERPT {
        return one_line(&start);
    }
    let kept: String = start.chars().take(LONGEST_EXCERPT - 1).collect();
    format!("{}…", one_line(&kept))
}
