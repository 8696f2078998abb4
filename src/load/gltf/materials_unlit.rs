//! KHR_materials_unlit: a colour that light does not change.

/// As files call it.
pub(super) const NAME: &str = "KHR_materials_unlit";

/// It says nothing but that it is there.
#[derive(serde::Deserialize)]
pub(super) struct Unlit {}
