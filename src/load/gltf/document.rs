//! The typed document of a file, and the words in which errors name its parts.
//!
//! Parts are called by name, or by their index in the file's own arrays, which count from 0.

use super::{Budget, Options, Warnings, json};
use crate::Error;
use crate::load::text_bytes;
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
    /// What the user says of reading it.
    pub(super) options: Options,
    /// Where the memory for what it names comes from.
    pub(super) budget: Budget,
}

impl Document {
    /// Parses the text of a document.
    ///
    /// # Errors
    ///
    /// It is no UTF-8, no JSON, no glTF 2; or an index is greater than any file can have.
    pub(super) fn parse(
        file: &Path,
        json: &[u8],
        options: &Options,
        budget: &Budget,
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
        budget
            .take(text_bytes::of_json(json))
            .map_err(|problem| problem.of(file, "its JSON"))?;
        let root = json::parse(file, text)?;
        check_version(file, &root)?;
        Ok(Document {
            file: file.to_owned(),
            root,
            options: options.clone(),
            budget: budget.clone(),
        })
    }

    /// An [`Error::Malformed`] of this file.
    pub(super) fn malformed(&self, place: impl Into<String>, problem: impl Into<String>) -> Error {
        Error::malformed(&self.file, place, problem)
    }

    /// Takes memory for a part of the file.
    pub(super) fn take(&self, bytes: u64, what: impl Into<String>) -> Result<(), Error> {
        let taken = self.budget.take(bytes);
        taken.map_err(|problem| problem.of(&self.file, what))
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
pub(super) fn check_raw_version(file: &Path, value: &Value) -> Result<(), Error> {
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
            &Options::default(),
            &Budget::default(),
            &mut Warnings::default(),
        )
        .map_err(|e| e.to_string())
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
                "a.gltf: line 1, column 2: invalid length 2, expected a glTF document",
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
                "a.gltf: line 1, column 52: invalid type: string \"a\", expected an index",
            ),
        ] {
            assert_eq!(parse(text).err().as_deref(), Some(expected));
        }
        let latin = Document::parse(
            Path::new("a.gltf"),
            b"{\"\xe9\"}",
            &Options::default(),
            &Budget::default(),
            &mut Warnings::default(),
        );
        assert_eq!(
            latin.err().map(|e| e.to_string()),
            Some("a.gltf: is not UTF-8 at byte 2 of its JSON".into())
        );
    }
}
