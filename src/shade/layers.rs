//! Highlights over a surface's own: those of a clear coat and of sheen.

use super::sheen::{self, Sheen};
use super::{Reflectance, blinn_phong, phong};
use crate::color::Rgb;
use glam::Vec3;

/// What lies over a surface, as lights meet it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layers {
    /// Fibres; their colour is less what the coat keeps.
    pub sheen: Sheen,
    /// `k_s` of the coat.
    pub coat_specular: f32,
    /// The exponent of the coat's highlight.
    pub coat_shininess: f32,
}

impl Layers {
    /// Nothing.
    pub const NONE: Layers = Layers {
        sheen: Sheen {
            color: Rgb::BLACK,
            roughness: 1.0,
        },
        coat_specular: 0.0,
        coat_shininess: 0.0,
    };

    fn coat(&self) -> Reflectance {
        Reflectance {
            specular: Rgb::grey(self.coat_specular),
            shininess: self.coat_shininess,
            ..Reflectance::BLACK
        }
    }

    /// What the layers send back of one light, the coat's highlight being Blinn's.
    #[inline(never)]
    pub(super) fn blinn_phong(&self, n: Vec3, l: Vec3, v: Vec3, e: Rgb) -> Rgb {
        blinn_phong::reflected(&self.coat(), n, l, v, e) + sheen::reflected(&self.sheen, n, l, v, e)
    }

    /// The same, the coat's highlight being Phong's.
    #[inline(never)]
    pub(super) fn phong(&self, n: Vec3, l: Vec3, v: Vec3, e: Rgb) -> Rgb {
        phong::reflected(&self.coat(), n, l, v, e) + sheen::reflected(&self.sheen, n, l, v, e)
    }
}

impl Reflectance {
    /// The same surface below something that lets this share of the light through; its own light is not touched.
    pub(super) fn dimmed(&self, share: f32) -> Reflectance {
        Reflectance {
            diffuse: self.diffuse * share,
            specular: self.specular * share,
            reflectivity: self.reflectivity * share,
            ambient: self.ambient * share,
            layers: self.layers.map(|layers| Layers {
                sheen: Sheen {
                    color: layers.sheen.color * share,
                    ..layers.sheen
                },
                coat_specular: layers.coat_specular * share,
                ..layers
            }),
            ..*self
        }
    }
}
