//! Materials that light goes through.
//!
//! `illum` says that there is glass (4, 9) or refraction (6, 7). How much passes is said by `Tf`, the colour that light
//! takes on, or else by `d`:
//!
//! - With `Tf` all light that does not come back passes, and takes on its colour.
//! - Else `1 - d` of it passes, and takes on the diffuse colour, or none where that is black.
//! - It bends by `Ni` where `illum` is 6 or 7, or where there is `Tf`; else the surface is a thin sheet, as glass is in
//!   Blender's files of `illum 9`.
//! - Where `Ni` is 1, or none is given beside `Tf` or refraction, nothing is glass: Maya writes `illum 4`, `Tf 1 1 1`
//!   and `Ni 1` for what is opaque. `d` is coverage then, as under every other `illum`.
//!
//! The share that comes back is Fresnel's, and `Ks` is its highlight alone.

use super::mtl::MtlMaterial;
use crate::color::Rgb;
use crate::material::{Textured, Transmission, Volume};

/// Window glass, for thin sheets whose file says nothing.
const GLASS: f32 = 1.5;

/// What of a material is different because light goes through.
pub(super) struct Glass {
    pub(super) transmission: Transmission,
    /// Stands for the diffuse colour.
    pub(super) tint: Rgb,
}

/// How light goes through, if it does; `diffuse` is the colour it has otherwise, `dissolve` what `d` or `Tr` say.
pub(super) fn glass(mtl: &MtlMaterial, diffuse: Rgb, dissolve: f32) -> Option<Glass> {
    let refracts = match mtl.illumination? {
        4 | 9 => false,
        6 | 7 => true,
        _ => return None,
    };
    let bends = refracts || mtl.filter.is_some();
    let ior = mtl.ior.unwrap_or(if bends { 1.0 } else { GLASS });
    let (share, tint) = match mtl.filter {
        Some(Rgb::BLACK) => return None,
        Some(filter) => (1.0, filter.map(|channel| channel.min(1.0))),
        None if diffuse == Rgb::BLACK => (1.0 - dissolve, Rgb::WHITE),
        None => (1.0 - dissolve, diffuse),
    };
    if ior == 1.0 || share <= 0.0 {
        return None;
    }
    let volume = Volume {
        attenuation_color: Rgb::WHITE,
        attenuation_distance: f32::INFINITY,
    };
    Some(Glass {
        transmission: Transmission {
            share: Textured::uniform(share),
            ior,
            dispersion: 0.0,
            volume: bends.then_some(volume),
        },
        tint,
    })
}
