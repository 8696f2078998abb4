//! Light that goes through a surface, at one point: how much, and where it then is.
//!
//! glTF's layers (KHR_materials_transmission, "Transmission BTDF"): what Fresnel's equations do not mirror is diffuse, or
//! goes through and takes the surface's colour. Of that follows:
//!
//! - **Colour.** The base colour (or `diffuse`) tints light each time that it goes through a boundary: once at a thin
//!   sheet, twice on the way through a body, when it enters and when it leaves ("Base color changes the color of light
//!   at the volume boundary", KHR_materials_volume). The path tracers of Dassault and of three.js do the same.
//! - **Thin sheets** mirror what one boundary does, not the two of a real pane: transmission changes nothing about
//!   glTF's specular term. Light goes straight on.
//! - **Sides.** A ray carries no list of the bodies it is in: from the front it enters, from the index 1 into that of the
//!   material; from behind it leaves, back to 1. Glass in water has to be told as such, by an index that is their ratio.
//! - **Roughness** blurs nothing, since a Whitted renderer has one ray for each direction: the mirror before a rough
//!   surface fades as anywhere (see `shade::microfacet`), what goes through stays sharp, and so does the mirror
//!   within a body, without which its total reflections would be dark.

use super::mix::{Mix, Vertex};
use super::{Primitive, Scene};
use crate::color::Rgb;
use crate::geometry::Hit;
use crate::material::{Material, Model, Transmission, Volume};
use crate::ray::Ray;
use crate::shade::{Reflectance, refraction};

/// What becomes of the light at a surface that lets some of it through.
#[derive(Clone, Copy, Debug)]
pub struct Through {
    /// What the surface answers by itself: what is diffuse has given up the share that goes through, and the mirror is
    /// in `mirrored` alone.
    pub rest: Reflectance,
    /// The share that is mirrored.
    pub mirrored: Rgb,
    /// The share that goes through, tinted.
    pub passed: Rgb,
    /// Where that goes.
    pub way: Way,
}

/// Where light goes that went through a surface.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Way {
    /// On as it came: the surface is a thin sheet.
    Straight,
    /// Into a body.
    In {
        /// The material of the body, which has a volume.
        material: u32,
        /// Its index of refraction for each colour.
        indices: Rgb,
    },
    /// Out of a body.
    Out {
        /// One over the body's index of refraction for each colour.
        indices: Rgb,
    },
}

/// What a surface does to a shadow ray.
#[derive(Clone, Copy, Debug)]
pub struct Filter<'a> {
    /// The share of the light that goes on.
    pub share: Rgb,
    /// The body that the ray goes into or comes out of.
    pub volume: Option<&'a Volume>,
    /// Whether it goes in.
    pub enters: bool,
}

impl Scene {
    /// What goes through a surface of a material (and its index) seen at an angle of cosine `cos_view`, and of `cos_true`
    /// with its own normal; `None` where nothing does. `reflectance` is that of the surface if nothing went through.
    ///
    /// From within a body light is reflected totally only where the surface's own normal says so, too: in a thin wall
    /// whose normals are tilted apart near its rim it would be caught, and come out anywhere.
    pub(super) fn through(
        &self,
        (index, material): (u32, &Material),
        vertex: &Vertex,
        reflectance: &Reflectance,
        front: bool,
        [cos_view, cos_true]: [f32; 2],
    ) -> Option<Through> {
        let transmission = material.transmits()?;
        let share = self.share(transmission, vertex);
        let color = let_through(self.tint(material, vertex, reflectance), share);
        if color == Rgb::BLACK {
            return None;
        }
        let indices = refraction::indices(transmission.ior, transmission.dispersion);
        let (way, relative) = match (&transmission.volume, front) {
            (None, _) => (Way::Straight, Rgb::grey(transmission.ior)),
            (Some(_), true) => {
                let material = index;
                (Way::In { material, indices }, indices)
            }
            (Some(_), false) => {
                let indices = indices.map(f32::recip);
                (Way::Out { indices }, indices)
            }
        };
        let fresnel = relative.map(|m| match refraction::fresnel(cos_view, m) {
            1.0 if !front => refraction::fresnel(cos_true, m),
            share => share,
        });
        let mirrored = match (&material.model, way) {
            (Model::MetallicRoughness(_), Way::Out { .. }) => fresnel,
            // Schlick's formula is in it: exact where it stands for Fresnel's alone, tinted or faded as it is.
            (Model::MetallicRoughness(_), _) => {
                let approximate = relative.map(|m| refraction::schlick(cos_view, m));
                let exact = fresnel.by_channel(approximate, ratio);
                (reflectance.reflectivity * exact).map(|share| share.min(1.0))
            }
            _ => reflectance
                .reflectivity
                .by_channel(fresnel, |a, b| a + (1.0 - a) * b),
        };
        // A coat that faces another way is no part of the surface's mirror.
        let coat = reflectance.layers.and_then(|layers| layers.coat());
        let below_coat = coat.map_or(1.0, |coat| 1.0 - coat.mirrored);
        let occlusion = material.occlusion();
        let access = occlusion.map_or(1.0, |occlusion| self.ambient_access(occlusion, vertex));
        // From within a body all that is reflected is in the mirror.
        let gloss = match way {
            Way::Out { .. } => Rgb::BLACK,
            _ => reflectance.gloss,
        };
        let lost = reflectance.gloss - gloss;
        let ambient = reflectance.diffuse * (share * access) + lost;
        Some(Through {
            rest: Reflectance {
                diffuse: reflectance.diffuse * (1.0 - share),
                // Rounding must not make it less than nothing.
                ambient: reflectance
                    .ambient
                    .by_channel(ambient, |a, b| (a - b).max(0.0)),
                reflectivity: Rgb::BLACK,
                gloss,
                ..*reflectance
            },
            mirrored,
            passed: color * fresnel.by_channel(mirrored, |a, b| 1.0 - a.max(b)) * below_coat,
            way,
        })
    }

    /// What tints light on its way through. Diffuse light has less: what is mirrored is taken from what goes through by
    /// itself.
    fn tint(&self, material: &Material, vertex: &Vertex, reflectance: &Reflectance) -> Rgb {
        match &material.model {
            Model::MetallicRoughness(m) => self.body_color(m, vertex),
            _ => reflectance.diffuse,
        }
    }

    /// The share of light that goes through instead of being diffuse.
    fn share(&self, transmission: &Transmission, vertex: &Vertex) -> f32 {
        let texel = transmission.share.texture.as_ref();
        let texel = texel.map_or(1.0, |used| self.look_up(used, vertex)[0]);
        (transmission.share.factor * texel).clamp(0.0, 1.0)
    }

    /// What a surface leaves of a shadow ray's light. The ray does not bend; at a body it loses at either boundary what a
    /// ray of its slope would lose on the way in. Both sides of a surface keep light away.
    pub fn filter(&self, ray: &Ray, hit: &Hit) -> Filter<'_> {
        let material = self.material(self.material_of(hit.primitive));
        let coverage = self.shadow_coverage(hit);
        let Some(transmission) = material.transmits() else {
            let (share, volume) = (Rgb::grey(1.0 - coverage), None);
            return Filter {
                share,
                volume,
                enters: false,
            };
        };
        let surface = self.surface(ray, hit);
        let cos_view = surface.normal.dot(-ray.direction).clamp(0.0, 1.0);
        let vertex = self.vertex(hit);
        let share = self.share(transmission, &vertex);
        let color = let_through(self.tint(material, &vertex, &surface.reflectance), share);
        let fresnel = refraction::fresnel(cos_view, transmission.ior);
        Filter {
            share: Rgb::grey(1.0 - coverage) + color * ((1.0 - fresnel) * coverage),
            volume: transmission.volume.as_ref(),
            enters: surface.place.front,
        }
    }

    /// What textures are looked up with at a hit.
    pub(super) fn vertex(&self, hit: &Hit) -> Vertex {
        let Primitive::Triangle { instance, triangle } = self.primitive(hit.primitive) else {
            return Vertex::neutral();
        };
        let mesh = self.mesh(self.instances[instance].mesh);
        Mix::new(mesh, triangle, hit.barycentric).vertex()
    }
}

/// What goes through of the light behind Fresnel's mirror, where `diffuse` is what would come back diffuse otherwise
/// (nothing from metals); never more than there is.
fn let_through(diffuse: Rgb, share: f32) -> Rgb {
    diffuse.map(|channel| (channel * share).min(1.0))
}

/// `a / b`, 1 where there is no `b`.
fn ratio(a: f32, b: f32) -> f32 {
    if b > 0.0 { a / b } else { 1.0 }
}
