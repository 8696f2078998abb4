//! How a slot of a material names a texture, in core glTF and in its extensions alike (section 5.29).

use gltf::json::material::{NormalTexture, OcclusionTexture};
use gltf::json::texture::Info;
use serde_json::{Map, Value};

/// The JSON object of a slot; what else a slot has (`scale`, `strength`) is the slot's own.
#[derive(Clone, Debug, serde::Deserialize)]
#[serde(rename_all = "camelCase")]
pub(super) struct TextureInfo {
    /// Of the file's textures.
    pub(super) index: usize,
    /// Which set of the mesh's texture coordinates.
    #[serde(default)]
    pub(super) tex_coord: u32,
    /// Of this use of the texture.
    #[serde(default)]
    pub(super) extensions: Option<Map<String, Value>>,
}

impl From<&Info> for TextureInfo {
    fn from(info: &Info) -> TextureInfo {
        TextureInfo {
            index: info.index.value(),
            tex_coord: info.tex_coord,
            extensions: info.extensions.as_ref().map(|e| e.others.clone()),
        }
    }
}

impl From<&NormalTexture> for TextureInfo {
    fn from(info: &NormalTexture) -> TextureInfo {
        TextureInfo {
            index: info.index.value(),
            tex_coord: info.tex_coord,
            extensions: info.extensions.as_ref().map(|e| e.others.clone()),
        }
    }
}

impl From<&OcclusionTexture> for TextureInfo {
    fn from(info: &OcclusionTexture) -> TextureInfo {
        TextureInfo {
            index: info.index.value(),
            tex_coord: info.tex_coord,
            extensions: info.extensions.as_ref().map(|e| e.others.clone()),
        }
    }
}
