//! What mattes need beside their ids: which names these stand for (Cryptomatte 1.2, section "Metadata").

use crate::film::{Manifest, murmur3};
use std::fmt::Write;

/// Names and values of a matte's attributes.
pub(super) fn attributes(manifest: &Manifest) -> [(String, String); 4] {
    let name = manifest.matte.name();
    // The first seven of eight digits.
    let key = murmur3(name.as_bytes()) >> 4;
    let named = |what: &str, value: String| (format!("cryptomatte/{key:07x}/{what}"), value);
    [
        named("name", name.into()),
        named("hash", "MurmurHash3_32".into()),
        named("conversion", "uint32_to_float32".into()),
        named("manifest", json(&manifest.names)),
    ]
}

/// An object of names and ids in hexadecimal digits.
fn json(names: &[(String, u32)]) -> String {
    let mut json = String::from("{");
    for (index, (name, id)) in names.iter().enumerate() {
        json.push_str(if index > 0 { ",\"" } else { "\"" });
        for letter in name.chars() {
            push_escaped(letter, &mut json);
        }
        // A string takes whatever it is given.
        let _ = write!(json, "\":\"{id:08x}\"");
    }
    json.push('}');
    json
}

fn push_escaped(letter: char, json: &mut String) {
    match letter {
        '"' => json.push_str("\\\""),
        '\\' => json.push_str("\\\\"),
        // Those that JSON forbids, and the others that no line of text has.
        letter if letter.is_control() => {
            let _ = write!(json, "\\u{:04x}", u32::from(letter));
        }
        letter => json.push(letter),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::film::Matte;

    #[test]
    fn a_manifest_is_json_whatever_names_there_are() {
        let names = ["a", "say \"\\\"\n", "равнина", "\u{0}\u{85}"];
        let named = |name: &str| (name.to_owned(), 0xabc);
        let manifest = Manifest {
            matte: Matte::Object,
            names: names.map(named).into(),
        };
        let attributes = attributes(&manifest);
        assert_eq!(attributes[0].0, "cryptomatte/3ae39a5/name");
        assert_eq!(attributes[0].1, "CryptoObject");
        let json: serde_json::Value = serde_json::from_str(&attributes[3].1).expect("JSON");
        for name in names {
            assert_eq!(json[name], "00000abc");
        }
        assert_eq!(json.as_object().map(serde_json::Map::len), Some(4));
    }
}
