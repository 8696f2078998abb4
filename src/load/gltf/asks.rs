//! What a file asks for beside its extensions, where that is more than triangles and their colours.

use super::document::Document;
use crate::load::{Ask, Treatment};
use gltf::json::texture::MinFilter;
use gltf::json::validation::Checked;

/// The extensions that a file uses, and then what it asks of the format's own.
pub(super) fn all(document: &Document, extensions: Vec<Ask>) -> Vec<Ask> {
    let root = &document.root;
    let mut primitives = root.meshes.iter().flat_map(|mesh| &mesh.primitives);
    let has_mipmaps = root.samplers.iter().any(|sampler| {
        !matches!(
            sampler.min_filter,
            None | Some(Checked::Valid(MinFilter::Nearest | MinFilter::Linear))
        )
    });
    let is_lit = root.materials.iter().any(|material| {
        let others = material.extensions.as_ref().map(|e| &e.others);
        !others.is_some_and(|others| others.contains_key(super::materials_unlit::NAME))
    });
    let own = [
        (
            "metallic-roughness materials",
            is_lit,
            Treatment::Approximated(
                "Blinn-Phong highlights as wide, mirror rays off what is smooth",
            ),
        ),
        ("mipmaps", has_mipmaps, Treatment::Honoured),
        (
            "morph targets",
            primitives.any(|p| p.targets.as_ref().is_some_and(|t| !t.is_empty())),
            Treatment::Honoured,
        ),
        ("skins", !root.skins.is_empty(), Treatment::Honoured),
        (
            "animations",
            !root.animations.is_empty(),
            Treatment::Honoured,
        ),
        (
            "sparse accessors",
            root.accessors
                .iter()
                .any(|accessor| accessor.sparse.is_some()),
            Treatment::Honoured,
        ),
    ];
    let own = own.into_iter().filter(|(_, asked, _)| *asked);
    let own = own.map(|(what, _, treatment)| Ask {
        what: what.into(),
        required: false,
        treatment,
    });
    extensions.into_iter().chain(own).collect()
}
