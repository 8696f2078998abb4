//! Highlights over a surface's own: those of a clear coat and of sheen.

use super::Reflectance;
use super::facets::{self, Facets};
use super::sheen::{self, Sheen};
use crate::color::Rgb;
use glam::Vec3;

/// What lies over a surface, as lights meet it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Layers {
    /// Fibres; their colour is less what the coat keeps.
    pub sheen: Sheen,
    /// The coat's highlight.
    pub coat_facets: Facets,
    /// The coat's mirror, where it faces another way than the surface; zero where the surface's has it in it.
    pub coat: Coat,
}

/// A clear coat as a mirror of its own.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coat {
    /// The unit normal, turned toward the viewer; zero where it is the surface's.
    pub normal: Vec3,
    /// The share of light that it mirrors.
    pub mirrored: f32,
}

impl Coat {
    /// One that faces where the surface does.
    pub const ALIKE: Coat = Coat {
        normal: Vec3::ZERO,
        mirrored: 0.0,
    };
}

impl Layers {
    /// Nothing.
    pub const NONE: Layers = Layers {
        sheen: Sheen {
            color: Rgb::BLACK,
            roughness: 1.0,
        },
        coat_facets: Facets::NONE,
        coat: Coat::ALIKE,
    };

    /// The coat, where it faces another way than the surface.
    pub fn coat(&self) -> Option<Coat> {
        (self.coat.normal != Vec3::ZERO).then_some(self.coat)
    }

    fn coat_normal(&self, of_surface: Vec3) -> Vec3 {
        self.coat().map_or(of_surface, |coat| coat.normal)
    }

    /// What the layers send back of one light.
    #[inline(never)]
    pub(super) fn reflected(&self, n: Vec3, l: Vec3, v: Vec3, e: Rgb) -> Rgb {
        let of_coat = facets::reflected(&self.coat_facets, self.coat_normal(n), l, v, e);
        of_coat + sheen::reflected(&self.sheen, n, l, v, e)
    }
}

impl Reflectance {
    /// The same surface below something that lets this share of the light through; its own light is not touched.
    pub(super) fn dimmed(&self, share: f32) -> Reflectance {
        Reflectance {
            diffuse: self.diffuse * share,
            specular: self.specular * share,
            facets: self.facets.map(|facets| facets.dimmed(share)),
            reflectivity: self.reflectivity * share,
            gloss: self.gloss * share,
            ambient: self.ambient * share,
            layers: self.layers.map(|layers| Layers {
                sheen: Sheen {
                    color: layers.sheen.color * share,
                    ..layers.sheen
                },
                coat_facets: layers.coat_facets.dimmed(share),
                coat: Coat {
                    mirrored: layers.coat.mirrored * share,
                    ..layers.coat
                },
            }),
            ..*self
        }
    }
}
