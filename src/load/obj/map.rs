//! The texture statements of MTL: options, then a file's name.

use super::text::{Words, name, number, shown};

/// A texture as a statement names it.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Map {
    /// As in the file.
    pub(super) name: String,
    /// `-s`: multiplies u and v, before the offset.
    pub(super) scale: [f32; 2],
    /// `-o`: is added to u and v.
    pub(super) offset: [f32; 2],
    /// `-clamp on`: not repeated.
    pub(super) clamps: bool,
    /// `-bm`: multiplies heights, or how much normals lean.
    pub(super) bump_multiplier: f32,
    /// `-imfchan`: one of r, g, b, m (matte: alpha), l (luminance), z.
    pub(super) channel: Option<u8>,
}

/// What may follow an option.
enum Arguments {
    /// One to three numbers.
    Numbers,
    /// So many numbers.
    Exactly(usize),
    /// A word.
    Word,
}

fn arguments(option: &[u8]) -> Option<Arguments> {
    Some(match option {
        b"-s" | b"-o" | b"-t" => Arguments::Numbers,
        b"-bm" | b"-boost" | b"-texres" => Arguments::Exactly(1),
        b"-mm" => Arguments::Exactly(2),
        b"-blendu" | b"-blendv" | b"-cc" | b"-clamp" | b"-imfchan" | b"-type" => Arguments::Word,
        _ => return None,
    })
}

impl Map {
    /// Reads what stands after the keyword; options that luch does not honour go to `ignored`.
    ///
    /// Options may stand after the name as well. A name may have blanks; it ends before the first known option.
    pub(super) fn read(words: Words, ignored: &mut Vec<String>) -> Result<Map, String> {
        let mut map = Map {
            name: String::new(),
            scale: [1.0; 2],
            offset: [0.0; 2],
            clamps: false,
            bump_multiplier: 1.0,
            channel: None,
        };
        let mut rest = map.take_options(words, ignored)?;
        let from_name = rest.rest();
        let mut length = from_name.len();
        loop {
            let before = rest;
            match rest.next() {
                None => break,
                Some(word) if arguments(word).is_some() => {
                    length = from_name.len() - before.rest().len();
                    let after = map.take_options(before, ignored)?;
                    if let [_, ..] = after.rest() {
                        let word = shown(after.rest());
                        return Err(format!("\"{word}\" stands after the options"));
                    }
                    break;
                }
                Some(_) => {}
            }
        }
        let bytes = Words::of(from_name.get(..length).unwrap_or_default()).rest();
        let quoted = bytes
            .strip_prefix(b"\"")
            .and_then(|b| b.strip_suffix(b"\""));
        map.name = name(quoted.unwrap_or(bytes));
        if map.name.is_empty() {
            return Err("names no texture".into());
        }
        Ok(map)
    }

    /// Takes the options at the beginning of `words`; what is left.
    fn take_options<'a>(
        &mut self,
        mut words: Words<'a>,
        ignored: &mut Vec<String>,
    ) -> Result<Words<'a>, String> {
        loop {
            let before = words;
            let Some((option, kind)) = words.next().and_then(|word| Some((word, arguments(word)?)))
            else {
                return Ok(before);
            };
            match kind {
                Arguments::Numbers => {
                    let numbers = take_numbers(&mut words, 3);
                    self.set_numbers(option, &numbers, ignored)?;
                }
                Arguments::Exactly(count) => {
                    let numbers = take_numbers(&mut words, count);
                    if numbers.len() < count {
                        return Err(format!("{} lacks a number", shown(option)));
                    }
                    self.set_numbers(option, &numbers, ignored)?;
                }
                Arguments::Word => match (option, words.next()) {
                    (_, None) => return Err(format!("{} lacks a word", shown(option))),
                    (b"-clamp", Some(word)) => self.clamps = word == b"on",
                    (b"-imfchan", Some(word)) => self.channel = word.first().copied(),
                    // Filtering is always on.
                    (b"-blendu" | b"-blendv", Some(b"on")) => {}
                    _ => ignored.push(shown(option)),
                },
            }
        }
    }

    fn set_numbers(
        &mut self,
        option: &[u8],
        numbers: &[f32],
        ignored: &mut Vec<String>,
    ) -> Result<(), String> {
        let Some(&first) = numbers.first() else {
            return Err(format!("{} lacks a number", shown(option)));
        };
        let second = numbers.get(1).copied();
        match option {
            b"-s" => self.scale = [first, second.unwrap_or(1.0)],
            b"-o" => self.offset = [first, second.unwrap_or(0.0)],
            b"-bm" => self.bump_multiplier = first,
            _ => ignored.push(shown(option)),
        }
        Ok(())
    }
}

/// As many finite numbers as come, `most` at most.
fn take_numbers(words: &mut Words, most: usize) -> Vec<f32> {
    let mut numbers = Vec::new();
    while numbers.len() < most {
        let mut ahead = *words;
        match ahead.next().and_then(number) {
            Some(number) if number.is_finite() => numbers.push(number),
            _ => break,
        }
        *words = ahead;
    }
    numbers
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

    use super::*;

    fn read(text: &str) -> Map {
        Map::read(Words::of(text.as_bytes()), &mut Vec::new()).unwrap()
    }

    fn problem(text: &str) -> String {
        Map::read(Words::of(text.as_bytes()), &mut Vec::new()).unwrap_err()
    }

    #[test]
    fn names_keep_their_blanks_and_lose_their_quotes() {
        assert_eq!(read(" dark  oak.png ").name, "dark  oak.png");
        assert_eq!(read("\"dark oak.png\"").name, "dark oak.png");
        assert_eq!(read("C:\\maps\\a-s.png").name, "C:\\maps\\a-s.png");
    }

    #[test]
    fn options_stand_before_and_after_the_name() {
        let map = read("-s 2 3 1 -o .5 -clamp on bump 01.png -bm 1.5 -imfchan r");
        assert_eq!(map.name, "bump 01.png");
        assert_eq!((map.scale, map.offset), ([2.0, 3.0], [0.5, 0.0]));
        assert!(map.clamps);
        assert_eq!((map.bump_multiplier, map.channel), (1.5, Some(b'r')));
    }

    #[test]
    fn fewer_numbers_than_three_end_where_the_name_begins() {
        assert_eq!(read("-s 0.1 0.2 2nd.jpg").name, "2nd.jpg");
        assert_eq!(read("-s 0.1 a.jpg").scale, [0.1, 1.0]);
    }

    #[test]
    fn options_without_effect_are_told() {
        let mut ignored = Vec::new();
        let text = b"-blendu on -cc on -mm 0.1 0.3 -t 1 1 1 -type sphere -texres 512 a.jpg";
        let map = Map::read(Words::of(text), &mut ignored).unwrap();
        assert_eq!(map.name, "a.jpg");
        assert_eq!(ignored, ["-cc", "-mm", "-t", "-type", "-texres"]);
    }

    #[test]
    fn what_is_missing_is_named() {
        assert_eq!(problem(""), "names no texture");
        assert_eq!(problem("-bm"), "-bm lacks a number");
        assert_eq!(problem("-s 1"), "names no texture");
        assert_eq!(problem("-s a.png"), "-s lacks a number");
        assert_eq!(problem("-clamp"), "-clamp lacks a word");
        assert_eq!(
            problem("a.png -bm 1 b.png"),
            "\"b.png\" stands after the options"
        );
    }
}
