//! KHR_materials_volume: what lies behind a surface that lets light through.

use super::materials::Reader;
use crate::material;

/// As files call it.
pub(super) const NAME: &str = "KHR_materials_volume";

/// What it says. Its texture of thickness is for renderers that cannot measure the way of light; luch's rays do.
#[derive(serde::Deserialize)]
#[serde(rename_all = "camelCase", default, expecting = "an object")]
pub(super) struct Volume {
    /// 0 for a thin sheet.
    thickness_factor: f32,
    /// Infinite, and then not in the file, where nothing is lost.
    attenuation_distance: f32,
    attenuation_color: [f32; 3],
}

impl Default for Volume {
    fn default() -> Volume {
        Volume {
            thickness_factor: 0.0,
            attenuation_distance: f32::INFINITY,
            attenuation_color: [1.0; 3],
        }
    }
}

impl Volume {
    /// Nothing where the surface is a thin sheet.
    pub(super) fn read(&self, reader: &mut Reader) -> Option<material::Volume> {
        if self.thickness_factor.is_nan() || self.thickness_factor <= 0.0 {
            return None;
        }
        let distance = self.attenuation_distance;
        let attenuation_distance = if distance > 0.0 {
            distance
        } else {
            reader.warn(&format!(
                "its attenuationDistance is {distance}, taken as none"
            ));
            f32::INFINITY
        };
        Some(material::Volume {
            attenuation_color: reader.color("attenuationColor", self.attenuation_color, 1.0),
            attenuation_distance,
        })
    }
}
