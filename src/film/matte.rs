//! Mattes: which share of a pixel each object and each material has (Psyop, "Cryptomatte Specification", version 1.2).

use super::{Combine, Layer, Layers, Precision, Quantity};
use std::borrow::Cow;

/// How many objects, or materials, a pixel tells of.
pub const RANKS: usize = 6;

/// Whose shares mattes tell.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Matte {
    /// Objects, by their names.
    Object,
    /// Materials, by their names.
    Material,
}

impl Matte {
    /// Both.
    pub const ALL: [Matte; 2] = [Matte::Object, Matte::Material];

    /// As files call it.
    pub fn name(self) -> &'static str {
        match self {
            Matte::Object => "CryptoObject",
            Matte::Material => "CryptoMaterial",
        }
    }
}

/// Which id stands for which name.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Manifest {
    /// Whose names these are.
    pub matte: Matte,
    /// Sorted, each name once.
    pub names: Vec<(String, u32)>,
}

impl Layers {
    /// The layers of mattes, still without values.
    pub fn of_mattes(&self) -> Vec<Layer> {
        let mattes = self.mattes.then_some(Matte::ALL).into_iter().flatten();
        let layers = mattes.flat_map(|matte| (0..RANKS / 2).map(move |pair| (matte, pair)));
        let layer = |(matte, pair): (Matte, usize)| Layer {
            name: Cow::Owned(format!("{}{pair:02}", matte.name())),
            quantity: Quantity::Matte { matte, pair },
            channels: &["R", "G", "B", "A"],
            precision: Precision::Float,
            unit: "id, coverage, id, coverage",
            combine: Combine::Mean,
            values: Vec::new(),
        };
        layers.map(layer).collect()
    }
}

/// The id of a name, as the bits of a float: its hash, one bit of it changed where the float would be no normal number.
pub fn id_of(name: &str) -> u32 {
    let hash = murmur3(name.as_bytes());
    match hash >> 23 & 255 {
        0 | 255 => hash ^ 1 << 23,
        _ => hash,
    }
}

/// MurmurHash3_x86_32 with seed 0 (Austin Appleby, public domain).
pub fn murmur3(bytes: &[u8]) -> u32 {
    let mixed = |word: u32| {
        let word = word.wrapping_mul(0xcc9e_2d51);
        word.rotate_left(15).wrapping_mul(0x1b87_3593)
    };
    let (words, rest) = bytes.as_chunks::<4>();
    let mut hash = words.iter().fold(0u32, |hash, word| {
        let hash = hash ^ mixed(u32::from_le_bytes(*word));
        hash.rotate_left(13)
            .wrapping_mul(5)
            .wrapping_add(0xe654_6b64)
    });
    let last = rest.iter().rev();
    hash ^= mixed(last.fold(0, |word, byte| word << 8 | u32::from(*byte)));
    hash ^= bytes.len() as u32;
    hash = (hash ^ hash >> 16).wrapping_mul(0x85eb_ca6b);
    hash = (hash ^ hash >> 13).wrapping_mul(0xc2b2_ae35);
    hash ^ hash >> 16
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The specification's, and the two names of which its keys are made.
    #[test]
    fn hashes_are_those_of_the_specification() {
        assert_eq!(id_of("torus"), 4_053_562_365);
        assert_eq!(id_of("равнина"), 2_518_896_926);
        assert_eq!(murmur3(b"CryptoObject") >> 4, 0x3ae_39a5);
        assert_eq!(murmur3(b"CryptoMaterial") >> 4, 0xbe3_59d6);
        assert_eq!(murmur3(b""), 0);
    }

    #[test]
    fn every_id_is_a_normal_float() {
        for number in 0..10_000 {
            let id = id_of(&format!("object {number}"));
            assert!(f32::from_bits(id).is_normal(), "{number}");
        }
        assert_eq!(id_of(""), 1 << 23);
    }
}
