//! From MTL's materials to luch's.
//!
//! Colours are linear, as every loader of ours has factors; textures are sRGB. `illum` chooses:
//!
//! - 0: a colour that light does not change.
//! - 1: diffuse alone.
//! - 2, or none: diffuse and highlight.
//! - 3 to 9: also a mirror, `Ks` of whose light comes back (without Fresnel's law).
//! - 4, 6, 7, 9: light may go through as well: see `glass.rs`.
//! - 10, shadows on what is not there: as 2.
//!
//! Statements of the PBR extension make it metallic-roughness, whatever `illum`: see `pbr.rs`.
//!
//! `Ns 0` is no highlight: MeshLab writes it beside `Ks 1 1 1` for what has none, and an exponent of 0 would pour light
//! over all of it.
//!
//! `d` counts before `Tr`, which is `1 - d`. A lone `Tr 1`, which would hide everything, comes from writers who mean
//! opaque by it.

use super::mtl::MtlMaterial;
use super::text::shown;
use super::textures::Textures;
use super::{glass, pbr};
use crate::color::Rgb;
use crate::material::{Alpha, AlphaMode, Material, Model, Phong, Textured};

/// The diffuse colour of what has none.
const GREY: Rgb = Rgb::grey(0.8);

/// The exponent of a highlight whose file gives none.
const SHININESS: f32 = 32.0;

/// The grey of parts without a material.
pub(super) fn default_material() -> Material {
    Material::matt("", GREY)
}

/// A material with its textures, or, where they are missing, without.
pub(super) fn material(mtl: &MtlMaterial, textures: &mut Textures) -> Material {
    let mut diffuse = diffuse(mtl, textures);
    let emission = emission(mtl, textures);
    let dissolve = dissolve(mtl, textures);
    let glass = glass::glass(mtl, diffuse.factor, dissolve);
    if let Some(glass) = &glass {
        diffuse.factor = glass.tint;
    }
    let is_unlit = mtl.illumination == Some(0);
    let mut model = match mtl.is_pbr {
        true => Model::MetallicRoughness(pbr::metallic_roughness(mtl, diffuse, textures)),
        false if is_unlit => Model::Unlit { color: diffuse },
        false => Model::Phong(lit(mtl, diffuse, textures)),
    };
    if let (Some(_), Model::Phong(phong)) = (&glass, &mut model) {
        phong.reflectivity = Rgb::BLACK;
    }
    let coverage = if glass.is_some() { 1.0 } else { dissolve };
    Material {
        name: mtl.name.clone(),
        model,
        emission,
        alpha: alpha(mtl, coverage, textures),
        transmission: glass.map(|glass| glass.transmission),
        normal_map: textures.normals(mtl.normal_map.as_ref(), mtl.bump_map.as_ref()),
        double_sided: true,
    }
}

fn diffuse(mtl: &MtlMaterial, textures: &mut Textures) -> Textured<Rgb> {
    let texture = textures.color(mtl.diffuse_map.as_ref());
    let has_texture = texture.is_some();
    Textured {
        factor: factor(mtl, mtl.diffuse, has_texture, "Kd", GREY, textures),
        texture,
    }
}

fn emission(mtl: &MtlMaterial, textures: &mut Textures) -> Textured<Rgb> {
    let texture = textures.color(mtl.emission_map.as_ref());
    let has_texture = texture.is_some();
    Textured {
        factor: factor(mtl, mtl.emission, has_texture, "Ke", Rgb::BLACK, textures),
        texture,
    }
}

/// What `illum` 1 to 10 have of the paper's surfaces.
fn lit(mtl: &MtlMaterial, diffuse: Textured<Rgb>, textures: &mut Textures) -> Phong {
    let illumination = mtl.illumination.unwrap_or(2);
    if illumination == 1 {
        return phong(diffuse, Textured::uniform(Rgb::BLACK), 0.0);
    }
    let texture = textures.color(mtl.specular_map.as_ref());
    let absent = if texture.is_some() {
        Rgb::WHITE
    } else {
        Rgb::BLACK
    };
    let factor = mtl.specular.unwrap_or(absent);
    let specular = Textured { factor, texture };
    let shininess = mtl.shininess.unwrap_or(SHININESS);
    let highlight = if shininess > 0.0 {
        specular
    } else {
        Textured::uniform(Rgb::BLACK)
    };
    let mut phong = phong(diffuse, highlight, shininess);
    if (3..=9).contains(&illumination) {
        phong.reflectivity = factor.map(|share| share.min(1.0));
    }
    phong
}

fn phong(diffuse: Textured<Rgb>, specular: Textured<Rgb>, shininess: f32) -> Phong {
    Phong {
        diffuse,
        specular,
        shininess,
        reflectivity: Rgb::BLACK,
        checker: None,
    }
}

/// What multiplies a texture: writers leave black there and mean the texture.
fn factor(
    mtl: &MtlMaterial,
    given: Option<Rgb>,
    has_texture: bool,
    statement: &str,
    otherwise: Rgb,
    textures: &mut Textures,
) -> Rgb {
    match given {
        Some(Rgb::BLACK) if has_texture => {
            let name = shown(mtl.name.as_bytes());
            textures.warnings.add(format!(
                "material \"{name}\": {statement} 0 0 0 would blacken map_{statement} and counts as 1 1 1"
            ));
            Rgb::WHITE
        }
        Some(given) => given,
        None if has_texture => Rgb::WHITE,
        None => otherwise,
    }
}

/// `d`, or what `Tr` says of it: the share that covers.
fn dissolve(mtl: &MtlMaterial, textures: &mut Textures) -> f32 {
    let is_glass = matches!(mtl.illumination, Some(4 | 6 | 7 | 9));
    match (mtl.dissolve, mtl.transparency) {
        (Some(0.0), _) if !is_glass => {
            let name = shown(mtl.name.as_bytes());
            textures
                .warnings
                .add(format!("material \"{name}\": d 0 hides what is made of it"));
            0.0
        }
        (Some(dissolve), _) => dissolve,
        (None, Some(1.0)) if !is_glass => {
            let name = shown(mtl.name.as_bytes());
            textures.warnings.add(format!(
                "material \"{name}\": Tr 1 would hide it and is taken as opaque; write d 0 to hide it"
            ));
            1.0
        }
        (None, transparency) => 1.0 - transparency.unwrap_or(0.0),
    }
}

fn alpha(mtl: &MtlMaterial, factor: f32, textures: &mut Textures) -> Alpha {
    match textures.coverage(mtl.dissolve_map.as_ref()) {
        None if factor == 1.0 => Alpha::OPAQUE,
        None => Alpha {
            mode: AlphaMode::Blend,
            coverage: Textured::uniform(factor),
            ..Alpha::OPAQUE
        },
        Some((texture, channel)) => Alpha {
            mode: AlphaMode::Blend,
            coverage: Textured {
                factor,
                texture: Some(texture),
            },
            channel,
        },
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::load::Warnings;
    use crate::load::obj::mtl;
    use crate::material::Volume;

    fn made(statements: &str) -> (Material, usize) {
        let text = format!("newmtl a\n{statements}");
        let mtl = mtl::read(text.as_bytes(), "a.mtl", &mut Warnings::default());
        let mut textures = Textures::default();
        let made = material(&mtl[0], &mut textures);
        (made, textures.warnings.iter().count())
    }

    fn phong_of(statements: &str) -> Phong {
        match made(statements).0.model {
            Model::Phong(phong) => phong,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn illum_chooses_what_light_does() {
        let all = "Kd .1 .2 .3\nKs .4 .5 2\nNs 7\n";
        let unlit = made(&format!("{all}illum 0")).0.model;
        let expected = Textured::uniform(Rgb::new(0.1, 0.2, 0.3));
        assert_eq!(unlit, Model::Unlit { color: expected });
        let diffuse = phong_of(&format!("{all}illum 1"));
        assert_eq!(diffuse.specular.factor, Rgb::BLACK);
        for illum in ["", "illum 2", "illum 10"] {
            let shiny = phong_of(&format!("{all}{illum}"));
            assert_eq!(shiny.specular.factor, Rgb::new(0.4, 0.5, 2.0));
            assert_eq!((shiny.shininess, shiny.reflectivity), (7.0, Rgb::BLACK));
        }
        for illum in 3..=9 {
            let mirror = phong_of(&format!("{all}illum {illum}"));
            assert_eq!(mirror.reflectivity, Rgb::new(0.4, 0.5, 1.0));
        }
    }

    #[test]
    fn an_exponent_of_zero_is_no_highlight_and_still_a_mirror() {
        let matt = phong_of("Ks 1 1 1\nNs 0");
        assert_eq!(matt.specular, Textured::uniform(Rgb::BLACK));
        let mirror = phong_of("Ks .5 .5 .5\nNs 0\nillum 3");
        assert_eq!(mirror.specular, Textured::uniform(Rgb::BLACK));
        assert_eq!(mirror.reflectivity, Rgb::grey(0.5));
    }

    #[test]
    fn d_counts_before_tr() {
        let blend = |factor| Alpha {
            mode: AlphaMode::Blend,
            coverage: Textured::uniform(factor),
            ..Alpha::OPAQUE
        };
        for (statements, alpha, warnings) in [
            ("", Alpha::OPAQUE, 0),
            ("d 1\nTr 1", Alpha::OPAQUE, 0),
            ("d .25\nTr .5", blend(0.25), 0),
            ("Tr .25", blend(0.75), 0),
            ("Tr 0", Alpha::OPAQUE, 0),
            ("Tr 1", Alpha::OPAQUE, 1),
            ("d 0", blend(0.0), 1),
        ] {
            let (material, told) = made(statements);
            assert_eq!((material.alpha, told), (alpha, warnings), "{statements}");
        }
    }

    #[test]
    fn glass_is_what_says_how_much_light_it_lets_through() {
        let body = Some(Volume {
            attenuation_color: Rgb::WHITE,
            attenuation_distance: f32::INFINITY,
        });
        for (statements, expected) in [
            // How Maya writes what is opaque, and Blender what is a mirror.
            ("illum 4\nTf 1 1 1\nNi 1\nKs 1 1 1", None),
            ("illum 4\nTf 1 1 1", None),
            ("illum 7\nNi 1.5", None),
            ("illum 7\nd .5", None),
            ("illum 7\nNi 1.5\nTf 0 0 0", None),
            // Under another model Tf is no more than a habit of writers.
            ("illum 2\nNi 1.5\nTf 1 1 1", None),
            (
                "illum 7\nNi 1.5\nTf .5 1 2",
                Some((1.0, 1.5, body, Rgb::new(0.5, 1.0, 1.0))),
            ),
            (
                "illum 4\nNi 1.3\nTf 1 1 1\nd .1",
                Some((1.0, 1.3, body, Rgb::WHITE)),
            ),
            (
                "illum 6\nNi 2\nd .25\nKd 1 0 0",
                Some((0.75, 2.0, body, Rgb::new(1.0, 0.0, 0.0))),
            ),
            (
                "illum 6\nNi 2\nTr 1\nKd 0 0 0",
                Some((1.0, 2.0, body, Rgb::WHITE)),
            ),
            (
                "illum 9\nNi 1.45\nd 0\nKd 0 1 0",
                Some((1.0, 1.45, None, Rgb::new(0.0, 1.0, 0.0))),
            ),
            ("illum 4\nd .5", Some((0.5, 1.5, None, GREY))),
        ] {
            let (material, _) = made(statements);
            let Model::Phong(phong) = &material.model else {
                panic!("{statements}")
            };
            let found = material
                .transmission
                .as_ref()
                .map(|t| (t.share.factor, t.ior, t.volume, phong.diffuse.factor));
            assert_eq!(found, expected, "{statements}");
            if found.is_some() {
                assert_eq!(material.alpha, Alpha::OPAQUE, "{statements}");
                assert_eq!(phong.reflectivity, Rgb::BLACK, "{statements}");
            }
        }
    }

    #[test]
    fn a_missing_texture_leaves_the_factor() {
        let (material, warnings) = made("Kd 0 0 0\nmap_Kd gone.png\nmap_d gone.png\nbump gone.png");
        assert_eq!(material.textures().count(), 0);
        assert_eq!(material.alpha, Alpha::OPAQUE);
        assert_eq!(phong_of("map_Kd gone.png").diffuse.factor, GREY);
        assert_eq!(warnings, 1);
    }
}
