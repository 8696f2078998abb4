//! Lights without extent: point, directional, spot.

use crate::color::Rgb;
use glam::Vec3;

/// A light of a scene.
#[derive(Clone, Debug, PartialEq)]
pub struct Light {
    /// As in the file; may be empty.
    pub name: String,
    /// Its shape.
    pub kind: LightKind,
    /// Linear colour.
    pub color: Rgb,
    /// The factor on `color`. At distance 1 (or at any, where nothing falls off) a white matt surface that faces the
    /// light shows `color * intensity`: the paper's units, π times less than radiometric ones.
    pub intensity: f32,
    /// How the light of points and spots weakens with distance.
    pub falloff: Falloff,
    /// Beyond this distance there is no light, approached smoothly (KHR_lights_punctual); `None` for no limit.
    pub range: Option<f32>,
}

/// The shape of a light.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum LightKind {
    /// Light from a point to all sides.
    Point {
        /// World space.
        position: Vec3,
    },
    /// Parallel light.
    Directional {
        /// Where the light travels; unit length.
        direction: Vec3,
    },
    /// Light from a point into a cone.
    Spot {
        /// World space.
        position: Vec3,
        /// Where the light of the axis travels; unit length.
        direction: Vec3,
        /// Half the angle of the cone of full light, radians.
        inner_angle: f32,
        /// Half the angle of the cone that has any light, radians; above `inner_angle`, at most π/2.
        outer_angle: f32,
    },
}

/// How light weakens with distance.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum Falloff {
    /// Not at all (the paper's).
    #[default]
    None,
    /// With the square of the distance (nature's, and glTF's).
    InverseSquare,
}

/// What a light sends to a point, as long as nothing lies between.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Illumination {
    /// `l`, unit, from the point toward the light.
    pub to_light: Vec3,
    /// How far the light is; infinity for a directional one.
    pub distance: f32,
    /// `E`, on a surface that faces the light.
    pub irradiance: Rgb,
}

impl Light {
    /// What the light sends to `point`; `None` where that is nothing: outside a cone, past the range, at the light.
    #[inline]
    pub fn illuminate(&self, point: Vec3) -> Option<Illumination> {
        Lamp::of(self).illuminate(point)
    }
}

/// A light made ready for many points: what is the same for all of them is reckoned once.
#[derive(Clone, Copy, Debug)]
pub struct Lamp {
    /// Where its light comes from; no matter where that is no point.
    position: Vec3,
    /// Where a directional light travels; `None` for the others.
    direction: Option<Vec3>,
    emitted: Rgb,
    weakens: bool,
    /// Infinity where there is no limit.
    range: f32,
    /// Where the light of a spot's axis travels; zero for the others.
    axis: Vec3,
    cone: Cone,
}

impl Lamp {
    /// A light made ready.
    pub fn of(light: &Light) -> Lamp {
        let lamp = Lamp {
            position: Vec3::ZERO,
            direction: None,
            emitted: light.color * light.intensity,
            weakens: light.falloff == Falloff::InverseSquare,
            range: light.range.unwrap_or(f32::INFINITY),
            axis: Vec3::ZERO,
            cone: Cone::EVERYWHERE,
        };
        match light.kind {
            LightKind::Point { position } => Lamp { position, ..lamp },
            LightKind::Directional { direction } => Lamp {
                direction: Some(direction),
                ..lamp
            },
            LightKind::Spot {
                position,
                direction,
                inner_angle,
                outer_angle,
            } => Lamp {
                position,
                axis: direction,
                cone: Cone::new(inner_angle, outer_angle),
                ..lamp
            },
        }
    }

    /// Where its light comes from; `None` where that is no point.
    #[inline(always)]
    pub fn position(&self) -> Option<Vec3> {
        self.direction.is_none().then_some(self.position)
    }

    /// What every point gets that faces it, where its light is parallel.
    pub fn parallel(&self) -> Option<Illumination> {
        self.direction.map(|direction| Illumination {
            to_light: -direction,
            distance: f32::INFINITY,
            irradiance: self.emitted,
        })
    }

    /// [`Light::illuminate`].
    pub fn illuminate(&self, point: Vec3) -> Option<Illumination> {
        self.parallel().or_else(|| {
            let (light, arrives) = self.shine(point);
            arrives.then_some(light)
        })
    }

    /// What a light that shines from a point sends to `point`, and whether that is anything. Without a branch, so that a
    /// loop over points becomes one over registers: what this light has not is there with numbers that change nothing.
    #[inline(always)]
    pub fn shine(&self, point: Vec3) -> (Illumination, bool) {
        let toward = self.position - point;
        // Not `length`, which calls `libm`: the compiler's own root is as exact, and SIMD.
        let distance = toward.length_squared().sqrt();
        let to_light = toward / distance;
        let squared = 1.0 / (distance * distance);
        let weakened = if self.weakens { squared } else { 1.0 };
        let attenuation = weakened * range_attenuation(distance, self.range);
        let cone = self.cone.attenuation(self.axis.dot(-to_light));
        let light = Illumination {
            to_light,
            distance,
            irradiance: self.emitted * attenuation * cone,
        };
        (
            light,
            (distance != 0.0) & (attenuation > 0.0) & (cone > 0.0),
        )
    }
}

/// A spot's cone (KHR_lights_punctual, "Inner and Outer Cone Angles").
#[derive(Clone, Copy, Debug)]
struct Cone {
    cos_outer: f32,
    /// The ramp's rise for each unit of the cosine.
    scale: f32,
}

impl Cone {
    /// Every cosine is past its ramp.
    const EVERYWHERE: Cone = Cone {
        cos_outer: -3.0,
        scale: 1.0,
    };

    fn new(inner_angle: f32, outer_angle: f32) -> Cone {
        let cos_outer = libm::cosf(outer_angle);
        let scale = 1.0 / (libm::cosf(inner_angle) - cos_outer).max(0.001);
        Cone { cos_outer, scale }
    }

    /// The share of light inside: 1 to the inner half-angle, 0 from the outer one on, between them the square of a
    /// ramp in the cosine.
    #[inline(always)]
    fn attenuation(&self, cos_angle: f32) -> f32 {
        let ramp = ((cos_angle - self.cos_outer) * self.scale).clamp(0.0, 1.0);
        ramp * ramp
    }
}

/// `max(min(1 - (distance / range)^4, 1), 0)` (KHR_lights_punctual, "Range Property").
#[inline(always)]
fn range_attenuation(distance: f32, range: f32) -> f32 {
    let ratio = distance / range;
    (1.0 - ratio * ratio * ratio * ratio).clamp(0.0, 1.0)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f32::consts::FRAC_PI_4;

    fn light(kind: LightKind) -> Light {
        let (color, falloff) = (Rgb::new(1.0, 0.5, 0.25), Falloff::None);
        Light {
            name: String::new(),
            kind,
            color,
            intensity: 2.0,
            falloff,
            range: None,
        }
    }

    #[test]
    fn without_falloff_a_point_light_is_as_bright_far_away() {
        let lamp = light(LightKind::Point {
            position: Vec3::new(0.0, 3.0, 4.0),
        });
        let seen = lamp
            .illuminate(Vec3::ZERO)
            .map(|l| (l.distance, l.irradiance));
        assert_eq!(seen, Some((5.0, Rgb::new(2.0, 1.0, 0.5))));
    }

    #[test]
    fn twice_the_distance_is_a_quarter_of_the_light() {
        let lamp = Light {
            falloff: Falloff::InverseSquare,
            ..light(LightKind::Point {
                position: Vec3::ZERO,
            })
        };
        let at = |x: f32| lamp.illuminate(Vec3::X * x).map_or(0.0, |l| l.irradiance.r);
        assert_eq!(at(1.0), 2.0);
        assert_eq!(at(2.0), 0.5);
    }

    #[test]
    fn a_direction_is_where_the_light_travels() {
        let sun = light(LightKind::Directional {
            direction: Vec3::NEG_Y,
        });
        assert_eq!(sun.illuminate(Vec3::ONE).map(|l| l.to_light), Some(Vec3::Y));
    }

    #[test]
    fn a_spot_ramps_from_its_inner_to_its_outer_cone() {
        let (position, direction) = (Vec3::ZERO, Vec3::NEG_Y);
        let spot = light(LightKind::Spot {
            position,
            direction,
            inner_angle: 0.0,
            outer_angle: FRAC_PI_4,
        });
        let at = |x: f32| {
            spot.illuminate(Vec3::new(x, -1.0, 0.0))
                .map_or(0.0, |l| l.irradiance.r)
        };
        assert_eq!(at(0.0), 2.0);
        assert_eq!(at(1.01), 0.0);
        // (cos a - cos 45°) / (1 - cos 45°), squared
        let (cos, outer) = (1.0 / 1.25f32.sqrt(), 0.5f32.sqrt());
        let ramp = (cos - outer) / (1.0 - outer);
        assert!((at(0.5) - 2.0 * ramp * ramp).abs() < 1e-5);
    }

    #[test]
    fn range_ends_the_light() {
        let lamp = Light {
            range: Some(2.0),
            ..light(LightKind::Point {
                position: Vec3::ZERO,
            })
        };
        assert!(lamp.illuminate(Vec3::X * 2.0).is_none());
        assert_eq!(
            lamp.illuminate(Vec3::X).map(|l| l.irradiance.r),
            Some(2.0 * 15.0 / 16.0)
        );
    }
}
