//! The shapes that stand at points, so that series are told apart without colour too.

/// What stands at a series' points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Marker {
    Disc,
    Square,
    Triangle,
    Diamond,
    Cross,
    Downward,
    Hexagon,
}

const MARKERS: [Marker; 7] = [
    Marker::Disc,
    Marker::Square,
    Marker::Triangle,
    Marker::Diamond,
    Marker::Cross,
    Marker::Downward,
    Marker::Hexagon,
];

impl Marker {
    /// Series' colours repeat after seven; by then another shape goes with each.
    pub(super) fn of(series: usize) -> Marker {
        MARKERS[(series + series / MARKERS.len()) % MARKERS.len()]
    }

    /// The corners, about as much area as a disc of `radius`; none for the disc.
    pub(super) fn corners(self, (x, y): (f64, f64), radius: f64) -> Vec<(f64, f64)> {
        let unit: &[(f64, f64)] = match self {
            Marker::Disc => &[],
            Marker::Square => &[(-0.9, -0.9), (0.9, -0.9), (0.9, 0.9), (-0.9, 0.9)],
            Marker::Triangle => &[(0.0, -1.3), (1.2, 0.85), (-1.2, 0.85)],
            Marker::Diamond => &[(0.0, -1.3), (1.3, 0.0), (0.0, 1.3), (-1.3, 0.0)],
            Marker::Cross => &[
                (-0.4, -1.2),
                (0.4, -1.2),
                (0.4, -0.4),
                (1.2, -0.4),
                (1.2, 0.4),
                (0.4, 0.4),
                (0.4, 1.2),
                (-0.4, 1.2),
                (-0.4, 0.4),
                (-1.2, 0.4),
                (-1.2, -0.4),
                (-0.4, -0.4),
            ],
            Marker::Downward => &[(0.0, 1.3), (1.2, -0.85), (-1.2, -0.85)],
            Marker::Hexagon => &[
                (1.1, 0.0),
                (0.55, 0.95),
                (-0.55, 0.95),
                (-1.1, 0.0),
                (-0.55, -0.95),
                (0.55, -0.95),
            ],
        };
        let corner = |&(dx, dy): &(f64, f64)| (x + dx * radius, y + dy * radius);
        unit.iter().map(corner).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    #[test]
    fn no_two_of_forty_nine_series_look_alike() {
        let looks: HashSet<_> = (0..49)
            .map(|i| {
                (
                    i % 7,
                    Marker::of(i).corners((0.0, 0.0), 1.0).len(),
                    format!("{:?}", Marker::of(i)),
                )
            })
            .collect();
        assert_eq!(looks.len(), 49);
    }
}
