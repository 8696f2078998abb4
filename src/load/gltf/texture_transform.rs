//! KHR_texture_transform: texture coordinates that are moved, turned and scaled for one use of a texture.

use glam::{Mat3, Vec3};

/// As files call it.
pub(super) const NAME: &str = "KHR_texture_transform";

/// What it says of a use of a texture.
#[derive(serde::Deserialize)]
#[serde(rename_all = "camelCase", default)]
pub(super) struct TextureTransform {
    /// Where the texture's origin goes, in textures.
    offset: [f32; 2],
    /// Radians, counter-clockwise about the origin for someone who sees v run down.
    rotation: f32,
    /// Multiplies the coordinates.
    scale: [f32; 2],
    /// Stands for the use's own set of coordinates.
    pub(super) tex_coord: Option<u32>,
}

impl Default for TextureTransform {
    fn default() -> TextureTransform {
        TextureTransform {
            offset: [0.0; 2],
            rotation: 0.0,
            scale: [1.0; 2],
            tex_coord: None,
        }
    }
}

impl TextureTransform {
    /// From the mesh's coordinates to the texture's: scale, then rotation, then offset, as in the specification's GLSL.
    /// `None` where they are the same.
    ///
    /// # Errors
    ///
    /// A number of it is too great to have a place in a texture.
    pub(super) fn matrix(&self) -> Result<Option<Mat3>, String> {
        let ([du, dv], [su, sv]) = (self.offset, self.scale);
        // In double precision, so that a quarter turn leaves less than a float can hold of the cosine.
        let angle = f64::from(self.rotation);
        let (sin, cos) = (libm::sin(angle) as f32, libm::cos(angle) as f32);
        let matrix = Mat3::from_cols(
            Vec3::new(cos * su, -sin * su, 0.0),
            Vec3::new(sin * sv, cos * sv, 0.0),
            Vec3::new(du, dv, 1.0),
        );
        if matrix.is_finite() {
            Ok((matrix != Mat3::IDENTITY).then_some(matrix))
        } else {
            Err(format!("{NAME} has a number that is too great"))
        }
    }
}

#[cfg(test)]
mod tests {
    #![allow(clippy::unwrap_used, reason = "a test that panics has failed")]

    use super::*;
    use glam::Vec2;

    fn matrix(json: &str) -> Option<Mat3> {
        let transform: TextureTransform = serde_json::from_str(json).unwrap();
        transform.matrix().unwrap()
    }

    #[test]
    fn the_specifications_example_shows_the_turned_lower_left_quarter() {
        let json = r#"{"offset": [0, 1], "rotation": 1.57079632679, "scale": [0.5, 0.5]}"#;
        let matrix = matrix(json).unwrap();
        // By hand, from `translation * rotation * scale` with the columns (cos, -sin) and (sin, cos).
        for (from, to) in [
            ([0.0, 0.0], [0.0, 1.0]),
            ([1.0, 0.0], [0.0, 0.5]),
            ([0.0, 1.0], [0.5, 1.0]),
            ([1.0, 1.0], [0.5, 0.5]),
        ] {
            let found = matrix.transform_point2(Vec2::from(from));
            assert!((found - Vec2::from(to)).length() < 1e-6, "{from:?} {found}");
        }
    }

    #[test]
    fn scale_comes_before_rotation_and_offset_last() {
        let matrix =
            matrix(r#"{"offset": [0.25, -2], "rotation": 0.5, "scale": [2, -3]}"#).unwrap();
        let (u, v) = (2.0 * 0.7_f32, -3.0 * 0.1_f32);
        let (sin, cos) = (0.479_425_54_f32, 0.877_582_55_f32);
        let expected = Vec2::new(cos * u + sin * v + 0.25, -sin * u + cos * v - 2.0);
        let found = matrix.transform_point2(Vec2::new(0.7, 0.1));
        assert!((found - expected).length() < 1e-6, "{found} {expected}");
    }

    #[test]
    fn nothing_said_is_no_transform_and_too_much_none_either() {
        assert_eq!(matrix("{}"), None);
        assert_eq!(matrix(r#"{"texCoord": 1}"#), None);
        let huge: TextureTransform = serde_json::from_str(r#"{"scale": [1e39, 1]}"#).unwrap();
        assert!(huge.matrix().is_err());
    }
}
