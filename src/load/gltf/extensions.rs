//! Which extensions luch honours, and what a file asks of them. One more is one more file and one more line here.

use super::document::{Document, one_line};
use super::{
    Warnings, emissive_strength, lights_punctual, materials_unlit, texture_basisu,
    texture_transform, texture_webp,
};
use crate::Error;
use crate::load::{ExtensionFacts, Treatment};
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};
use std::collections::HashSet;

/// The extensions that luch knows, and what it does with each.
const KNOWN: &[(&str, Treatment)] = &[
    (emissive_strength::NAME, Treatment::Honoured),
    (lights_punctual::NAME, Treatment::Honoured),
    (materials_unlit::NAME, Treatment::Honoured),
    (texture_basisu::NAME, Treatment::Honoured),
    (texture_transform::NAME, Treatment::Honoured),
    (texture_webp::NAME, Treatment::Honoured),
];

/// What luch does with an extension.
fn treatment(name: &str) -> Treatment {
    let known = KNOWN.iter().find(|(known, _)| *known == name);
    known.map_or(Treatment::Ignored, |&(_, treatment)| treatment)
}

/// Each extension that the file uses, in its order.
///
/// # Errors
///
/// The file says that it makes no sense without one that luch lacks.
pub(super) fn check(
    document: &Document,
    warnings: &mut Warnings,
) -> Result<Vec<ExtensionFacts>, Error> {
    let root = &document.root;
    let missing: Vec<&str> = root
        .extensions_required
        .iter()
        .map(String::as_str)
        .filter(|name| treatment(name) == Treatment::Ignored)
        .filter(|name| !document.options.allow.iter().any(|allowed| allowed == name))
        .collect();
    if let Some(first) = missing.first() {
        let (which, way_out) = match missing.len() {
            1 => ("which is", way_out(first)),
            _ => ("which are", "re-export without them"),
        };
        let names: Vec<String> = missing.iter().take(8).map(|name| one_line(name)).collect();
        return Err(Error::Unsupported {
            file: document.file.clone(),
            what: format!("needs {}, {which} not supported", names.join(" and ")),
            way_out: way_out.into(),
        });
    }
    let required: HashSet<&String> = root.extensions_required.iter().collect();
    let mut known = HashSet::new();
    let mut facts: Vec<ExtensionFacts> = Vec::new();
    for name in root.extensions_used.iter().chain(&root.extensions_required) {
        if !known.insert(name) {
            continue;
        }
        let treatment = treatment(name);
        if treatment == Treatment::Ignored {
            warnings.add(format!("uses {}, which is ignored", one_line(name)));
        }
        facts.push(ExtensionFacts {
            name: name.clone(),
            required: required.contains(name),
            treatment,
        });
    }
    Ok(facts)
}

/// How a file comes out without an extension.
pub(super) fn way_out(name: &str) -> &'static str {
    match name {
        "KHR_draco_mesh_compression" | "EXT_meshopt_compression" | "KHR_meshopt_compression" => {
            "re-export without compression"
        }
        "KHR_mesh_quantization" => "re-export without quantization",
        "KHR_texture_basisu" | "EXT_texture_webp" | "EXT_texture_avif" => {
            "re-export with PNG or JPEG textures"
        }
        _ => "re-export without it",
    }
}

/// What an object of the file says under an extension's name.
///
/// # Errors
///
/// It does not say it as the extension does: the parser's words.
pub(super) fn read<T: DeserializeOwned>(
    of_object: Option<&Map<String, Value>>,
    name: &str,
) -> Result<Option<T>, String> {
    of_object
        .and_then(|extensions| extensions.get(name))
        .map(|value| T::deserialize(value).map_err(|error| one_line(&error.to_string())))
        .transpose()
}
