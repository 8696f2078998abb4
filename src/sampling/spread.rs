//! A progressive (0, 2)-sequence in base 2: the first two dimensions of Sobol' (1967, "On the distribution of points in a
//! cube and the approximate evaluation of integrals").
//!
//! Of its first 4^k points, one lies in each cell of a 2^k x 2^k grid, and in each column and row 4^k times as narrow:
//! edges that are nearly upright or level, where a regular grid of as many samples has only 2^k shades, get 4^k.

/// Point number `number`, both coordinates in 0..1, multiples of 2^-32.
pub(super) fn place(number: u32) -> [f64; 2] {
    // The first dimension has the number's bits in reverse; of the second, each direction number is the one before,
    // xor itself shifted by one (Kollig and Keller 2002, "Efficient Multidimensional Sampling").
    let mut second = 0;
    let (mut direction, mut bits) = (1 << 31, number);
    while bits != 0 {
        if bits & 1 == 1 {
            second ^= direction;
        }
        direction ^= direction >> 1;
        bits >>= 1;
    }
    [number.reverse_bits(), second].map(|bits: u32| f64::from(bits) / 2f64.powi(32))
}

/// Point number `number` of `count`, in the middle of the narrowest columns and rows that hold one point each: one point
/// alone lies at the centre.
pub(super) fn place_of(number: u32, count: u32) -> [f64; 2] {
    let cells = f64::from(count.max(1).next_power_of_two());
    place(number).map(|along| along + 0.5 / cells)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// How many of the points lie in each cell of a grid.
    fn in_cells(points: &[[f64; 2]], columns: usize, rows: usize) -> Vec<usize> {
        let mut cells = vec![0; columns * rows];
        for [x, y] in points {
            let (column, row) = (x * columns as f64, y * rows as f64);
            cells[row as usize * columns + column as usize] += 1;
        }
        cells
    }

    #[test]
    fn each_power_of_two_of_points_has_one_in_every_cell_of_every_shape() {
        for m in 0..9 {
            let count = 1 << m;
            let points: Vec<_> = (0..count).map(|n| place_of(n, count)).collect();
            for across in 0..=m {
                let cells = in_cells(&points, 1 << across, 1 << (m - across));
                assert!(cells.iter().all(|&n| n == 1), "{count} points, {across}");
            }
        }
    }

    #[test]
    fn the_next_points_fill_the_next_cells() {
        // Every 4 in a row are stratified 2 x 2, every 16 in a row 4 x 4.
        let points: Vec<_> = (0..1024).map(|n| place_of(n, 1024)).collect();
        for (count, side) in [(4, 2), (16, 4), (64, 8)] {
            for points in points.chunks(count) {
                assert!(in_cells(points, side, side).iter().all(|&n| n == 1));
            }
        }
    }

    #[test]
    fn one_point_alone_lies_at_the_centre() {
        assert_eq!(place_of(0, 1), [0.5, 0.5]);
    }

    #[test]
    fn all_points_there_can_be_are_inside() {
        for count in [1, 3, 1000, 65_536] {
            let inside = |along: f64| 0.0 < along && along < 1.0;
            assert!((0..count).all(|n| place_of(n, count).into_iter().all(inside)));
        }
    }
}
