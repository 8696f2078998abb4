//! Which corners make which triangle (glTF 2.0, section 3.7.2.1).

use gltf::json::mesh::Mode;

/// The triangles of `corners`, counter-clockwise seen from the front. None where the mode draws points or lines.
pub(super) fn triangles(mode: Mode, corners: &[u32]) -> Vec<[u32; 3]> {
    match mode {
        Mode::Triangles => corners.as_chunks().0.to_vec(),
        Mode::TriangleStrip => corners
            .windows(3)
            .enumerate()
            .filter_map(|(i, corners)| match *corners {
                // Every second one is wound the other way round in the strip.
                [a, b, c] => Some(if i % 2 == 0 { [a, b, c] } else { [a, c, b] }),
                _ => None,
            })
            .collect(),
        Mode::TriangleFan => {
            let (Some(&hub), Some(rim)) = (corners.first(), corners.get(1..)) else {
                return Vec::new();
            };
            rim.windows(2)
                .filter_map(|pair| match *pair {
                    [b, c] => Some([b, c, hub]),
                    _ => None,
                })
                .collect()
        }
        Mode::Points | Mode::Lines | Mode::LineLoop | Mode::LineStrip => Vec::new(),
    }
}

/// How many corners are left over: a triangle's or a line's first without its rest.
pub(super) fn left_over(mode: Mode, corners: usize) -> usize {
    match mode {
        Mode::Triangles => corners % 3,
        Mode::TriangleStrip | Mode::TriangleFan if corners < 3 => corners,
        _ => 0,
    }
}

/// How many line segments of a mode that draws lines are not drawn.
pub(super) fn lines(mode: Mode, corners: usize) -> usize {
    match mode {
        Mode::Lines => corners / 2,
        Mode::LineStrip => corners.saturating_sub(1),
        Mode::LineLoop if corners > 1 => corners,
        _ => 0,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_strip_turns_every_second_triangle() {
        assert_eq!(
            triangles(Mode::TriangleStrip, &[5, 6, 7, 8, 9]),
            [[5, 6, 7], [6, 8, 7], [7, 8, 9]]
        );
    }

    #[test]
    fn a_fan_shares_its_first_corner() {
        assert_eq!(
            triangles(Mode::TriangleFan, &[5, 6, 7, 8]),
            [[6, 7, 5], [7, 8, 5]]
        );
    }

    #[test]
    fn too_few_corners_make_no_triangle() {
        for mode in [Mode::Triangles, Mode::TriangleStrip, Mode::TriangleFan] {
            for corners in [&[][..], &[1], &[1, 2]] {
                assert!(triangles(mode, corners).is_empty());
                assert_eq!(left_over(mode, corners.len()), corners.len());
            }
        }
        assert_eq!(triangles(Mode::Triangles, &[0, 1, 2, 3, 4]), [[0, 1, 2]]);
        assert_eq!(left_over(Mode::Triangles, 5), 2);
    }

    #[test]
    fn segments_are_counted_by_mode() {
        let counts =
            [Mode::Lines, Mode::LineStrip, Mode::LineLoop, Mode::Points].map(|mode| lines(mode, 4));
        assert_eq!(counts, [2, 3, 4, 0]);
    }
}
