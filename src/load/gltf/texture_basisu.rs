//! KHR_texture_basisu: textures whose image is KTX2 with Basis Universal.

/// As files call it.
pub(super) const NAME: &str = "KHR_texture_basisu";

/// Where the image is; the texture's own `source` is for who cannot read it.
#[derive(serde::Deserialize)]
pub(super) struct TextureBasisu {
    /// An index into the file's images.
    pub(super) source: usize,
}
