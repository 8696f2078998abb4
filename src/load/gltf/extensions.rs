//! Which extensions luch honours, and what a file asks of them. One more is one more file and one more line here.

use super::document::{Document, one_line};
use super::{Warnings, emissive_strength, lights_punctual, materials_unlit};
use crate::Error;
use crate::load::ExtensionFacts;
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};

/// The extensions that luch honours.
const HONOURED: [&str; 3] = [
    emissive_strength::NAME,
    lights_punctual::NAME,
    materials_unlit::NAME,
];

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
        .filter(|name| !HONOURED.contains(name))
        .collect();
    if let Some(first) = missing.first() {
        let which = if missing.len() == 1 {
            "which is"
        } else {
            "which are"
        };
        let names: Vec<String> = missing.iter().take(8).map(|name| one_line(name)).collect();
        return Err(Error::Unsupported {
            file: document.file.clone(),
            what: format!("needs {}, {which} not supported", names.join(" and ")),
            way_out: way_out(first).into(),
        });
    }
    let mut facts: Vec<ExtensionFacts> = Vec::new();
    let mut known = std::collections::HashSet::new();
    for name in root.extensions_used.iter().chain(&root.extensions_required) {
        if !known.insert(name) {
            continue;
        }
        let honoured = HONOURED.contains(&name.as_str());
        if !honoured {
            warnings.add(format!("uses {}, which is ignored", one_line(name)));
        }
        facts.push(ExtensionFacts {
            name: name.clone(),
            required: root.extensions_required.contains(name),
            honoured,
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
