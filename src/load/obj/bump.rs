//! Bump maps: normals that are taken as they are, and heights that become normals.
//!
//! MTL's `map_Bump` is a picture of heights; many writers put a picture of normals there. Which one it is shows in its
//! mean colour: normals lean little on average, so theirs is near (0.5, 0.5, 1), and heights are grey.

use crate::texture::{Image, Pixels};
use glam::DVec3;

/// How far from 0.5 the mean red and green of normals may be.
const MEAN_LEAN: f64 = 0.12;

/// The least mean blue of normals.
const LEAST_MEAN_BLUE: f64 = 0.75;

/// Whether an image holds normals rather than heights.
pub(super) fn looks_like_normals(image: &Image) -> bool {
    let count = pixel_count(image);
    let sum = (0..count).fold([0.0; 3], |sum: [f64; 3], at| {
        let [r, g, b, _] = pixel(image, at);
        [sum[0] + r, sum[1] + g, sum[2] + b]
    });
    let [r, g, b] = sum.map(|sum| sum / count.max(1) as f64);
    (r - 0.5).abs() < MEAN_LEAN && (g - 0.5).abs() < MEAN_LEAN && b > LEAST_MEAN_BLUE
}

/// Which number of a pixel is its height (`-imfchan`).
pub(super) fn height_of(channel: Option<u8>) -> fn([f64; 4]) -> f64 {
    match channel {
        Some(b'r') => |[r, _, _, _]| r,
        Some(b'g') => |[_, g, _, _]| g,
        Some(b'b') => |[_, _, b, _]| b,
        Some(b'm') => |[_, _, _, a]| a,
        _ => |[r, g, b, _]| (r + g + b) / 3.0,
    }
}

/// A picture of normals from one of heights in 0..1, with more digits, since slopes are small.
///
/// The format gives heights no unit. Here a height of 1 is one pixel high: at pixel (x, y) the normal is
/// `(h(x-1, y) - h(x+1, y), h(x, y+1) - h(x, y-1), 2)`, of unit length (y grows downward, green up). To multiply
/// heights is to multiply the first two: what [`crate::material::NormalMap::scale`] does.
pub(super) fn normals_from_heights(
    image: &Image,
    height: fn([f64; 4]) -> f64,
    clamps: bool,
) -> Image {
    let (width, rows) = (image.width as usize, image.height as usize);
    let heights: Vec<f64> = (0..pixel_count(image))
        .map(|at| height(pixel(image, at)))
        .collect();
    let at = |x: usize, y: usize| heights.get(y * width + x).copied().unwrap_or_default();
    // The neighbours on both sides, as the texture's wrap has them.
    let around = |i: usize, count: usize| {
        if clamps {
            (i.saturating_sub(1), (i + 1).min(count.saturating_sub(1)))
        } else {
            ((i + count - 1) % count, (i + 1) % count)
        }
    };
    let normals = (0..rows).flat_map(|y| (0..width).map(move |x| (x, y)));
    let pixels = normals.map(|(x, y)| {
        let (left, right) = around(x, width);
        let (above, below) = around(y, rows);
        let across = at(left, y) - at(right, y);
        let up = at(x, below) - at(x, above);
        let normal = DVec3::new(across, up, 2.0).normalize_or(DVec3::Z);
        let [r, g, b] = (normal * 0.5 + 0.5)
            .to_array()
            .map(|part| (part * 65535.0 + 0.5) as u16);
        [r, g, b, u16::MAX]
    });
    Image {
        name: image.name.clone(),
        width: image.width,
        height: image.height,
        pixels: Pixels::Sixteen(pixels.collect()),
    }
}

fn pixel_count(image: &Image) -> usize {
    match &image.pixels {
        Pixels::Eight(pixels) => pixels.len(),
        Pixels::Sixteen(pixels) => pixels.len(),
    }
}

/// A pixel in 0..1, as stored.
pub(super) fn pixel(image: &Image, at: usize) -> [f64; 4] {
    match &image.pixels {
        Pixels::Eight(pixels) => {
            let pixel = pixels.get(at).copied().unwrap_or_default();
            pixel.map(|channel| f64::from(channel) / 255.0)
        }
        Pixels::Sixteen(pixels) => {
            let pixel = pixels.get(at).copied().unwrap_or_default();
            pixel.map(|channel| f64::from(channel) / 65535.0)
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn image(width: u32, pixels: Vec<[u8; 4]>) -> Image {
        Image {
            name: String::new(),
            width,
            height: pixels.len() as u32 / width,
            pixels: Pixels::Eight(pixels),
        }
    }

    fn grey(width: u32, heights: &[u8]) -> Image {
        image(width, heights.iter().map(|&h| [h, h, h, 255]).collect())
    }

    fn normal_at(map: &Image, at: usize) -> DVec3 {
        let [x, y, z, _] = pixel(map, at);
        DVec3::new(x, y, z) * 2.0 - 1.0
    }

    #[test]
    fn normals_are_known_by_their_mean() {
        assert!(looks_like_normals(&image(1, vec![[128, 128, 255, 255]])));
        let leaning = vec![[28, 128, 200, 255], [228, 128, 200, 255]];
        assert!(looks_like_normals(&image(1, leaning)));
        for height in [0, 128, 255] {
            assert!(!looks_like_normals(&grey(1, &[height])));
        }
    }

    #[test]
    fn a_level_surface_looks_straight_up() {
        let map = normals_from_heights(&grey(2, &[77; 4]), height_of(None), false);
        assert!((0..4).all(|at| (normal_at(&map, at) - DVec3::Z).length() < 1e-4));
    }

    #[test]
    fn a_ramp_leans_away_from_its_rise() {
        // Heights 0, 0.2, 0.4 to the right: a slope of 0.2 for each pixel.
        let map = normals_from_heights(&grey(3, &[0, 51, 102]), height_of(None), true);
        let expected = DVec3::new(-0.2, 0.0, 1.0).normalize();
        assert!((normal_at(&map, 1) - expected).length() < 1e-4);
        // The same ramp downward the picture: rising toward its lower edge, so leaning up.
        let map = normals_from_heights(&grey(1, &[0, 51, 102]), height_of(None), true);
        let expected = DVec3::new(0.0, 0.2, 1.0).normalize();
        assert!((normal_at(&map, 1) - expected).length() < 1e-4);
    }

    #[test]
    fn the_edge_sees_the_other_side_where_the_texture_repeats() {
        let heights = grey(3, &[0, 0, 255]);
        let lean =
            |clamps| normal_at(&normals_from_heights(&heights, height_of(None), clamps), 0).x;
        assert!(lean(false) > 0.3 && lean(true).abs() < 1e-4);
    }

    #[test]
    fn a_channel_can_be_the_height() {
        let ramp = image(3, vec![[0, 0, 0, 0], [51, 9, 9, 9], [102, 0, 0, 0]]);
        let of_red = normals_from_heights(&ramp, height_of(Some(b'r')), true);
        let expected = DVec3::new(-0.2, 0.0, 1.0).normalize();
        assert!((normal_at(&of_red, 1) - expected).length() < 1e-4);
    }
}
