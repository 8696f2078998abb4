//! KHR_materials_variants: other materials for the same things, of which a user chooses.

use super::document::Document;
use super::{Warnings, extensions};
use crate::Error;
use crate::load::choice;
use gltf::json::mesh::Primitive;

/// As files call it.
pub(super) const NAME: &str = "KHR_materials_variants";

#[derive(serde::Deserialize)]
#[serde(expecting = "an object")]
struct OfRoot {
    variants: Vec<Variant>,
}

#[derive(serde::Deserialize)]
#[serde(expecting = "an object")]
struct Variant {
    #[serde(default)]
    name: String,
}

#[derive(serde::Deserialize)]
#[serde(expecting = "an object")]
struct OfPrimitive {
    mappings: Vec<Mapping>,
}

#[derive(serde::Deserialize)]
#[serde(expecting = "an object")]
struct Mapping {
    variants: Vec<u64>,
    material: u64,
}

/// The variants of a file, and which of them is shown.
pub(super) struct Variants {
    /// Names; empty strings where they have none.
    pub(super) names: Vec<String>,
    /// By its index.
    chosen: Option<u64>,
}

impl Variants {
    /// The file's variants, and the one that the user wants.
    ///
    /// # Errors
    ///
    /// It has none of that name.
    pub(super) fn read(document: &Document, warnings: &mut Warnings) -> Result<Variants, Error> {
        let of_root = document.root.extensions.as_ref().map(|e| &e.others);
        let names = match extensions::read::<OfRoot>(of_root, NAME) {
            Ok(of_root) => of_root.map_or_else(Vec::new, |of_root| {
                of_root.variants.into_iter().map(|v| v.name).collect()
            }),
            Err(problem) => {
                warnings.add(format!("{NAME}: {problem}: it is ignored"));
                Vec::new()
            }
        };
        let chosen = match &document.options.variant {
            None => None,
            Some(wanted) => {
                let names: Vec<&str> = names.iter().map(String::as_str).collect();
                let found = choice::find("variant", wanted, &names);
                Some(found.map_err(|problem| document.malformed("", problem))? as u64)
            }
        };
        Ok(Variants { names, chosen })
    }

    /// The material that the chosen variant gives a primitive; its own where the variant says nothing of it.
    pub(super) fn material(
        &self,
        primitive: &Primitive,
        place: &str,
        warnings: &mut Warnings,
    ) -> Option<usize> {
        let own = primitive.material.map(|index| index.value());
        let Some(chosen) = self.chosen else {
            return own;
        };
        let others = primitive.extensions.as_ref().map(|e| &e.others);
        match extensions::read::<OfPrimitive>(others, NAME) {
            Ok(of_primitive) => of_primitive
                .and_then(|of_primitive| {
                    let mut mappings = of_primitive.mappings.into_iter();
                    mappings.find(|mapping| mapping.variants.contains(&chosen))
                })
                .map(|mapping| usize::try_from(mapping.material).unwrap_or(usize::MAX))
                .or(own),
            Err(problem) => {
                warnings.add(format!("{place}, {NAME}: {problem}: it is ignored"));
                own
            }
        }
    }
}
