//! What several tests share.

pub(crate) mod picture;
pub(crate) mod scenes;
