//! The numbers of OBJ's statements.

use super::geometry::NONE;
use super::text::{Words, number, shown};

/// Up to `N` numbers and how many there were, `least` of them needed; the others are 0.
pub(super) fn numbers<const N: usize>(
    words: Words,
    least: usize,
    what: &str,
    expected: &str,
) -> Result<([f32; N], usize), String> {
    let mut numbers = [0.0; N];
    let mut count = 0;
    let words = words.take_while(|word| !word.starts_with(b"#"));
    for (slot, word) in numbers.iter_mut().zip(words) {
        *slot = number(word)
            .ok_or_else(|| format!("{what} has \"{}\", expected a number", shown(word)))?;
        count += 1;
    }
    if count < least {
        return Err(format!(
            "{what} has too few numbers ({count}), expected {expected}"
        ));
    }
    Ok((numbers, count))
}

/// What a number of a face's corner names.
pub(super) enum Index {
    /// Nothing: the number is left out.
    None,
    /// The one at this place, counted from 0. It may come later in the file.
    At(u32),
    /// One that cannot be: said in words.
    Nowhere(String),
}

/// An index of what counts from 1, or backwards from the latest where it is negative.
pub(super) fn index(digits: &[u8], kind: &str, count: usize) -> Result<Index, String> {
    let (is_negative, magnitude) = match digits {
        [b'-', rest @ ..] => (true, rest),
        [b'+', rest @ ..] => (false, rest),
        rest => (false, rest),
    };
    let no_index = || format!("face has \"{}\", expected an index", shown(digits));
    if magnitude.is_empty() {
        return Err(no_index());
    }
    let mut value = 0u64;
    for byte in magnitude {
        let digit = byte.wrapping_sub(b'0');
        if digit > 9 {
            return Err(no_index());
        }
        value = value.saturating_mul(10).saturating_add(u64::from(digit));
    }
    let index = match (value, is_negative) {
        (0, _) => {
            let problem = format!("face names {kind} 0, indices start at 1");
            return Ok(Index::Nowhere(problem));
        }
        (_, true) => (count as u64).checked_sub(value),
        (_, false) => Some(value - 1),
    };
    Ok(match index.and_then(|index| u32::try_from(index).ok()) {
        Some(index) if index != NONE => Index::At(index),
        _ => Index::Nowhere(no_such(kind, shown(digits), count)),
    })
}

pub(super) fn no_such(kind: &str, index: impl std::fmt::Display, count: usize) -> String {
    format!("face names {kind} {index}, there are {count}")
}
