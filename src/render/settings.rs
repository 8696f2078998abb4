//! What a picture should be like, checked once.

mod error;

pub use error::SettingsError;

use super::matte::KnownShares;
use super::record::Record;
use crate::color::Rgb;
use crate::film::{Layers, Quantity, Window};
use crate::sampling::{BASE, Grid, MAX_SAMPLES, Pattern, Sampling};
use crate::scene::Scene;
use crate::shade::Shading;
use crate::texture::TextureFilter;
use crate::whitted::Counts;

/// What a picture should be like.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Settings {
    pub(super) width: u32,
    pub(super) height: u32,
    pub(super) window: Window,
    pub(super) sampling: Sampling,
    pub(super) max_depth: u32,
    pub(super) shading: Shading,
    pub(super) tile_side: u32,
    pub(super) layers: Layers,
    pub(super) texture_filter: TextureFilter,
}

/// The most memory a film may take.
pub(super) const MAX_FILM_BYTES: u64 = 4 << 30;
/// The furthest column and row, of either sign: as far as an EXR's windows reach.
const MAX_PLACE: i32 = i32::MAX / 2;
/// The most mirror bounces that can be asked for.
pub(super) const MAX_DEPTH: u32 = 10_000;
/// Tiles of this side are one batch of rays, large enough for packets of 64.
const TILE_SIDE: u32 = 8;

impl Settings {
    /// A picture of `width x height` pixels with `samples` (a square number) a pixel, the paper's grid, and at most
    /// `max_depth` mirror bounces.
    ///
    /// # Errors
    ///
    /// No pixels, more of them than 4 GiB hold, samples that are not a square number, a depth above
    /// 10,000.
    pub fn new(
        width: u32,
        height: u32,
        samples: u32,
        max_depth: u32,
        shading: Shading,
    ) -> Result<Settings, SettingsError> {
        if width == 0 || height == 0 {
            return Err(SettingsError::NoPixels { width, height });
        }
        let settings = Settings {
            width,
            height,
            window: Window::whole(width, height),
            sampling: Sampling::grid(1),
            max_depth,
            shading,
            tile_side: TILE_SIDE,
            layers: Layers::default(),
            texture_filter: TextureFilter::default(),
        };
        settings.check_bytes()?;
        if max_depth > MAX_DEPTH {
            return Err(SettingsError::TooDeep { max_depth });
        }
        settings.with_sampling(Sampling::grid(samples))
    }

    /// The same picture of other samples.
    ///
    /// # Errors
    ///
    /// None of them, more than 65,536, a grid of no square number; more than 4 GiB of pixels.
    pub fn with_sampling(self, sampling: Sampling) -> Result<Settings, SettingsError> {
        let samples = sampling.samples;
        match sampling.pattern {
            Pattern::Grid if Grid::with_samples(samples).is_none() => {
                let side = samples.min(MAX_SAMPLES).isqrt().max(1);
                let above = ((side + 1) * (side + 1)).min(MAX_SAMPLES);
                return Err(SettingsError::NotSquare {
                    samples,
                    below: side * side,
                    above,
                });
            }
            _ if samples == 0 || samples > MAX_SAMPLES => {
                return Err(SettingsError::NoSamples { samples });
            }
            _ => {}
        }
        let settings = Settings { sampling, ..self };
        settings.check_bytes()?;
        Ok(settings)
    }

    /// The same picture with these layers.
    ///
    /// # Errors
    ///
    /// More than 4 GiB of pixels.
    pub fn with_layers(self, layers: Layers) -> Result<Settings, SettingsError> {
        let settings = Settings { layers, ..self };
        settings.check_bytes()?;
        Ok(settings)
    }

    /// Those pixels of the same picture that are in `window`, which may reach beyond it (overscan): each has the bits that
    /// it has in any other window.
    ///
    /// # Errors
    ///
    /// No pixels, more than 4 GiB of them, or further than 1,073,741,823 columns or rows from the picture's first.
    pub fn with_window(self, window: Window) -> Result<Settings, SettingsError> {
        let Window { width, height, .. } = window;
        if width == 0 || height == 0 {
            return Err(SettingsError::NoPixels { width, height });
        }
        let furthest = i64::from(MAX_PLACE);
        let is_near = window.left >= -MAX_PLACE && window.top >= -MAX_PLACE;
        if !is_near || window.right() > furthest || window.bottom() > furthest {
            return Err(SettingsError::TooFar { window });
        }
        let settings = Settings { window, ..self };
        settings.check_bytes()?;
        Ok(settings)
    }

    /// The same picture, rendered in tiles of `side` pixels (at least 1): no pixel depends on it.
    pub fn with_tile_side(self, side: u32) -> Settings {
        Settings {
            tile_side: side.max(1),
            ..self
        }
    }

    /// The same picture, its textures shown so.
    pub fn with_texture_filter(self, texture_filter: TextureFilter) -> Settings {
        Settings {
            texture_filter,
            ..self
        }
    }

    /// Makes ready what a render of `scene` will look up: [`super::render`] does it by itself; who calls it before has
    /// something else done meanwhile.
    pub fn prepare(&self, scene: &Scene) {
        if self.texture_filter == TextureFilter::Footprint {
            scene.prepare_textures();
        }
    }

    /// What a film takes while it is rendered, in bytes.
    pub fn film_bytes(&self) -> u64 {
        let layers = self.layers.list(&[]);
        let whole = layers
            .iter()
            .filter(|layer| !matches!(layer.quantity, Quantity::Part(_)));
        let channels: usize = whole.map(|layer| layer.channels.len()).sum();
        let parts = self.layers.parts() * size_of::<Rgb>();
        let film = channels * size_of::<f32>() + parts;
        let mut known = 0;
        if self.is_adaptive() {
            known += size_of::<Record>() + parts;
            known += usize::from(self.layers.cost) * size_of::<Counts>();
            known += usize::from(self.layers.mattes) * size_of::<KnownShares>();
        }
        let bytes =
            |window: Window, of_pixel: usize| window.pixels().saturating_mul(of_pixel as u64);
        bytes(self.window, film).saturating_add(bytes(self.area(), known))
    }

    /// The pixels that the first pass sees: those of the window, and where sampling is adaptive those around it, which
    /// its pixels are compared with. Inside a picture they end with it.
    pub(super) fn area(&self) -> Window {
        let display = Window::whole(self.width, self.height);
        let around = self.window.grown(u32::from(self.is_adaptive()));
        if self.window.is_within(display) {
            around.shared(display).unwrap_or(around)
        } else {
            around
        }
    }

    /// Finds whether that is too much.
    fn check_bytes(&self) -> Result<(), SettingsError> {
        let bytes = self.film_bytes();
        if bytes > MAX_FILM_BYTES {
            return Err(SettingsError::TooLarge {
                width: self.window.width,
                height: self.window.height,
                bytes,
            });
        }
        Ok(())
    }

    /// Whether some pixels can get more samples than others.
    pub fn is_adaptive(&self) -> bool {
        self.sampling.adaptive && self.sampling.samples > BASE
    }

    /// Which pixels of the picture are rendered.
    pub fn window(&self) -> Window {
        self.window
    }

    /// Of the whole picture, in pixels.
    pub fn width(&self) -> u32 {
        self.width
    }

    /// Of the whole picture, in pixels.
    pub fn height(&self) -> u32 {
        self.height
    }

    /// The most mirror bounces.
    pub fn max_depth(&self) -> u32 {
        self.max_depth
    }

    /// A pixel; the most, where sampling is adaptive.
    pub fn samples(&self) -> u32 {
        self.sampling.samples
    }

    /// How surfaces answer light.
    pub fn shading(&self) -> Shading {
        self.shading
    }

    /// Which part of a texture a ray shows.
    pub fn texture_filter(&self) -> TextureFilter {
        self.texture_filter
    }

    /// The samples of a pixel.
    pub fn sampling(&self) -> Sampling {
        self.sampling
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn asked(width: u32, height: u32, samples: u32) -> Result<Settings, String> {
        Settings::new(width, height, samples, 5, Shading::BlinnPhong)
            .map_err(|error| error.to_string())
    }

    #[test]
    fn pictures_of_no_size_or_too_great_a_size_are_refused_before_memory_is_taken() {
        assert_eq!(
            asked(0, 4, 1),
            Err("a picture of 0 x 4 pixels has no pixels; both must be above 0".into())
        );
        let refused = asked(100_000, 100_000, 1).err();
        assert_eq!(
            refused.as_deref(),
            Some(
                "a picture of 100000 x 100000 pixels needs 200000 MB of memory, more than the 4294 MB allowed; make it smaller"
            )
        );
        assert!(asked(u32::MAX, u32::MAX, 1).is_err());
        // 20 bytes a pixel fit, 28 do not.
        let settings = Settings::new(14_000, 14_000, 1, 5, Shading::BlinnPhong);
        let layers = Layers {
            cost: true,
            ..Layers::default()
        };
        let refused = settings.and_then(|settings| settings.with_layers(layers));
        assert!(matches!(
            refused,
            Err(SettingsError::TooLarge {
                bytes: 5_488_000_000,
                ..
            })
        ));
    }

    #[test]
    fn samples_that_make_no_grid_get_the_nearest_ones_that_do() {
        assert_eq!(
            asked(4, 4, 5),
            Err("5 samples a pixel do not make a square grid; use 4 or 9".into())
        );
        assert_eq!(
            asked(4, 4, 0),
            Err("0 samples a pixel do not make a square grid; use 1 or 4".into())
        );
        assert!(asked(4, 4, 65_536).is_ok() && asked(4, 4, u32::MAX).is_err());
    }
}
