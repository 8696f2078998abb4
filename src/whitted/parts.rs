//! What a sample's light is made of: what surfaces did to it, where it came from, how many mirrors it met.

use super::batch::Path;
use crate::color::Rgb;
use crate::film::{Layers, Source};

/// What happened to light first, seen from the camera.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum By {
    /// Nothing: the surface that it left is seen itself, or behind what is not wholly there.
    Sight,
    /// A mirror.
    Mirror,
    /// Something that lets light through.
    Glass,
}

impl By {
    /// After something else happened, nearer to where light comes from.
    pub(super) fn then(self, other: By) -> By {
        match self {
            By::Sight => other,
            _ => self,
        }
    }
}

/// What was done to light where it is seen itself: places in [`crate::film::COMPONENTS`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Did {
    /// Scattered to all sides.
    Scatter = 0,
    /// Sent on about the mirrored direction.
    Gloss = 1,
    /// Nothing: it comes from there.
    Emit = 4,
    /// Scattered, being constant ambient light.
    Ambient = 5,
}

/// In the place of [`Did`].
const REFLECTION: usize = 2;
const TRANSMISSION: usize = 3;

/// The parts of the light of a batch's samples.
#[derive(Debug)]
pub struct Parts {
    layers: Layers,
    /// Sample by sample, part by part.
    values: Vec<Rgb>,
}

impl Parts {
    /// What `layers` ask for; `None` where they ask for no part.
    pub fn of(layers: Layers) -> Option<Parts> {
        let values = Vec::new();
        (layers.parts() > 0).then_some(Parts { layers, values })
    }

    /// Forgets all, for so many samples.
    pub(super) fn start(&mut self, samples: usize) {
        self.values.clear();
        self.values
            .resize(samples * self.layers.parts(), Rgb::BLACK);
    }

    /// Each sample's parts, in the order of the film's layers.
    pub fn of_samples(&self) -> impl Iterator<Item = &[Rgb]> {
        self.values.chunks_exact(self.layers.parts().max(1))
    }

    /// Takes note of light that a sample gets along a path.
    pub(super) fn add(&mut self, path: &Path, did: Did, source: Source, light: Rgb) {
        let count = self.layers.parts();
        let start = path.sample as usize * count;
        let Some(parts) = self.values.get_mut(start..start + count) else {
            return;
        };
        let component = match path.by {
            By::Sight => did as usize,
            By::Mirror => REFLECTION,
            By::Glass => TRANSMISSION,
        };
        let mirrored = match path.by {
            By::Mirror => self.layers.mirrored(path.bounces),
            _ => None,
        };
        let of = [
            self.layers.component(component),
            self.layers.source(source),
            mirrored,
        ];
        for part in of.into_iter().flatten() {
            if let Some(sum) = parts.get_mut(part) {
                *sum += light;
            }
        }
    }
}
