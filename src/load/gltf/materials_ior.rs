//! KHR_materials_ior: the index of refraction of what is not metal.

use super::materials::Reader;

/// As files call it.
pub(super) const NAME: &str = "KHR_materials_ior";

/// Of glass, and of every material that does not say it.
pub(super) const DEFAULT: f32 = 1.5;
/// The greatest that is taken as it is: nothing known has one above 40.
const GREATEST: f32 = 1e3;

/// What it says.
#[derive(serde::Deserialize)]
#[serde(default, expecting = "an object")]
pub(super) struct Ior {
    /// 1 or more; or 0, which stands for infinity: then colours alone say what is reflected.
    ior: f32,
}

impl Default for Ior {
    fn default() -> Ior {
        Ior { ior: DEFAULT }
    }
}

impl Ior {
    /// For what is reflected; infinite where the file says 0.
    pub(super) fn reflecting(&self, reader: &mut Reader) -> f32 {
        if self.ior == 0.0 {
            return f32::INFINITY;
        }
        reader.between("ior", self.ior, 1.0, GREATEST)
    }

    /// For what is bent, which needs a number.
    pub(super) fn bending(&self) -> f32 {
        if self.ior == 0.0 {
            return GREATEST;
        }
        self.ior.clamp(1.0, GREATEST)
    }
}
