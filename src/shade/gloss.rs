//! What a Phong surface sends back of an environment, of which its formula does not speak.
//!
//! A lamp has no extent, so that `k_s cos^s` may be as great as it likes; light from everywhere can only come back once.
//! `k_s` is read as Blender reads it ("Specular" of its OBJ importer): 0.5 is what glass reflects, 4 % head-on.

use super::facets::{albedo, roughness_of};
use crate::color::Rgb;

/// What a surface of `k_s = 1` reflects head-on.
const F0: f32 = 0.08;

/// The share of light from everywhere that comes back as gloss, toward a viewer at `cos_view`, 0..1; none from matt
/// surfaces. `specular` is `k_s`, of which more than 1 is 1.
pub fn of_phong(specular: Rgb, shininess: f32, cos_view: f32) -> Rgb {
    let [head_on, edge] = albedo(cos_view, roughness_of(shininess));
    let share = F0 * head_on + edge;
    specular.map(|k| k.min(1.0) * share)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn head_on_a_smooth_surface_reflects_what_glass_does_where_specular_is_one_half() {
        let found = of_phong(Rgb::new(0.5, 0.0, 9.0), 1e6, 1.0);
        assert!((found.r - 0.04).abs() < 1e-3 && found.g == 0.0 && (found.b - 0.08).abs() < 2e-3);
    }

    #[test]
    fn no_light_is_made() {
        for step in 0..=10 {
            let found = of_phong(Rgb::WHITE, 30.0, step as f32 / 10.0);
            assert!((0.0..=1.0).contains(&found.r));
        }
    }
}
