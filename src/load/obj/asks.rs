//! What an OBJ and its MTLs ask for beside triangles and their colours, and what luch does with it.

use super::geometry::Geometry;
use crate::color::Rgb;
use crate::load::{Ask, Treatment};
use crate::material::{Finish, Material, Model};

/// What the geometry and the materials made of it ask, and then what `lacking` names, which luch does not read.
pub(super) fn all(geometry: &Geometry, materials: &[Material], lacking: &[String]) -> Vec<Ask> {
    let is_mirror = |material: &Material| match &material.model {
        Model::Phong(phong) => phong.reflectivity != Rgb::BLACK,
        _ => false,
    };
    let is_pbr = |material: &Material| matches!(material.model, Model::MetallicRoughness(_));
    let has = |part: fn(&Finish) -> bool| materials.iter().filter_map(finish).any(part);
    let asked = [
        (
            "smoothing groups",
            geometry.faces.iter().any(|face| face.is_smooth),
            Treatment::Honoured,
        ),
        (
            "vertex colors",
            !geometry.colors.is_empty(),
            Treatment::Honoured,
        ),
        (
            "mirrors (illum)",
            materials.iter().any(is_mirror),
            Treatment::Honoured,
        ),
        (
            "glass (illum)",
            materials.iter().any(|m| m.transmission.is_some()),
            Treatment::Honoured,
        ),
        (
            "PBR statements",
            materials.iter().any(is_pbr),
            Treatment::Approximated(
                "Blinn-Phong highlights as wide, mirror rays off what is smooth",
            ),
        ),
        (
            "sheen (Ps)",
            has(|f| f.sheen.is_some()),
            Treatment::Honoured,
        ),
        (
            "clear coat (Pc)",
            has(|f| f.clearcoat.is_some()),
            Treatment::Approximated("a second highlight and mirror along the surface's own normal"),
        ),
        (
            "anisotropy (aniso)",
            has(|f| f.anisotropy.is_some()),
            Treatment::Approximated("a round lobe as high as the long one"),
        ),
        (
            "normal and bump maps",
            materials.iter().any(|m| m.normal_map.is_some()),
            Treatment::Honoured,
        ),
        ("points", geometry.points > 0, Treatment::Ignored),
        ("line segments", geometry.lines > 0, Treatment::Ignored),
    ];
    let asked = asked.into_iter().filter(|(_, is_asked, _)| *is_asked);
    let asked = asked.map(|(what, _, treatment)| ask(what, treatment));
    let lacks = geometry.lacks.iter().copied();
    let lacking = lacks.chain(lacking.iter().map(String::as_str));
    asked
        .chain(lacking.map(|what| ask(what, Treatment::Ignored)))
        .collect()
}

fn ask(what: &str, treatment: Treatment) -> Ask {
    Ask {
        what: what.into(),
        required: false,
        treatment,
    }
}

fn finish(material: &Material) -> Option<&Finish> {
    match &material.model {
        Model::MetallicRoughness(made) => made.finish.as_deref(),
        _ => None,
    }
}
