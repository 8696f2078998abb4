//! What a material is like at one point: every texture looked up.

use super::Scene;
use super::microfacets::{Facing, Seen};
use super::mix::Vertex;
use crate::color::Rgb;
use crate::material::{Alpha, AlphaChannel, AlphaMode, Material, Model, NormalMap, Textured};
use crate::shade::{Reflectance, facets, gloss};
use crate::texture::TextureUse;
use glam::{Vec3, Vec4};

impl Scene {
    pub(super) fn look_up(&self, used: &TextureUse, vertex: &Vertex) -> [f32; 4] {
        let set = usize::from(used.uv_set != 0);
        let uv = used.transform.map_or(vertex.uvs[set], |transform| {
            transform.transform_point2(vertex.uvs[set])
        });
        let Some(texture) = self.textures.get(used.texture as usize) else {
            return [1.0; 4];
        };
        match self.pyramids.get(used.texture) {
            Some(pyramid) => texture.sample_over(pyramid, uv, &vertex.taps(used, &texture.image)),
            None => texture.sample(uv),
        }
    }

    /// How much of what a texture shows is a mean of many pixels, 0..1: the share of the pyramid's levels in it.
    fn blurred(&self, used: &TextureUse, vertex: &Vertex) -> f32 {
        let textures = self.textures.get(used.texture as usize);
        let (Some(texture), Some(_)) = (textures, self.pyramids.get(used.texture)) else {
            return 0.0;
        };
        vertex.taps(used, &texture.image).blurred()
    }

    pub(super) fn color(&self, textured: &Textured<Rgb>, vertex: &Vertex) -> Rgb {
        textured.texture.as_ref().map_or(textured.factor, |used| {
            let [r, g, b, _] = self.look_up(used, vertex);
            textured.factor * Rgb::new(r, g, b)
        })
    }

    pub(super) fn coverage(&self, alpha: &Alpha, vertex: &Vertex) -> f32 {
        if alpha.mode == AlphaMode::Opaque {
            return 1.0;
        }
        let texel = alpha.coverage.texture.as_ref().map_or(1.0, |used| {
            let [red, _, _, a] = self.look_up(used, vertex);
            match alpha.channel {
                AlphaChannel::Alpha => a,
                AlphaChannel::Red => red,
            }
        });
        let factor = alpha.coverage.factor * vertex.color[3];
        let coverage = |texel: f32| (factor * texel).clamp(0.0, 1.0);
        let AlphaMode::Mask { cutoff } = alpha.mode else {
            return coverage(texel);
        };
        let is_there = |texel| f32::from(u8::from(coverage(texel) >= cutoff));
        // Of many pixels, a texture has how many are there.
        let blurred = alpha.coverage.texture.as_ref();
        let blurred = blurred.map_or(0.0, |used| self.blurred(used, vertex));
        if blurred == 0.0 {
            return is_there(texel);
        }
        is_there(texel) * (1.0 - blurred) + is_there(1.0) * texel * blurred
    }

    pub(super) fn reflectance(
        &self,
        material: &Material,
        vertex: &Vertex,
        cos_view: f32,
        coat: Option<Facing>,
    ) -> Reflectance {
        let [r, g, b, _] = vertex.color;
        let tint = Rgb::new(r, g, b);
        let emission = self.color(&material.emission, vertex);
        let seen = Seen {
            vertex,
            tint,
            cos_view,
            coat,
            emission,
        };
        match &material.model {
            Model::Phong(phong) => {
                let diffuse = self.color(&phong.diffuse, vertex) * tint;
                let (specular, shininess) = (self.color(&phong.specular, vertex), phong.shininess);
                let gloss = match self.environment {
                    Some(_) => gloss::of_phong(specular, shininess, cos_view),
                    None => Rgb::BLACK,
                };
                Reflectance {
                    diffuse,
                    color: diffuse,
                    specular,
                    shininess,
                    reflectivity: phong.reflectivity,
                    gloss,
                    roughness: facets::roughness_of(shininess),
                    ambient: diffuse * (1.0 - gloss.max_component()) + gloss,
                    emission,
                    ..Reflectance::BLACK
                }
            }
            Model::MetallicRoughness(m) => self.metallic_roughness(m, &seen),
            Model::SpecularGlossiness(m) => self.specular_glossiness(m, &seen),
            Model::Unlit { color } => {
                let color = self.color(color, vertex) * tint;
                Reflectance {
                    diffuse: color,
                    color,
                    emission: color,
                    ..Reflectance::BLACK
                }
            }
        }
    }

    /// The shading normal of the front, bent by a normal map where the mesh says which way is right.
    pub(super) fn mapped_normal(
        &self,
        map: &NormalMap,
        n: Vec3,
        tangent: Vec4,
        vertex: &Vertex,
    ) -> Vec3 {
        let t = tangent.truncate();
        if t == Vec3::ZERO {
            return n;
        }
        let [x, y, z, _] = self.look_up(&map.texture, vertex);
        let b = n.cross(t) * tangent.w;
        let (x, y, z) = (
            (x * 2.0 - 1.0) * map.scale,
            (y * 2.0 - 1.0) * map.scale,
            z * 2.0 - 1.0,
        );
        (t * x + b * y + n * z).normalize_or(n)
    }
}

/// How a material answers light wherever it is seen, from whatever side; `None` where that depends on the place, as gloss
/// in an environment does.
pub(super) fn plain(material: &Material, in_environment: bool) -> Option<Reflectance> {
    let Model::Phong(phong) = &material.model else {
        return None;
    };
    let glossy = in_environment && phong.specular.factor != Rgb::BLACK;
    let same = material.double_sided
        && material.is_opaque()
        && !glossy
        && material.textures().next().is_none();
    same.then_some(Reflectance {
        diffuse: phong.diffuse.factor,
        color: phong.diffuse.factor,
        specular: phong.specular.factor,
        shininess: phong.shininess,
        reflectivity: phong.reflectivity,
        roughness: facets::roughness_of(phong.shininess),
        ambient: phong.diffuse.factor,
        emission: material.emission.factor,
        ..Reflectance::BLACK
    })
}
