//! Phong's highlight (Phong 1975, "Illumination for Computer Generated Pictures").

use super::{Reflectance, mirror};
use crate::color::Rgb;
use glam::Vec3;

/// `(k_d (n . l) + k_s max(0, r . v)^s) E`, where `r` is `l` mirrored about `n`; zero where the light stands behind the
/// surface, so that no highlight leaks through.
pub fn reflected(surface: &Reflectance, n: Vec3, l: Vec3, v: Vec3, e: Rgb) -> Rgb {
    let cos_theta = n.dot(l);
    if cos_theta <= 0.0 {
        return Rgb::BLACK;
    }
    if surface.specular == Rgb::BLACK {
        return surface.diffuse * cos_theta * e;
    }
    let r = mirror::direction(-l, n);
    (surface.diffuse * cos_theta
        + surface.specular * libm::powf(r.dot(v).max(0.0), surface.shininess))
        * e
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shade::test_surface::glossy;

    #[test]
    fn the_highlight_follows_the_angle_to_the_mirrored_light() {
        let l = Vec3::new(0.6, 0.8, 0.0);
        let lit = |v| reflected(&glossy(3.0), Vec3::Y, l, v, Rgb::WHITE).r;
        assert!((lit(Vec3::new(-0.6, 0.8, 0.0)) - (0.5 * 0.8 + 1.0)).abs() < 1e-6);
        // r . v = 0.8 seen from straight above.
        assert!((lit(Vec3::Y) - (0.4 + 0.8f32 * 0.8 * 0.8)).abs() < 1e-6);
    }

    #[test]
    fn no_highlight_leaks_through_from_behind() {
        let lit = reflected(&glossy(0.0), Vec3::Y, Vec3::NEG_Y, Vec3::Y, Rgb::WHITE);
        assert_eq!(lit, Rgb::BLACK);
    }
}
