//! From JSON text to crate `gltf`'s typed document.

use super::animation_pointer;
use super::document::check_raw_version;
use crate::Error;
use gltf::json::Root;
use serde_json::Value;
use std::path::Path;

/// Keys whose values are indices.
const INDICES: [&str; 19] = [
    "attributes",
    "buffer",
    "bufferView",
    "camera",
    "children",
    "index",
    "indices",
    "input",
    "inverseBindMatrices",
    "joints",
    "material",
    "mesh",
    "node",
    "nodes",
    "output",
    "sampler",
    "scene",
    "skin",
    "source",
];

/// Parses the text of a document.
///
/// # Errors
///
/// It is no JSON, or not that of glTF 2; or an index is greater than any file can have.
pub(super) fn parse(file: &Path, text: &str) -> Result<Root, Error> {
    if has_long_integer(text) {
        check_indices(file, text)?;
    }
    match serde_json::from_str(text) {
        Ok(root) => Ok(root),
        Err(error) => parse_mended(file, text, &error),
    }
}

/// Whether the text has a number that may be too great for 32 bits: cheap, and no for nearly every file.
fn has_long_integer(text: &str) -> bool {
    let mut digits = 0;
    let mut fraction = false;
    for byte in text.bytes() {
        match byte {
            b'0'..=b'9' if fraction => {}
            b'0'..=b'9' => digits += 1,
            b'.' => {
                fraction = true;
                digits = 0;
            }
            _ if digits >= 10 => return true,
            _ => (digits, fraction) = (0, false),
        }
    }
    false
}

/// Crate `gltf` reads the index 2^32 as 0, which would be another thing of the file.
fn check_indices(file: &Path, text: &str) -> Result<(), Error> {
    match serde_json::from_str(text) {
        Ok(value) => check_value(file, &value),
        Err(_) => Ok(()), // The typed parser says it better.
    }
}

fn check_value(file: &Path, value: &Value) -> Result<(), Error> {
    too_great(value, "").map_or(Ok(()), |(key, index)| {
        let problem = format!("index {index} does not exist: it is more than 32 bits can count");
        Err(Error::malformed(file, key, problem))
    })
}

/// The first index that 32 bits cannot hold, and its key. The parser has bounded the depth of `value`.
fn too_great<'a>(value: &'a Value, key: &'a str) -> Option<(&'a str, u64)> {
    match value {
        Value::Number(number) if INDICES.contains(&key) => number
            .as_u64()
            .filter(|&index| index > u64::from(u32::MAX))
            .map(|index| (key, index)),
        Value::Array(values) => values.iter().find_map(|value| too_great(value, key)),
        Value::Object(fields) => fields
            .iter()
            .filter(|(name, _)| name.as_str() != "extras")
            .find_map(|(name, value)| {
                // The names below `attributes` are a file's own.
                too_great(value, if key == "attributes" { key } else { name })
            }),
        _ => None,
    }
}

/// A second attempt at a document, for what glTF allows and crate `gltf` does not: scenes without nodes, animations without channels, channels
/// without a node, whole numbers that end in `.0`.
fn parse_mended(file: &Path, text: &str, first: &serde_json::Error) -> Result<Root, Error> {
    let mut value: Value = serde_json::from_str(text).map_err(|e| not_read(file, &e))?;
    check_raw_version(file, &value)?;
    if let Some(scenes) = value.get_mut("scenes").and_then(Value::as_array_mut) {
        for scene in scenes.iter_mut().filter_map(Value::as_object_mut) {
            scene
                .entry("nodes")
                .or_insert_with(|| Value::Array(Vec::new()));
        }
    }
    if let Some(animations) = value.get_mut("animations").and_then(Value::as_array_mut) {
        for animation in animations {
            if let Some(animation) = animation.as_object_mut() {
                for name in ["channels", "samplers"] {
                    let nothing = || Value::Array(Vec::new());
                    animation.entry(name).or_insert_with(nothing);
                }
            }
            if let Some(channels) = animation.get_mut("channels").and_then(Value::as_array_mut) {
                let (of_nodes, others): (Vec<Value>, Vec<Value>) = std::mem::take(channels)
                    .into_iter()
                    .partition(|channel| channel.pointer("/target/node").is_some());
                *channels = of_nodes;
                animation_pointer::keep(animation, others);
            }
        }
    }
    make_whole(&mut value);
    check_value(file, &value)?;
    serde_json::from_value(value).map_err(|_| not_read(file, first))
}

/// Turns `3.0` into `3`: the same number in JSON, and not the same to serde.
fn make_whole(value: &mut Value) {
    match value {
        Value::Number(number) => {
            let whole = number
                .as_f64()
                .filter(|x| number.is_f64() && x.fract() == 0.0);
            // Beyond this, not every whole number is one of these.
            if let Some(x) = whole.filter(|x| x.abs() < 9e15) {
                *number = if x < 0.0 {
                    (x as i64).into()
                } else {
                    (x as u64).into()
                };
            }
        }
        Value::Array(values) => values.iter_mut().for_each(make_whole),
        Value::Object(fields) => fields.values_mut().for_each(make_whole),
        _ => {}
    }
}

/// What serde calls things, and what a reader of JSON does.
const WORDS: [(&str, &str); 11] = [
    ("index into child of root", "an index"),
    ("struct Root with 19 elements", "a glTF document"),
    ("struct Root", "a glTF document"),
    ("expected struct", "expected an object for"),
    ("type: map", "type: object"),
    ("type: sequence", "type: array"),
    ("expected a sequence", "expected an array"),
    ("expected u64", "expected a whole number"),
    ("expected u32", "expected a whole number"),
    ("expected usize", "expected a whole number"),
    ("expected f32", "expected a number"),
];

/// What serde says, in our words: at which line, and without Rust's names of numbers.
fn not_read(file: &Path, error: &serde_json::Error) -> Error {
    let said = error.to_string();
    let said = said
        .rsplit_once(" at line ")
        .map_or(said.as_str(), |(problem, _)| problem);
    let mut problem = said.to_owned();
    for (theirs, ours) in WORDS {
        problem = problem.replace(theirs, ours);
    }
    if !error.is_data() {
        problem = format!("is no JSON: {problem}");
    }
    let place = match error.line() {
        0 => String::new(),
        line => format!("line {line}, column {}", error.column()),
    };
    Error::Malformed {
        file: file.to_owned(),
        place,
        problem: one_line_of_error(&problem),
        source: Some(one_line_of_error(&error.to_string()).into()),
    }
}

/// Serde repeats a file's words, and some are long.
fn one_line_of_error(problem: &str) -> String {
    problem
        .chars()
        .take(200)
        .map(|c| if c.is_control() { '\u{fffd}' } else { c })
        .collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parsed(text: &str) -> Result<Root, String> {
        parse(Path::new("a.gltf"), text).map_err(|e| e.to_string())
    }

    #[test]
    fn what_gltf_allows_and_the_crate_does_not_is_mended() {
        let text = r#"{"asset": {"version": "2.0", "extras": {"a": 1}}, "scenes": [{}],
            "accessors": [{"count": 3.0, "componentType": 5126.0, "type": "VEC3"}],
            "animations": [{"samplers": [], "channels": [{"sampler": 0, "target": {"path": "pointer"}}]}]}"#;
        let document = parsed(text).map(|d| (d.scenes.len(), d.accessors[0].count.0));
        assert_eq!(document, Ok((1, 3)));
    }

    #[test]
    fn an_index_beyond_32_bits_is_not_index_0() {
        let text = r#"{"asset": {"version": "2.0"}, "nodes": [{"mesh": 4294967296}]}"#;
        assert_eq!(
            parsed(text).err(),
            Some(
                "a.gltf: mesh: index 4294967296 does not exist: it is more than 32 bits can count"
                    .into()
            )
        );
        assert_eq!(
            parsed(&text.replace("296}", "296.0}")).err(),
            parsed(text).err()
        );
        let harmless = r#"{"asset": {"version": "2.0"}, "nodes": [{"translation": [4294967296, 0.12345678901, 0],
            "extras": {"mesh": 4294967296}}]}"#;
        assert!(parsed(harmless).is_ok());
    }
}
