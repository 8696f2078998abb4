//! Blinn's highlight (Blinn 1977, "Models of Light Reflection for Computer Synthesized Pictures").

use super::Reflectance;
use crate::color::Rgb;
use glam::Vec3;

/// `(k_d (n . l) + k_s max(0, n . h)^s) E`, where `h` lies halfway between `l` and `v`; zero where the light stands
/// behind the surface, so that no highlight leaks through.
#[inline(always)]
pub fn reflected(surface: &Reflectance, n: Vec3, l: Vec3, v: Vec3, e: Rgb) -> Rgb {
    let cos_theta = n.dot(l);
    if cos_theta <= 0.0 {
        return Rgb::BLACK;
    }
    let matt = surface.diffuse * cos_theta;
    if surface.specular == Rgb::BLACK {
        return matt * e;
    }
    (matt + surface.specular * lobe(n, l, v, surface.shininess)) * e
}

/// `max(0, n . h)^s`.
#[inline(never)]
fn lobe(n: Vec3, l: Vec3, v: Vec3, shininess: f32) -> f32 {
    let h = (l + v).normalize_or_zero(); // Zero when the light is exactly behind, as seen from the viewer.
    libm::powf(n.dot(h).max(0.0), shininess)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shade::test_surface::glossy;

    #[test]
    fn the_highlight_is_full_where_the_half_vector_is_the_normal() {
        let (l, v) = (Vec3::new(0.6, 0.8, 0.0), Vec3::new(-0.6, 0.8, 0.0));
        let lit = reflected(&glossy(64.0), Vec3::Y, l, v, Rgb::grey(2.0)).r;
        assert!((lit - 2.0 * (0.5 * 0.8 + 1.0)).abs() < 1e-5);
    }

    #[test]
    fn the_highlight_falls_with_the_cosine_to_the_power_of_the_shininess() {
        // l = n, v at 60 degrees: h at 30 degrees, n . h = cos 30°.
        let v = Vec3::new(0.75f32.sqrt(), 0.5, 0.0);
        let lit = reflected(&glossy(4.0), Vec3::Y, Vec3::Y, v, Rgb::WHITE).r;
        assert!((lit - (0.5 + 0.75 * 0.75)).abs() < 1e-5);
    }

    #[test]
    fn no_highlight_leaks_through_from_behind() {
        let l = Vec3::new(0.8, -0.6, 0.0);
        assert_eq!(
            reflected(&glossy(0.0), Vec3::Y, l, Vec3::Y, Rgb::WHITE),
            Rgb::BLACK
        );
    }
}
