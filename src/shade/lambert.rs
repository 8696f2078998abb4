//! Lambert's cosine law (Lambert 1760, "Photometria").

use super::Reflectance;
use crate::color::Rgb;
use glam::Vec3;

/// `k_d (n . l) E`, zero where the light stands behind the surface.
#[inline]
pub fn reflected(surface: &Reflectance, n: Vec3, l: Vec3, e: Rgb) -> Rgb {
    surface.diffuse * n.dot(l).max(0.0) * e
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shade::test_surface::glossy;

    #[test]
    fn a_wall_lit_at_sixty_degrees_is_half_as_bright() {
        let slanted = Vec3::new(0.75f32.sqrt(), 0.5, 0.0);
        let at = |l| reflected(&glossy(1.0), Vec3::Y, l, Rgb::WHITE).g;
        assert!((at(slanted) / at(Vec3::Y) - 0.5).abs() < 1e-6);
        assert_eq!(at(Vec3::NEG_Y), 0.0);
    }
}
