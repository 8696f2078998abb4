//! KHR_node_visibility: nodes that are not seen, with all that is below them.

/// As files call it.
pub(super) const NAME: &str = "KHR_node_visibility";

/// What a node says.
#[derive(serde::Deserialize)]
pub(super) struct Visibility {
    /// Whether it is seen, if everything above it is.
    #[serde(default = "yes")]
    pub(super) visible: bool,
}

fn yes() -> bool {
    true
}
