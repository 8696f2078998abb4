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

/// Digits after these do not count: no file has so many vertices.
const BEYOND_ALL: u64 = 1 << 40;

/// What a number of a face's corner names.
pub(super) enum Index<'a> {
    /// Nothing: the number is left out.
    None,
    /// The one at this place, counted from 0.
    At(u32),
    /// One that is not there.
    Nowhere(Nowhere<'a>),
}

/// An index of what is not there.
pub(super) struct Nowhere<'a> {
    digits: &'a [u8],
    is_zero: bool,
    /// Of how many.
    count: usize,
}

impl Nowhere<'_> {
    /// In words, of a `kind` of thing.
    pub(super) fn of(&self, kind: &str) -> String {
        if self.is_zero {
            return format!("face names {kind} 0, indices start at 1");
        }
        let (digits, count) = (shown(self.digits), self.count);
        format!("face names {kind} {digits}, there are {count}")
    }
}

/// An index of one of `all` that counts from 1, or backwards from the latest of those `here` where it is negative.
pub(super) fn index(digits: &[u8], here: usize, all: usize) -> Result<Index<'_>, String> {
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
        if value < BEYOND_ALL {
            value = value * 10 + u64::from(digit);
        }
    }
    let index = if is_negative {
        (here as u64).checked_sub(value)
    } else {
        value.checked_sub(1)
    };
    Ok(match index.and_then(|index| u32::try_from(index).ok()) {
        Some(index) if value > 0 && (index as usize) < all && index != NONE => Index::At(index),
        _ => Index::Nowhere(Nowhere {
            digits,
            is_zero: value == 0,
            count: if is_negative { here } else { all },
        }),
    })
}
