//! Materials with statements of the PBR extension, as glTF's metallic-roughness.
//!
//! As Blender's importer (4.5, `obj_import_mtl.cc`): the base colour is `Kd`; a texture stands instead of its number,
//! not beside it; without `Pr` the roughness comes from `Ns`. `Ps` is how much white sheen there is and `Pc` how much
//! clear coat (Blender's weights, and its roughness of both where the file says none), `aniso` how anisotropic it is.

use super::bump::{height_of, pixel};
use super::map::Map;
use super::mtl::MtlMaterial;
use super::textures::Textures;
use crate::color::Rgb;
use crate::material::{Clearcoat, Finish, MetallicRoughness, Sheen, Textured};
use crate::texture::{Image, Pixels};

/// The greatest exponent that Blender tells from a mirror's.
const MOST_SHININESS: f32 = 1000.0;

/// Of what says nothing of its gloss.
const ROUGHNESS: f32 = 0.5;

/// Of Blender's sheen.
const SHEEN_ROUGHNESS: f32 = 0.5;

/// Of Blender's clear coat where there is no `Pcr`.
const COAT_ROUGHNESS: f32 = 0.03;

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
        finish: finish(mtl, textures),
    }
}

/// Sheen, clear coat and anisotropy, where there are any.
fn finish(mtl: &MtlMaterial, textures: &mut Textures) -> Option<Box<Finish>> {
    let sheen_map = textures.amount(mtl.sheen_map.as_ref());
    let sheen = match &sheen_map {
        Some(_) => 1.0,
        None => mtl.sheen.unwrap_or(0.0),
    };
    let sheen = (sheen > 0.0).then_some(Sheen {
        color: Textured {
            factor: Rgb::grey(sheen),
            texture: sheen_map,
        },
        roughness: Textured::uniform(SHEEN_ROUGHNESS),
    });
    let coat = mtl.coat.filter(|&weight| weight > 0.0);
    let clearcoat = coat.map(|weight| Clearcoat {
        weight: Textured::uniform(weight),
        roughness: Textured::uniform(mtl.coat_roughness.unwrap_or(COAT_ROUGHNESS)),
        normal_map: None,
    });
    let anisotropy = mtl.anisotropy.filter(|&strength| strength > 0.0);
    let finish = Finish {
        sheen,
        clearcoat,
        anisotropy: anisotropy.map(Textured::uniform),
        ..Finish::PLAIN
    };
    (finish != Finish::PLAIN).then(|| Box::new(finish))
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
    use crate::load::Warnings;
    use crate::load::obj::{materials, mtl};
    use crate::material::Model;

    /// What statements make, if it is metallic-roughness.
    fn made(statements: &str) -> Option<MetallicRoughness> {
        let text = format!("newmtl a\n{statements}");
        let mtl = mtl::read(text.as_bytes(), "a.mtl", &mut Warnings::default());
        match materials::material(&mtl[0], &mut Textures::default()).model {
            Model::MetallicRoughness(made) => Some(made),
            _ => None,
        }
    }

    #[test]
    fn statements_of_the_pbr_extension_make_metallic_roughness() {
        let rough = |statements: &str| {
            let made = made(statements).unwrap();
            (made.base_color.factor, made.metallic, made.roughness)
        };
        let red = Rgb::new(1.0, 0.0, 0.0);
        assert_eq!(rough("Kd 1 0 0\nPr .25\nPm .75"), (red, 0.75, 0.25));
        // Blender: 1 - sqrt(Ns / 1000).
        assert_eq!(rough("Kd 1 0 0\nPm 1\nNs 250"), (red, 1.0, 0.5));
        assert_eq!(rough("Kd 1 0 0\nPc 1\nNs 4000\nillum 0"), (red, 0.0, 0.0));
        assert_eq!(rough("map_Pr gone.png\nPm 1"), (Rgb::grey(0.8), 1.0, 0.5));
        // Ke and norm are of the extension, too, but old files have them.
        assert!(made("Ke 1 1 1\nnorm gone.png").is_none());
    }

    #[test]
    fn sheen_coat_and_anisotropy_are_a_finish() {
        let finish = |statements: &str| made(statements).unwrap().finish;
        assert_eq!(finish("Pr .5\nPs 0\nPc 0\nPcr .5\naniso 0"), None);
        let coat = |weight, roughness| Clearcoat {
            weight: Textured::uniform(weight),
            roughness: Textured::uniform(roughness),
            normal_map: None,
        };
        let sheen = Sheen {
            color: Textured::uniform(Rgb::grey(0.25)),
            roughness: Textured::uniform(0.5),
        };
        for (statements, expected) in [
            (
                "Pc .5",
                Finish {
                    clearcoat: Some(coat(0.5, 0.03)),
                    ..Finish::PLAIN
                },
            ),
            (
                "Ps .25\nPc 1\nPcr .75\naniso .125\nanisor .5",
                Finish {
                    clearcoat: Some(coat(1.0, 0.75)),
                    sheen: Some(sheen),
                    anisotropy: Some(Textured::uniform(0.125)),
                    ..Finish::PLAIN
                },
            ),
        ] {
            assert_eq!(finish(statements), Some(Box::new(expected)), "{statements}");
        }
    }

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
