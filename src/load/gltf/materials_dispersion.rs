//! KHR_materials_dispersion: colours that bend unlike.

use super::materials::Reader;

/// As files call it.
pub(super) const NAME: &str = "KHR_materials_dispersion";

/// What it says.
#[derive(Default, serde::Deserialize)]
#[serde(default, expecting = "an object")]
pub(super) struct Dispersion {
    /// 20 divided by Abbe's number; above 1 only to exaggerate.
    dispersion: f32,
}

impl Dispersion {
    pub(super) fn read(&self, reader: &mut Reader) -> f32 {
        reader.within("dispersion", self.dispersion, super::BRIGHTEST)
    }
}
