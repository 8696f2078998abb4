//! A lookup between the pixels of an environment.

use super::equirect::Equirect;
use crate::color::Rgb;

/// A picture of all directions, continuous between its pixels.
#[derive(Clone, Debug)]
pub(super) struct Level {
    picture: Equirect,
    /// At +Y and at -Y, where all columns meet: the mean of the nearest row.
    poles: [Rgb; 2],
}

impl Level {
    pub(super) fn new(picture: Equirect) -> Level {
        let mean = |row: Option<&[Rgb]>| {
            let mut sum = Rgb::BLACK;
            row.unwrap_or_default()
                .iter()
                .for_each(|&pixel| sum += pixel);
            sum * (1.0 / picture.width as f32)
        };
        let poles = [
            mean(picture.rows().next()),
            mean(picture.rows().next_back()),
        ];
        Level { picture, poles }
    }

    /// The radiance at a position (0..1 to the right and down): a blend of the nearest four pixels, the first column
    /// being beside the last one.
    pub(super) fn at(&self, (u, v): (f32, f32)) -> Rgb {
        let Equirect { width, height, .. } = self.picture;
        // Pixel centres lie at halves.
        let (x, y) = (u * width as f32 - 0.5, v * height as f32 - 0.5);
        let left = x.floor();
        let columns = [left, left + 1.0].map(|x| (x as i64).rem_euclid(width.into()) as usize);
        let across = |row: u32| {
            let first = row as usize * width as usize;
            let [left_pixel, right_pixel] = columns.map(|column| {
                self.picture
                    .pixels
                    .get(first + column)
                    .copied()
                    .unwrap_or_default()
            });
            left_pixel.mix(right_pixel, x - left)
        };
        let [top, bottom] = self.poles;
        let last = height - 1;
        if y < 0.0 {
            top.mix(across(0), (2.0 * y + 1.0).max(0.0))
        } else if y >= last as f32 {
            across(last).mix(bottom, (2.0 * (y - last as f32)).min(1.0))
        } else {
            across(y as u32).mix(across(y as u32 + 1), y - y.floor())
        }
    }
}
