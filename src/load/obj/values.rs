//! What stands after the keyword of an MTL's statement, but for textures.

use super::text::{Words, number, shown};
use crate::color::Rgb;

/// `r g b`, or one number for all three.
pub(super) fn color(mut words: Words) -> Result<Rgb, String> {
    let first = words.rest();
    if first.starts_with(b"spectral") || first.starts_with(b"xyz") {
        return Err(format!("is given as \"{}\", expected r g b", shown(first)));
    }
    let channels = numbers::<3>(&mut words)?;
    let (red, green, blue) = match channels {
        (1, [grey, _, _]) => (grey, grey, grey),
        (3, [red, green, blue]) => (red, green, blue),
        (count, _) => {
            return Err(format!("has too few numbers ({count}), expected r g b"));
        }
    };
    if [red, green, blue].iter().all(|channel| *channel >= 0.0) {
        Ok(Rgb::new(red, green, blue))
    } else {
        Err(format!(
            "is {red} {green} {blue}, expected 0 or more in every channel"
        ))
    }
}

pub(super) fn amount(mut words: Words) -> Result<f32, String> {
    match numbers::<1>(&mut words)? {
        (1, [amount]) if amount >= 0.0 => Ok(amount),
        (1, [amount]) => Err(format!("is {amount}, expected 0 or more")),
        _ => Err("has no number, expected one".into()),
    }
}

pub(super) fn index_of_refraction(words: Words) -> Result<f32, String> {
    match amount(words)? {
        0.0 => Err("is 0, expected an index of refraction, as 1.5".into()),
        index => Ok(index),
    }
}

pub(super) fn share(mut words: Words) -> Result<f32, String> {
    if words.rest().starts_with(b"-halo") {
        return Err("depends on the view (-halo), expected a number".into());
    }
    match numbers::<1>(&mut words)? {
        (1, [share]) if (0.0..=1.0).contains(&share) => Ok(share),
        (1, [share]) => Err(format!("is {share}, expected a share from 0 to 1")),
        _ => Err("has no number, expected one".into()),
    }
}

pub(super) fn illumination(mut words: Words) -> Result<u32, String> {
    const LAST: u32 = 10;
    let word = words.next().unwrap_or_default();
    let model: Option<u32> = str::from_utf8(word).ok().and_then(|word| word.parse().ok());
    model
        .filter(|&model| model <= LAST)
        .ok_or_else(|| format!("is \"{}\", expected 0 to {LAST}", shown(word)))
}

/// How many numbers there are, up to `N`, and them.
fn numbers<const N: usize>(words: &mut Words) -> Result<(usize, [f32; N]), String> {
    let mut numbers = [0.0; N];
    let mut count = 0;
    let words = words.take_while(|word| !word.starts_with(b"#"));
    for (slot, word) in numbers.iter_mut().zip(words) {
        *slot = number(word)
            .filter(|number| number.is_finite())
            .ok_or_else(|| format!("has \"{}\", expected a finite number", shown(word)))?;
        count += 1;
    }
    Ok((count, numbers))
}
