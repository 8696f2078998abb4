//! From JSON text to crate `gltf`'s typed document, and the words in which errors name its parts.
//!
//! Parts are called by name, or by their index in the file's own arrays, which count from 0.

use super::Warnings;
use crate::Error;
use gltf::json::Root;
use serde_json::Value;
use std::path::{Path, PathBuf};

/// A parsed document, nothing of which is checked but its version.
#[derive(Debug)]
pub(super) struct Document {
    /// Where it came from.
    pub(super) file: PathBuf,
    /// The JSON, typed.
    pub(super) root: Root,
}

/// Keys whose values are indices.
const INDICES: [&str; 18] = [
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
    "source",
];

impl Document {
    /// Parses the text of a document.
    ///
    /// # Errors
    ///
    /// It is no UTF-8, no JSON, no glTF 2; or an index is greater than any file can have.
    pub(super) fn parse(
        file: &Path,
        json: &[u8],
        warnings: &mut Warnings,
    ) -> Result<Document, Error> {
        let text = std::str::from_utf8(json).map_err(|e| {
            let problem = format!("is not UTF-8 at byte {} of its JSON", e.valid_up_to());
            Error::malformed(file, "", problem)
        })?;
        let text = text.strip_prefix('\u{feff}').map_or(text, |rest| {
            warnings.add("begins with a byte order mark, which is ignored");
            rest
        });
        if has_long_integer(text) {
            check_indices(file, text)?;
        }
        let root = match serde_json::from_str(text) {
            Ok(root) => root,
            Err(error) => parse_mended(file, text, &error)?,
        };
        check_version(file, &root)?;
        let file = file.to_owned();
        Ok(Document { file, root })
    }

    /// An [`Error::Malformed`] of this file.
    pub(super) fn malformed(&self, place: impl Into<String>, problem: impl Into<String>) -> Error {
        Error::malformed(&self.file, place, problem)
    }

    /// The `index` again, if there is such a thing.
    pub(super) fn checked(
        &self,
        place: impl Into<String>,
        kind: &str,
        index: usize,
        count: usize,
    ) -> Result<usize, Error> {
        if index < count {
            Ok(index)
        } else {
            let problem = format!("{kind} {index} does not exist, there are {count}");
            Err(self.malformed(place, problem))
        }
    }
}

/// `mesh "chair"`, or `mesh 3` where it has no name.
pub(super) fn named(kind: &str, index: usize, name: Option<&String>) -> String {
    match name {
        Some(name) if !name.is_empty() => format!("{kind} \"{}\"", one_line(name)),
        _ => format!("{kind} {index}"),
    }
}

/// A file's own words on one line, of bounded length.
pub(super) fn one_line(text: &str) -> String {
    let mut shown: String = text
        .chars()
        .take(80)
        .map(|c| if c.is_control() { '\u{fffd}' } else { c })
        .collect();
    if shown.len() < text.len() {
        shown.push('…');
    }
    shown
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
    let Ok(value) = serde_json::from_str(text) else {
        return Ok(()); // The typed parser says it better.
    };
    too_great(&value, false).map_or(Ok(()), |(key, index)| {
        let problem = format!("index {index} does not exist: it is more than 32 bits can count");
        Err(Error::malformed(file, key, problem))
    })
}

/// The first index that 32 bits cannot hold. The parser has bounded the depth of `value`.
fn too_great(value: &Value, is_index: bool) -> Option<(String, u64)> {
    match value {
        Value::Number(number) if is_index => number
            .as_u64()
            .filter(|&index| index > u64::from(u32::MAX))
            .map(|index| (String::new(), index)),
        Value::Array(values) => values.iter().find_map(|value| too_great(value, is_index)),
        Value::Object(fields) => fields.iter().find_map(|(key, value)| {
            let found = match key.as_str() {
                "extras" => None,
                key => too_great(value, is_index || INDICES.contains(&key)),
            };
            found.map(|(below, index)| (if below.is_empty() { key.clone() } else { below }, index))
        }),
        _ => None,
    }
}

/// A second attempt at a document, for what glTF allows and crate `gltf` does not: scenes without nodes, channels
/// without a node (KHR_animation_pointer), whole numbers that end in `.0`.
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
            if let Some(channels) = animation.get_mut("channels").and_then(Value::as_array_mut) {
                channels.retain(|channel| channel.pointer("/target/node").is_some());
            }
        }
    }
    make_whole(&mut value);
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

/// What serde says, in our words: at which line, and without Rust's names of numbers.
fn not_read(file: &Path, error: &serde_json::Error) -> Error {
    let said = error.to_string();
    let said = said
        .rsplit_once(" at line ")
        .map_or(said.as_str(), |(problem, _)| problem);
    let mut problem = said.to_owned();
    for number in ["u64", "u32", "usize", "i64"] {
        problem = problem.replace(&format!("expected {number}"), "expected a whole number");
    }
    problem = problem.replace("expected f32", "expected a number");
    if !error.is_data() {
        problem = format!("is no JSON: {problem}");
    }
    let place = match error.line() {
        0 => String::new(),
        line => format!("line {line}, column {}", error.column()),
    };
    Error::malformed(file, place, one_line_of_error(&problem))
}

/// Serde repeats a file's words, and some are long.
fn one_line_of_error(problem: &str) -> String {
    problem
        .chars()
        .take(200)
        .map(|c| if c.is_control() { '\u{fffd}' } else { c })
        .collect()
}

fn check_version(file: &Path, root: &Root) -> Result<(), Error> {
    let asset = &root.asset;
    version_is_2(file, "version", &asset.version)?;
    match asset.min_version.as_deref() {
        None | Some("2.0") => Ok(()),
        Some(least) => Err(Error::Unsupported {
            file: file.to_owned(),
            what: format!(
                "needs glTF {} at least, which is not supported",
                one_line(least)
            ),
            way_out: "export it as glTF 2.0".into(),
        }),
    }
}

/// The version of a document that is not glTF 2 in other ways, too.
fn check_raw_version(file: &Path, value: &Value) -> Result<(), Error> {
    match value.pointer("/asset/version") {
        Some(Value::String(version)) => version_is_2(file, "version", version),
        // Some writers of glTF 1.0 made it a number, or left it out: its meshes are an object, not an array.
        Some(Value::Number(number)) => version_is_2(file, "version", &number.to_string()),
        _ if value.get("meshes").is_some_and(Value::is_object) => {
            version_is_2(file, "version", "1.0")
        }
        _ => Ok(()),
    }
}

fn version_is_2(file: &Path, field: &str, version: &str) -> Result<(), Error> {
    let major = version
        .split('.')
        .next()
        .and_then(|v| v.parse::<u32>().ok());
    match major {
        Some(2) => Ok(()),
        Some(_) => Err(Error::Unsupported {
            file: file.to_owned(),
            what: format!("is glTF {}, expected 2.0", one_line(version)),
            way_out: "export it as glTF 2.0".into(),
        }),
        None => {
            let problem = format!("is \"{}\", expected \"2.0\"", one_line(version));
            Err(Error::malformed(file, format!("asset.{field}"), problem))
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn parse(text: &str) -> Result<Document, String> {
        Document::parse(
            Path::new("a.gltf"),
            text.as_bytes(),
            &mut Warnings::default(),
        )
        .map_err(|e| e.to_string())
    }

    #[test]
    fn what_gltf_allows_and_the_crate_does_not_is_mended() {
        let text = r#"{"asset": {"version": "2.0", "extras": {"a": 1}}, "scenes": [{}],
            "accessors": [{"count": 3.0, "componentType": 5126.0, "type": "VEC3"}],
            "animations": [{"samplers": [], "channels": [{"sampler": 0, "target": {"path": "pointer"}}]}]}"#;
        let document = parse(text).map(|d| (d.root.scenes.len(), d.root.accessors[0].count.0));
        assert_eq!(document, Ok((1, 3)));
    }

    #[test]
    fn an_index_beyond_32_bits_is_not_index_0() {
        let text = r#"{"asset": {"version": "2.0"}, "nodes": [{"mesh": 4294967296}]}"#;
        assert_eq!(
            parse(text).err(),
            Some(
                "a.gltf: mesh: index 4294967296 does not exist: it is more than 32 bits can count"
                    .into()
            )
        );
        let harmless = r#"{"asset": {"version": "2.0"}, "nodes": [{"translation": [4294967296, 0.12345678901, 0],
            "extras": {"mesh": 4294967296}}]}"#;
        assert!(parse(harmless).is_ok());
    }

    #[test]
    fn every_wrong_text_has_its_own_words() {
        for (text, expected) in [
            (
                "{",
                "a.gltf: line 1, column 1: is no JSON: EOF while parsing an object",
            ),
            (
                "[]",
                "a.gltf: line 1, column 2: invalid length 0, expected struct Root with 17 elements",
            ),
            ("{}", "a.gltf: line 1, column 2: missing field `asset`"),
            (
                r#"{"asset": {"version": "1.0"}}"#,
                "a.gltf: is glTF 1.0, expected 2.0; export it as glTF 2.0",
            ),
            (
                r#"{"asset": {"version": "two"}}"#,
                "a.gltf: asset.version: is \"two\", expected \"2.0\"",
            ),
            (
                r#"{"asset": {}, "meshes": {"a": {}}}"#,
                "a.gltf: is glTF 1.0, expected 2.0; export it as glTF 2.0",
            ),
            (
                r#"{"asset": {"version": "2.0", "minVersion": "2.1"}}"#,
                "a.gltf: needs glTF 2.1 at least, which is not supported; export it as glTF 2.0",
            ),
            (
                r#"{"asset": {"version": "2.0"}, "nodes": [{"mesh": "a"}]}"#,
                "a.gltf: line 1, column 53: invalid type: string \"a\", expected index into child of root",
            ),
        ] {
            assert_eq!(parse(text).err().as_deref(), Some(expected));
        }
        let latin = Document::parse(Path::new("a.gltf"), b"{\"\xe9\"}", &mut Warnings::default());
        assert_eq!(
            latin.err().map(|e| e.to_string()),
            Some("a.gltf: is not UTF-8 at byte 2 of its JSON".into())
        );
    }
}
