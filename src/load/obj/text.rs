//! OBJ and MTL as text: encodings, line ends, continuation, words and numbers.
//!
//! Everything works on bytes: files come as UTF-8, Latin-1 or a mixture, and only names care.

use std::borrow::Cow;

/// Without a byte order mark, and UTF-16 as UTF-8.
pub(super) fn plain(bytes: &[u8]) -> Cow<'_, [u8]> {
    match bytes {
        [0xef, 0xbb, 0xbf, rest @ ..] => Cow::Borrowed(rest),
        [0xff, 0xfe, rest @ ..] => Cow::Owned(from_utf16(rest, u16::from_le_bytes)),
        [0xfe, 0xff, rest @ ..] => Cow::Owned(from_utf16(rest, u16::from_be_bytes)),
        _ => Cow::Borrowed(bytes),
    }
}

fn from_utf16(bytes: &[u8], unit: fn([u8; 2]) -> u16) -> Vec<u8> {
    let units = bytes.as_chunks::<2>().0.iter().map(|&pair| unit(pair));
    let text: String = char::decode_utf16(units)
        .map(|c| c.unwrap_or(char::REPLACEMENT_CHARACTER))
        .collect();
    text.into_bytes()
}

/// A line, or several that a backslash at their end joins.
#[derive(Clone, Copy, Debug)]
pub(super) struct Line<'a> {
    /// Counted from 1; of joined lines the first.
    pub(super) number: u32,
    /// Without its end.
    pub(super) text: &'a [u8],
}

/// The lines of a text, ended by LF, CR LF or CR.
pub(super) struct Lines<'a> {
    rest: &'a [u8],
    number: u32,
    joined: Vec<u8>,
}

impl<'a> Lines<'a> {
    /// Those of a text that has `before` lines before it.
    pub(super) fn new(text: &'a [u8], before: u32) -> Lines<'a> {
        Lines {
            rest: text,
            number: before,
            joined: Vec::new(),
        }
    }

    /// The next line; `None` at the end. Not an [`Iterator`], since joined lines live here.
    pub(super) fn next_line(&mut self) -> Option<Line<'_>> {
        let first = self.next_raw()?;
        let number = self.number;
        let Some(mut part) = continued(first) else {
            let text = first;
            return Some(Line { number, text });
        };
        self.joined.clear();
        loop {
            self.joined.extend_from_slice(part);
            self.joined.push(b' ');
            let Some(next) = self.next_raw() else { break };
            match continued(next) {
                Some(more) => part = more,
                None => {
                    self.joined.extend_from_slice(next);
                    break;
                }
            }
        }
        let text = &self.joined;
        Some(Line { number, text })
    }

    /// How many lines there were, joined ones each.
    pub(super) fn number(&self) -> u32 {
        self.number
    }

    /// What follows the latest line.
    pub(super) fn rest(&self) -> &'a [u8] {
        self.rest
    }

    /// The next line as it is.
    pub(super) fn next_raw(&mut self) -> Option<&'a [u8]> {
        if self.rest.is_empty() {
            return None;
        }
        self.number = self.number.saturating_add(1);
        let is_end = |&byte: &u8| byte == b'\n' || byte == b'\r';
        let length = self.rest.iter().position(is_end).unwrap_or(self.rest.len());
        let (line, rest) = self.rest.split_at(length);
        self.rest = rest
            .strip_prefix(b"\r\n")
            .or_else(|| rest.get(1..))
            .unwrap_or_default();
        Some(line)
    }
}

/// What stands before a backslash at the end. A comment's backslash joins nothing: it is likelier a path's.
pub(super) fn continued(line: &[u8]) -> Option<&[u8]> {
    let before = line.trim_ascii_end().strip_suffix(b"\\")?;
    (!before.trim_ascii_start().starts_with(b"#")).then_some(before)
}

/// The words of a line, parted by blanks and control characters.
#[derive(Clone, Copy, Debug)]
pub(super) struct Words<'a>(&'a [u8]);

impl<'a> Words<'a> {
    pub(super) fn of(text: &'a [u8]) -> Words<'a> {
        Words(text)
    }

    /// What the words that were not taken yet say together, as a name with blanks in it.
    pub(super) fn rest(self) -> &'a [u8] {
        let is_blank = |byte: &u8| *byte <= b' ';
        let start = self.0.iter().position(|byte| !is_blank(byte));
        let end = self.0.iter().rposition(|byte| !is_blank(byte));
        match (start, end) {
            (Some(start), Some(end)) => self.0.get(start..=end).unwrap_or_default(),
            _ => &[],
        }
    }
}

impl<'a> Iterator for Words<'a> {
    type Item = &'a [u8];

    fn next(&mut self) -> Option<&'a [u8]> {
        let start = self.0.iter().position(|&byte| byte > b' ')?;
        let from_start = self.0.get(start..)?;
        let length = from_start.iter().position(|&byte| byte <= b' ');
        let (word, rest) = from_start.split_at(length.unwrap_or(from_start.len()));
        self.0 = rest;
        Some(word)
    }
}

/// A number: what Rust reads, and C's `1.#QNAN` and `1.#INF` as no number.
pub(super) fn number(word: &[u8]) -> Option<f32> {
    let text = str::from_utf8(word).ok()?;
    match text.parse() {
        Ok(number) => Some(number),
        Err(_) if text.contains(".#") => Some(f32::NAN),
        Err(_) => None,
    }
}

/// Bytes as a name: UTF-8, or else Latin-1, whose bytes are the first 256 characters.
pub(super) fn name(bytes: &[u8]) -> String {
    match str::from_utf8(bytes) {
        Ok(name) => name.to_owned(),
        Err(_) => bytes.iter().copied().map(char::from).collect(),
    }
}

/// A word for a message: short, and on one line.
pub(super) fn shown(word: &[u8]) -> String {
    const LONGEST: usize = 40;
    let name = name(word.get(..LONGEST).unwrap_or(word));
    let clean = |c: char| if c.is_control() { '\u{fffd}' } else { c };
    let mut shown: String = name.chars().map(clean).collect();
    if word.len() > LONGEST {
        shown.push_str("...");
    }
    shown
}

#[cfg(test)]
mod tests {
    use super::*;

    fn lines(text: &[u8]) -> Vec<(u32, String)> {
        let mut lines = Lines::new(text, 0);
        let mut found = Vec::new();
        while let Some(line) = lines.next_line() {
            found.push((line.number, name(line.text)));
        }
        found
    }

    fn numbered(expected: &[(u32, &str)]) -> Vec<(u32, String)> {
        expected.iter().map(|&(n, text)| (n, text.into())).collect()
    }

    #[test]
    fn every_line_end_is_a_line_end() {
        assert_eq!(
            lines(b"a\nb\r\nc\rd\n\ne"),
            numbered(&[(1, "a"), (2, "b"), (3, "c"), (4, "d"), (5, ""), (6, "e")])
        );
    }

    #[test]
    fn a_backslash_joins_lines_under_the_first_number() {
        assert_eq!(
            lines(b"f 1 \\\r\n 2\\ \n3\nend"),
            numbered(&[(1, "f 1   2 3"), (4, "end")])
        );
        assert_eq!(lines(b"f 1\\"), numbered(&[(1, "f 1 ")]));
    }

    #[test]
    fn a_comment_joins_nothing() {
        assert_eq!(
            lines(b" # C:\\maps\\\nv"),
            numbered(&[(1, " # C:\\maps\\"), (2, "v")])
        );
    }

    #[test]
    fn marks_and_utf_16_are_gone() {
        assert_eq!(*plain(b"\xef\xbb\xbfv 1"), *b"v 1");
        assert_eq!(*plain(b"\xff\xfev\0\xe4\0"), *"v\u{e4}".as_bytes());
        assert_eq!(*plain(b"\xfe\xff\0v"), *b"v");
    }

    #[test]
    fn words_are_parted_by_blanks_and_a_name_keeps_its_own() {
        let mut words = Words::of(b" \tusemtl  dark  oak \0");
        assert_eq!(words.next(), Some(&b"usemtl"[..]));
        assert_eq!(words.rest(), b"dark  oak");
        assert_eq!(words.count(), 2);
        assert_eq!(Words::of(b"  ").rest(), b"");
    }

    #[test]
    fn numbers_of_every_exporter_are_read() {
        let read = |word: &str| number(word.as_bytes());
        assert_eq!(
            [read("-1.5e-1"), read(".5"), read("5."), read("+2")],
            [Some(-0.15), Some(0.5), Some(5.0), Some(2.0)]
        );
        assert!(read("-1.#QNAN").is_some_and(f32::is_nan));
        assert_eq!([read("0x10"), read("1,5"), read("")], [None; 3]);
    }

    #[test]
    fn latin_1_names_keep_their_letters() {
        assert_eq!(name(b"gr\xfcn"), "gr\u{fc}n");
        assert_eq!(name("gr\u{fc}n".as_bytes()), "gr\u{fc}n");
    }
}
