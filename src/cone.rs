//! Ray cones: how wide a ray is, for textures to show all that it sees (Akenine-Möller et al. 2019, "Texture Level of
//! Detail Strategies for Real-Time Ray Tracing", Ray Tracing Gems, ch. 20).
//!
//! A cone is followed as optics follows rays that stay near an axis: by its width and its angle, both small, both signed.

/// A cone around a ray.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Cone {
    /// The diameter where the ray begins, in the scene's unit; below zero behind a focus.
    pub width: f32,
    /// What the diameter grows by with each unit of the ray: an angle in radians, as long as it is small.
    pub spread: f32,
}

impl Cone {
    /// A ray that is not wide at all, and stays so at every surface.
    pub const POINT: Cone = Cone {
        width: 0.0,
        spread: 0.0,
    };

    /// The diameter at `t` along the ray, in the scene's unit.
    pub fn width_at(self, t: f32) -> f32 {
        (self.width + self.spread * t).abs()
    }

    /// The cone of the mirror ray from a surface at `t`: `curvature` is one over its radius, above zero where it bulges
    /// toward the ray; `lobe` is the angle over which a rough mirror scatters, in radians.
    pub fn mirrored(self, t: f32, curvature: f32, lobe: f32) -> Cone {
        let width = self.width + self.spread * t;
        Cone {
            width,
            spread: self.spread + 2.0 * curvature * width + lobe,
        }
    }

    /// The cone behind a boundary at `t`, `m` being the index of refraction behind it over the one before it: as if the
    /// ray came head-on.
    pub fn refracted(self, t: f32, curvature: f32, m: f32) -> Cone {
        let width = self.width + self.spread * t;
        Cone {
            width,
            spread: self.spread / m - curvature * width * (1.0 - 1.0 / m),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const CONE: Cone = Cone {
        width: 0.5,
        spread: 0.1,
    };

    #[test]
    fn a_flat_mirror_leaves_the_cone_as_it_was() {
        let mirrored = CONE.mirrored(2.0, 0.0, 0.0);
        assert!((mirrored.width_at(3.0) - CONE.width_at(5.0)).abs() < 1e-6);
    }

    #[test]
    fn a_hollow_mirror_has_its_focus_at_half_its_radius() {
        let parallel = Cone {
            width: 0.1,
            spread: 0.0,
        };
        let mirrored = parallel.mirrored(7.0, -1.0 / 4.0, 0.0);
        assert!(mirrored.width_at(2.0) < 1e-7);
        // As wide again behind it.
        assert!((mirrored.width_at(4.0) - 0.1).abs() < 1e-7);
    }

    #[test]
    fn a_glass_ball_has_its_focus_where_lens_makers_say() {
        // n R / (2 (n - 1)) from the middle of the ball: 1.5 R.
        let (parallel, n) = (
            Cone {
                width: 0.1,
                spread: 0.0,
            },
            1.5,
        );
        let behind = parallel
            .refracted(3.0, 1.0, n)
            .refracted(2.0, -1.0, 1.0 / n);
        assert!(behind.width_at(0.5) < 1e-7, "{behind:?}");
    }

    #[test]
    fn a_ray_that_is_a_point_stays_one() {
        let bounced = Cone::POINT.mirrored(5.0, 3.0, 0.0).refracted(2.0, 4.0, 1.5);
        assert_eq!(bounced, Cone::POINT);
    }
}
