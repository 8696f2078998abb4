//! The parameters of KHR_materials_pbrSpecularGlossiness: `F0 = specular`, `k_d = diffuse`, `roughness = 1 - glossiness`.
//!
//! The extension's `diffuse (1 - max specular)` is what [`microfacet`](super::microfacet) makes of it, at any angle.

use super::microfacet::Parameters;
use crate::color::Rgb;

/// The formulas in this file's head.
pub fn parameters(diffuse: Rgb, specular: Rgb, glossiness: f32) -> Parameters {
    Parameters {
        diffuse,
        through: Rgb::BLACK,
        f0: specular,
        f90: 1.0,
        roughness: 1.0 - glossiness,
        ambient_access: 1.0,
        film: None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::shade::metallic_roughness::{self, Dielectric};
    use crate::shade::microfacet::reflectance;

    #[test]
    fn the_specifications_gold_is_metallic_roughness_gold() {
        let gold = Rgb::new(1.0, 0.766, 0.336);
        let [glossy, metal] = [
            parameters(Rgb::BLACK, gold, 0.9),
            metallic_roughness::parameters(gold, 1.0, 1.0 - 0.9, Dielectric::PLAIN),
        ]
        .map(|p| reflectance(p, 0.3, Rgb::BLACK));
        assert_eq!(glossy, metal);
    }

    #[test]
    fn the_greatest_specular_channel_takes_its_share_of_the_diffuse_light() {
        let p = parameters(Rgb::new(1.0, 0.5, 0.0), Rgb::new(0.2, 0.75, 0.1), 1.0);
        let surface = reflectance(p, 1.0, Rgb::BLACK);
        assert_eq!(surface.diffuse, Rgb::new(0.25, 0.125, 0.0));
    }
}
