//! Roughness along a grain (KHR_materials_anisotropy), as one number.

/// The roughness whose round lobe is as high as the long one of a surface of this `roughness` across its grain.
///
/// Along the grain `alpha` is `mix(roughness^2, 1, strength^2)`, across it `roughness^2`; the lobe's height is
/// `1 / (π alpha alpha)` (KHR_materials_anisotropy), so that the geometric mean stands for both.
pub fn mean_roughness(roughness: f32, strength: f32) -> f32 {
    let across = roughness * roughness;
    let along = across + (1.0 - across) * strength * strength;
    (across * along).sqrt().sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn strength_makes_it_rougher_up_to_the_mean_with_full_roughness() {
        assert!((mean_roughness(0.5, 0.0) - 0.5).abs() < 1e-6);
        // alpha 1/4 and 1: the mean is 1/2.
        assert!((mean_roughness(0.5, 1.0) - 0.5f32.sqrt()).abs() < 1e-6);
        // alpha 1/4 and mix(1/4, 1, 1/4) = 7/16: the mean is sqrt(7) / 8.
        assert!((mean_roughness(0.5, 0.5).powi(2) - 7f32.sqrt() / 8.0).abs() < 1e-6);
        assert_eq!(mean_roughness(1.0, 0.7), 1.0);
    }
}
