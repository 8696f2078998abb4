//! What a file says beside the picture: `extras` of any object, and metadata (KHR_xmp_json_ld, KHR_xmp). `luch info`
//! shows them; nothing else looks at them.

use super::document::{Document, named};
use crate::load::Note;
use gltf::json::Extras;

/// As files call them; the older one differs in nothing that is read here.
pub(super) const NAMES: [&str; 2] = ["KHR_xmp_json_ld", "KHR_xmp"];

/// What luch does with them.
pub(super) const HOW: &str = "`luch info` shows it";

/// Every note of the file, in its order.
pub(super) fn all(document: &Document) -> Vec<Note> {
    let root = &document.root;
    let mut notes = Vec::new();
    let mut note = |place: String, extras: &Extras| {
        let json = extras.as_ref().map(|json| json.get().to_owned());
        notes.extend(
            json.filter(|json| json != "null")
                .map(|json| Note { place, json }),
        );
    };
    note("file".into(), &root.extras);
    note("asset".into(), &root.asset.extras);
    macro_rules! each {
        ($things:ident, $kind:literal) => {
            for (index, thing) in root.$things.iter().enumerate() {
                note(named($kind, index, thing.name.as_ref()), &thing.extras);
            }
        };
    }
    each!(scenes, "scene");
    each!(nodes, "node");
    each!(meshes, "mesh");
    each!(materials, "material");
    each!(textures, "texture");
    each!(images, "image");
    each!(cameras, "camera");
    each!(animations, "animation");
    each!(skins, "skin");
    notes.extend(packets(document));
    notes
}

/// Packets of metadata; which object each belongs to is no matter of a picture.
fn packets(document: &Document) -> Vec<Note> {
    let extensions = document.root.extensions.as_ref();
    let mut notes = Vec::new();
    for name in NAMES {
        let packets = extensions
            .and_then(|extensions| extensions.others.get(name)?.get("packets")?.as_array());
        for (index, packet) in packets.into_iter().flatten().enumerate() {
            notes.push(Note {
                place: format!("{name}, packet {index}"),
                json: packet.to_string(),
            });
        }
    }
    notes
}
