//! Whether two tiles are of one picture.

use super::tile::{Tile, window_of};
use crate::Error;
use crate::film::Window;
use exr::meta::attribute::{AttributeValue, SampleType};
use exr::meta::header::Header;

/// What differs between tiles, and when and how they came about. The first tile's are kept, but for the window.
const MAY_DIFFER: [&[u8]; 5] = [
    b"dataWindow",
    b"chunkCount",
    b"comments",
    b"capDate",
    b"utcOffset",
];

/// What is counted in each tile by itself, by the start of its name: the picture has the sum. Of rays that adaptive
/// sampling sends around a tile to compare its pixels with, each tile has its own.
const COUNTED: [&[u8]; 2] = [b"luch/rays/", b"luch/samples"];

/// Whether the attribute of this name is a count that tiles add up.
pub(super) fn is_counted(name: &[u8]) -> bool {
    COUNTED.iter().any(|start| name.starts_with(start))
}

/// Finds whether `tile` is of the same picture as the first.
pub(super) fn check(first: &Tile, tile: &Tile) -> Result<(), Error> {
    let other = |place: &str, found: String, expected: String| {
        let of_first = first
            .file
            .to_string_lossy()
            .replace(char::is_control, "\u{fffd}");
        let problem = format!(
            "{found}, expected {expected} as in {of_first}; render all tiles of one picture with the same options"
        );
        Err(Error::malformed(&tile.file, place, problem))
    };
    let (expected, found) = (first.header(), tile.header());
    if shown(found) != shown(expected) {
        return other("displayWindow", shown(found), shown(expected));
    }
    if channels(found) != channels(expected) {
        return other("channels", channels(found), channels(expected));
    }
    let [of_first, of_tile] = [expected, found].map(attributes);
    for (name, value) in &of_tile {
        let known = of_first.iter().find(|(known, _)| known == name);
        match known {
            Some((_, known)) if known == value => {}
            Some((_, known)) => return other(&quoted(name), said(value), said(known)),
            None => return other(&quoted(name), said(value), "none".into()),
        }
    }
    let missing =
        |(name, _): &&(Vec<u8>, AttributeValue)| !of_tile.iter().any(|(it, _)| it == name);
    if let Some((name, value)) = of_first.iter().find(missing) {
        return other(&quoted(name), "is missing".into(), said(value));
    }
    Ok(())
}

/// Every attribute that must be the same, by name.
fn attributes(header: &Header) -> Vec<(Vec<u8>, AttributeValue)> {
    let all = header.all_named_attributes();
    let mut all: Vec<_> = all
        .map(|(name, value)| (name.to_vec(), value))
        .filter(|(name, _)| !MAY_DIFFER.contains(&name.as_slice()) && !is_counted(name))
        .collect();
    all.sort_by(|(a, _), (b, _)| a.cmp(b));
    all
}

fn quoted(name: &[u8]) -> String {
    format!("attribute {:?}", String::from_utf8_lossy(name))
}

/// A value in few words.
fn said(value: &AttributeValue) -> String {
    match value {
        AttributeValue::Text(text) => {
            let words: String = String::from_utf8_lossy(text.as_slice())
                .chars()
                .take(80)
                .collect();
            format!("{words:?}")
        }
        AttributeValue::F32(number) => number.to_string(),
        AttributeValue::F64(number) => number.to_string(),
        AttributeValue::I32(number) => number.to_string(),
        _ => "another value".into(),
    }
}

fn shown(header: &Header) -> String {
    let window = window_of(header.shared_attributes.display_window);
    let Window {
        left,
        top,
        width,
        height,
    } = window.unwrap_or_default();
    format!("{width} x {height} pixels from {left},{top}")
}

/// The names of the channels, with the bits of each.
fn channels(header: &Header) -> String {
    let named = header.channels.list.iter().map(|channel| {
        let kind = match channel.sample_type {
            SampleType::F16 => "half",
            SampleType::F32 => "float",
            SampleType::U32 => "uint",
        };
        format!(
            "{} ({kind})",
            String::from_utf8_lossy(channel.name.as_slice())
        )
    });
    named.collect::<Vec<_>>().join(", ")
}
