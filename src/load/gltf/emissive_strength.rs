//! KHR_materials_emissive_strength: materials that shine brighter than 1.

/// As files call it.
pub(super) const NAME: &str = "KHR_materials_emissive_strength";

/// Multiplies the emissive factor.
#[derive(serde::Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct EmissiveStrength {
    /// 0 or more.
    #[serde(default = "one")]
    pub(super) emissive_strength: f32,
}

fn one() -> f32 {
    1.0
}
