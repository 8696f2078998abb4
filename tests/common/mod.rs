//! What several tests share.

pub(crate) mod models;
pub(crate) mod picture;
pub(crate) mod scenes;
