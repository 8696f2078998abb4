//! Printing. Whoever closed the other end of a pipe has read enough: that is neither an error nor a panic.

use super::Failure;
use indicatif::HumanCount;
use serde::Serialize;
use std::io::{self, Write};
use std::path::Path;

/// Writes to standard output.
pub(super) fn to_stdout(bytes: &[u8]) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    written(out.write_all(bytes).and_then(|()| out.flush()))
}

/// What came of writing to standard output.
pub(super) fn written(result: io::Result<()>) -> Result<(), Failure> {
    match result {
        Err(error) if error.kind() != io::ErrorKind::BrokenPipe => Err(Failure::output(format!(
            "standard output: cannot write: {error}"
        ))),
        _ => Ok(()),
    }
}

/// Writes a line to standard error, where nothing is left to complain to.
pub(super) fn to_stderr(line: &str) {
    let _ = writeln!(io::stderr(), "{}", one_line(line));
}

/// Writes a value to standard output as JSON.
pub(super) fn json(value: &impl Serialize) -> Result<(), Failure> {
    let json = serde_json::to_string_pretty(value).map_err(Failure::output)?;
    to_stdout(format!("{json}\n").as_bytes())
}

/// A text without line breaks and whatever else moves a terminal's cursor: names come from files that anyone wrote.
pub(super) fn one_line(text: &str) -> String {
    text.chars()
        .map(|c| if c.is_control() { '\u{fffd}' } else { c })
        .collect()
}

/// A path as text, in which bytes that are no UTF-8 are replaced.
pub(super) fn path(path: &Path) -> String {
    path.to_string_lossy().into_owned()
}

/// As in "1 plane" and "2,304 planes".
pub(super) fn counted(count: u64, one: &str, many: &str) -> String {
    let thing = if count == 1 { one } else { many };
    format!("{} {thing}", HumanCount(count))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_name_cannot_break_the_line_or_move_the_cursor() {
        assert_eq!(one_line("a\nb\u{1b}[2Jü"), "a\u{fffd}b\u{fffd}[2Jü");
    }

    #[test]
    fn one_is_singular() {
        assert_eq!(counted(1, "leaf", "leaves"), "1 leaf");
        assert_eq!(counted(0, "leaf", "leaves"), "0 leaves");
        assert_eq!(counted(2304, "leaf", "leaves"), "2,304 leaves");
    }
}
