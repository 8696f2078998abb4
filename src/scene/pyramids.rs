//! The smaller versions of a scene's textures, made when a picture asks for them.

use super::Scene;
use crate::material::{AlphaChannel, AlphaMode, Material};
use crate::texture::{Encoding, Fourth, Image, Pyramid, Texture};
use rayon::iter::{IntoParallelRefIterator, ParallelIterator};
use std::collections::HashMap;
use std::sync::{Arc, OnceLock};

/// One pyramid for each image and use of it, however many textures show it.
#[derive(Clone, Debug)]
pub(super) struct Pyramids {
    /// Of each texture; `None` where no material shows it, and where it is to be looked up as it is.
    of_textures: Vec<Option<usize>>,
    all: Vec<Planned>,
}

/// A pyramid, once it is made, and what it is made of.
#[derive(Clone, Debug)]
struct Planned {
    image: Arc<Image>,
    encoding: Encoding,
    fourth: Fourth,
    made: OnceLock<Pyramid>,
}

impl Pyramids {
    /// Of textures as materials use them; indices must be in range.
    pub(super) fn of(textures: &[Texture], materials: &[Material]) -> Pyramids {
        let mut fourths = vec![None; textures.len()];
        for used in materials.iter().flat_map(Material::textures) {
            fourths[used.texture as usize] = Some(Fourth::Number);
        }
        // The first material that reads coverage says how: others with another cutoff are rare.
        for material in materials.iter().rev() {
            let alpha = &material.alpha;
            let fourth = match alpha.mode {
                AlphaMode::Opaque => continue,
                // Written so that a factor of 0 leaves nothing there.
                AlphaMode::Mask { cutoff } => Fourth::Mask {
                    cutoff: cutoff / alpha.coverage.factor.max(0.0),
                },
                AlphaMode::Blend => Fourth::Coverage,
            };
            if let (AlphaChannel::Alpha, Some(used)) = (alpha.channel, &alpha.coverage.texture) {
                fourths[used.texture as usize] = Some(fourth);
            }
        }
        let mut known = HashMap::new();
        let mut all = Vec::new();
        let plan = |(texture, fourth): (&Texture, Option<Fourth>)| {
            let fourth = fourth.filter(|_| texture.mipmaps)?;
            let cutoff = match fourth {
                Fourth::Number => None,
                Fourth::Coverage => Some(None),
                Fourth::Mask { cutoff } => Some(Some(cutoff.to_bits())),
            };
            let is_color = texture.encoding == Encoding::Srgb;
            let key = (Arc::as_ptr(&texture.image), is_color, cutoff);
            Some(*known.entry(key).or_insert_with(|| {
                all.push(Planned {
                    image: texture.image.clone(),
                    encoding: texture.encoding,
                    fourth,
                    made: OnceLock::new(),
                });
                all.len() - 1
            }))
        };
        let of_textures = textures.iter().zip(fourths).map(plan).collect();
        Pyramids { of_textures, all }
    }

    /// What all of them take, made or not, in bytes.
    pub(super) fn bytes(&self) -> u64 {
        let bytes = |planned: &Planned| Pyramid::bytes_over(&planned.image);
        self.all.iter().map(bytes).fold(0, u64::saturating_add)
    }

    /// That of a texture, if there is one and it is made.
    #[inline]
    pub(super) fn get(&self, texture: u32) -> Option<&Pyramid> {
        let index = self.of_textures.get(texture as usize).copied().flatten()?;
        self.all.get(index)?.made.get()
    }
}

/// The smaller versions of textures that a scene had made, for one that shows the same images.
#[derive(Debug)]
pub struct PreparedTextures(Vec<Planned>);

impl Scene {
    /// What remains of a scene for the next one.
    pub fn into_textures(self) -> PreparedTextures {
        PreparedTextures(self.pyramids.all)
    }

    /// The same scene, in which nothing is made again that an earlier one of the same asset had made.
    pub fn with_textures(mut self, PreparedTextures(earlier): PreparedTextures) -> Scene {
        for (planned, known) in self.pyramids.all.iter_mut().zip(earlier) {
            let is_of_the_same_image = Arc::ptr_eq(&planned.image, &known.image);
            let is_made_the_same_way =
                (planned.encoding, planned.fourth) == (known.encoding, known.fourth);
            if is_of_the_same_image && is_made_the_same_way {
                planned.made = known.made;
            }
        }
        self
    }

    /// Makes the smaller versions of textures that a picture with [`TextureFilter::Footprint`] needs, on the threads of the
    /// rayon pool it is called from. `render` does it by itself; who calls this before has something else done meanwhile.
    ///
    /// [`TextureFilter::Footprint`]: crate::texture::TextureFilter::Footprint
    pub fn prepare_textures(&self) {
        self.pyramids.all.par_iter().for_each(|planned| {
            if planned.made.get().is_none() {
                // Not inside the lock, where a thread that waits could take up work that waits for the same lock.
                let pyramid = Pyramid::of(&planned.image, planned.encoding, planned.fourth);
                // Whoever came first made the same.
                let _ = planned.made.set(pyramid);
            }
        });
    }
}
