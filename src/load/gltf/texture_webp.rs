//! EXT_texture_webp: textures whose image is WebP.

/// As files call it.
pub(super) const NAME: &str = "EXT_texture_webp";

/// Where the image is; the texture's own `source` is for who cannot read it.
#[derive(serde::Deserialize)]
pub(super) struct TextureWebp {
    /// An index into the file's images; some files say only that the texture's own is WebP.
    pub(super) source: Option<usize>,
}
