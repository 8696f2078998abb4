//! Materials with statements of the PBR extension, as glTF's metallic-roughness.
//!
//! As Blender's importer (4.5, `obj_import_mtl.cc`): the base colour is `Kd`; a texture stands instead of its number,
//! not beside it; without `Pr` the roughness comes from `Ns`. Sheen, coat and anisotropy (`Ps Pc Pcr aniso anisor`) are
//! told and ignored.

use super::bump::{height_of, pixel};
use super::map::Map;
use super::mtl::MtlMaterial;
use super::textures::Textures;
use crate::color::Rgb;
use crate::material::{MetallicRoughness, Textured};
use crate::texture::{Image, Pixels};

/// The greatest exponent that Blender tells from a mirror's.
const MOST_SHININESS: f32 = 1000.0;

/// Of what says nothing of its gloss.
const ROUGHNESS: f32 = 0.5;

pub(super) fn metallic_roughness(
    mtl: &MtlMaterial,
    base_color: Textured<Rgb>,
    textures: &mut Textures,
) -> MetallicRoughness {
    let of_shininess = |exponent: f32| 1.0 - (exponent.min(MOST_SHININESS) / MOST_SHININESS).sqrt();
    let roughness = mtl.roughness.or(mtl.shininess.map(of_shininess));
    let packed = textures.roughness_and_metal(mtl.roughness_map.as_ref(), mtl.metal_map.as_ref());
    let replaced = |map: &Option<Map>, number: f32| match map {
        Some(_) if packed.is_some() => 1.0,
        _ => number,
    };
    MetallicRoughness {
        base_color,
        metallic: replaced(&mtl.metal_map, mtl.metal.unwrap_or(0.0)),
        roughness: replaced(&mtl.roughness_map, roughness.unwrap_or(ROUGHNESS)),
        metallic_roughness: packed,
        occlusion: Textured::uniform(1.0),
        finish: None,
    }
}

/// A picture as glTF has it, roughness in green and metalness in blue, from one or two pictures with a number in a
/// channel. The smaller one is stretched.
pub(super) fn packed(
    name: String,
    roughness: Option<(&Image, Option<u8>)>,
    metal: Option<(&Image, Option<u8>)>,
) -> Option<Image> {
    let area = |image: &Image| u64::from(image.width) * u64::from(image.height);
    let both = [roughness, metal];
    let (largest, _) = both
        .into_iter()
        .flatten()
        .max_by_key(|(image, _)| area(image))?;
    let (width, height) = (largest.width, largest.height);
    let number = |from: Option<(&Image, Option<u8>)>, x: u32, y: u32| {
        let Some((image, channel)) = from else {
            return u8::MAX;
        };
        let scaled = |at: u32, from: u32, to: u32| u64::from(at) * u64::from(to) / u64::from(from);
        let (x, y) = (
            scaled(x, width, image.width),
            scaled(y, height, image.height),
        );
        let at = y * u64::from(image.width) + x;
        (height_of(channel)(pixel(image, at as usize)) * 255.0 + 0.5) as u8
    };
    let places = (0..height).flat_map(|y| (0..width).map(move |x| (x, y)));
    let pixels = places.map(|(x, y)| {
        [
            u8::MAX,
            number(roughness, x, y),
            number(metal, x, y),
            u8::MAX,
        ]
    });
    Some(Image {
        name,
        width,
        height,
        pixels: Pixels::Eight(pixels.collect()),
    })
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

    use super::*;

    fn image(width: u32, height: u32, pixels: &[[u8; 4]]) -> Image {
        Image {
            name: String::new(),
            width,
            height,
            pixels: Pixels::Eight(pixels.to_vec()),
        }
    }

    #[test]
    fn two_pictures_become_one_of_the_larger_size() {
        let rough = image(2, 1, &[[10, 10, 10, 255], [20, 20, 20, 255]]);
        let metal = image(1, 1, &[[0, 0, 7, 255]]);
        let both = packed(
            String::new(),
            Some((&rough, None)),
            Some((&metal, Some(b'b'))),
        )
        .unwrap();
        let pixels = vec![[255, 10, 7, 255], [255, 20, 7, 255]];
        assert_eq!((both.width, both.height), (2, 1));
        assert_eq!(both.pixels, Pixels::Eight(pixels));
        let alone = packed(String::new(), None, Some((&metal, Some(b'b')))).unwrap();
        assert_eq!(alone.pixels, Pixels::Eight(vec![[255, 255, 7, 255]]));
        assert!(packed(String::new(), None, None).is_none());
    }
}
