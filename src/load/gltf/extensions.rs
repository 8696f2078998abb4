//! Which extensions luch honours, and what a file asks of them. One more is one more file and one more line here.

use super::document::{Document, one_line};
use super::{
    Warnings, animation_pointer, draco, emissive_strength, implicit_shapes, lights_punctual,
    materials_anisotropy, materials_clearcoat, materials_diffuse_transmission,
    materials_dispersion, materials_ior, materials_iridescence, materials_sheen,
    materials_specular, materials_specular_glossiness, materials_transmission, materials_unlit,
    materials_variants, materials_volume, mesh_gpu_instancing, mesh_quantization, meshopt,
    node_visibility, notes, texture_basisu, texture_transform, texture_webp,
};
use crate::Error;
use crate::load::{Ask, Treatment};
use serde::de::DeserializeOwned;
use serde_json::{Map, Value};
use std::collections::HashSet;

/// The extensions that luch knows, and what it does with each.
const KNOWN: &[(&str, Treatment)] = &[
    (draco::NAME, Treatment::Honoured),
    (mesh_gpu_instancing::NAME, Treatment::Honoured),
    (mesh_quantization::NAME, Treatment::Honoured),
    (meshopt::NAMES[0], Treatment::Honoured),
    (meshopt::NAMES[1], Treatment::Honoured),
    (animation_pointer::NAME, Treatment::Honoured),
    (node_visibility::NAME, Treatment::Honoured),
    (emissive_strength::NAME, Treatment::Honoured),
    (implicit_shapes::NAME, Treatment::Honoured),
    (lights_punctual::NAME, Treatment::Honoured),
    (
        materials_anisotropy::NAME,
        Treatment::Approximated("a round lobe as high as the long one"),
    ),
    (
        materials_clearcoat::NAME,
        Treatment::Approximated("a second highlight and mirror along the surface's own normal"),
    ),
    (
        materials_diffuse_transmission::NAME,
        Treatment::Approximated("ambient light comes through, that of lamps does not"),
    ),
    (
        materials_dispersion::NAME,
        Treatment::Approximated("three rays, for red, green and blue"),
    ),
    (materials_ior::NAME, Treatment::Honoured),
    (
        materials_iridescence::NAME,
        Treatment::Approximated("interference at the angle of the viewer"),
    ),
    (materials_sheen::NAME, Treatment::Honoured),
    (materials_specular::NAME, Treatment::Honoured),
    (materials_specular_glossiness::NAME, Treatment::Honoured),
    (
        materials_transmission::NAME,
        Treatment::Approximated("a ray goes on, sharp however rough the surface is"),
    ),
    (materials_unlit::NAME, Treatment::Honoured),
    (materials_variants::NAME, Treatment::Honoured),
    (materials_volume::NAME, Treatment::Honoured),
    (notes::NAMES[0], Treatment::Approximated(notes::HOW)),
    (notes::NAMES[1], Treatment::Approximated(notes::HOW)),
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
pub(super) fn check(document: &Document, warnings: &mut Warnings) -> Result<Vec<Ask>, Error> {
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
        let allow = names.join(" --allow ");
        return Err(Error::Unsupported {
            file: document.file.clone(),
            what: format!("needs {}, {which} not supported", names.join(" and ")),
            way_out: format!("{way_out}, or go on without with --allow {allow}"),
        });
    }
    let required: HashSet<&String> = root.extensions_required.iter().collect();
    let mut known = HashSet::new();
    let mut asks: Vec<Ask> = Vec::new();
    for name in root.extensions_used.iter().chain(&root.extensions_required) {
        if !known.insert(name) {
            continue;
        }
        let treatment = treatment(name);
        if treatment == Treatment::Ignored {
            warnings.add(format!("uses {}, which is ignored", one_line(name)));
        }
        asks.push(Ask {
            what: name.clone(),
            required: required.contains(name),
            treatment,
        });
    }
    Ok(asks)
}

/// How a file comes out without an extension.
pub(super) fn way_out(name: &str) -> &'static str {
    match name {
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
