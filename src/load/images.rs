//! Image files: PNG, JPEG, BMP, TGA, GIF.

use crate::texture::Image;

/// Decodes an image file, whose kind its first bytes tell (TGA: `name`'s ending).
///
/// # Errors
///
/// One line that says what is wrong, without the image's name.
pub(super) fn decode(name: &str, bytes: &[u8]) -> Result<Image, String> {
    let _ = (name, bytes);
    Err("not yet".into())
}
