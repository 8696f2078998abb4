//! KHR_mesh_quantization: positions, normals, tangents and texture coordinates as integers of 8 or 16 bits.
//!
//! There is nothing to do for it: attributes are read from every component type. The file's own nodes and texture
//! transforms scale what integers stand for.

/// As files call it.
pub(super) const NAME: &str = "KHR_mesh_quantization";
